/* The counting model where counts are rare, endless, certain or impossible, where the footprint is hardly one, and far
 * from the origin: means against their closed form, places against long double. */
#define _GNU_SOURCE
#include "traps.h"

#define GLINT_LANES 1
#include "math/binomial.h"
#include "model/counting_kernel.h"
#include "model/counting_place.h"
#include "wide.h"

static const double ROUNDING = (double)FLOAT_ROUNDING;

/* One draw of b(trials, p). */
static double draw(float trials, float p, int32_t u, float dither)
{
    vint uniform[12];
    vfloat weight[12] = { 1.0F };
    for (int i = 0; i < 12; i++)
        uniform[i] = i == 0 ? u : INT32_MAX;
    const binomial_chance c = binomial_chance_of(p);
    return (double)binomial_weighted_sum(trials, &c, uniform, weight, dither, NULL, (binomial_many){ 12, 1.0F });
}

/* The mean over all of 2^16 dithers and 2^32 uniforms, where no more than a few of these give a count. */
static wide rare_mean(float trials, float p)
{
    wide sum = 0.0L;
    for (int k = 0; k < 65536; k++)
        for (int32_t u = INT32_MIN;; u++) {
            const double count = draw(trials, p, u, (float)k * 0x1p-16F);
            if (!(count > 0.0))
                break;
            sum += (wide)count;
        }
    return sum * 0x1p-48L;
}

static void rare_counts_keep_their_mean(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    static const float means[] = { 1e-12F, 1e-11F, 3e-10F, 1e-9F };
    static const float trials[] = { 1e-6F, 0.5F, 1.0F, 37.5F, 1e9F, 1e18F };
    for (size_t i = 0; i < sizeof(means) / sizeof(means[0]); i++)
        for (size_t k = 0; k < sizeof(trials) / sizeof(trials[0]); k++) {
            const float p = means[i] / trials[k];
            const wide exact = (wide)trials[k] * (wide)p;
            /* A dither of 16 bits below a threshold of 31: one step of 2^-47. Above, six roundings of the survival
             * function. */
            worst_add(&worst, rare_mean(trials[k], p) - exact, 0x1p-47L + 6.0L * FLOAT_ROUNDING * exact,
                      (double)trials[k], (double)p, 0);
        }
    printf("mean of rare counts: off by %.1Le of %.1Le allowed, at N = %g, p = %g\n", worst.measured, worst.allowed,
           worst.at[0], worst.at[1]);
    assert_true(worst.error <= 1.0L);
}

/* The mean over uniforms in the middle of as many strata. */
static void counts_of_any_size_keep_their_mean(void **state)
{
    (void)state;
    enum { STRATA = 1 << 16 };
    static const float trials[] = { 0.5F, 1.0F, 1e3F, 1e9F, 1e12F, 1e15F, 1e18F };
    static const float chances[] = { 1e-30F, 1e-18F, 1e-12F, 1e-9F, 1e-6F, 1e-3F, 0.5F, 0.999F, 1.0F - 0x1p-24F, 1.0F };
    for (size_t i = 0; i < sizeof(trials) / sizeof(trials[0]); i++)
        for (size_t k = 0; k < sizeof(chances) / sizeof(chances[0]); k++) {
            const wide n = (wide)trials[i], p = (wide)chances[k], mean = n * p;
            if (mean < 0.4L)
                continue;
            wide sum = 0.0L;
            double least = (double)INFINITY, most = 0.0;
            for (int s = 0; s < STRATA; s++) {
                const double x =
                    draw(trials[i], chances[k], (int32_t)(INT32_MIN + 65536U * (uint32_t)s + 32768U), 0.5F);
                sum += (wide)x;
                least = fmin(least, x);
                most = fmax(most, x);
            }
            /* The count falls as u grows, so a stratum's middle is off by no more than its own fall: half the range
             * over all of them. The law itself has the mean within 2e-4 of the smaller count (docs/models.md), and a
             * count is a float. */
            const wide smaller = fminl(mean, n - mean + 1.0L);
            const wide bound = (wide)(most - least) / (2.0L * STRATA) + 2e-4L * smaller + 3.0L * FLOAT_ROUNDING * mean;
            if (fabsl(sum / STRATA - mean) > bound)
                fail_msg("N %g, p %g: mean %Lg, expected %Lg +- %Lg", (double)trials[i], (double)chances[k],
                         sum / STRATA, mean, bound);
        }
}

/* ---- footprints ---- */

enum { COUNT = 64 };

typedef struct arrays {
    double u[COUNT], v[COUNT];
    float dudx[COUNT], dudy[COUNT], dvdx[COUNT], dvdy[COUNT], density[COUNT], hx[COUNT], hy[COUNT], cap[COUNT],
        p[COUNT];
    uint32_t seed[COUNT];
} arrays;

static arrays a;
static const counting_points points = { a.u,       a.v,    a.dudx, a.dudy, a.dvdx, a.dvdy,
                                        a.density, a.seed, a.hx,   a.hy,   a.cap,  a.p };

/* One facet in a thousand, under a sunny slope. */
static void set_point(int i, double u, double v, const float j[4], float density, float p)
{
    a.u[i] = u;
    a.v[i] = v;
    a.dudx[i] = j[0];
    a.dudy[i] = j[1];
    a.dvdx[i] = j[2];
    a.dvdy[i] = j[3];
    a.density[i] = density;
    a.hx[i] = 0.1F;
    a.hy[i] = -0.2F;
    a.cap[i] = 1e-4F;
    a.p[i] = p;
    a.seed[i] = (uint32_t)i * 0x9E3779B1U;
}

/* Singular values from 1e-9 to 1e3 m, up to a million to one, in any direction; some of rank one. */
static void long_footprints_keep_their_facets(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    uint64_t random = 1;
    float factor[COUNT], facets[COUNT];
    for (int round = 0; round < 2000; round++) {
        for (int i = 0; i < COUNT; i++) {
            const double major = random_log_between(&random, 1e-9, 1e3),
                         minor = major / random_log_between(&random, 1, 1e6);
            const double t = random_between(&random, 0.0, 6.2831853), r = random_between(&random, 0.0, 6.2831853);
            const double c = cos(t), s = sin(t), x = cos(r), y = sin(r);
            const float j[4] = { (float)(c * major * x - s * minor * y), (float)(-c * major * y - s * minor * x),
                                 (float)(s * major * x + c * minor * y), (float)(-s * major * y + c * minor * x) };
            const float rank_one[4] = { j[0], 2.0F * j[0], j[1], 2.0F * j[1] };
            set_point(i, 0.3, -0.4, i % 8 ? j : rank_one, (float)random_log_between(&random, 1e-6, 1e18), 1e-3F);
        }
        counting_kernel_1(&points, COUNT, factor, facets);
        for (int i = 0; i < COUNT; i++) {
            const wide area = fabsl((wide)a.dudx[i] * (wide)a.dvdy[i] - (wide)a.dudy[i] * (wide)a.dvdx[i]);
            const wide exact = area * (wide)a.density[i];
            /* The determinant of floats is exact in doubles but for one rounding of the difference; then it is a float,
             * and so is the product. */
            if (exact > 1e-37L && area > 1e-37L)
                worst_add(&worst, relative_error((double)facets[i], exact), 2.01L * FLOAT_ROUNDING, (double)a.dudx[i],
                          (double)a.dvdy[i], (double)a.density[i]);
            assert_true(area > 1e-29L || area == 0.0L || facets[i] >= 0.0F);
            if (area == 0.0L)
                assert_true(factor[i] == 1.0F && facets[i] == 0.0F);
        }
    }
    assert_true(worst_holds(&worst, "N of long footprints", ROUNDING));
}

/* Cells and their weights a thousand kilometres and a million away: the position in the lattice in long double. */
static void far_places_keep_their_cells(void **state)
{
    (void)state;
    worst_error worst = { 0 };
    uint64_t random = 2;
    long other = 0;
    static const double far[] = { 1e-6, 1.0, 1e3, 1e6, 1e9 };
    for (int i = 0; i < 200000; i++) {
        const double u = random_between(&random, -1.0, 1.0) * far[i % 5];
        const double v = random_between(&random, -1.0, 1.0) * far[i / 5 % 5];
        /* Without a turn and at ratio one the four numbers of the lattice are known exactly, but for its skew. */
        const grid_vertex g = { 0.0F, 0, -(int)(random_bits(&random) % 21U) };
        vuint cell[GRID_CELLS];
        vfloat weight[GRID_CELLS], sine, cosine;
        grid_cells(&g, u, v, 77U, cell, weight);
        sincos_pi(0.0F, &sine, &cosine);
        const float across = exp2_i(-(g.level >> 1)) * (g.level & 1 ? 0.70710678F : 1.0F);
        const float skew = across * 0.577350269F, tall = across * 1.15470054F;
        const vuint grid = hash_top(77U + (vuint)g.level * HASH_Z, HASH_TOP);
        const wide a_u = (wide)(cosine * across + sine * skew), a_v = (wide)(sine * across - cosine * skew);
        const wide start = 1.0L + (wide)(grid >> 9) / 8388608.0L;
        const wide x = (wide)u * a_u + (wide)v * a_v + start;
        const wide y = (wide)v * (wide)(cosine * tall) - (wide)u * (wide)(sine * tall) + start;
        const wide fx = x - floorl(x), fy = y - floorl(y);
        const int upper = fx + fy >= 1.0L;
        const wide exact[3] = { fabsl(1.0L - fx - fy), upper ? 1.0L - fy : fx, upper ? 1.0L - fx : fy };
        /* Two products and two sums in double, of numbers of this size; a weight adds up both coordinates, and is a
         * float. */
        const wide size = fabsl((wide)u * a_u) + fabsl((wide)v * a_v) + fabsl((wide)v * (wide)tall) + 2.0L;
        const wide bound = 3.0L * DOUBLE_ROUNDING * size + 2.0L * FLOAT_ROUNDING;
        /* On an edge between two cells either is right. */
        if (fminl(fminl(exact[0], exact[1]), exact[2]) < bound || fx < bound || fy < bound) {
            other++;
            continue;
        }
        const vuint origin = (vuint)(int64_t)floorl(x) * HASH_Z + (vuint)(int64_t)floorl(y) * HASH_Y + grid;
        assert_int_equal(cell[1], hash_full(origin + HASH_Z));
        assert_int_equal(cell[2], hash_full(origin + HASH_Y));
        for (int k = 0; k < 3; k++)
            worst_add(&worst, (wide)weight[k] - exact[k], bound, u, v, (double)across);
    }
    printf("weights far out: off by %.1Le of %.1Le allowed, at %g %g m with %g cells per m; %ld of 200000 on an edge\n",
           worst.measured, worst.allowed, worst.at[0], worst.at[1], worst.at[2], other);
    assert_true(worst.error <= 1.0L);
    assert_true(other < 4000);
}

/* So far out that a cell has no number any more, single facets are lost; the mean must not be. */
static void places_without_cells_keep_the_mean(void **state)
{
    (void)state;
    static const double far[] = { 1e9, 1e11, 1e12 };
    uint64_t random = 3;
    float factor[COUNT], facets[COUNT];
    for (size_t k = 0; k < 3; k++) {
        moments m = { 0 };
        for (int round = 0; round < 400; round++) {
            for (int i = 0; i < COUNT; i++) {
                const float j[4] = { 1e-7F, 0.0F, 0.0F, 1e-7F };
                set_point(i, far[k] * random_between(&random, 0.5, 0.999),
                          far[k] * random_between(&random, -1.0, 0.999), j, 1e16F, 0.01F);
                a.seed[i] = (uint32_t)random_bits(&random);
            }
            counting_kernel_1(&points, COUNT, factor, facets);
            for (int i = 0; i < COUNT; i++) {
                assert_true(factor[i] >= 0.0F);
                moments_add(&m, (double)factor[i]);
            }
        }
        /* N p = 1: five standard errors. */
        if (fabs(m.mean - 1.0) > 5.0 * moments_standard_error(&m))
            fail_msg("%g m away: mean %g, expected 1 +- %g (%.1f sigmas)", far[k], m.mean, moments_standard_error(&m),
                     (m.mean - 1.0) / moments_standard_error(&m));
        assert_true(moments_variance(&m) < 5.0);
    }
}

/* What is rarer than a chance can be said is not counted at all: the mean is then right, and nobody sees the
 * difference.
 */
static void counts_too_rare_to_be_seen_are_smooth(void **state)
{
    (void)state;
    float factor[COUNT], facets[COUNT];
    const float j[4] = { 1e-3F, 0.0F, 0.0F, 1e-3F };
    for (int i = 0; i < COUNT; i++)
        set_point(i, 0.01 * i, 0.5, j, 1e6F, 1e-10F * powf(10.0F, -0.4F * (float)i));
    counting_kernel_1(&points, COUNT, factor, facets);
    for (int i = 0; i < COUNT; i++)
        assert_true(factor[i] == 1.0F);
}

/* ---- half vectors ---- */

/* The angular lattice: h on either side of the pole and of every seam between cells, and of levels. A step of h by one
 * float moves a weight by no more than that step in cells, and a cell of 2^-16 besides. */
static void half_vectors_cross_seams_without_a_jump(void **state)
{
    (void)state;
    uint64_t random = 4;
    float factor[COUNT], facets[COUNT];
    double most = 0.0;
    for (int round = 0; round < 4000; round++) {
        const double cap = random_log_between(&random, 1e-8, 1.0);
        const int level = (int)ceil(-log2(cap) / 2.0);
        /* A seam of this cap's cells, or the pole. */
        const double seam =
            round % 3 ? floor(random_between(&random, -1.0, 1.0) * ldexp(1.0, level)) * ldexp(1.0, -level) : 0.0;
        const double across = random_between(&random, -0.7, 0.7);
        const uint32_t seed = (uint32_t)random_bits(&random);
        const double step = ldexp(1.0, -level - 14);
        for (int i = 0; i < COUNT; i++) {
            const float j[4] = { 1e-3F, 0.0F, 0.0F, 1e-3F };
            set_point(i, 0.3, 0.4, j, 1e9F, 0.02F);
            const double h = seam + (i - COUNT / 2) * step;
            a.hx[i] = (float)(round & 1 ? h : across);
            a.hy[i] = (float)(round & 1 ? across : h);
            a.cap[i] = (float)cap;
            a.seed[i] = seed;
        }
        counting_kernel_1(&points, COUNT, factor, facets);
        for (int i = 1; i < COUNT; i++)
            most = fmax(most, fabs((double)factor[i] - (double)factor[i - 1]));
    }
    /* A quarter of 2^-12 of a cell moves as much weight from one side of a cell to the other, on all twelve cells.
     * Counts of 20 expected lie within 6 sigma of each other: 2 * 6 / sqrt(20 / 2) = 4 times the mean; and half a step
     * of 16 bits, or of h as a float near 1, on either side. */
    const double moved = 4.0 * (ldexp(1.0, -14) + 2.0 * ldexp(1.0, -16) + ldexp(1.0, -10));
    printf("largest step of the factor where h moves by 2^-14 of a cell: %.1e of %.1e\n", most, moved);
    assert_true(most < moved);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rare_counts_keep_their_mean, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(counts_of_any_size_keep_their_mean, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(long_footprints_keep_their_facets, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(far_places_keep_their_cells, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(places_without_cells_keep_the_mean, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(counts_too_rare_to_be_seen_are_smooth, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(half_vectors_cross_seams_without_a_jump, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
