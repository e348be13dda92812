/* exp, log, trigonometry and the normal quantile in lanes: the same bits on every machine, which libm does not promise.
 *
 * Polynomials for log and exp: Cephes, single precision (coefficients of S. Moshier's minimax fits).
 */
#ifndef MATH_ELEMENTARY_H
#define MATH_ELEMENTARY_H

#include "math/lanes.h"

#define MATH_PI 3.14159265358979323846F

/* Natural logarithm of a normal x > 0; error below 2 ulp. */
static inline vfloat log_f(vfloat x)
{
    vint e = exponent_of(x);
    vfloat m = mantissa_of(x);
    const vmask big = less(splat(1.41421356F), m);
    m = choose(big, m * 0.5F, m);
    const vfloat ef = to_float(e - mask_bits(big));
    const vfloat f = m - 1.0F;
    const vfloat z = f * f;
    vfloat p = 7.0376836292e-2F * f - 1.1514610310e-1F;
    p = p * f + 1.1676998740e-1F;
    p = p * f - 1.2420140846e-1F;
    p = p * f + 1.4249322787e-1F;
    p = p * f - 1.6668057665e-1F;
    p = p * f + 2.0000714765e-1F;
    p = p * f - 2.4999993993e-1F;
    p = p * f + 3.3333331174e-1F;
    p = p * f * z;
    p = p + ef * -2.12194440e-4F;
    p = p - 0.5F * z;
    return (f + p) + ef * 0.693359375F;
}

/* log(1 - p) for p in [0, .5], by -2 atanh(p / (2 - p)): keeps its relative precision down to the smallest p. */
static inline vfloat log1m_half(vfloat p)
{
    const vfloat s = p / (2.0F - p);
    const vfloat z = s * s;
    vfloat q = 0.0769231F * z + 0.0909091F;
    q = q * z + 0.1111111F;
    q = q * z + 0.1428571F;
    q = q * z + 0.2F;
    q = q * z + 0.33333333F;
    return -2.0F * (s + s * (q * z));
}

/* t = *n log(2) + what is returned, *n whole, the rest at most log(2) / 2. log(2) comes in two parts, of which the
 * first has so few bits that its product is exact (Cody and Waite). */
static inline vfloat exp_rest(vfloat t, vfloat *n)
{
    *n = floor_f(t * 1.44269504F + 0.5F);
    const vfloat r = t - *n * 0.693359375F;
    return r + *n * 2.12194440e-4F;
}

/* exp(t) = (*q + 1) * *scale, *q the exponential of what is left of t less one. */
static inline void exp_reduce(vfloat t, vfloat *q, vfloat *scale)
{
    vfloat n;
    const vfloat r = exp_rest(t, &n);
    vfloat p = 1.9875691500e-4F * r + 1.3981999507e-3F;
    p = p * r + 8.3334519073e-3F;
    p = p * r + 4.1665795894e-2F;
    p = p * r + 1.6666665459e-1F;
    p = p * r + 5.0000001201e-1F;
    *q = p * r * r + r;
    *scale = exp2_i(to_int(n));
}

/* *e = exp(t) and *missing = 1 - exp(t), which keeps its precision near 0, both times 2^scale, for t in [-60, 0]. One
 * degree less than above: the error is 6e-9. */
static inline void exp_both(vfloat t, const int scale, vfloat *missing, vfloat *e)
{
    vfloat n;
    const vfloat r = exp_rest(t, &n);
    vfloat p = 1.394112263e-3F * r + 8.366768787e-3F;
    p = p * r + 4.166635272e-2F;
    p = p * r + 1.666654106e-1F;
    p = p * r + 5.000000047e-1F;
    const vfloat q = p * r * r + r, s = exp2_i(to_int(n) + scale), qs = q * s;
    *e = qs + s;
    *missing = (exp2_i(splat_i(scale)) - s) - qs;
}

/* exp(t) for t <= 0, 0 below -87. */
static inline vfloat exp_negative(vfloat t)
{
    vfloat q, s;
    exp_reduce(max_f(t, splat(-87.0F)), &q, &s);
    return choose(less(t, splat(-87.0F)), splat(0.0F), (q + 1.0F) * s);
}

/* sin and cos of pi x for x in [0, 1). */
static inline void sincos_pi(vfloat x, vfloat *s, vfloat *c)
{
    const vfloat y = x - 0.5F; /* sin(pi x) = cos(pi y), cos(pi x) = -sin(pi y) */
    const vfloat z = y * y;
    vfloat a = 0.23533063F - 0.02580689F * z;
    a = a * z - 1.33526277F;
    a = a * z + 4.05871213F;
    a = a * z - 4.93480220F;
    *s = a * z + 1.0F;
    vfloat b = 0.08214589F - 0.0073704F * z;
    b = b * z - 0.59926453F;
    b = b * z + 2.55016404F;
    b = b * z - 5.16771278F;
    b = b * z + 3.14159265F;
    *c = -y * b;
}

/* Angle of (x, y) in turns, in [0, 1): atan2(y, x) / (2 pi) modulo 1. 0 for (0, 0). */
static inline vfloat turn_of(vfloat y, vfloat x)
{
    const vfloat ax = abs_f(x), ay = abs_f(y);
    const vmask steep = less(ax, ay);
    const vfloat low = choose(steep, ax, ay), high = choose(steep, ay, ax);
    const vfloat t0 = low / max_f(high, splat(1e-37F));
    /* atan t = pi/8-range reduction: atan t = atan(tan pi/8) + atan((t - k) / (1 + k t)) */
    const vmask far = less(splat(0.41421356F), t0);
    const vfloat t = choose(far, (t0 - 1.0F) / (t0 + 1.0F), t0);
    const vfloat z = t * t;
    vfloat p = 8.05374449538e-2F * z - 1.38776856032e-1F;
    p = p * z + 1.99777106478e-1F;
    p = p * z - 3.33329491539e-1F;
    vfloat a = p * z * t + t;
    a = choose(far, a + 0.785398163397F, a);
    a = a * 0.159154943F; /* turns, in [0, 1/8] */
    a = choose(steep, 0.25F - a, a);
    a = choose(less(x, splat(0.0F)), 0.5F - a, a);
    a = choose(less(y, splat(0.0F)), 1.0F - a, a);
    return choose(less(a, splat(1.0F)), a, splat(0.0F));
}

/* Normal quantile of u = (1 + x) / 2 for x in (-1, 1): x times a polynomial in -log2(1 - x^2). Error below .0009
 * within 2 sigma and .0031 within 5. */
static inline vfloat normal_quantile(vfloat x)
{
    const vfloat w = max_f(1.0F - x * x, splat(5e-8F));
    const vfloat m = mantissa_of(w);
    vfloat l = 0.08001088F * m - 0.63551112F;
    l = l * m + 2.09940228F;
    l = l * m - 4.04961689F;
    l = l * m + 2.50561466F;
    l = l - exponent_f(w);
    vfloat r = 2.074259067e-08F * l - 2.052269594e-06F;
    r = r * l + 7.779042563e-05F;
    r = r * l - 1.345180591e-03F;
    r = r * l + 6.783757864e-03F;
    r = r * l + 2.312640392e-01F;
    r = r * l + 1.251269917F;
    return x * r;
}

/* The same for x = 2^-31 u, a uniform of 32 bits, with fewer steps: x times the sum of a polynomial in l, which is
 * -log2(1 - x^2) but a straight line between powers of two, and one in the mantissa that makes up for it. Error below
 * .0008 within 2 sigma, where it is .0002 in the mean square, and .023 within 5; its variance is 1 to 1e-6. A least-
 * squares fit to the density, continuous where the exponent changes. */
static inline vfloat normal_quantile_i(vint u)
{
    const float unit = 0x1p-31F;
    const vfloat x = to_float(u);
    /* The float after 2^62, so that something is left. */
    const vfloat w = 0x1.000002p62F - x * x;
    const vfloat l = to_float((vint)(bits_of(splat(0x1p62F)) - bits_of(w))) * 0x1p-23F;
    const vfloat m = mantissa_of(w);
    vfloat k = -3.76786983e-2F * unit * m + 2.49919364e-1F * unit;
    k = k * m - 4.86007205e-1F * unit;
    k = k * m + 1.52734675F * unit;
    vfloat r = -1.51297691e-06F * unit * l + 8.22271669e-05F * unit;
    r = r * l - 1.56520111e-03F * unit;
    r = r * l + 8.66407115e-03F * unit;
    r = r * l + 2.26450446e-01F * unit;
    return x * (r * l + k);
}

#endif
