/* One realisation drawn for all: its mean is the whole sum, and it varies as its bound says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_points.h"

/* Evenly spaced draws hit each of the 36 realisations in proportion to its weight, to within one draw: their mean is
 * nearer to the whole sum than that of as many random draws would be, at every kind of point, and its error has no
 * sign. */
static void mean_over_draws_is_the_whole_sum(void **state)
{
    (void)state;
    enum { DRAWS = 2048 };
    static const double n[] = { 0.3, 10.0, 1e3, 1e5 }, p[] = { 1e-3, 0.05, 0.6 };
    static float full[COUNT], facets[COUNT], factor[COUNT];
    static double sum[COUNT];
    static uint32_t draw[COUNT];
    const counting_width width = counting_widest(16);
    uint64_t random = 22;
    for (size_t k = 0; k < 12; k++) {
        moments off = { 0 };
        double one = 0.0, all = 0.0; /* mean squares of the error of one draw, and of the mean of all */
        fill_alike(&random, n[k / 3], p[k % 3]);
        width.kernel(&points, COUNT, full, facets);
        memset(sum, 0, sizeof(sum));
        for (uint32_t d = 0; d < DRAWS; d++) {
            for (int i = 0; i < COUNT; i++)
                draw[i] = d * (uint32_t)(0x100000000U / DRAWS) + (uint32_t)i * 7U;
            width.drawn(&points, draw, COUNT, factor, facets);
            for (int i = 0; i < COUNT; i++) {
                const double e = (double)factor[i] - (double)full[i];
                sum[i] += (double)factor[i] / DRAWS;
                one += e * e / ((double)DRAWS * COUNT);
            }
        }
        for (int i = 0; i < COUNT; i++) {
            moments_add(&off, sum[i] - (double)full[i]);
            all += (sum[i] - (double)full[i]) * (sum[i] - (double)full[i]) / COUNT;
        }
        const double sigmas = off.mean / moments_standard_error(&off);
        printf("N %g p %g: mean over draws less the sum %.2e, %.1f sigma; error over that of random draws %.3f\n",
               n[k / 3], p[k % 3], off.mean, sigmas, sqrt(all * DRAWS / one));
        assert_true(fabs(sigmas) < 4.5 || fabs(off.mean) < 1e-5);
        assert_true(all < one / DRAWS);
    }
}

/* A count of N_g p has the variance 2 (1 - p) / (N share p), over four grids 8 (1 - p) / (N p); a fraction of one
 * trial has 1 - f p in place of 1 - p. What the sum of all varies by, at most half of 1 / N p, is no part of it. Where
 * a single grid has all the share 2 of the 8 are left, less that half. */
static void drawing_varies_as_its_bound_says(void **state)
{
    (void)state;
    static const double n[] = { 10.0, 30.0, 1e4 }, p[] = { 1e-2, 0.1 };
    static float full[COUNT], facets[COUNT], factor[COUNT];
    static uint32_t draw[COUNT];
    uint64_t random = 23;
    for (size_t k = 0; k < 6; k++) {
        moments noise = { 0 }, inverse = { 0 };
        for (int round = 0; round < 40; round++) {
            fill_alike(&random, n[k / 2], p[k % 2]);
            for (int i = 0; i < COUNT; i++)
                draw[i] = (uint32_t)random_bits(&random);
            counting_widest(16).kernel(&points, COUNT, full, facets);
            counting_widest(16).drawn(&points, draw, COUNT, factor, facets);
            for (int i = 0; i < COUNT; i++) {
                moments_add(&noise, (double)factor[i] - (double)full[i]);
                moments_add(&inverse, 1.0 / counted(i));
            }
        }
        const double bound = 8.0 * inverse.mean / p[k % 2], ratio = moments_variance(&noise) / bound;
        printf("N %g p %g: variance of drawing over 8 / N p: %.3f\n", n[k / 2], p[k % 2], ratio);
        /* 1.6e5 samples of a law whose kurtosis is about 36 / N p. */
        const double margin = 4.0 * sqrt((2.0 + 36.0 / (n[k / 2] * p[k % 2])) / noise.count);
        assert_true(ratio < 1.0 + margin && ratio > (2.0 - 0.5) / 8.0 - margin);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_over_draws_is_the_whole_sum),
        cmocka_unit_test(drawing_varies_as_its_bound_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
