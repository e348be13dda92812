/* Three floats: the few operations that shading needs. */
#ifndef MATH_VEC3_H
#define MATH_VEC3_H

#include <math.h>

typedef struct vec3 {
    float x, y, z;
} vec3;

static inline vec3 vec3_from(const float v[3])
{
    return (vec3){ v[0], v[1], v[2] };
}

static inline vec3 vec3_add(vec3 a, vec3 b)
{
    return (vec3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec3 vec3_scale(vec3 a, float s)
{
    return (vec3){ a.x * s, a.y * s, a.z * s };
}

static inline float vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* The zero vector for a vector too short to have a direction. */
static inline vec3 vec3_normalize(vec3 a)
{
    const float length = sqrtf(vec3_dot(a, a));
    return length > 1e-20F ? vec3_scale(a, 1.0F / length) : (vec3){ 0.0F, 0.0F, 0.0F };
}

#endif
