/* The dictionary's table and the cells under a footprint: integrals, lobes, mean, places. */
#include <fenv.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "model/dictionary_cell.h"
#include "model/dictionary_kernel.h"
#include "model/dictionary_patch.h"
#include "statistics.h"

#define PI 3.14159265358979323846

/* FNV-1a of the table of seed 1. */
#define KNOWN 0xe3cc6f6bcbb802c0ULL

static dictionary table;
static dictionary_scratch scratch;

static void takes_384_KiB(void **state)
{
    (void)state;
    assert_true(sizeof(table) <= (size_t)384 * 1024);
}

static uint64_t fnv1a(const void *bytes, size_t count)
{
    uint64_t h = 0xcbf29ce484222325U;
    for (size_t i = 0; i < count; i++)
        h = (h ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3U;
    return h;
}

/* The number was found once, with gcc 12 at -O3; every compiler and machine must find it again. */
static void seed_alone_decides_every_bit(void **state)
{
    (void)state;
    dictionary_build(&table, &scratch, 1);
    const uint64_t first = fnv1a(&table, sizeof(table));
    dictionary_build(&table, &scratch, 2);
    assert_true(fnv1a(&table, sizeof(table)) != first);
    if (first != KNOWN)
        fail_msg("the table of seed 1 has the hash %#llx", (unsigned long long)first);
}

/* Simpson's rule in double on 16 points a sample, which knows nothing about where the samples are. */
static double integral(const dictionary_marginal marginal)
{
    enum { STEPS = 16 * DICTIONARY_SAMPLES };
    const double h = (double)DICTIONARY_DOMAIN / STEPS;
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        const double a = (double)dictionary_density(marginal, (float)(i * h));
        const double m = (double)dictionary_density(marginal, (float)((i + 0.5) * h));
        const double b = (double)dictionary_density(marginal, (float)((i + 1) * h));
        sum += (a + 4.0 * m + b) * h / 6.0;
    }
    return 2.0 * sum;
}

static void every_marginal_integrates_to_one(void **state)
{
    (void)state;
    dictionary_build(&table, &scratch, 3);
    double worst = 0.0;
    for (int l = 0; l < DICTIONARY_LEVELS; l++)
        for (int i = 0; i < DICTIONARY_MARGINALS; i++)
            worst = fmax(worst, fabs(integral(table.marginal[l][i]) - 1.0));
    printf("largest deviation from 1: %.1e (bound 3e-4)\n", worst);
    assert_true(worst < 3e-4);
}

/* Peaks at least least high. */
static int count_lobes(const dictionary_marginal marginal, float least)
{
    int lobes = 0;
    const float h = DICTIONARY_DOMAIN / DICTIONARY_SAMPLES;
    for (int i = 0; i < DICTIONARY_SAMPLES; i++) {
        const float before = dictionary_density(marginal, (float)(i - 1) * h); /* of i = 0 the mirror image */
        const float here = dictionary_density(marginal, (float)i * h);
        if (here < least)
            continue;
        lobes += here > before && here >= dictionary_density(marginal, (float)(i + 1) * h);
    }
    return lobes;
}

/* Level l has the lobes of level l - 1, half as high, and as many new ones. */
static void lobes_double_from_level_to_level_and_stay(void **state)
{
    (void)state;
    const float h = DICTIONARY_DOMAIN / DICTIONARY_SAMPLES;
    dictionary_build(&table, &scratch, 4);
    for (int i = 0; i < DICTIONARY_MARGINALS; i++) {
        /* One of 2^l lobes of sigma .02 with its mirror image is 10 / 2^l high, and .86 of that at the nearest sample.
         */
        assert_int_equal(count_lobes(table.marginal[0][i], 8.0F), 1);
        for (int l = 1; l < DICTIONARY_LEVELS; l++) {
            assert_true(count_lobes(table.marginal[l][i], ldexpf(8.0F, -l)) <= 1 << l);
            for (float x = 0.0F; x < DICTIONARY_DOMAIN; x += 0.01F) {
                const float before = dictionary_density(table.marginal[l - 1][i], x);
                const float now = dictionary_density(table.marginal[l][i], x);
                /* A lobe's tails end between 3.3 and 4.4 sigmas, 5e-4 of it. Rounding to half is 2^-11 of a sample and
                 * of what its inner neighbour passed on, and there is nothing below 6e-5. */
                const float inner = fabsf(x - h);
                const float largest =
                    fmaxf(fmaxf(before, now), fmaxf(dictionary_density(table.marginal[l - 1][i], inner),
                                                    dictionary_density(table.marginal[l][i], inner)));
                assert_true(now >= 0.5F * before * (1.0F - 5e-4F) - 0x1p-10F * largest - 1.3e-4F);
            }
        }
    }
}

static void quantiles_invert_the_integral(void **state)
{
    (void)state;
    dictionary_build(&table, &scratch, 5);
    uint64_t random = 1;
    for (int k = 0; k < 2000; k++) {
        const uint64_t pick = random_bits(&random);
        const uint16_t *marginal = table.marginal[pick % DICTIONARY_LEVELS][pick / 16 % DICTIONARY_MARGINALS];
        const float u = (float)random_uniform(&random) * 0.9999999F;
        const double x = (double)dictionary_quantile(marginal, u);
        const int steps = 4000;
        double below = 0.0;
        for (int i = 0; i < steps; i++)
            below += (double)dictionary_density(marginal, (float)((i + 0.5) * fabs(x) / steps)) * fabs(x) / steps;
        /* 3e-6 from the area of the half floats, the midpoint rule at kinks and u in float. */
        assert_true(fabs(0.5 + copysign(below, x) - (double)u) < 2e-5);
    }
}

/* Nothing in the middle and at the first samples: 0 / 0 there, which is not to be asked for. */
static void quantiles_are_numbers_where_there_is_no_density(void **state)
{
    (void)state;
    enum { EMPTY = 3 };
    dictionary_marginal marginal = { 0 };
    marginal[EMPTY] = 0x3c00; /* 1 */
    feclearexcept(FE_ALL_EXCEPT);
    const float middle = dictionary_quantile(marginal, 0.5F), beside = dictionary_quantile(marginal, 0.5F + 0x1p-24F);
    assert_false(fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW));
    assert_true(middle >= 0.0F && middle <= EMPTY * DICTIONARY_SPACING);
    assert_true(beside >= middle && beside <= (EMPTY + 1) * DICTIONARY_SPACING);
}

/* Of the logarithm to base 4 of how many facets a cell has, over cells: its mean, and the deviation that is asked for,
 * eight of which lie between the ends of what a cell may have. Normal: the fourth moment is 3. */
static void density_varies_from_cell_to_cell_as_asked(void **state)
{
    (void)state;
    enum { CELLS = 1 << 18 };
    const float mean = 0.5F * DICTIONARY_LEVELS, deviation = mean / 8.0F;
    const dictionary_surface s = { &table, { NDF_GGX, 0.4F, 0.4F }, 1.0F, deviation };
    uint64_t random = 21;
    moments log4 = { 0 };
    double fourth = 0.0;
    for (int i = 0; i < CELLS; i++) {
        const double x = (double)dictionary_cell_log4(&s, (uint32_t)random_bits(&random), mean, 1.0F);
        moments_add(&log4, x);
        fourth += pow((x - (double)mean) / (double)deviation, 4.0) / CELLS;
    }
    const double found = sqrt(moments_variance(&log4)) / (double)deviation;
    printf("log4 of the density: mean %.4f of %.4f, deviation %.4f of that asked for, fourth moment %.3f\n", log4.mean,
           (double)mean, found, fourth);
    /* Five standard errors of a normal sample: 1 / sqrt(n), 1 / sqrt(2 n), sqrt(96 / n). The quantile is off by .0008
     * deviations near the middle, and by .023 beyond four, where it ends. */
    assert_true(fabs(log4.mean - (double)mean) < (5.0 / sqrt(CELLS) + 0.0008) * (double)deviation);
    assert_true(fabs(found - 1.0) < 5.0 / sqrt(2.0 * CELLS) + 0.0008);
    assert_true(fabs(fourth - 3.0) < 5.0 * sqrt(96.0 / CELLS) + 4.0 * 0.0008 * 3.0);
}

/* The average over cells is the surface's own distribution at every slope, whatever the number of facets. Seeds are
 * independent, cells of one seed share its marginals: the error is that of the mean over seeds. */
static void mean_over_cells_is_the_target(void **state)
{
    (void)state;
    enum { SEEDS = 24, CELLS = 12000, SLOPES = 6, AT_ONCE = 400 };
    static const double slopes[SLOPES][2] = { { 0, 0 },     { 0.7, 0 },    { 0, 0.7 },
                                              { 0.9, 0.6 }, { -1.1, 0.4 }, { 0.3, 1.2 } };
    static const float facets[] = { 1.0F, 20.0F, 1e4F };
    const double ax = 0.4, ay = 0.1;
    moments mean[2][3][SLOPES] = { { { { 0 } } } };
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        dictionary_build(&table, &scratch, seed);
        for (int k = 0; k < 2; k++)
            for (int f = 0; f < 3; f++) {
                const dictionary_surface s = {
                    &table, { k ? NDF_BECKMANN : NDF_GGX, (float)ax, (float)ay }, 1.0F, 0.0F
                };
                double sum[SLOPES] = { 0.0 };
                uint64_t random = (uint64_t)seed << 8 | (uint64_t)(3 * k + f);
                for (int c = 0; c < CELLS; c += AT_ONCE) {
                    dictionary_cells cells;
                    float density[DICTIONARY_ROOM];
                    for (int i = 0; i < AT_ONCE; i++) {
                        cells.hash[i] = (uint32_t)random_bits(&random);
                        cells.log4_facets[i] = dictionary_cell_log4(&s, cells.hash[i], 0.5F * log2f(facets[f]), 1.0F);
                    }
                    for (int n = 0; n < SLOPES; n++) {
                        dictionary_cells_density(&s, &cells, AT_ONCE,
                                                 (slope){ (float)(slopes[n][0] * ax), (float)(slopes[n][1] * ay) },
                                                 density);
                        for (int i = 0; i < AT_ONCE; i++)
                            sum[n] += (double)density[i];
                    }
                }
                for (int i = 0; i < SLOPES; i++) {
                    const double r2 = slopes[i][0] * slopes[i][0] + slopes[i][1] * slopes[i][1];
                    const double target = (k ? exp(-r2) : 1.0 / ((1.0 + r2) * (1.0 + r2))) / (PI * ax * ay);
                    moments_add(&mean[k][f][i], sum[i] / CELLS / target);
                }
            }
    }
    printf("mean over cells / target, in sigmas of 24 seeds\n");
    int failed = 0;
    for (int k = 0; k < 2; k++)
        for (int f = 0; f < 3; f++) {
            printf("%-8s %5g facets:", k ? "Beckmann" : "GGX", (double)facets[f]);
            for (int i = 0; i < SLOPES; i++) {
                const moments *m = &mean[k][f][i];
                const double error = m->mean - 1.0, sigma = moments_standard_error(m);
                printf("  %.4f %+.1f", m->mean, error / sigma);
                /* Student's t of 23 degrees of freedom: 4.9 sigmas for 36 means is a significance of .002. 1.3e-3: see
                 * the resolution in configurations.h. */
                failed += fabs(error) > 4.9 * sigma + 1.3e-3;
            }
            printf("\n");
        }
    assert_int_equal(failed, 0);
}

/* ---- patches ---- */

static dictionary_patch patch, other;

static int has_cell(const dictionary_patch *p, uint32_t hash, int level)
{
    for (int i = 0; i < p->count; i++)
        if (p->cell[i].hash == hash && p->cell[i].level == level)
            return 1;
    return 0;
}

static glint_footprint ellipse_at(double u, double v, double major, double minor, double turn)
{
    return (glint_footprint){ u,
                              v,
                              (float)(major * cos(turn)),
                              (float)(-minor * sin(turn)),
                              (float)(major * sin(turn)),
                              (float)(minor * cos(turn)),
                              0U };
}

static void every_width_gives_the_same_cells(void **state)
{
    (void)state;
    uint64_t random = 41;
    dictionary_build(&table, &scratch, 5);
    static dictionary_corners corners;
    static dictionary_cells cells;
    static float weight[2][DICTIONARY_ROOM], density[2][DICTIONARY_ROOM];
    static uint32_t hash[2][DICTIONARY_ROOM];
    enum { COUNT = 400 };
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < COUNT; i++) {
            corners.row[i] = (uint32_t)random_bits(&random);
            corners.low[i] = (uint32_t)random_bits(&random);
            corners.high[i] = (uint32_t)random_bits(&random);
            corners.r2[i] = (float)random_between(&random, 0.0, 1.0);
            cells.hash[i] = (uint32_t)random_bits(&random);
            cells.log4_facets[i] = (float)random_between(&random, 0.0, 16.0);
        }
        const ndf_kind kind = round % 2 ? NDF_GGX : NDF_BECKMANN;
        /* Two in the domain of the marginals, and beyond it. */
        const float x = (float)random_between(&random, -2.0, 2.0), y = (float)random_between(&random, -2.0, 2.0);
        for (size_t lanes = 1; lanes <= 16; lanes = lanes == 1 ? 4 : 2 * lanes) {
            const dictionary_width width = dictionary_widest(lanes);
            const int k = lanes > 1;
            width.weigh(&corners, COUNT, hash[k], weight[k]);
            width.look(&table, kind, &cells, COUNT, x, y, density[k]);
            assert_memory_equal(hash[k], hash[0], COUNT * sizeof(hash[0][0]));
            assert_memory_equal(weight[k], weight[0], COUNT * sizeof(weight[0][0]));
            assert_memory_equal(density[k], density[0], COUNT * sizeof(density[0][0]));
        }
    }
}

static void weights_sum_to_one_and_cells_fit(void **state)
{
    (void)state;
    uint64_t random = 2;
    int most = 0;
    for (int k = 0; k < 20000; k++) {
        const double major = random_log_between(&random, 1e-6, 1e3);
        const glint_footprint f =
            ellipse_at(random_between(&random, -1e3, 1e3), random_between(&random, -1e3, 1e3), major,
                       major / random_log_between(&random, 1.0, 1e4), random_between(&random, 0.0, PI));
        dictionary_patch_find(&patch, &f, (float)random_log_between(&random, 1e-3, 1e15),
                              (float)random_between(&random, 1.0, DICTIONARY_MAX_ANISOTROPY), 7);
        double sum = 0.0;
        for (int i = 0; i < patch.count; i++) {
            assert_true(patch.cell[i].weight >= 0.0F);
            sum += (double)patch.cell[i].weight;
        }
        assert_true(fabs(sum - 1.0) < 1e-5 && patch.count > 0 && patch.grain_level[0] >= 0);
        most = patch.count > most ? patch.count : most;
    }
    printf("at most %d cells, room for %d\n", most, DICTIONARY_MAX_CELLS);
    assert_true(most <= DICTIONARY_MAX_CELLS);
}

/* A long footprint sees what small ones along its major axis see, and nothing of what lies as far away across it. */
static void cells_lie_along_the_footprint(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int k = 0; k < 500; k++) {
        const double u = random_between(&random, -5.0, 5.0), v = random_between(&random, -5.0, 5.0);
        const double turn = random_between(&random, 0.0, PI);
        const glint_footprint f = ellipse_at(u, v, 12e-3, 1e-3, turn);
        dictionary_patch_find(&patch, &f, 1e12F, 16.0F, 7);
        for (int side = -1; side <= 1; side += 2)
            for (int across = 0; across < 2; across++) {
                const double away = 7e-3 * side, direction = turn + 0.5 * PI * across;
                const glint_footprint small =
                    ellipse_at(u + away * cos(direction), v + away * sin(direction), 1e-4, 1e-4, 0.0);
                /* So many facets that its finest cells are those of the long footprint's finer level. */
                dictionary_patch_find(&other, &small, (float)pow(4.0, 10.0), 16.0F, 7);
                int seen = 0, there = 0;
                for (int i = 0; i < other.count; i++)
                    if (other.cell[i].level == 0 && other.cell[i].weight > 0.15F) {
                        there++;
                        seen += has_cell(&patch, other.cell[i].hash, 0);
                    }
                assert_true(there > 0);
                assert_int_equal(seen, across ? 0 : there);
            }
    }
}

/* Figure 7: a coarser cell has the hash of that one of its four children whose corner it shares. */
static void cells_of_neighbouring_levels_share_one_index_in_four(void **state)
{
    (void)state;
    uint64_t random = 4;
    double children = 0.0, shared = 0.0;
    for (int k = 0; k < 500; k++) {
        const double u = random_between(&random, -5.0, 5.0), v = random_between(&random, -5.0, 5.0);
        const double size = 1.5 / 1024.0;
        glint_footprint f = ellipse_at(u, v, size, size, 0.0);
        dictionary_patch_find(&patch, &f, 1e12F, 4.0F, 7);
        f = ellipse_at(u, v, 2.0 * size, 2.0 * size, 0.0);
        dictionary_patch_find(&other, &f, 1e12F, 4.0F, 7);
        for (int i = 0; i < patch.count; i++)
            if (patch.cell[i].level == 1) {
                assert_true(has_cell(&other, patch.cell[i].hash, 0));
            } else {
                children += 1.0;
                shared += has_cell(&other, patch.cell[i].hash, 0);
            }
    }
    /* Ellipses sit anywhere on the lattice: one child in four in the mean. 500 patches of some 12 cells, of which the
     * number of even ones varies by about 1. */
    printf("%.4f of the finer cells have the index of a coarser one\n", shared / children);
    assert_true(fabs(shared / children - 0.25) < 4.0 / sqrt(500.0) / 12.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(takes_384_KiB),
        cmocka_unit_test(seed_alone_decides_every_bit),
        cmocka_unit_test(every_marginal_integrates_to_one),
        cmocka_unit_test(lobes_double_from_level_to_level_and_stay),
        cmocka_unit_test(quantiles_invert_the_integral),
        cmocka_unit_test(quantiles_are_numbers_where_there_is_no_density),
        cmocka_unit_test(density_varies_from_cell_to_cell_as_asked),
        cmocka_unit_test(mean_over_cells_is_the_target),
        cmocka_unit_test(every_width_gives_the_same_cells),
        cmocka_unit_test(weights_sum_to_one_and_cells_fit),
        cmocka_unit_test(cells_lie_along_the_footprint),
        cmocka_unit_test(cells_of_neighbouring_levels_share_one_index_in_four),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
