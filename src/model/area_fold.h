/* Sums over the eight lanes of a vector, always in one order: ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). */
#ifndef MODEL_AREA_FOLD_H
#define MODEL_AREA_FOLD_H

#include "math/lanes.h"

static inline float fold_one(vfloat x)
{
    return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/* Halves of two vectors, then quarters, then eighths, until every lane is the sum of a vector. */
static inline vfloat fold_halves(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3] } +
           (vfloat){ a[4], a[5], a[6], a[7], b[4], b[5], b[6], b[7] };
}

static inline vfloat fold_quarters(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[1], b[0], b[1], a[4], a[5], b[4], b[5] } +
           (vfloat){ a[2], a[3], b[2], b[3], a[6], a[7], b[6], b[7] };
}

static inline vfloat fold_eighths(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[2], b[0], b[2], a[4], a[6], b[4], b[6] } +
           (vfloat){ a[1], a[3], b[1], b[3], a[5], a[7], b[5], b[7] };
}

/* The sums of four vectors, in lanes 0, 1, 4 and 5. */
static inline vfloat fold_four(vfloat a, vfloat b, vfloat c, vfloat d)
{
    const vfloat q = fold_quarters(fold_halves(a, c), fold_halves(b, d));
    return fold_eighths(q, q);
}

/* The sums of eight vectors, in their order. */
static inline vfloat fold_eight(vfloat a, vfloat b, vfloat c, vfloat d, vfloat e, vfloat f, vfloat g, vfloat h)
{
    return fold_eighths(fold_quarters(fold_halves(a, e), fold_halves(b, f)),
                        fold_quarters(fold_halves(c, g), fold_halves(d, h)));
}

#endif
