/* Mean and variance of the counting kernel: what its blending over grids, corners and levels leaves of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "kernel_points.h"

/* E factor = 1 and Var = 1/2 (1 - p) / (N' p): 2 from the facets that are drawn, 1/2 * 1/2 from the blending
 * (sums of squares of barycentric weights, in the mean over the cell). N' = counted facets. */
static void mean_is_one_and_variance_follows_from_the_blending(void **state)
{
    (void)state;
    static const double n[] = { 1.0, 30.0, 1e3, 1e6 }, p[] = { 1e-4, 1e-2, 0.4 };
    static float factor[COUNT], facets[COUNT];
    uint64_t random = 12;
    for (size_t k = 0; k < 4; k++)
        for (size_t j = 0; j < 3; j++) {
            moments m = { 0 }, inverse = { 0 };
            for (int round = 0; round < 100; round++) {
                fill(&random);
                for (int i = 0; i < COUNT; i++) {
                    if (!(a.dudy[i] != 0.0F || a.dvdy[i] != 0.0F))
                        a.dvdy[i] = a.dudx[i];
                    a.p[i] = (float)p[j];
                }
                /* Set the density so that N is exactly n: measure the area first. */
                for (int i = 0; i < COUNT; i++)
                    a.density[i] = 1.0F;
                counting_kernel_1(&points, COUNT, factor, facets);
                for (int i = 0; i < COUNT; i++)
                    a.density[i] = facets[i] > 0.0F ? (float)n[k] / facets[i] : 0.0F;
                counting_kernel_1(&points, COUNT, factor, facets);
                for (int i = 0; i < COUNT; i++)
                    if (facets[i] > 0.0F) {
                        moments_add(&m, (double)factor[i]);
                        moments_add(&inverse, 1.0 / counted(i));
                    }
            }
            const double variance = 0.5 * (1.0 - p[j]) * inverse.mean / p[j];
            const double sigmas = (m.mean - 1.0) / moments_standard_error(&m);
            printf("N %g p %g: mean %.5f (%.1f sigma), variance over (1-p)/2Np %.4f\n", n[k], p[j], m.mean, sigmas,
                   moments_variance(&m) / variance);
            assert_true(fabs(sigmas) < 4.5); /* 12 tests, significance 1e-4 */
            /* A draw from a fraction f of a facet has f p (1 - f p) instead of f p (1 - p), at most p^2 / 4 more, in
             * each of four draws that share N / 2. The rest is noise: the kurtosis of a count is about 1 / N p. */
            const double fraction = p[j] / (n[k] * 0.5 * (1.0 - p[j]));
            const double noise = 4.0 * sqrt((2.0 + 9.0 / (n[k] * p[j])) / m.count);
            assert_true(fabs(moments_variance(&m) / variance - 1.0) < 0.01 + fraction + noise);
        }
}

/* A pixel well inside a facet sees it lit or not, over the mean: variance (1 - p) / p. */
static void facet_larger_than_the_pixel_is_lit_or_not(void **state)
{
    (void)state;
    static float factor[COUNT], facets[COUNT];
    uint64_t random = 14;
    moments m = { 0 };
    const double p = 0.05;
    for (int round = 0; round < 100; round++) {
        fill(&random);
        for (int i = 0; i < COUNT; i++) {
            a.dudx[i] = a.dvdy[i] = 1e-4F;
            a.dudy[i] = a.dvdx[i] = 0.0F;
            a.density[i] = 1e2F; /* a millionth of a facet under the pixel */
            a.p[i] = (float)p;
        }
        counting_kernel_1(&points, COUNT, factor, facets);
        for (int i = 0; i < COUNT; i++)
            moments_add(&m, (double)factor[i]);
    }
    /* Draws from 2/9 of a facet in four parts have f p (1 - f p) instead of f p (1 - p): more by (1 - f) p with f =
     * 1/18. The rest is noise, with a kurtosis of about 9 / 4 * 18 for 4e5 samples. */
    const double fraction = p, noise = 4.0 * sqrt(45.0 / m.count);
    printf("variance over (1-p)/p: %.3f\n", moments_variance(&m) / ((1.0 - p) / p));
    assert_true(fabs(m.mean - 1.0) < 4.5 * moments_standard_error(&m));
    assert_true(fabs(moments_variance(&m) / ((1.0 - p) / p) - 1.0) < fraction + noise);
}

/* The blend must be as wide at the origin as elsewhere: grids that all had a vertex there would double the variance. */
static void origin_is_a_place_like_any_other(void **state)
{
    (void)state;
    static float factor[COUNT], facets[COUNT];
    uint64_t random = 13;
    moments m = { 0 };
    for (int round = 0; round < 50; round++) {
        fill(&random);
        for (int i = 0; i < COUNT; i++) {
            a.u[i] = a.v[i] = 0.0;
            a.dudx[i] = a.dvdy[i] = (float)random_log_between(&random, 1e-5, 1e-1);
            a.dudy[i] = a.dvdx[i] = 0.0F;
            a.density[i] = 1000.0F / (a.dudx[i] * a.dudx[i]);
            a.p[i] = 0.01F;
        }
        counting_kernel_1(&points, COUNT, factor, facets);
        for (int i = 0; i < COUNT; i++)
            moments_add(&m, (double)factor[i]);
    }
    /* 2e5 samples, kurtosis 3.1: 3 sigma of the variance is 1 % */
    assert_true(fabs(moments_variance(&m) / (0.5 * 0.99 / 10.005) - 1.0) < 0.01 + 0.01);
}

/* Weight of the corner at the origin of a lattice of equilateral triangles, whose cells have this area. */
static double angular_hat(double hx, double hy, double area)
{
    const double side = sqrt(area * 2.0 / sqrt(3.0)), y = hy / (0.5 * sqrt(3.0) * side), x = hx / side - 0.5 * y;
    return fmax(0.0, 1.0 - fmax(fabs(x), fmax(fabs(y), fabs(x + y))));
}

/* Sum of v(h) v(h + d) over the corners, in the mean over h: what stays of the variance. */
static double angular_correlation(double dx, double dy, double area)
{
    enum { STEPS = 400 };
    const double reach = 1.3 * sqrt(area);
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            const double x = reach * (2 * i + 1 - STEPS) / STEPS, y = reach * (2 * k + 1 - STEPS) / STEPS;
            sum += angular_hat(x, y, area) * angular_hat(x + dx, y + dy, area);
        }
    return sum * 4.0 * reach * reach / (STEPS * STEPS) / area;
}

/* As h turns, lit facets go at the same pace in all directions: that of equilateral triangles. */
static void half_vectors_nearby_share_facets_in_every_direction(void **state)
{
    (void)state;
    static float here[COUNT], there[COUNT], facets[COUNT];
    const double cap = 1.0 / 4096.0, step = 0.4 * sqrt(cap), whole = angular_correlation(0.0, 0.0, cap);
    assert_true(fabs(whole - 0.5) < 1e-3); /* sum v^2 */
    uint64_t random = 33;
    for (int direction = 0; direction < 6; direction++) {
        const double turn = direction * 3.14159265358979 / 6.0, dx = step * cos(turn), dy = step * sin(turn);
        moments value = { 0 }, change = { 0 };
        for (int round = 0; round < 12; round++) {
            fill_alike(&random, 1e6, 0.05);
            for (int side = 0; side < 2; side++) {
                for (int i = 0; i < COUNT; i++) {
                    a.cap[i] = (float)cap;
                    a.hx[i] = side ? a.hx[i] + (float)dx : a.hx[i];
                    a.hy[i] = side ? a.hy[i] + (float)dy : a.hy[i];
                }
                counting_widest(16).kernel(&points, COUNT, side ? there : here, facets);
            }
            for (int i = 0; i < COUNT; i++) {
                moments_add(&value, (double)here[i]);
                moments_add(&change, (double)there[i] - (double)here[i]);
            }
        }
        const double expected = 2.0 * (1.0 - angular_correlation(dx, dy, cap) / whole);
        const double ratio = moments_variance(&change) / moments_variance(&value);
        printf("turned by %d degrees: change over variance %.4f, expected %.4f\n", 30 * direction, ratio, expected);
        /* Variances of 5e4 nearly normal values, which vary in width with the weights: kurtosis below 4. */
        assert_true(fabs(ratio / expected - 1.0) < 4.5 * sqrt(2.0 * 3.0 / value.count));
    }
}

/* Levels of the angular lattice change where the cap's area passes a power of four. */
static void nothing_moves_when_the_cap_passes_a_level(void **state)
{
    (void)state;
    uint64_t random = 17;
    static float below[COUNT], above[COUNT], facets[COUNT];
    for (int level = 1; level <= 13; level++) {
        fill(&random);
        for (int side = 0; side < 2; side++) {
            for (int i = 0; i < COUNT; i++) {
                a.cap[i] = (float)(ldexp(1.0, -2 * level) * (side ? 1.0 + 1e-6 : 1.0 - 1e-6));
                a.density[i] = (float)(3.0 / fmax((double)(a.dudx[i] * a.dvdy[i] - a.dudy[i] * a.dvdx[i]), 1e-20));
                a.p[i] = 0.3F;
            }
            counting_kernel_1(&points, COUNT, side ? above : below, facets);
        }
        /* A millionth of the cap makes as many of the cells take the other level: of 4096 points with 12 of them each
         * the odd one. h is cut to 2^-16 of a cell, which moves a value by a few times that. */
        int moved = 0;
        for (int i = 0; i < COUNT; i++)
            moved += fabs((double)(above[i] - below[i])) > 1e-3 * (1.0 + (double)below[i]);
        if (moved > 10)
            fail_msg("at 4^-%d %d of %d values move", level, moved, COUNT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_is_one_and_variance_follows_from_the_blending),
        cmocka_unit_test(facet_larger_than_the_pixel_is_lit_or_not),
        cmocka_unit_test(origin_is_a_place_like_any_other),
        cmocka_unit_test(half_vectors_nearby_share_facets_in_every_direction),
        cmocka_unit_test(nothing_moves_when_the_cap_passes_a_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
