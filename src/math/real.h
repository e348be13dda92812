/* exp, log and the arc tangent of doubles: the same bits on every machine, which libm does not promise. */
#ifndef MATH_REAL_H
#define MATH_REAL_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#define REAL_PI 3.14159265358979323846

/* Of numbers: fmax and fmin, which look out for NaN, are calls. */
static inline double real_max(double a, double b)
{
    return a > b ? a : b;
}

static inline double real_min(double a, double b)
{
    return a < b ? a : b;
}

/* atan x; relative error below 1e-15. Cephes, double precision (coefficients of S. Moshier's rational fit). */
static inline double real_atan(double x)
{
    const double a = fabs(x);
    const int far = a > 2.414213562373095, middle = !far && a > 0.66;
    const double t = far ? -1.0 / a : middle ? (a - 1.0) / (a + 1.0) : a;
    const double z = t * t;
    const double p =
        ((((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
          1.228866684490136173410e2) *
             z -
         6.485021904942025371773e1) *
        z;
    const double q =
        ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
         4.853903996359136964868e2) *
            z +
        1.945506571482613964425e2;
    const double base = far ? 0.5 * REAL_PI : middle ? 0.25 * REAL_PI : 0.0;
    const double angle = base + (t + t * (p / q));
    return x < 0.0 ? -angle : angle;
}

/* The angle of (x, y) in (-pi, pi]; 0 for (0, 0). */
static inline double real_atan2(double y, double x)
{
    if (x == 0.0 && y == 0.0)
        return 0.0;
    if (fabs(y) > fabs(x))
        return (y > 0.0 ? 0.5 : -0.5) * REAL_PI - real_atan(x / y);
    const double angle = real_atan(y / x);
    return x > 0.0 ? angle : y < 0.0 ? angle - REAL_PI : angle + REAL_PI;
}

/* exp x for x <= 0; 0 below -700. */
static inline double real_exp_negative(double x)
{
    if (!(x > -700.0))
        return 0.0;
    const double n = floor(x * 1.4426950408889634 + 0.5);
    const double r = (x - n * 6.93145751953125e-1) - n * 1.42860682030941723212e-6;
    /* Taylor's series: |r| < .35, the first term left out is 1e-17. */
    double p = 1.0 / 6227020800.0;
    static const double c[13] = { 1.0,
                                  1.0,
                                  0.5,
                                  1.0 / 6.0,
                                  1.0 / 24.0,
                                  1.0 / 120.0,
                                  1.0 / 720.0,
                                  1.0 / 5040.0,
                                  1.0 / 40320.0,
                                  1.0 / 362880.0,
                                  1.0 / 3628800.0,
                                  1.0 / 39916800.0,
                                  1.0 / 479001600.0 };
    for (int i = 12; i >= 0; i--)
        p = p * r + c[i];
    const uint64_t bits = (uint64_t)(1023 + (int)n) << 52;
    double scale;
    memcpy(&scale, &bits, sizeof(scale));
    return p * scale;
}

/* Natural logarithm of a normal x > 0. */
static inline double real_log(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof(bits));
    int exponent = (int)(bits >> 52) - 1023;
    bits = (bits & 0xfffffffffffffU) | 0x3ff0000000000000U;
    double m;
    memcpy(&m, &bits, sizeof(m));
    if (m > 1.4142135623730951) {
        m *= 0.5;
        exponent++;
    }
    /* 2 atanh((m - 1) / (m + 1)): the argument is below .172, the first term left out 1e-16 of the first. */
    const double s = (m - 1.0) / (m + 1.0), z = s * s;
    double p = 0.0;
    for (int k = 19; k >= 1; k -= 2)
        p = p * z + 1.0 / k;
    return 2.0 * s * p + exponent * 0.69314718055994530942;
}

/* atanh x / x for |x| < 1, 1 at 0. An x that has been rounded to 1 or more is taken as the number before it. */
static inline double real_atanh_over(double x)
{
    x = real_min(fabs(x), 0.9999999999999998);
    const double z = x * x;
    if (z < 1e-4)
        return 1.0 + z * (1.0 / 3.0 + z * (0.2 + z * (1.0 / 7.0)));
    return 0.5 * real_log((1.0 + x) / (1.0 - x)) / x;
}

/* atan x / x, 1 at 0. */
static inline double real_atan_over(double x)
{
    const double z = x * x;
    if (z < 1e-4)
        return 1.0 - z * (1.0 / 3.0 - z * (0.2 - z * (1.0 / 7.0)));
    return real_atan(x) / x;
}

#endif
