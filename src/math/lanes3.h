/* Vectors of three floats, in lanes: math/vec3.h for many. */
#ifndef MATH_LANES3_H
#define MATH_LANES3_H

#include "math/lanes.h"

typedef struct vfloat3 {
    vfloat x, y, z;
} vfloat3;

static inline vfloat3 add_3(vfloat3 a, vfloat3 b)
{
    return (vfloat3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vfloat3 scale_3(vfloat3 a, vfloat s)
{
    return (vfloat3){ a.x * s, a.y * s, a.z * s };
}

static inline vfloat dot_3(vfloat3 a, vfloat3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vfloat3 cross_3(vfloat3 a, vfloat3 b)
{
    return (vfloat3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline vfloat3 choose_3(vmask m, vfloat3 a, vfloat3 b)
{
    return (vfloat3){ choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z) };
}

/* The zero vector for a vector too short to have a direction. */
static inline vfloat3 normalize_3(vfloat3 a)
{
    const vfloat length = sqrt_f(dot_3(a, a));
    const vmask is_long = less(splat(1e-20F), length);
    const vfloat inverse = 1.0F / choose(is_long, length, splat(1.0F));
    return scale_3(a, choose(is_long, inverse, splat(0.0F)));
}

#endif
