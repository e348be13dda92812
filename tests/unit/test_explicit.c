/* The explicit model's parts against closed forms: which cells, which facets, which normals, how much light. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "footprint/coverage.h"
#include "model/facet.h"
#include "model/facet_lobe.h"
#include "ndf/slopes.h"
#include "statistics.h"

#define PI 3.14159265358979323846

static coverage_pixel random_pixel(uint64_t *random)
{
    const double size = random_log_between(random, 0.05, 30.0), turn = random_between(random, 0.0, 6.3);
    const double other = size * random_between(random, 0.01, 1.0), skew = random_between(random, -0.5, 0.5);
    return (coverage_pixel){ random_between(random, -1e6, 1e6),
                             random_between(random, -1e6, 1e6),
                             size * cos(turn),
                             -other * sin(turn + skew),
                             size * sin(turn),
                             other * cos(turn + skew) };
}

typedef struct tally {
    double sum, cells, u, v;
    double least;
} tally;

static void tally_cell(int64_t x, int64_t y, double share, void *user)
{
    tally *t = user;
    t->sum += share;
    t->cells += 1.0;
    t->u += share * ((double)x + 0.5);
    t->v += share * ((double)y + 0.5);
    t->least = fmin(t->least, share);
}

static void shares_add_up_and_surround_the_pixel(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 5000; i++) {
        const coverage_pixel p = random_pixel(&random);
        tally t = { .least = 1.0 };
        coverage_each(&p, tally_cell, &t);
        assert_true(fabs(t.sum - 1.0) < 1e-9);
        assert_true(t.least > 0.0);
        assert_true(t.cells <= coverage_cell_bound(&p));
        /* The centre of the shares is within a cell of the pixel's. */
        assert_true(fabs(t.u - p.u) < 1.0 && fabs(t.v - p.v) < 1.0);
    }
}

/* The cost is one visit a facet: as many as the pixel has area, and those that its outline cuts. */
static void visits_grow_with_the_facets_and_no_faster(void **state)
{
    (void)state;
    for (double side = 1.0; side < 3000.0; side *= 3.0) {
        const coverage_pixel p = { 0.3, 0.7, 0.8 * side, -0.6 * side, 0.6 * side, 0.8 * side };
        tally t = { .least = 1.0 };
        coverage_each(&p, tally_cell, &t);
        /* A straight line of length 4 side crosses at most 4 side * sqrt(2) + 4 borders, and enters a cell at each. */
        assert_true(t.cells >= side * side && t.cells <= side * side + 4.0 * sqrt(2.0) * side + 4.0);
    }
}

/* Deep inside a facet the pixel is a millionth of a cell, and still has its whole share there. */
static void pixel_within_a_cell_has_all_of_it(void **state)
{
    (void)state;
    for (double size = 1e-3; size > 1e-9; size *= 0.1) {
        const coverage_pixel p = { 12345.6, -789.3, size, 0.3 * size, -0.2 * size, 0.1 * size };
        tally t = { .least = 1.0 };
        coverage_each(&p, tally_cell, &t);
        assert_true(t.cells == 1.0 && fabs(t.sum - 1.0) < 1e-5);
        assert_true(fabs(coverage_area(&p) / (0.16 * size * size) - 1.0) < 1e-12);
    }
}

typedef struct probe {
    int64_t x, y;
    double share;
} probe;

static void find_cell(int64_t x, int64_t y, double share, void *user)
{
    probe *p = user;
    if (x == p->x && y == p->y)
        p->share = share;
}

/* The share of one cell by a fine regular grid of points of the pixel. */
static void share_of_a_cell_agrees_with_points(void **state)
{
    (void)state;
    enum { FINE = 400 };
    uint64_t random = 2;
    for (int i = 0; i < 200; i++) {
        const coverage_pixel p = random_pixel(&random);
        probe found = { (int64_t)floor(p.u), (int64_t)floor(p.v), 0.0 };
        coverage_each(&p, find_cell, &found);
        int inside = 0;
        for (int a = 0; a < FINE; a++)
            for (int b = 0; b < FINE; b++) {
                const double s = (a + 0.5) / FINE - 0.5, t = (b + 0.5) / FINE - 0.5;
                inside += floor(p.u + s * p.dudx + t * p.dudy) == (double)found.x &&
                          floor(p.v + s * p.dvdx + t * p.dvdy) == (double)found.y;
            }
        /* Points within half a step of the cell's outline are in doubt: its outline crosses at most 4 sides of FINE
         * points. */
        assert_true(fabs((double)inside / (FINE * FINE) - found.share) < 4.0 / FINE);
    }
}

/* Numbers from an implementation in Python, which was held against Blender's White Noise and POV-Ray's functions. */
static void hashes_are_those_of_the_renderers(void **state)
{
    (void)state;
    static const struct {
        int64_t x, y;
        uint32_t seed;
        double cycles[2], povray[2];
    } known[] = {
        { 0, 0, 0U, { 0.6110676517, 0.1029127322 }, { 0.6845635040, 0.5189444168 } },
        { 1, 2, 3U, { 0.2945981464, 0.4703811029 }, { 0.8020968314, 0.9536259610 } },
        { -5, 17, 7U, { 0.1965540175, 0.3934307164 }, { 0.4507055052, 0.9809142490 } },
        { 4000, -3000, 1U, { 0.8991721933, 0.9727768653 }, { 0.4963148843, 0.8498165036 } },
        { 123456, 654321, 12345U, { 0.5241772485, 0.3055675578 }, { 0.9950938108, 0.6822531925 } },
    };
    for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++) {
        const facet_uniforms c = facet_hash(GLINT_FACET_HASH_CYCLES, known[i].x, known[i].y, known[i].seed);
        const facet_uniforms p = facet_hash(GLINT_FACET_HASH_POVRAY, known[i].x, known[i].y, known[i].seed);
        assert_true(fabs(c.radius - known[i].cycles[0]) < 1e-9 && fabs(c.azimuth - known[i].cycles[1]) < 1e-9);
        assert_true(fabs(p.radius - known[i].povray[0]) < 1e-9 && fabs(p.azimuth - known[i].povray[1]) < 1e-9);
    }
}

/* Slopes at roughness one in cells that are equally likely under P22; with equal areas each is weighted by its own
 * sqrt(1 + slope^2) / D_H. */
static void slopes_follow_their_weighting(void **state)
{
    (void)state;
    static const float alphas[][2] = { { 0.3F, 0.3F }, { 1.0F, 1.0F }, { 0.9F, 0.1F }, { 0.05F, 0.05F } };
    enum { ROWS = 16, COLUMNS = 16, SAMPLES = 400000, FINE = 64 };
    uint64_t random = 3;
    for (int kind = 0; kind < 2; kind++)
        for (int a = 0; a < 4; a++)
            for (int weighting = 0; weighting < 2; weighting++) {
                const ndf n = { kind ? NDF_BECKMANN : NDF_GGX, alphas[a][0], alphas[a][1] };
                const double area = (double)ndf_total_area(&n);
                double expected[ROWS * COLUMNS] = { 0 }, seen[ROWS * COLUMNS] = { 0 };
                for (int i = 0; i < ROWS * FINE; i++)
                    for (int k = 0; k < COLUMNS * FINE; k++) {
                        /* As in the test of visible normals: 1 - (1 - w)^2 is the distribution function of the radius.
                         */
                        const double w = (i + 0.5) / (ROWS * FINE), phi = 2.0 * PI * (k + 0.5) / (COLUMNS * FINE);
                        const double v = 1.0 - (1.0 - w) * (1.0 - w);
                        const double r = kind ? sqrt(-log1p(-v)) : sqrt(v / (1.0 - v));
                        const double x = r * cos(phi) * (double)n.alpha_x, y = r * sin(phi) * (double)n.alpha_y;
                        const double weight = weighting ? 1.0 : sqrt(1.0 + x * x + y * y) / area;
                        expected[i / FINE * COLUMNS + k / FINE] +=
                            weight * 2.0 * (1.0 - w) / (ROWS * FINE * COLUMNS * FINE) * SAMPLES;
                    }
                for (int i = 0; i < SAMPLES; i++) {
                    const float u = (float)(random_bits(&random) >> 40) * 0x1p-24F;
                    const float t = (float)(random_bits(&random) >> 40) * 0x1p-24F;
                    const slope2 s = weighting ? slopes_of_projected_area(&n, u, t) : slopes_of_area(&n, u, t);
                    const double x = (double)(s.x / n.alpha_x), y = (double)(s.y / n.alpha_y), r2 = x * x + y * y;
                    const double w = 1.0 - (kind ? exp(-0.5 * r2) : 1.0 / sqrt(1.0 + r2));
                    const double phi = atan2(y, x) / (2.0 * PI);
                    const int row = (int)fmin(w * ROWS, ROWS - 1);
                    seen[row * COLUMNS + (int)fmin((phi < 0.0 ? phi + 1.0 : phi) * COLUMNS, COLUMNS - 1)] += 1.0;
                }
                double chi2 = 0.0;
                for (int i = 0; i < ROWS * COLUMNS; i++)
                    chi2 += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
                const double tail = chi_square_tail(chi2, ROWS * COLUMNS - 1);
                if (tail < 0.001 / 16.0)
                    fail_msg("kind %d, alpha %g %g, weighting %d: chi^2 %.1f on 255, significance %.1e", kind,
                             (double)n.alpha_x, (double)n.alpha_y, weighting, chi2, tail);
            }
}

/* The same mass around the lobe's middle, in double: all of the rings of radius s that lie within the disk, and the
 * arcs of those that its rim cuts, cos(half the arc) = (s^2 + d^2 - r^2) / (2 s d). s = middle + half sin(t) makes the
 * ends smooth. */
static double disk_mass_by_quadrature(int beckmann, double d2, double r2)
{
    enum { STEPS = 40000 };
    const double d = sqrt(d2), r = sqrt(r2), inner = fabs(r - d);
    /* A Gaussian has ended by 8. */
    const double outer = beckmann ? fmin(r + d, fmax(inner, 8.0)) : r + d;
    const double middle = 0.5 * (outer + inner), half = 0.5 * (outer - inner);
    double sum = r > d ? (beckmann ? -expm1(-inner * inner) : inner * inner / (1.0 + inner * inner)) : 0.0;
    for (int i = 0; i < STEPS; i++) {
        const double t = PI * ((i + 0.5) / STEPS - 0.5), s = middle + half * sin(t);
        const double cosine = (s * s + d2 - r2) / (2.0 * s * d);
        const double arc = acos(fmax(-1.0, fmin(1.0, cosine)));
        const double density = beckmann ? exp(-s * s) : 1.0 / ((1.0 + s * s) * (1.0 + s * s));
        sum += 2.0 * s * density * arc / PI * half * cos(t) * PI / STEPS;
    }
    return sum;
}

/* GGX is half a dozen roundings; Beckmann's Bessel function is good to 2e-7, its Gaussian ends at 2e-8, and the
 * distance of the rim carries the rounding of d^2 and r^2, an ulp of d: the mass changes by its slope, at most 1.13. */
static void part_of_a_rough_facet_that_meets_the_light_agrees_with_quadrature(void **state)
{
    (void)state;
    uint64_t random = 4;
    double worst[2] = { 0.0, 0.0 };
    for (int i = 0; i < 1200; i++) {
        const float d2 = i % 10 ? (float)random_log_between(&random, 1e-6, 900.0) : 1e-12F;
        /* Disks that are small, that are large, and whose rim passes near the lobe's middle. */
        const float r2 = i % 3 ? (float)random_log_between(&random, 1e-6, 900.0)
                               : (float)pow(sqrt((double)d2) + random_between(&random, -2.0, 2.0), 2.0);
        for (int kind = 0; kind < 2; kind++) {
            const double expected = disk_mass_by_quadrature(kind, (double)d2, (double)r2);
            const double found = (double)facet_lobe_disk_mass(kind ? NDF_BECKMANN : NDF_GGX, d2, r2);
            const double bound = kind ? 1e-6 + 1.2e-7 * 1.13 * sqrt((double)d2) : 1e-6 * expected + 1e-9;
            worst[kind] = fmax(worst[kind], fabs(found - expected));
            if (!(fabs(found - expected) <= bound))
                fail_msg("%s, d^2 %g, r^2 %g: %.8g, by quadrature %.8g", kind ? "Beckmann" : "GGX", (double)d2,
                         (double)r2, found, expected);
        }
    }
    printf("mass of a lobe within a disk: off by %.1e (GGX) and %.1e (Beckmann) at most\n", worst[0], worst[1]);
    assert_true(facet_lobe_disk_mass(NDF_GGX, 1.0F, 1e12F) > 0.999999F);
    assert_true(facet_lobe_disk_mass(NDF_BECKMANN, 1.0F, 1e12F) > 0.999999F);
    assert_true(facet_lobe_disk_mass(NDF_BECKMANN, 1e12F, 1.0F) == 0.0F);
    assert_true(facet_lobe_disk_mass(NDF_GGX, 0.0F, 0.0F) == 0.0F &&
                facet_lobe_disk_mass(NDF_BECKMANN, 0.0F, 0.0F) == 0.0F);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_add_up_and_surround_the_pixel),
        cmocka_unit_test(visits_grow_with_the_facets_and_no_faster),
        cmocka_unit_test(pixel_within_a_cell_has_all_of_it),
        cmocka_unit_test(share_of_a_cell_agrees_with_points),
        cmocka_unit_test(hashes_are_those_of_the_renderers),
        cmocka_unit_test(slopes_follow_their_weighting),
        cmocka_unit_test(part_of_a_rough_facet_that_meets_the_light_agrees_with_quadrature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
