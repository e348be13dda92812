/* The textures of glint.inc against libglint, pixel by pixel and in the mean, as POV-Ray renders them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "glint.h"
#include "povray_run.h"
#include "workplace.h"

/* A square of surface z = 0 from -HALF to HALF, seen by an orthographic camera that is tilted along y, under a point
 * light: both far enough that directions hardly change over it, near enough that they do. */
enum { SIDE = 160 };
#define HALF 1.0
#define PI 3.14159265358979
/* W/m^2 at the origin. */
#define E PI

typedef struct setting {
    const char *ndf, *texture; /* the macro's call; %s of it is the eye */
    glint_distribution distribution;
    double alpha, lobe, size;
    unsigned seed;
    double view_deg, light_deg; /* tilts towards -y and +y */
    double light_distance;
} setting;

static const double eye_distance = 1e6;

static void direction(double degrees, double sign, double out[3])
{
    const double a = degrees * PI / 180.0;
    out[0] = 0.0;
    out[1] = sign * sin(a);
    out[2] = cos(a);
}

static image render(const setting *s, const char *name)
{
    double v[3], l[3];
    char eye[128], light[128], texture[256], source[2048];
    direction(s->view_deg, -1.0, v);
    direction(s->light_deg, 1.0, l);
    snprintf(eye, sizeof eye, "<0, %.12g, %.12g>", v[1] * eye_distance, v[2] * eye_distance);
    snprintf(light, sizeof light, "<0, %.12g, %.12g>", l[1] * s->light_distance, l[2] * s->light_distance);
    snprintf(texture, sizeof texture, s->texture, eye, light);
    const bool mesh = strstr(s->texture, "Mirror") != NULL; /* a mesh of flakes in the place of a plane */
    /* The picture's y axis is foreshortened: up is perpendicular to the view. */
    snprintf(source, sizeof source,
             "#version 3.7;\n#include \"glint.inc\"\nglobal_settings { assumed_gamma 1.0 }\n"
             "camera { orthographic location <0, %.17g, %.17g> right <2, 0, 0> up <0, %.17g, %.17g>\n"
             "  direction <0, %.17g, %.17g> }\n"
             "Glint_Point_Light(%s, %.12g, 0)\n"
             "#declare Glint_Ndf = %s;\n#declare Glint_Alpha = %.9g;\n#declare Glint_Lobe = %.9g;\n"
             "#declare Glint_Size = %.9g;\n#declare Glint_Seed = %u;\n"
             "#declare Glint_F0 = <0.9, 0.5, 0.04>;\n#declare Glint_Base = pigment { color rgb <0.1, 0.2, 0.4> }\n"
             "#declare Texture = %s\n%s\n",
             10.0 * v[1], 10.0 * v[2], 2.0 * v[2], -2.0 * v[1], -v[1], -v[2], light,
             E * s->light_distance * s->light_distance, s->ndf, s->alpha, s->lobe, s->size, s->seed, texture,
             mesh ? "object { Glint_Flake_Mesh(2.4, 2.4) translate <-1.2, -1.2, 0> texture { Texture } }"
                  : "plane { z, 0 texture { Texture } }");
    return povray_render(name, source, SIDE, SIDE);
}

static glint_material *material_of(const setting *s, glint_model model)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.distribution = s->distribution;
    o.facet_hash = GLINT_FACET_HASH_POVRAY;
    o.facet_alpha = (float)s->lobe;
    o.seed = s->seed;
    o.surface = (glint_surface){ .alpha_x = (float)s->alpha,
                                 .alpha_y = (float)s->alpha,
                                 .diffuse = { 0.1F, 0.2F, 0.4F },
                                 .f0 = { 0.9F, 0.5F, 0.04F },
                                 .f90 = { 1.0F, 1.0F, 1.0F },
                                 .facets_per_m2 = (float)(1.0 / (s->size * s->size)),
                                 .discreteness = 1.0F };
    glint_material *m;
    char message[256];
    if (glint_material_create(&o, &m, message, sizeof message) != GLINT_OK)
        fail_msg("%s", message);
    return m;
}

/* What libglint says about the middle of a pixel; diffuse only, too. */
static void expect(const setting *s, const glint_material *m, int px, int py, double rgb[3], double matt[3])
{
    double v[3], l[3], to[3];
    direction(s->view_deg, -1.0, v);
    direction(s->light_deg, 1.0, l);
    const double x = (2.0 * (px + 0.5) / SIDE - 1.0) * HALF;
    const double y = (1.0 - 2.0 * (py + 0.5) / SIDE) * HALF / v[2];
    to[0] = l[0] * s->light_distance - x;
    to[1] = l[1] * s->light_distance - y;
    to[2] = l[2] * s->light_distance;
    const double d = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    const float wo[3] = { (float)v[0], (float)v[1], (float)v[2] };
    const float wi[3] = { (float)(to[0] / d), (float)(to[1] / d), (float)(to[2] / d) };
    /* A pixel that is a point within one flake. */
    const float step = (float)(1e-4 * s->size);
    const glint_footprint f = { .u = x, .v = y, .dudx = step, .dvdy = -step };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-7F };
    const double e = E * s->light_distance * s->light_distance / (d * d);
    float out[3];
    glint_eval(m, NULL, &f, wo, wi, &light, out);
    glint_surface bare = glint_material_surface(m);
    for (int c = 0; c < 3; ++c)
        bare.f0[c] = bare.f90[c] = 0.0F;
    float base[3];
    glint_eval(m, &bare, NULL, wo, wi, NULL, base);
    for (int c = 0; c < 3; ++c) {
        rgb[c] = (double)out[c] * e;
        matt[c] = (double)base[c] * e;
    }
}

/* ---- the exact form is libglint's explicit model ---- */

/* Flakes only: the base below them is POV-Ray's Lambert, which knows the angle of the light but not what flakes let
 * through there. Pixels whose highlight is below a thousandth of a lit flake's are dark in both. */
static void compare_flakes(const setting *s, const char *name)
{
    image picture = render(s, name);
    glint_material *m = material_of(s, GLINT_MODEL_EXPLICIT);
    const double peak = E / (PI * s->lobe * s->lobe) / 4.0;
    int lit = 0, off = 0;
    double worst = 0.0;
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x) {
            double rgb[3], matt[3];
            expect(s, m, x, y, rgb, matt);
            const double found = (double)pixel_at(&picture, x, y)[0];
            /* The flake's own light; the base adds at most its albedo to either. */
            const double error = fabs(found - rgb[0]);
            lit += rgb[0] > 0.01 * peak;
            if (error > 0.01 * rgb[0] + matt[0] + 1e-3 * peak) {
                ++off;
                worst = fmax(worst, error / (rgb[0] + 1e-3 * peak));
            }
        }
    print_message("%s: %d of %d pixels lit, %d off by more than 1 %%, worst %.3g\n", name, lit, SIDE * SIDE, off,
                  worst);
    assert_true(lit > 50);
    /* 1e-4 of the pixels, rounded up: those whose centre is on the edge of a flake. */
    assert_true(off <= SIDE * SIDE / 10000 + 1);
    glint_material_destroy(m);
    image_free(&picture);
}

static void exact_view_is_the_explicit_model(void **state)
{
    (void)state;
    static const setting settings[] = {
        { "Glint_Beckmann", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.03, 0.011, 5U, 30.0,
          20.0, 40.0 },
        { "Glint_Beckmann", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_BECKMANN, 0.25, 0.03, 0.0101, 7U, 50.0,
          45.0, 60.0 },
        { "Glint_Beckmann", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_BECKMANN, 0.15, 0.02, 0.03, 4000000000U,
          10.0, 20.0, 30.0 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        char name[16];
        snprintf(name, sizeof name, "view%d", (int)i);
        compare_flakes(&settings[i], name);
    }
}

/* Where Smith's masking of the light does not matter, the form that knows no camera is the same. */
static void exact_is_the_explicit_model_where_nothing_is_masked(void **state)
{
    (void)state;
    const setting s = {
        "Glint_Beckmann", "Glint_Exact_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.03, 0.011, 3U, 25.0, 35.0, 50.0
    };
    compare_flakes(&s, "exact");
}

/* ---- the analytic form is libglint's smooth model ---- */

static void analytic_is_the_smooth_model_to_half_precision(void **state)
{
    (void)state;
    static const setting settings[] = {
        { "Glint_GGX", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_GGX, 0.3, 0.05, 0.01, 0U, 40.0, 25.0, 4.0 },
        { "Glint_Beckmann", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.05, 0.01, 0U, 60.0,
          50.0, 3.0 },
        { "Glint_GGX", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_GGX, 0.9, 0.05, 0.01, 0U, 70.0, 10.0, 2.0 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        image picture = render(&settings[i], "analytic");
        glint_material *m = material_of(&settings[i], GLINT_MODEL_SMOOTH);
        double worst = 0.0;
        for (int y = 0; y < SIDE; ++y)
            for (int x = 0; x < SIDE; ++x) {
                double rgb[3], matt[3];
                expect(&settings[i], m, x, y, rgb, matt);
                for (int c = 0; c < 3; ++c)
                    worst = fmax(worst, fabs((double)pixel_at(&picture, x, y)[c] / rgb[c] - 1.0));
            }
        print_message("analytic %d: worst pixel off by %.2e\n", (int)i, worst);
        /* Half a unit in the last place of a half is 2^-11; Walter's rational masking is off by up to 0.35 %, half
         * of that in the sum of two, where the light or the view is masked at all. */
        assert_true(worst < 0x1p-11 + 2e-5 + (settings[i].distribution == GLINT_DISTRIBUTION_BECKMANN ? 4e-3 : 0.0));
        glint_material_destroy(m);
        image_free(&picture);
    }
}

/* ---- means over seeds ---- */

typedef struct mean {
    double ratio, sigma;
} mean;

/* Mean of 12 seeds over the smooth model's mean over the picture, where the base is left out of both. */
static mean mean_over_seeds(setting s, const char *name)
{
    enum { SEEDS = 12 };
    double sum = 0.0, squares = 0.0;
    for (unsigned seed = 0; seed < SEEDS; ++seed) {
        s.seed = seed;
        image picture = render(&s, name);
        glint_material *m = material_of(&s, GLINT_MODEL_SMOOTH);
        double found = 0.0, expected = 0.0;
        for (int y = 0; y < SIDE; ++y)
            for (int x = 0; x < SIDE; ++x) {
                double rgb[3], matt[3];
                expect(&s, m, x, y, rgb, matt);
                found += (double)pixel_at(&picture, x, y)[0];
                expected += rgb[0];
            }
        sum += found / expected;
        squares += found * found / (expected * expected);
        glint_material_destroy(m);
        image_free(&picture);
    }
    const double average = sum / SEEDS, variance = (squares / SEEDS - average * average) / (SEEDS - 1);
    const mean result = { average, sqrt(fmax(variance, 0.0)) };
    print_message("%s: mean over smooth %.4f, standard error %.4f\n", name, result.ratio, result.sigma);
    return result;
}

/* The bound is that of the claim and three standard errors of the measurement. */
static void assert_mean(setting s, const char *name, double expected, double bound)
{
    const mean m = mean_over_seeds(s, name);
    if (!(fabs(m.ratio / expected - 1.0) < bound + 3.0 * m.sigma))
        fail_msg("%s: mean over smooth %.4f, expected %.4f within %g; %.1f standard errors of %.4f off", name, m.ratio,
                 expected, bound, (m.ratio - expected) / m.sigma, m.sigma);
    assert_true(m.sigma < bound);
}

/* What the lobe of a flake, x times as rough as the surface, leaves of the peak of the distribution. Beckmann: two
 * Gaussians. GGX is a Gaussian of variance alpha^2 / e with e drawn from exp(-e). */
static double peak_through_lobe(glint_distribution distribution, double x)
{
    if (distribution == GLINT_DISTRIBUTION_BECKMANN)
        return 1.0 / (1.0 + x * x);
    enum { POINTS = 40000 };
    double sum = 0.0;
    for (int i = 0; i < POINTS; ++i) {
        const double e = 40.0 * (i + 0.5) / POINTS;
        sum += exp(-e) * e / (1.0 + e * x * x);
    }
    return sum * 40.0 / POINTS;
}

/* Light and view at the same angle, so that half vectors are at the peak. */
static void exact_means_are_smooth(void **state)
{
    (void)state;
    static const setting settings[] = {
        { "Glint_GGX", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_GGX, 0.3, 0.06, 0.009, 0U, 25.0, 25.0, 1e4 },
        { "Glint_Beckmann", "Glint_Exact_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.3, 0.06, 0.009, 0U, 25.0, 25.0,
          1e4 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i)
        assert_mean(settings[i], settings[i].ndf, peak_through_lobe(settings[i].distribution, 0.2), 0.02);
}

/* Flakes that are there as polygons hide more of each other than Smith's masking says, which takes neighbours for
 * independent. */
static void flakes_as_polygons_have_nearly_the_same_mean(void **state)
{
    (void)state;
    const setting s = {
        "Glint_Beckmann", "Glint_Mirror_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.07, 0.04, 0U, 25.0, 25.0, 1e4
    };
    assert_mean(s, "mesh", peak_through_lobe(s.distribution, s.lobe / s.alpha), 0.1);
}

static void portable_means_are_nearly_smooth(void **state)
{
    (void)state;
    const setting ggx = {
        "Glint_GGX", "Glint_Portable_Texture()", GLINT_DISTRIBUTION_GGX, 0.35, 0.05, 0.011, 0U, 30.0, 35.0, 1e4
    };
    const setting beckmann = { "Glint_Beckmann",
                               "Glint_Portable_Texture()",
                               GLINT_DISTRIBUTION_BECKMANN,
                               0.35,
                               0.05,
                               0.011,
                               0U,
                               25.0,
                               20.0,
                               1e4 };
    assert_mean(ggx, "portable_ggx", 1.0, 0.1);
    assert_mean(beckmann, "portable_beckmann", 1.0, 0.1);
}

static void smooth_is_nearly_the_smooth_model(void **state)
{
    (void)state;
    static const setting settings[] = {
        { "Glint_GGX", "Glint_Smooth_Texture()", GLINT_DISTRIBUTION_GGX, 0.3, 0.05, 0.01, 0U, 40.0, 25.0, 4.0 },
        { "Glint_Beckmann", "Glint_Smooth_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.05, 0.01, 0U, 20.0, 50.0,
          3.0 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        image picture = render(&settings[i], "smooth");
        glint_material *m = material_of(&settings[i], GLINT_MODEL_SMOOTH);
        double found[3] = { 0 }, expected[3] = { 0 };
        for (int y = 0; y < SIDE; ++y)
            for (int x = 0; x < SIDE; ++x) {
                double rgb[3], matt[3];
                expect(&settings[i], m, x, y, rgb, matt);
                for (int c = 0; c < 3; ++c) {
                    found[c] += (double)pixel_at(&picture, x, y)[c];
                    expected[c] += rgb[c];
                }
            }
        for (int c = 0; c < 3; ++c) {
            print_message("smooth %d, channel %d: mean %.3f of libglint's\n", (int)i, c, found[c] / expected[c]);
            assert_true(fabs(found[c] / expected[c] - 1.0) < 0.1);
        }
        glint_material_destroy(m);
        image_free(&picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(exact_view_is_the_explicit_model, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(exact_is_the_explicit_model_where_nothing_is_masked, workplace_enter,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(analytic_is_the_smooth_model_to_half_precision, workplace_enter,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(exact_means_are_smooth, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(flakes_as_polygons_have_nearly_the_same_mean, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(portable_means_are_nearly_smooth, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(smooth_is_nearly_the_smooth_model, workplace_enter, workplace_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
