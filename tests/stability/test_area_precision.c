/* What a point sees of a light of real size, against the same integral in long double: lights of any size at any
 * distance, astride the horizon, touching the surface, nearly edge-on; and the cells that a pixel of any shape covers.
 */
#define _GNU_SOURCE
#include "traps.h"

#include "footprint/coverage.h"
#include "light/area.h"
#include "wide.h"

static const double ROUNDING = (double)DOUBLE_ROUNDING;

typedef struct wide3 {
    wide x, y, z;
} wide3;

static wide3 wide3_of(vec3d v)
{
    return (wide3){ (wide)v.x, (wide)v.y, (wide)v.z };
}

static wide3 mad(wide3 a, wide3 b, wide s)
{
    return (wide3){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static wide3 cross(wide3 a, wide3 b)
{
    return (wide3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static wide dot(wide3 a, wide3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static wide length_of(wide3 a)
{
    return sqrtl(dot(a, a));
}

static vec3d random_vector(uint64_t *random, double size)
{
    return (vec3d){ size * random_between(random, -1.0, 1.0), size * random_between(random, -1.0, 1.0),
                    size * random_between(random, -1.0, 1.0) };
}

/* The integral of the direction over a polygon of any corners, cut at z = 0, and how far its boundary may be off when
 * every corner's direction is off by a rounding. */
static wide3 polygon_truth(const vec3d *corner, int count, wide *reach)
{
    wide3 above[12], sum = { 0.0L, 0.0L, 0.0L };
    wide off[12]; /* of this corner's direction, in roundings */
    int n = 0;
    for (int i = 0; i < count; i++) {
        const wide3 a = wide3_of(corner[i]), b = wide3_of(corner[(i + 1) % count]);
        if (a.z >= 0.0L) {
            off[n] = 4.0L;
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

static void polygons_keep_their_digits(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    uint64_t random = 1;
    long seen = 0;
    for (int i = 0; i < 300000; i++) {
        /* A flat quadrilateral: a parallelogram in a random plane, one corner pulled in. */
        const double size = random_log_between(&random, 1e-6, 1e3);
        const vec3d c = random_vector(&random, 1.0), x = random_vector(&random, size), y = random_vector(&random, size);
        vec3d v[4] = { c, vec3d_add(c, x), vec3d_mad(vec3d_add(c, x), y, 0.7), vec3d_add(c, y) };
        const double lowest = fmin(fmin(v[0].z, v[1].z), fmin(v[2].z, v[3].z));
        for (int k = 0; k < 4 && i % 3 == 0; k++) /* one corner on the ground */
            v[k].z -= lowest;
        area_light light;
        area_make_polygon(&light, v, 4, 1);
        wide reach;
        const wide3 exact = polygon_truth(v, 4, &reach);
        if (light.kind == AREA_NOTHING || !area_measure(&light)) {
            /* Of 10^-26 sr, in a plane as good as through the point, or hardly above the horizon: by less than the
             * integral is off. */
            const vec3d normal = vec3d_cross(x, y);
            const double height = vec3d_dot(normal, v[0]);
            assert_true(length_of(exact) < 1e-25L || fabsl(exact.z) < reach * DOUBLE_ROUNDING ||
                        fabs(height) < 2e-9 * vec3d_length(normal) * (2.0 + 4.0 * size));
            continue;
        }
        seen++;
        const wide sign = vec3d_dot(vec3d_cross(x, y), v[0]) < 0.0 ? -1.0L : 1.0L;
        const wide3 error = mad(wide3_of(light.moment), exact, -sign);
        /* A boundary that is off by so much moves the integral by that times its length: reach has both. */
        worst_add(&worst, length_of(error), (reach + 8.0L * length_of(exact)) * DOUBLE_ROUNDING, size, (double)exact.z,
                  (double)light.corner_count);
    }
    assert_true(seen > 100000);
    assert_true(worst_holds(&worst, "polygon (absolute)", ROUNDING));
}

/* 1/2 of the integral of p x p' / |p|^2 for p = c + q, q = x cos t + y sin t, from t0 to t1: Gauss's four points in 512
 * pieces. What 1 / |c|^2 makes of it is known, and what is left is as small as the light. */
static wide3 arc_integral(wide3 c, wide3 x, wide3 y, wide t0, wide t1)
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

/* The same for an ellipse, cut at z = 0. */
static wide3 ellipse_truth(wide3 c, wide3 x, wide3 y)
{
    const wide swing = hypotl(x.z, y.z);
    if (c.z >= swing)
        return arc_integral(c, x, y, 0.0L, 2.0L * WIDE_PI);
    const wide middle = atan2l(y.z, x.z), open = acosl(-c.z / swing);
    wide3 sum = arc_integral(c, x, y, middle - open, middle + open);
    /* Along the ground from the last point to the first. */
    const wide3 a = mad(mad(c, x, cosl(middle + open)), y, sinl(middle + open));
    const wide swung = 2.0L * sinl(open);
    const wide3 way = mad(mad((wide3){ 0.0L, 0.0L, 0.0L }, x, swung * sinl(middle)), y, -swung * cosl(middle));
    sum.z += 0.5L * atan2l(a.x * way.y - a.y * way.x, dot(a, a) + dot(a, way));
    return sum;
}

static void ellipses_keep_their_digits(void **state)
{
    (void)state;
    worst_error whole = { 0 }, cut = { 0 };
    uint64_t random = 2;
    long seen[2] = { 0, 0 };
    for (int i = 0; i < 4000; i++) {
        const double size = random_log_between(&random, 1e-8, 0.6);
        vec3d c = vec3d_normalize(random_vector(&random, 1.0)), x = random_vector(&random, size),
              y = random_vector(&random, size * random_log_between(&random, 0.1, 1.0));
        c.z = fabs(c.z);
        if (i % 2) /* astride the horizon */
            c.z = random_between(&random, -0.9, 0.9) * sqrt(x.z * x.z + y.z * y.z);
        /* Not nearly edge-on: the quadrature would need more pieces. */
        const vec3d normal = vec3d_cross(x, y);
        if (fabs(vec3d_dot(normal, c)) < 0.05 * vec3d_length(x) * vec3d_length(y))
            continue;
        area_light light;
        area_make_ellipse(&light, c, x, y, 1);
        const wide3 exact = ellipse_truth(wide3_of(c), wide3_of(x), wide3_of(y));
        const wide sign = vec3d_dot(normal, c) < 0.0 ? -1.0L : 1.0L, perimeter = 2.0L * WIDE_PI * (wide)size;
        if (!area_measure(&light)) {
            assert_true(fabsl(exact.z) < 24.0L * perimeter * DOUBLE_ROUNDING);
            continue;
        }
        const wide error = length_of(mad(wide3_of(light.moment), exact, -sign));
        seen[light.cone.is_cut]++;
        /* Whole, the closed form has the axes to the first power each: two dozen roundings of an eigenvector, of two
         * roots and their products, for a light that is not nearly edge-on (1 / .05 of them at worst). The axis itself
         * is off by four roundings, which squared are to be compared with the square of the light's width. */
        const wide askew = 4.0L * DOUBLE_ROUNDING / (wide)light.cone.b;
        if (!light.cone.is_cut)
            worst_add(&whole, error / length_of(exact), 24.0L * 20.0L * DOUBLE_ROUNDING + askew * askew, size,
                      (double)exact.z, 0);
        else /* Cut, arc and chord are of the perimeter's size and nearly cancel in a small light. */
            worst_add(&cut, error, (24.0L * 20.0L * length_of(exact) + 24.0L * perimeter) * DOUBLE_ROUNDING, size,
                      (double)exact.z, 0);
    }
    printf("%ld ellipses whole, %ld cut\n", seen[0], seen[1]);
    int ok = worst_holds(&whole, "ellipse", ROUNDING);
    ok &= worst_holds(&cut, "ellipse at the horizon (absolute)", ROUNDING);
    assert_true(ok && seen[0] > 500 && seen[1] > 500);
}

/* ---- cells under a pixel ---- */

typedef struct tally {
    wide share, u, v; /* of all cells; times their middles, from the pixel's centre */
    double at_u, at_v;
    long cells, below;
} tally;

static void count_cell(int64_t x, int64_t y, double share, void *user)
{
    tally *t = user;
    t->share += (wide)share;
    t->u += (wide)share * ((wide)x + 0.5L - (wide)t->at_u);
    t->v += (wide)share * ((wide)y + 0.5L - (wide)t->at_v);
    t->cells++;
    t->below += share < 0.0;
}

/* Pixels up to a million times as long as wide, a billion cells out: shares are not negative, add up to one, and
 * their centre of gravity is the pixel's within half a cell. */
static void long_pixels_cover_themselves(void **state)
{
    (void)state;
    worst_error sum = { 0 };
    uint64_t random = 3;
    for (int i = 0; i < 20000; i++) {
        const double far = random_log_between(&random, 1e-6, 1e9);
        const double major = random_log_between(&random, 1e-3, 300.0),
                     minor = major / random_log_between(&random, 1, 1e6);
        const double t = random_between(&random, 0.0, 6.2831853), c = cos(t), s = sin(t);
        const coverage_pixel p = { random_between(&random, -far, far),
                                   random_between(&random, -far, far),
                                   c * major,
                                   -s * minor,
                                   s * major,
                                   c * minor };
        if (!(coverage_area(&p) > 0.0)) {
            assert_true(major * minor <= 1e-10 * 2.0 * (major + minor) * fmax(2.0 * (major + minor), 1.0));
            continue;
        }
        tally all = { .at_u = p.u, .at_v = p.v };
        coverage_each(&p, count_cell, &all);
        assert_int_equal(all.below, 0);
        assert_true((double)all.cells <= coverage_cell_bound(&p));
        /* Corners are off by two roundings of their distance from the first cell, or of the place's own, over the area:
         * that of the outline. */
        const wide outline = 2.0L * ((wide)major + (wide)minor), reach = outline + 1.0L;
        const wide bound = 8.0L * reach * outline * DOUBLE_ROUNDING / ((wide)major * (wide)minor) +
                           8.0L * (wide)all.cells * DOUBLE_ROUNDING;
        worst_add(&sum, all.share - 1.0L, bound, major, minor, far);
        assert_true(fabsl(all.u) <= 0.5L + reach * bound && fabsl(all.v) <= 0.5L + reach * bound);
    }
    printf("shares add up to one but for %.1Le of %.1Le allowed, at %g by %g cells, %g away\n", sum.measured,
           sum.allowed, sum.at[0], sum.at[1], sum.at[2]);
    assert_true(sum.error <= 1.0L);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(polygons_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(ellipses_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(long_pixels_cover_themselves, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
