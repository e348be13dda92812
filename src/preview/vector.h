/* Vectors and column-major 4x4 matrices in double precision: places on a surface are metres that must resolve facets.
 */
#ifndef PREVIEW_VECTOR_H
#define PREVIEW_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#define PREVIEW_PI 3.14159265358979323846

typedef struct vec3 {
    double x, y, z;
} vec3;

static inline vec3 v3(double x, double y, double z)
{
    return (vec3){ x, y, z };
}

static inline vec3 v3_from(const float f[3])
{
    return v3((double)f[0], (double)f[1], (double)f[2]);
}

static inline vec3 v3_add(vec3 a, vec3 b)
{
    return v3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline vec3 v3_sub(vec3 a, vec3 b)
{
    return v3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vec3 v3_scale(vec3 a, double s)
{
    return v3(a.x * s, a.y * s, a.z * s);
}

/* a + b s */
static inline vec3 v3_mad(vec3 a, vec3 b, double s)
{
    return v3(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s);
}

static inline double v3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 v3_cross(vec3 a, vec3 b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double v3_length(vec3 a)
{
    return sqrt(v3_dot(a, a));
}

/* The zero vector stays zero. */
static inline vec3 v3_normalize(vec3 a)
{
    const double length = v3_length(a);
    return length > 0.0 ? v3_scale(a, 1.0 / length) : v3(0.0, 0.0, 0.0);
}

/* The part of a that is perpendicular to the unit vector n. */
static inline vec3 v3_reject(vec3 a, vec3 n)
{
    return v3_mad(a, n, -v3_dot(a, n));
}

/* Of two numbers; b where a is none. In two instructions, and not in a call as fmax, which looks for NaNs on both
 * sides.
 */
static inline double larger_of(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller_of(double a, double b)
{
    return a < b ? a : b;
}

static inline double v3_max_abs(vec3 a)
{
    return larger_of(fabs(a.x), larger_of(fabs(a.y), fabs(a.z)));
}

static inline vec3 m4_point(const double m[16], vec3 p)
{
    return v3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
              m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
}

static inline vec3 m4_vector(const double m[16], vec3 d)
{
    return v3(m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
              m[2] * d.x + m[6] * d.y + m[10] * d.z);
}

/* The transpose of the 3x3 part times d: with the inverse of a matrix, this carries normals through that matrix. */
static inline vec3 m4_transposed_vector(const double m[16], vec3 d)
{
    return v3(m[0] * d.x + m[1] * d.y + m[2] * d.z, m[4] * d.x + m[5] * d.y + m[6] * d.z,
              m[8] * d.x + m[9] * d.y + m[10] * d.z);
}

static inline vec3 m4_column(const double m[16], int column)
{
    const double *const c = m + (ptrdiff_t)4 * column;
    return v3(c[0], c[1], c[2]);
}

/* A unit vector perpendicular to the unit vector n, continuous but for n.z = 0: Duff et al. 2017, "Building an
 * Orthonormal Basis, Revisited", Listing 3. */
static inline vec3 v3_any_tangent(vec3 n)
{
    const double sign = copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    return v3(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}

/* Inverse of an affine matrix; false when it flattens space. */
bool m4_invert_affine(const double m[16], double inverse[16]);

/* The column-major matrix, as a scene has it, of a node with these axes at this place. */
void m4_from_axes(vec3 x, vec3 y, vec3 z, vec3 origin, float m[16]);

#endif
