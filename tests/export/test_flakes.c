/* The flakes of a fallback, as a viewer of glTF 2.0 shades them: their mean is the lobe of the material. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "exporters/gltf/flakes.h"

#define PI 3.14159265358979323846

enum { TURNS = 24 };

/* The normal of a texel as glTF 2.0 section 3.9.3 decodes it. */
static void decode(const flakes *f, size_t texel, double n[3])
{
    for (int k = 0; k < 3; k++)
        n[k] = 2.0 * f->rgb[3 * texel + (size_t)k] / 255.0 - 1.0;
    n[0] *= (double)f->scale;
    n[1] *= (double)f->scale;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] /= length;
}

/* Appendix B of glTF 2.0: D of GGX. */
static double ggx(double alpha, double cosine)
{
    if (cosine <= 0.0)
        return 0.0;
    const double d = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (PI * d * d);
}

static double wanted_lobe(const flakes_request *q, const double h[3])
{
    const double x = h[0] / (double)q->alpha_x, y = h[1] / (double)q->alpha_y, z2 = h[2] * h[2];
    const double area = PI * (double)q->alpha_x * (double)q->alpha_y, t2 = (x * x + y * y) / z2;
    if (q->distribution == GLINT_DISTRIBUTION_BECKMANN)
        return exp(-t2) / (area * z2 * z2);
    return 1.0 / (area * z2 * z2 * (1.0 + t2) * (1.0 + t2));
}

/* What the map reflects with half vector h to a viewer along the normal, over 1 / 4: D(n.h) / n.v. */
static double found_lobe(const flakes *f, const double h[3])
{
    double sum = 0.0;
    for (size_t i = 0; i < FLAKES_COUNT; i++) {
        double n[3];
        decode(f, i, n);
        sum += ggx((double)f->alpha_rest, n[0] * h[0] + n[1] * h[1] + n[2] * h[2]) / n[2];
    }
    return sum / FLAKES_COUNT;
}

/* Standard deviation of the mean of N lobes D_rest at random normals, relative to its peak 1 / (pi alpha^2): where
 * normals have the density M = 1 / (pi alpha^2), the variance is M / N times the integral of D_rest^2, which is
 * 1 / (3 pi alpha_rest^2). The mean over a ring of slope r alpha has as many independent lobes as fit side by side.
 * Stratified normals stay below that. */
static double sigma(const flakes_request *q, const flakes *f, double r)
{
    const double rest = (double)f->alpha_rest;
    const double square = rest * rest / ((double)q->alpha_x * (double)q->alpha_y);
    const double apart = fmax(1.0, fmin(TURNS, PI * r * (double)fminf(q->alpha_x, q->alpha_y) / rest));
    return sqrt(1.0 / (3.0 * square * FLAKES_COUNT * apart));
}

/* The largest difference over rings of slopes up to twice alpha, relative to the peak of the lobe, where it is largest
 * in terms of its bound. */
static void check(const flakes_request *q, double model_error)
{
    flakes *f = malloc(sizeof *f);
    assert_non_null(f);
    assert_true(flakes_make(q, f));
    const double up[3] = { 0.0, 0.0, 1.0 }, peak = wanted_lobe(q, up);
    double worst = 0.0, bound_there = 1.0;
    for (int ring = 1; ring <= 8; ring++) {
        double difference = 0.0;
        const double r = 0.25 * ring;
        for (int turn = 0; turn < TURNS; turn++) {
            const double phi = 2.0 * PI * (turn + 0.3) / TURNS;
            const double x = r * (double)q->alpha_x * cos(phi), y = r * (double)q->alpha_y * sin(phi);
            const double z = 1.0 / sqrt(1.0 + x * x + y * y), h[3] = { x * z, y * z, z };
            difference += (found_lobe(f, h) - wanted_lobe(q, h)) / peak / TURNS;
        }
        const double bound = model_error + 3.0 * sigma(q, f, r);
        if (fabs(difference) / bound >= worst / bound_there) {
            worst = fabs(difference);
            bound_there = bound;
        }
    }
    printf("alpha %.3g %.3g, facet %.3g, %s: off by %.2f %% of the peak, bound %.2f %%\n", (double)q->alpha_x,
           (double)q->alpha_y, (double)q->facet_alpha, q->distribution == GLINT_DISTRIBUTION_GGX ? "ggx" : "beckmann",
           100.0 * worst, 100.0 * bound_there);
    assert_true(worst <= bound_there);
    free(f);
}

static void mean_of_isotropic_flakes_is_the_lobe(void **state)
{
    (void)state;
    for (int beckmann = 0; beckmann < 2; beckmann++)
        for (int i = 0; i < 5; i++) {
            const float alphas[5] = { 0.02F, 0.09F, 0.23F, 0.5F, 0.81F };
            const flakes_request q = { .distribution = beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX,
                                       .alpha_x = alphas[i],
                                       .alpha_y = alphas[i],
                                       .facet_alpha = 0.0025F,
                                       .seed = 7 };
            check(&q, 0.01);
        }
}

/* The rougher direction turned away from the tangent. */
static void mean_of_anisotropic_flakes_is_the_lobe(void **state)
{
    (void)state;
    flakes_request q = { .alpha_x = 0.28F, .alpha_y = 0.04F, .facet_alpha = 0.01F, .seed = 7 };
    check(&q, 0.02);
    q.distribution = GLINT_DISTRIBUTION_BECKMANN;
    check(&q, 0.02);
}

static void mean_slope(const flakes_request *q, double square[2])
{
    flakes *f = malloc(sizeof *f);
    assert_non_null(f);
    assert_true(flakes_make(q, f));
    square[0] = square[1] = 0.0;
    for (size_t i = 0; i < FLAKES_COUNT; i++) {
        double n[3];
        decode(f, i, n);
        for (int k = 0; k < 2; k++)
            square[k] += n[k] / n[2] * n[k] / n[2] / FLAKES_COUNT;
    }
    free(f);
}

static void a_quarter_turn_swaps_the_directions(void **state)
{
    (void)state;
    flakes_request q = { .distribution = GLINT_DISTRIBUTION_BECKMANN, .alpha_x = 0.3F, .alpha_y = 0.1F, .seed = 7 };
    double plain[2], turned[2];
    mean_slope(&q, plain);
    q.direction_rad = 0.5 * PI;
    mean_slope(&q, turned);
    for (int k = 0; k < 2; k++)
        assert_true(fabs(plain[k] / turned[1 - k] - 1.0) < 0.02);
    assert_true(plain[0] > 5.0 * plain[1]);
}

static void facets_that_are_as_rough_as_the_surface_give_no_map(void **state)
{
    (void)state;
    const flakes_request q = { .alpha_x = 0.2F, .alpha_y = 0.2F, .facet_alpha = 0.2F };
    flakes *f = malloc(sizeof *f);
    assert_non_null(f);
    assert_false(flakes_make(&q, f));
    free(f);
}

static void seeds_place_the_same_facets_elsewhere(void **state)
{
    (void)state;
    flakes_request q = { .alpha_x = 0.2F, .alpha_y = 0.2F, .seed = 1 };
    flakes *a = malloc(sizeof *a), *b = malloc(sizeof *b);
    assert_true(a && b && flakes_make(&q, a));
    assert_true(flakes_make(&q, b));
    assert_memory_equal(a->rgb, b->rgb, sizeof a->rgb);
    q.seed = 2;
    assert_true(flakes_make(&q, b));
    assert_memory_not_equal(a->rgb, b->rgb, sizeof a->rgb);
    unsigned long sum = 0;
    for (size_t i = 0; i < sizeof a->rgb; i++)
        sum += (unsigned long)a->rgb[i] - b->rgb[i];
    assert_int_equal(sum, 0);
    free(a);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_of_isotropic_flakes_is_the_lobe),
        cmocka_unit_test(mean_of_anisotropic_flakes_is_the_lobe),
        cmocka_unit_test(a_quarter_turn_swaps_the_directions),
        cmocka_unit_test(facets_that_are_as_rough_as_the_surface_give_no_map),
        cmocka_unit_test(seeds_place_the_same_facets_elsewhere),
    };
    return cmocka_run_group_tests_name("flakes", tests, NULL, NULL);
}
