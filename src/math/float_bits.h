/* Comparisons of floats from outside by their bits.
 *
 * Comparing a NaN raises a floating-point exception, and a compiler may compare before the branch that should have kept
 * it from doing so. Floats that are not negative are ordered as their bits.
 */
#ifndef MATH_FLOAT_BITS_H
#define MATH_FLOAT_BITS_H

#include <stdint.h>
#include <string.h>

static inline uint32_t bits_of_float(float x)
{
    uint32_t u;
    memcpy(&u, &x, sizeof(u));
    return u;
}

/* A float from outside as the double that a message prints: converting a signalling NaN would raise an exception. */
static inline double printable(float x)
{
    const uint32_t bits = bits_of_float(x), quiet = (bits & 0x7fffffffU) > 0x7f800000U ? bits | 0x00400000U : bits;
    float y;
    memcpy(&y, &quiet, sizeof(y));
    return (double)y;
}

/* |x| < limit; false for a NaN. */
static inline int is_below(float x, float limit)
{
    return (bits_of_float(x) & 0x7fffffffU) < bits_of_float(limit);
}

static inline int is_below_d(double x, double limit)
{
    uint64_t u, most;
    memcpy(&u, &x, sizeof(u));
    memcpy(&most, &limit, sizeof(most));
    return (u & 0x7fffffffffffffffU) < most;
}

/* low <= x <= high, for 0 <= low. */
static inline int in_range(float x, float low, float high)
{
    const uint32_t u = bits_of_float(x) == 0x80000000U ? 0U : bits_of_float(x);
    return u >= bits_of_float(low) && u <= bits_of_float(high);
}

/* x in [low, high] for 0 <= low; low for a NaN. */
static inline float clamp_to(float x, float low, float high)
{
    const uint32_t u = bits_of_float(x);
    if (u > 0x7f800000U) /* negative, or a NaN */
        return low;
    return u < bits_of_float(low) ? low : u > bits_of_float(high) ? high : x;
}

#endif
