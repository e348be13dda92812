/* Facets of different colours: what hues leave alone, how far colours pop, and how much they vary. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "kernel_points.h"

/* The hues of a facet add up to white, so the mean of the channels is what it was without them. */
static void hues_leave_the_mean_of_the_channels(void **state)
{
    (void)state;
    uint64_t random = 17;
    static float plain[COUNT], facets[COUNT], factor[3][COUNT];
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    const tint_palette hues = palette_of(0, 1.0F);
    for (int round = 0; round < 10; round++) {
        fill(&random);
        counting_kernel_1(&points, COUNT, plain, facets);
        counting_tinted_1(&points, COUNT, &hues, to_factor, facets);
        for (int i = 0; i < COUNT; i++) {
            const double mean = ((double)factor[0][i] + (double)factor[1][i] + (double)factor[2][i]) / 3.0;
            /* The polynomial of sin(pi x) is good to 2e-6; sums of 36 floats to 36 half ulp. */
            assert_true(fabs(mean - (double)plain[i]) < 6e-6 * fmax((double)plain[i], 1.0));
        }
    }
}

/* A light that grows by a thousandth lights some facets more and puts out none. With T the most that a tint may be,
 * X + sqrt(X) (T - 1) moves by no more than T for one facet more: colours pop no more than counts do. */
static void colors_pop_no_more_than_counts(void **state)
{
    (void)state;
    uint64_t random = 18;
    static float plain[2][COUNT], facets[COUNT], factor[2][3][COUNT];
    const tint_palette palette = palette_of(3, 1.0F);
    double most = 1.0;
    for (int i = 0; i < 9; i++)
        most = fmax(most, 2.0 * (double)palette.color[i / 3][i % 3]);
    long moved = 0;
    for (int round = 0; round < 100; round++) {
        fill(&random);
        double expected[2][COUNT];
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < COUNT; i++) {
                a.dudx[i] = a.dvdy[i] = 1e-3F;
                a.dudy[i] = a.dvdx[i] = 0.0F;
                a.u[i] = k ? a.u[i] : random_between(&random, -1.0, 1.0);
                a.v[i] = k ? a.v[i] : random_between(&random, -1.0, 1.0);
                a.density[i] = 2e7F; /* at most 9 in one grid, of which less than 8 are lit: counts are walked */
                a.p[i] = k ? a.p[i] * 1.001F : (float)random_log_between(&random, 1e-3, 0.49);
                expected[k][i] = 0.5 * 20.5 * (double)a.p[i];
            }
            float *const to_factor[3] = { factor[k][0], factor[k][1], factor[k][2] };
            counting_kernel_1(&points, COUNT, plain[k], facets);
            counting_tinted_1(&points, COUNT, &palette, to_factor, facets);
        }
        for (int i = 0; i < COUNT; i++) {
            const double more = expected[1][i] * (double)plain[1][i] - expected[0][i] * (double)plain[0][i];
            moved += more > 1e-3;
            for (int c = 0; c < 3; c++) {
                const double step = expected[1][i] * (double)factor[1][c][i] - expected[0][i] * (double)factor[0][c][i];
                assert_true(fabs(step) <= most * fabs(more) + 1e-5 * (1.0 + expected[0][i] * most));
            }
        }
    }
    printf("%ld of %d counts moved\n", moved, 100 * COUNT);
    assert_true(moved > 1000);
}

/* A chroma part a.f of the factors has Var = 1/2 Var(a.T) / (N' p): the tints of all the facets that are lit, and of a
 * fraction of one too. For hues and red less green Var(a.T) = 3/2. */
static void chroma_varies_as_the_tints_of_lit_facets(void **state)
{
    (void)state;
    static const double n[] = { 1.0, 30.0, 1e3, 1e6 }, p[] = { 1e-2, 0.4, 0.95 };
    static float factor[3][COUNT], facets[COUNT];
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    const tint_palette hues = palette_of(0, 1.0F);
    const counting_width width = counting_widest(16);
    uint64_t random = 19;
    for (size_t k = 0; k < 4; k++)
        for (size_t j = 0; j < 3; j++) {
            moments m = { 0 }, inverse = { 0 };
            for (int round = 0; round < 60; round++) {
                fill(&random);
                for (int i = 0; i < COUNT; i++) {
                    a.dudx[i] = a.dvdy[i] = (float)random_log_between(&random, 1e-5, 1e-1);
                    a.dudy[i] = a.dvdx[i] = 0.0F;
                    a.density[i] = (float)n[k] / (a.dudx[i] * a.dudx[i]);
                    a.p[i] = (float)p[j];
                    moments_add(&inverse, 1.0 / counted(i));
                }
                width.tinted(&points, COUNT, &hues, to_factor, facets);
                for (int i = 0; i < COUNT; i++)
                    moments_add(&m, (double)factor[0][i] - (double)factor[1][i]);
            }
            const double expected = 0.5 * 1.5 * inverse.mean / p[j], sigma = moments_standard_error(&m);
            printf("N %g p %g: chroma %+.1f sigma, variance over that of tints %.4f\n", n[k], p[j], m.mean / sigma,
                   moments_variance(&m) / expected);
            assert_true(fabs(m.mean) < 4.5 * sigma);
            /* As for counts: 1 % for the blending, and noise. */
            const double noise = 4.0 * sqrt((2.0 + 9.0 / (n[k] * p[j])) / m.count);
            assert_true(fabs(moments_variance(&m) / expected - 1.0) < 0.01 + noise);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hues_leave_the_mean_of_the_channels),
        cmocka_unit_test(colors_pop_no_more_than_counts),
        cmocka_unit_test(chroma_varies_as_the_tints_of_lit_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
