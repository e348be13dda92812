/* The counting kernel: the same bits at every vector width, and the variance that its blending leaves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "model/counting_kernel.h"
#include "statistics.h"

enum { COUNT = 4096 };

typedef struct arrays {
    double u[COUNT], v[COUNT];
    float dudx[COUNT], dudy[COUNT], dvdx[COUNT], dvdy[COUNT], density[COUNT], hx[COUNT], hy[COUNT], cap[COUNT],
        p[COUNT];
    uint32_t seed[COUNT];
} arrays;

static arrays a;
static const counting_points points = { a.u,       a.v,    a.dudx, a.dudy, a.dvdx, a.dvdy,
                                        a.density, a.seed, a.hx,   a.hy,   a.cap,  a.p };

/* Log-uniform over everything that an ordinary scene and a hostile one may ask. */
static void fill(uint64_t *random)
{
    for (int i = 0; i < COUNT; i++) {
        const double size = random_log_between(random, 1e-7, 10.0), turn = random_between(random, 0.0, 6.3);
        const double minor = size / random_log_between(random, 1.0, 1e4);
        /* Up to 10^12 cells from the origin: of a double's 52 bits, 12 are left for the place within the cell. */
        const double far = minor * random_log_between(random, 1e-3, 1e12);
        a.u[i] = random_between(random, -far, far);
        a.v[i] = random_between(random, -far, far);
        a.dudx[i] = (float)(size * cos(turn));
        a.dvdx[i] = (float)(size * sin(turn));
        a.dudy[i] = (float)(-minor * sin(turn));
        a.dvdy[i] = (float)(minor * cos(turn));
        if (random_bits(random) % 50 == 0)
            a.dudy[i] = a.dvdy[i] = 0.0F;
        const double n = random_log_between(random, 1e-6, 1e12);
        a.density[i] = (float)(n / (size * minor));
        a.hx[i] = (float)random_between(random, -0.7, 0.7);
        a.hy[i] = (float)random_between(random, -0.7, 0.7);
        a.cap[i] = (float)random_log_between(random, 1e-10, 3.0);
        a.p[i] = (float)random_log_between(random, 1e-12, 1.0);
        if (random_bits(random) % 20 == 0)
            a.p[i] = 1.0F - a.p[i];
        a.seed[i] = (uint32_t)random_bits(random);
    }
}

static void every_width_gives_the_same_bits(void **state)
{
    (void)state;
    uint64_t random = 11;
    static float reference[COUNT], facets[COUNT], factor[COUNT], other[COUNT];
    for (int round = 0; round < 30; round++) {
        fill(&random);
        counting_kernel_1(&points, COUNT, reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            const counting_width width = counting_widest(lanes);
            if (round == 0)
                printf("%zu lanes asked, %zu found\n", lanes, width.lanes);
            width.kernel(&points, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
            counting_narrowest(lanes).kernel(&points, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        for (int i = 0; i < COUNT; i++)
            assert_true(isfinite(reference[i]) && reference[i] >= 0.0F && isfinite(facets[i]) && facets[i] >= 0.0F);
    }
}

/* ---- one realisation for all ---- */

/* Facets that are counted: root of det(density J J^T + I / 2). */
static double counted(int i)
{
    const double x = (double)a.dudx[i], y = (double)a.dudy[i], z = (double)a.dvdx[i], w = (double)a.dvdy[i];
    const double d = (double)a.density[i], uu = d * (x * x + y * y) + 0.5, vv = d * (z * z + w * w) + 0.5;
    const double uv = d * (x * z + y * w);
    return sqrt(uu * vv - uv * uv);
}

static void every_width_draws_the_same_realisation(void **state)
{
    (void)state;
    uint64_t random = 21;
    static uint32_t draw[COUNT];
    static float reference[COUNT], facets[COUNT], factor[COUNT], other[COUNT];
    for (int round = 0; round < 30; round++) {
        fill(&random);
        for (int i = 0; i < COUNT; i++)
            draw[i] = random_bits(&random) % 40 == 0 ? 0xffffffffU : (uint32_t)random_bits(&random);
        counting_drawn_1(&points, draw, COUNT, reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            counting_widest(lanes).drawn(&points, draw, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        for (int i = 0; i < COUNT; i++)
            assert_true(isfinite(reference[i]) && reference[i] >= 0.0F && isfinite(facets[i]) && facets[i] >= 0.0F);
    }
}

/* Points of N facets with this p, of which the kernel counts counted(i). */
static void fill_alike(uint64_t *random, double n, double p)
{
    fill(random);
    for (int i = 0; i < COUNT; i++) {
        a.u[i] = random_between(random, -1.0, 1.0);
        a.v[i] = random_between(random, -1.0, 1.0);
        a.dudx[i] = a.dvdy[i] = (float)random_log_between(random, 1e-5, 1e-1);
        a.dudy[i] = 0.0F;
        a.dvdx[i] = a.dudx[i] * (float)random_between(random, 0.0, 3.0);
        a.density[i] = (float)(n / ((double)a.dudx[i] * (double)a.dvdy[i]));
        a.p[i] = (float)p;
    }
}

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

/* ---- facets of different colours ---- */

/* A table of this many colours, some channels black, and a hue. */
static tint_palette palette_of(uint32_t count, float variation)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.color_variation = variation;
    o.color_count = count;
    for (uint32_t i = 0; i < 3 * count; i++)
        o.colors[i / 3][i % 3] = (float)(i * 5 % 7) / 7.0F;
    return tint_palette_of(&o);
}

static void every_width_gives_the_same_tints(void **state)
{
    (void)state;
    uint64_t random = 15;
    static float reference[3][COUNT], facets[COUNT], factor[3][COUNT], other[COUNT];
    float *const to_reference[3] = { reference[0], reference[1], reference[2] };
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    for (uint32_t round = 0; round < 18; round++) {
        const tint_palette palette = palette_of(round % 9, round < 9 ? 0.0F : 0.9F);
        fill(&random);
        counting_tinted_1(&points, COUNT, &palette, to_reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            counting_widest(lanes).tinted(&points, COUNT, &palette, to_factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        counting_narrowest(16).tinted(&points, COUNT, &palette, to_factor, other);
        assert_memory_equal(factor, reference, sizeof(factor));
        assert_memory_equal(other, facets, sizeof(other));
        for (int i = 0; i < 3 * COUNT; i++)
            assert_true(isfinite(reference[i % 3][i / 3]) && reference[i % 3][i / 3] >= 0.0F);
    }
}

static void one_white_color_gives_the_bits_of_the_plain_kernel(void **state)
{
    (void)state;
    uint64_t random = 16;
    static float plain[COUNT], facets[COUNT], factor[3][COUNT], other[COUNT];
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    const tint_palette white = palette_of(0, 0.0F);
    for (int round = 0; round < 10; round++) {
        fill(&random);
        const counting_width width = counting_widest(16);
        width.kernel(&points, COUNT, plain, facets);
        width.tinted(&points, COUNT, &white, to_factor, other);
        for (int c = 0; c < 3; c++)
            assert_memory_equal(factor[c], plain, sizeof(plain));
        assert_memory_equal(other, facets, sizeof(facets));
    }
}

/* Every width, for one light or several a point, in runs that begin and end anywhere in a vector. */
static void lights_of_a_point_have_the_bits_of_points_alone(void **state)
{
    (void)state;
    uint64_t random = 31;
    static float alone[COUNT], facets[COUNT], factor[COUNT], other[COUNT], tinted[3][COUNT];
    static double far[2][COUNT];
    static float near[5][COUNT];
    static uint32_t place[COUNT], seed[COUNT];
    float *const to_tinted[3] = { tinted[0], tinted[1], tinted[2] };
    const tint_palette white = palette_of(0, 0.0F);
    for (uint32_t most = 1; most <= 12; most++) {
        fill(&random);
        for (int i = 1; i < COUNT; i++)
            place[i] = place[i - 1] + (random_bits(&random) % most == 0);
        for (int i = 0; i < COUNT; i++) {
            far[0][i] = a.u[place[i]];
            far[1][i] = a.v[place[i]];
            near[0][i] = a.dudx[place[i]];
            near[1][i] = a.dudy[place[i]];
            near[2][i] = a.dvdx[place[i]];
            near[3][i] = a.dvdy[place[i]];
            near[4][i] = a.density[place[i]];
            seed[i] = a.seed[place[i]];
        }
        const counting_points apart = { far[0],  far[1], near[0], near[1], near[2], near[3],
                                        near[4], seed,   a.hx,    a.hy,    a.cap,   a.p };
        counting_points together = points;
        together.place = place;
        counting_kernel_1(&apart, COUNT, alone, facets);
        for (size_t lanes = 1; lanes <= 16; lanes *= 2) {
            const counting_width width = counting_widest(lanes);
            width.kernel(&together, COUNT, factor, other);
            assert_memory_equal(factor, alone, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
            width.tinted(&together, COUNT, &white, to_tinted, other);
            for (int c = 0; c < 3; c++)
                assert_memory_equal(tinted[c], alone, sizeof(alone));
            counting_narrowest(lanes).kernel(&together, COUNT, factor, other);
            assert_memory_equal(factor, alone, sizeof(factor));
        }
    }
}

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

/* ---- mean and variance ---- */

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
        cmocka_unit_test(every_width_gives_the_same_bits),
        cmocka_unit_test(lights_of_a_point_have_the_bits_of_points_alone),
        cmocka_unit_test(every_width_draws_the_same_realisation),
        cmocka_unit_test(mean_over_draws_is_the_whole_sum),
        cmocka_unit_test(drawing_varies_as_its_bound_says),
        cmocka_unit_test(every_width_gives_the_same_tints),
        cmocka_unit_test(one_white_color_gives_the_bits_of_the_plain_kernel),
        cmocka_unit_test(hues_leave_the_mean_of_the_channels),
        cmocka_unit_test(colors_pop_no_more_than_counts),
        cmocka_unit_test(mean_is_one_and_variance_follows_from_the_blending),
        cmocka_unit_test(chroma_varies_as_the_tints_of_lit_facets),
        cmocka_unit_test(facet_larger_than_the_pixel_is_lit_or_not),
        cmocka_unit_test(origin_is_a_place_like_any_other),
        cmocka_unit_test(half_vectors_nearby_share_facets_in_every_direction),
        cmocka_unit_test(nothing_moves_when_the_cap_passes_a_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
