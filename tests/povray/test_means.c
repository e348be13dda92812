/* What the flakes of glint.inc reflect on average over seeds is what libglint's smooth model says, spread by the lobe
 * of a flake. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "povray_run.h"
#include "surface.h"
#include "workplace.h"

typedef struct mean {
    double ratio, sigma;
} mean;

/* Mean over seeds, over that of the smooth model. */
static mean mean_over_seeds(surface_setting s, const char *name, unsigned seeds)
{
    double sum = 0.0, squares = 0.0;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        s.seed = seed;
        image picture = surface_render(&s, name);
        glint_material *m = surface_material(&s, GLINT_MODEL_SMOOTH);
        double found = 0.0, expected = 0.0;
        for (int y = 0; y < SURFACE_SIDE; ++y)
            for (int x = 0; x < SURFACE_SIDE; ++x) {
                double rgb[3];
                surface_expect(&s, m, x, y, rgb);
                found += (double)pixel_at(&picture, x, y)[0];
                expected += rgb[0];
            }
        sum += found / expected;
        squares += found * found / (expected * expected);
        glint_material_destroy(m);
        image_free(&picture);
    }
    const double average = sum / seeds, variance = (squares / seeds - average * average) / (seeds - 1);
    return (mean){ average, sqrt(fmax(variance, 0.0)) };
}

/* The bound as it is: seeds are fixed, so chance has no second try. The error has to be small beside it. */
static void assert_mean(const surface_setting *s, const char *name, double expected, double bound, unsigned seeds)
{
    const mean m = mean_over_seeds(*s, name, seeds);
    print_message("%s: mean over smooth %.4f, standard error %.4f; expected %.4f, %.3f of it\n", name, m.ratio, m.sigma,
                  expected, m.ratio / expected);
    if (!(fabs(m.ratio / expected - 1.0) < bound))
        fail_msg("%s: mean over smooth %.4f, expected %.4f within %g; %.1f standard errors of %.4f off", name, m.ratio,
                 expected, bound, (m.ratio - expected) / m.sigma, m.sigma);
    assert_true(m.sigma < 0.5 * bound);
}

/* ---- what the lobe of a flake does to the mean ---- */

static double density(glint_distribution distribution, double alpha, double slope2)
{
    const double s2 = slope2 / (alpha * alpha), scale = 1.0 / (PI * alpha * alpha);
    return distribution == GLINT_DISTRIBUTION_BECKMANN ? scale * exp(-s2) : scale / ((1.0 + s2) * (1.0 + s2));
}

/* The distribution of normals at its peak, after every flake has spread its light over a lobe, over that before: the
 * integral of D(m) L(m, h) over all m at h = n, where the lobe L is that of libglint, a function of the chord from m to
 * h with an integral of one over the sphere. */
static double peak_after_lobe(glint_distribution distribution, double alpha, double lobe)
{
    enum { STEPS = 200000 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        const double angle = 0.5 * PI * (i + 0.5) / STEPS, c = cos(angle), t = tan(angle);
        sum += sin(angle) / (c * c * c * c) * density(distribution, alpha, t * t) *
               density(distribution, lobe, 2.0 - 2.0 * c);
    }
    return sum * 2.0 * PI * (0.5 * PI / STEPS) / density(distribution, alpha, 0.0);
}

/* With both, means over seeds are within 2 % of the smooth model itself: a sixtieth is what presets have. */
static void lobes_of_a_sixtieth_leave_the_peak(void **state)
{
    (void)state;
    static const glint_distribution distributions[] = { GLINT_DISTRIBUTION_GGX, GLINT_DISTRIBUTION_BECKMANN };
    for (int i = 0; i < 2; ++i) {
        const double left = peak_after_lobe(distributions[i], 0.3, 0.3 / 60.0);
        print_message("a lobe of a sixtieth leaves %.4f of the peak\n", left);
        assert_true(fabs(left - 1.0) < 0.005);
    }
}

/* Light and view at the same angle, so that half vectors are at the peak. No row of pixels is on the edges of flakes.
 */
static void exact_means_are_those_of_smooth_after_the_lobe(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_GGX", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_GGX, 0.3, 0.06, 0.0093, 0U, 25.0, 25.0,
          .light_distance = 1e4 },
        { "Glint_Beckmann", "Glint_Exact_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.3, 0.06, 0.0093, 0U, 25.0, 25.0,
          .light_distance = 1e4 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        const surface_setting *s = &settings[i];
        assert_mean(s, s->ndf, peak_after_lobe(s->distribution, s->alpha, s->lobe), 0.02, 8U);
    }
}

/* Tints are white in the mean, channel by channel; the first is measured. */
static void tints_leave_the_mean(void **state)
{
    (void)state;
    const surface_setting s = { "Glint_Beckmann",
                                "Glint_Exact_Texture()",
                                GLINT_DISTRIBUTION_BECKMANN,
                                0.3,
                                0.1,
                                0.0093,
                                0U,
                                25.0,
                                25.0,
                                .light_distance = 1e4,
                                .hues = 0.3,
                                .color_count = 2,
                                .colors = { { 1.0F, 0.2F, 0.1F }, { 0.5F, 1.0F, 0.3F } } };
    assert_mean(&s, "tints", peak_after_lobe(s.distribution, s.alpha, s.lobe), 0.02, 8U);
}

/* ---- flakes that stand in each other's way ---- */

static uint64_t random_state = 0x9E3779B97F4A7C15U;

/* Marsaglia's xorshift64. */
static double uniform(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return ((double)(random_state >> 11) + 0.5) * 0x1p-53;
}

/* A square of edge 1 that is turned about its middle: two edges of length one, half of it to either side. */
typedef struct square {
    double x, y;
    double n[3], across[3], along[3];
} square;

static square square_of(double x, double y, double p, double q)
{
    const double length = sqrt(1.0 + p * p + q * q), n[3] = { p / length, q / length, 1.0 / length };
    const double w = hypot(n[2], n[0]);
    return (square){ x,
                     y,
                     { n[0], n[1], n[2] },
                     { n[2] / w, 0.0, -n[0] / w },
                     { -n[1] * n[0] / w, (n[2] * n[2] + n[0] * n[0]) / w, -n[1] * n[2] / w } };
}

/* A tilt of Beckmann's distribution; by_area: every flake has the same area of its own, and tilted ones cover less. */
static square random_square(double x, double y, double alpha, bool by_area)
{
    for (;;) {
        const double r = alpha * sqrt(-log(uniform())), azimuth = 2.0 * PI * uniform();
        const double most = sqrt(1.0 + 50.0 * alpha * alpha);
        if (!by_area || uniform() * most < sqrt(1.0 + r * r))
            return square_of(x, y, r * cos(azimuth), r * sin(azimuth));
    }
}

static double along(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_hit(const square *s, const double from[3], const double towards[3])
{
    const double d[3] = { s->x - from[0], s->y - from[1], -from[2] };
    const double t = along(d, s->n) / along(towards, s->n);
    if (!(t > 1e-9))
        return false;
    const double at[3] = { t * towards[0] - d[0], t * towards[1] - d[1], t * towards[2] - d[2] };
    return fabs(along(at, s->across)) < 0.5 && fabs(along(at, s->along)) < 0.5;
}

/* How much of a lit flake sees both the light and the eye past its neighbours, each a square about its own middle: by
 * casting rays. Lit flakes are those whose normal is near the half vector, which is n here. */
static double share_in_sight(const surface_setting *s)
{
    enum { TRIALS = 60000, REACH = 2 };
    double view[3], light[3];
    surface_direction(s->view_deg, -1.0, view);
    surface_direction(s->light_deg, 1.0, light);
    const double lit = s->alpha * s->lobe / hypot(s->alpha, s->lobe);
    int seen = 0;
    for (int i = 0; i < TRIALS; ++i) {
        const square flake = random_square(0.0, 0.0, lit, false);
        const double u = uniform() - 0.5, v = uniform() - 0.5;
        double from[3];
        for (int k = 0; k < 3; ++k)
            from[k] = u * flake.across[k] + v * flake.along[k];
        bool hidden = false;
        for (int y = -REACH; y <= REACH; ++y)
            for (int x = -REACH; x <= REACH; ++x) {
                if (x == 0 && y == 0)
                    continue;
                const square other = random_square(x, y, s->alpha, true);
                hidden = hidden || is_hit(&other, from, view) || is_hit(&other, from, light);
            }
        seen += !hidden;
    }
    return (double)seen / TRIALS;
}

/* Smith's masking, which takes neighbours for independent, says 1 at these angles; polygons that stand up at their
 * edges hide more. Nothing is hidden where light and view come from above. */
static void flakes_as_polygons_lose_what_their_neighbours_hide(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_Beckmann", "Glint_Mirror_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.12, 0.025, 0U, 0.0, 0.0,
          .light_distance = 1e4 },
        { "Glint_Beckmann", "Glint_Mirror_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.12, 0.025, 0U, 25.0, 25.0,
          .light_distance = 1e4 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        const surface_setting *s = &settings[i];
        const double seen = share_in_sight(s);
        print_message("mesh at %g degrees: %.3f of a lit flake is in sight\n", s->view_deg, seen);
        assert_true(seen > 0.9); /* within 10 % of smooth */
        assert_mean(s, "mesh", seen * peak_after_lobe(s->distribution, s->alpha, s->lobe), 0.02, 12U);
    }
}

/* ---- flakes of POV-Ray's own, whose lobe is part of the roughness that was asked for ---- */

static void portable_means_are_smooth(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_GGX", "Glint_Portable_Texture()", GLINT_DISTRIBUTION_GGX, 0.35, 0.1, 0.011, 0U, 25.0, 25.0,
          .light_distance = 1e4 },
        { "Glint_Beckmann", "Glint_Portable_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.1, 0.011, 0U, 25.0, 20.0,
          .light_distance = 1e4 },
        { "Glint_Beckmann", "Glint_Portable_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.06, 0.011, 0U, 40.0, 20.0,
          .light_distance = 1e4 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i)
        assert_mean(&settings[i], "portable", 1.0, 0.1, 4U);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(exact_means_are_those_of_smooth_after_the_lobe, workplace_enter,
                                        workplace_leave),
        cmocka_unit_test(lobes_of_a_sixtieth_leave_the_peak),
        cmocka_unit_test_setup_teardown(tints_leave_the_mean, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(flakes_as_polygons_lose_what_their_neighbours_hide, workplace_enter,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(portable_means_are_smooth, workplace_enter, workplace_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
