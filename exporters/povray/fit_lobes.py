"""The table Glint_Lobe_Share, Glint_Lobe_Width of glint.inc: GGX as a sum of Beckmann lobes.

1 / (1 + x)^2 = sum of share / width^2 exp(-x / width^2), x the squared slope over alpha^2, for x from 0 to 49. Least squares in
the relative error by Levenberg and Marquardt's method, with weights that grow where the error is large, which makes it even.
"""

import numpy as np

LOBES = 5
REACH = 7.0  # widths
ROUNDS = 3000

x = np.expm1(np.linspace(0.0, np.log1p(REACH**2), 600))
wanted = 1.0 / (1.0 + x) ** 2


def error(p):
    """Relative error; p: logarithms of amplitudes and of rates."""
    amplitude, rate = np.exp(p[:LOBES]), np.exp(p[LOBES:])
    return amplitude @ np.exp(-np.outer(rate, x)) / wanted - 1.0


def jacobian(p):
    steps = 1e-6 * np.eye(2 * LOBES)
    return np.array([(error(p + s) - error(p)) / 1e-6 for s in steps]).T


def fit():
    # GGX is the mean of rates drawn from exp(-rate): its quadrature in log(rate) starts near the fit.
    rate = np.exp(np.linspace(np.log(2.0 / (1.0 + REACH**2)), np.log(4.0), LOBES))
    p = np.log(np.concatenate([0.6 * rate**2 * np.exp(-rate) * np.log(rate[1] / rate[0]), rate]))
    weight, damping = np.ones_like(x), 1e-2
    for i in range(ROUNDS):
        r, j = error(p), jacobian(p)
        a = (j * weight[:, None] ** 2).T @ j
        step = np.linalg.solve(a + damping * np.diag(np.diag(a) + 1e-12), -(j * weight[:, None] ** 2).T @ r)
        better = np.sum((weight * error(p + step)) ** 2) < np.sum((weight * r) ** 2)
        p = p + step if better else p
        damping = max(damping / 3.0, 1e-9) if better else min(damping * 3.0, 1e6)
        if i % 15 == 14:
            e = np.abs(error(p))
            weight = weight * (e / e.max() + 0.02) ** 0.25
            weight /= weight.max()
    return p


result = fit()
order = np.argsort(-result[LOBES:])
rate = np.exp(result[LOBES:])[order]
share = np.exp(result[:LOBES])[order] / rate
print("share:", ", ".join(f"{s:.6f}" for s in share))
print("width:", ", ".join(f"{w:.6f}" for w in rate**-0.5))
print(f"largest error {np.abs(error(result)).max():.4f}, sum of shares {share.sum():.4f}")
