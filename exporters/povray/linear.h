/* Three-dimensional vectors and column-major transforms in double, as far as the exporter needs them. */
#ifndef EXPORTERS_POVRAY_LINEAR_H
#define EXPORTERS_POVRAY_LINEAR_H

#include <math.h>

typedef struct vec {
    double x, y, z;
} vec;

static inline vec vec_add(vec a, vec b)
{
    return (vec){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec vec_sub(vec a, vec b)
{
    return (vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline vec vec_scale(vec a, double s)
{
    return (vec){ a.x * s, a.y * s, a.z * s };
}

static inline double vec_dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec vec_cross(vec a, vec b)
{
    return (vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double vec_length(vec a)
{
    return sqrt(vec_dot(a, a));
}

/* Zero stays zero. */
static inline vec vec_unit(vec a)
{
    const double length = vec_length(a);
    return length > 0.0 ? vec_scale(a, 1.0 / length) : a;
}

static inline vec vec_of(const float *p)
{
    return (vec){ (double)p[0], (double)p[1], (double)p[2] };
}

static inline vec matrix_column(const float m[16], int column)
{
    return vec_of(&m[4 * column]);
}

static inline vec matrix_vector(const float m[16], vec v)
{
    return vec_add(vec_scale(matrix_column(m, 0), v.x),
                   vec_add(vec_scale(matrix_column(m, 1), v.y), vec_scale(matrix_column(m, 2), v.z)));
}

static inline vec matrix_point(const float m[16], vec p)
{
    return vec_add(matrix_vector(m, p), matrix_column(m, 3));
}

/* A normal goes with the cofactors, which are the inverse transpose but for scale. */
static inline vec matrix_normal(const float m[16], vec n)
{
    const vec a = matrix_column(m, 0), b = matrix_column(m, 1), c = matrix_column(m, 2);
    const double sign = vec_dot(vec_cross(a, b), c) < 0.0 ? -1.0 : 1.0;
    const vec turned = vec_add(vec_scale(vec_cross(b, c), n.x),
                               vec_add(vec_scale(vec_cross(c, a), n.y), vec_scale(vec_cross(a, b), n.z)));
    return vec_unit(vec_scale(turned, sign));
}

#endif
