/* Three doubles: geometry whose differences would have no digit left in floats. */
#ifndef MATH_VEC3D_H
#define MATH_VEC3D_H

#include <math.h>

#include "math/vec3.h"

typedef struct vec3d {
    double x, y, z;
} vec3d;

static inline vec3d vec3d_from(const float v[3])
{
    return (vec3d){ (double)v[0], (double)v[1], (double)v[2] };
}

static inline vec3d vec3d_of(vec3 v)
{
    return (vec3d){ (double)v.x, (double)v.y, (double)v.z };
}

static inline vec3 vec3d_narrow(vec3d v)
{
    return (vec3){ (float)v.x, (float)v.y, (float)v.z };
}

static inline vec3d vec3d_add(vec3d a, vec3d b)
{
    return (vec3d){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec3d vec3d_sub(vec3d a, vec3d b)
{
    return (vec3d){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline vec3d vec3d_scale(vec3d a, double s)
{
    return (vec3d){ a.x * s, a.y * s, a.z * s };
}

/* a + s b */
static inline vec3d vec3d_mad(vec3d a, vec3d b, double s)
{
    return (vec3d){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static inline double vec3d_dot(vec3d a, vec3d b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3d vec3d_cross(vec3d a, vec3d b)
{
    return (vec3d){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double vec3d_length(vec3d a)
{
    return sqrt(vec3d_dot(a, a));
}

/* The zero vector for a vector too short to have a direction. */
static inline vec3d vec3d_normalize(vec3d a)
{
    const double length = vec3d_length(a);
    return length > 1e-100 ? vec3d_scale(a, 1.0 / length) : (vec3d){ 0.0, 0.0, 0.0 };
}

/* A unit vector that is normal to the unit vector a. */
static inline vec3d vec3d_any_normal(vec3d a)
{
    const vec3d other = fabs(a.x) < 0.7 ? (vec3d){ 1.0, 0.0, 0.0 } : (vec3d){ 0.0, 1.0, 0.0 };
    return vec3d_normalize(vec3d_cross(other, a));
}

#endif
