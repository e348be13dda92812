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

/* log2(1 - p) for p in [0, .5], by -2 atanh(p / (2 - p)): keeps its relative precision down to the smallest p. */
static inline vfloat log2_of_miss(vfloat p)
{
    const vfloat s = p / (2.0F - p);
    const vfloat z = s * s;
    vfloat q = 0.0769231F * z + 0.0909091F;
    q = q * z + 0.1111111F;
    q = q * z + 0.1428571F;
    q = q * z + 0.2F;
    q = q * z + 0.33333333F;
    return -2.88539008F * (s + s * (q * z));
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

/* *e = 2^t and *missing = 1 - 2^t, which keeps its precision near 0, both times 2^scale, for t in [-90, 0]. A minimax
 * fit, continuous where the exponent changes: the error is 6e-9. */
static inline void exp2_both(vfloat t, const int scale, vfloat *missing, vfloat *e)
{
    const vfloat n = floor_f(t + 0.5F), r = t - n;
    vfloat p = 1.53238867e-4F * r + 1.33898433e-3F;
    p = p * r + 9.61839336e-3F;
    p = p * r + 5.55036458e-2F;
    p = p * r + 2.40226495e-1F;
    p = p * r + 6.93147181e-1F;
    const vfloat s = exp2_i(to_int(n) + scale), qs = p * r * s;
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

/* sin and cos of pi (y + 1/2) for y in [-1/2, 1/2]: the cosine, -sin(pi y), keeps its relative precision near 0. */
static inline void sincos_pi_past_quarter(vfloat y, vfloat *s, vfloat *c)
{
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

/* sin and cos of pi x for x in [0, 1). */
static inline void sincos_pi(vfloat x, vfloat *s, vfloat *c)
{
    sincos_pi_past_quarter(x - 0.5F, s, c);
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

/* The same for x = 2^-31 u, a uniform of 32 bits, from a table: z / x is a cubic in l, which is -log2(1 - x^2) but a
 * straight line between powers of two; one for each of the first seven of these, and one for all beyond. Error below
 * .0003 within 2 sigma, .00036 in the mean square, and .019 within 5, .006 of it rounding of x^2; its variance is 1 to
 * 1e-6. A least-squares fit to the density, continuous from one to the next. */
static inline vfloat normal_quantile_i(vint u)
{
    static const float c0[8] = { 1.25284540e+00F * 0x1p-31F, 1.29744460e+00F * 0x1p-31F,  1.17248539e+00F * 0x1p-31F,
                                 7.00901500e-01F * 0x1p-31F, -2.22950932e-01F * 0x1p-31F, -2.63588397e+00F * 0x1p-31F,
                                 1.16381668e+01F * 0x1p-31F, 1.21314886e+00F * 0x1p-31F };
    static const float c1[8] = { 1.70535661e-01F * 0x1p-54F,  2.40512986e-01F * 0x1p-54F, 5.25712991e-01F * 0x1p-54F,
                                 9.89647827e-01F * 0x1p-54F,  1.57770417e+00F * 0x1p-54F, 2.79469777e+00F * 0x1p-54F,
                                 -4.19767086e+00F * 0x1p-54F, 2.73907483e-01F * 0x1p-54F };
    static const float c2[8] = { 2.24695236e-02F * 0x1p-77F,  -8.94252661e-02F * 0x1p-77F, -1.98272243e-01F * 0x1p-77F,
                                 -2.95221860e-01F * 0x1p-77F, -3.75427601e-01F * 0x1p-77F, -5.41731709e-01F * 0x1p-77F,
                                 6.28875127e-01F * 0x1p-77F,  -5.36882273e-03F * 0x1p-77F };
    static const float c3[8] = { 4.13560871e-02F * 0x1p-100F,  3.86743488e-02F * 0x1p-100F, 3.74177376e-02F * 0x1p-100F,
                                 3.56520315e-02F * 0x1p-100F,  3.33851392e-02F * 0x1p-100F, 3.72696815e-02F * 0x1p-100F,
                                 -2.96825645e-02F * 0x1p-100F, 6.06515601e-05F * 0x1p-100F };
    const vfloat x = to_float(u);
    /* The float after 2^62, so that something is left. */
    const vfloat one = splat(0x1.000002p62F), w = one - x * x;
    const vint l = (vint)(bits_of(one) - bits_of(w)); /* times 2^23 */
    const vint part = min_i(l >> 23, splat_i(7));
    const vfloat f = to_float(l);
    const vfloat r = lookup_f(c3, part) * f + lookup_f(c2, part);
    return x * ((r * f + lookup_f(c1, part)) * f + lookup_f(c0, part));
}

#endif
