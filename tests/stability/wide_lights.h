/* What a point sees of polygons and ellipses, in long double: the truth for what the library has in double. */
#ifndef TESTS_WIDE_LIGHTS_H
#define TESTS_WIDE_LIGHTS_H

#include "math/vec3d.h"
#include "statistics.h"
#include "wide.h"

typedef struct wide3 {
    wide x, y, z;
} wide3;

static inline wide3 wide3_of(vec3d v)
{
    return (wide3){ (wide)v.x, (wide)v.y, (wide)v.z };
}

static inline wide3 mad(wide3 a, wide3 b, wide s)
{
    return (wide3){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static inline wide3 cross(wide3 a, wide3 b)
{
    return (wide3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline wide dot(wide3 a, wide3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline wide length_of(wide3 a)
{
    return sqrtl(dot(a, a));
}

static inline vec3d random_vector(uint64_t *random, double size)
{
    return (vec3d){ size * random_between(random, -1.0, 1.0), size * random_between(random, -1.0, 1.0),
                    size * random_between(random, -1.0, 1.0) };
}

/* The integral of the direction over a polygon of any corners, cut at z = 0, and by how many roundings its boundary may
 * be off when corner i's direction is off by own[i] of them. */
static inline wide3 polygon_truth(const wide3 *corner, const wide *own, int count, wide *reach)
{
    wide3 above[12], sum = { 0.0L, 0.0L, 0.0L };
    wide off[12]; /* of this corner's direction, in roundings */
    int n = 0;
    for (int i = 0; i < count; i++) {
        const wide3 a = corner[i], b = corner[(i + 1) % count];
        if (a.z >= 0.0L) {
            off[n] = own[i];
            above[n++] = a;
        }
        if ((a.z < 0.0L) != (b.z < 0.0L)) {
            const wide3 side = mad(b, a, -1.0L);
            above[n] = mad(a, side, a.z / (a.z - b.z));
            above[n].z = 0.0L;
            /* The cut has three roundings of the side's length, seen from where it is. */
            off[n] = 4.0L + 3.0L * (length_of(side) + length_of(a)) / length_of(above[n]);
            n++;
        }
    }
    *reach = 0.0L;
    for (int i = 0; i < n; i++) {
        const int k = (i + 1) % n;
        const wide3 normal = cross(above[i], mad(above[k], above[i], -1.0L));
        const wide sine = length_of(normal);
        if (sine == 0.0L)
            continue;
        const wide angle = atan2l(sine, dot(above[i], above[k]));
        sum = mad(sum, normal, 0.5L * angle / sine);
        /* A corner that moves takes its two sides along: four roundings, of two products in three components. The
         * side's normal has five more, its length three, the angle four, their product and the sum four. */
        *reach += angle * (fmaxl(off[i], off[k]) + 16.0L);
    }
    return sum;
}

/* 1/2 of the integral of p x p' / |p|^2 for p = c + q, q = x cos t + y sin t, from t0 to t1: Gauss's four points in 512
 * pieces. What 1 / |c|^2 makes of it is known, and what is left is as small as the light. */
static inline wide3 arc_integral(wide3 c, wide3 x, wide3 y, wide t0, wide t1)
{
    static const wide at[4] = { -0.861136311594052575224L, -0.339981043584856264803L, 0.339981043584856264803L,
                                0.861136311594052575224L };
    static const wide weight[4] = { 0.347854845137453857373L, 0.652145154862546142627L, 0.652145154862546142627L,
                                    0.347854845137453857373L };
    enum { PIECES = 512 };
    const wide half = (t1 - t0) / (2 * PIECES), c2 = dot(c, c);
    const wide3 none = { 0.0L, 0.0L, 0.0L };
    wide3 sum = mad(none, cross(x, y), 0.5L * (t1 - t0) / c2);
    /* The way from q(t0) to q(t1): -2 sin(middle) sin(half) and 2 cos(middle) sin(half). Nothing for a whole turn. */
    const wide middle = 0.5L * (t0 + t1), reach = 2.0L * sinl(0.5L * (t1 - t0));
    if (t1 - t0 < 2.0L * WIDE_PI)
        sum = mad(sum, cross(c, mad(mad(none, y, reach * cosl(middle)), x, -reach * sinl(middle))), 0.5L / c2);
    for (int i = 0; i < PIECES; i++)
        for (int k = 0; k < 4; k++) {
            const wide t = t0 + half * (2 * i + 1 + at[k]), co = cosl(t), si = sinl(t);
            const wide3 q = mad(mad(none, x, co), y, si), p = mad(c, q, 1.0L), d = mad(mad(none, y, co), x, -si);
            const wide less = -(2.0L * dot(c, q) + dot(q, q)) / (dot(p, p) * c2);
            sum = mad(sum, cross(p, d), 0.5L * weight[k] * half * less);
        }
    return sum;
}

#endif
