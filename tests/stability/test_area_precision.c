/* What a point sees of a light of real size, against the same integral in long double: lights of any size at any
 * distance, astride the horizon, touching the surface, nearly edge-on; and the cells that a pixel of any shape covers.
 */
#define _GNU_SOURCE
#include "traps.h"

#include "footprint/coverage.h"
#include "light/area.h"
#include "wide_lights.h"

static const double ROUNDING = (double)DOUBLE_ROUNDING;

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
        static const wide own[4] = { 4.0L, 4.0L, 4.0L, 4.0L };
        wide3 corner[4];
        for (int k = 0; k < 4; k++)
            corner[k] = wide3_of(v[k]);
        const wide3 exact = polygon_truth(corner, own, 4, &reach);
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
