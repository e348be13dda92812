/* The textures of glint.inc against libglint, pixel by pixel, as POV-Ray renders them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "povray_run.h"
#include "surface.h"
#include "workplace.h"

/* ---- the exact form is libglint's explicit model ---- */

/* Pixels whose highlight is below a thousandth of a lit flake's, in that channel, are dark in both. */
static bool is_off(const double expected[3], const float *found, double peak)
{
    for (int c = 0; c < 3; ++c)
        if (fabs((double)found[c] - expected[c]) > 0.01 * expected[c] + 1e-3 * peak * (double)surface_f0[c])
            return true;
    return false;
}

static void compare_flakes(const surface_setting *s, const char *name)
{
    image picture = surface_render(s, name);
    glint_material *m = surface_material(s, GLINT_MODEL_EXPLICIT);
    const double peak = SURFACE_IRRADIANCE / (PI * s->lobe * s->lobe) / 4.0;
    int lit = 0, off = 0;
    for (int y = 0; y < SURFACE_SIDE; ++y)
        for (int x = 0; x < SURFACE_SIDE; ++x) {
            double rgb[3];
            surface_expect(s, m, x, y, rgb);
            lit += rgb[0] > 0.01 * peak;
            const float *found = pixel_at(&picture, x, y);
            if (is_off(rgb, found, peak) && ++off <= 5)
                print_message("%s: pixel %d %d is %g %g %g, expected %g %g %g\n", name, x, y, (double)found[0],
                              (double)found[1], (double)found[2], rgb[0], rgb[1], rgb[2]);
        }
    print_message("%s: %d of %d pixels lit, %d off by more than 1 %%\n", name, lit, SURFACE_SIDE * SURFACE_SIDE, off);
    assert_true(lit > 50);
    /* 1e-4 of the pixels, rounded up: those whose centre is on the edge of a flake. */
    assert_true(off <= SURFACE_SIDE * SURFACE_SIDE / 10000 + 1);
    glint_material_destroy(m);
    image_free(&picture);
}

static void exact_view_is_the_explicit_model(void **state)
{
    (void)state;
    static const char texture[] = "Glint_Exact_View_Texture(%s)";
    static const surface_setting settings[] = {
        { "Glint_Beckmann", texture, GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.03, 0.011, 5U, 30.0, 20.0,
          .light_distance = 40.0 },
        { "Glint_Beckmann", texture, GLINT_DISTRIBUTION_BECKMANN, 0.25, 0.03, 0.0101, 7U, 50.0, 45.0,
          .light_distance = 60.0 },
        { "Glint_Beckmann", texture, GLINT_DISTRIBUTION_BECKMANN, 0.15, 0.02, 0.03, 4000000000U, 10.0, 20.0,
          .light_distance = 30.0 },
        { "Glint_GGX", texture, GLINT_DISTRIBUTION_GGX, 0.35, 0.03, 0.011, 5U, 30.0, 20.0, .light_distance = 40.0 },
        { "Glint_GGX", texture, GLINT_DISTRIBUTION_GGX, 0.2, 0.02, 0.0207, 11U, 50.0, 45.0, .light_distance = 60.0 },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        char name[16];
        snprintf(name, sizeof name, "view%d", (int)i);
        compare_flakes(&settings[i], name);
    }
}

static void flakes_have_the_tints_of_the_explicit_model(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_Beckmann", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_BECKMANN, 0.35, 0.03, 0.011, 5U, 30.0,
          20.0, .light_distance = 40.0, .hues = 0.8 },
        { "Glint_GGX", "Glint_Exact_View_Texture(%s)", GLINT_DISTRIBUTION_GGX, 0.35, 0.03, 0.011, 6U, 30.0, 20.0,
          .light_distance = 40.0, .hues = 0.25, .color_count = 3,
          .colors = { { 1.0F, 0.2F, 0.1F }, { 0.2F, 1.0F, 0.3F }, { 0.1F, 0.3F, 1.0F } } },
        { "Glint_Beckmann", "Glint_Exact_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.03, 0.011, 3U, 25.0, 35.0,
          .light_distance = 50.0, .color_count = 2, .colors = { { 0.9F, 0.0F, 0.5F }, { 0.3F, 0.0F, 0.7F } } },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        char name[16];
        snprintf(name, sizeof name, "tint%d", (int)i);
        compare_flakes(&settings[i], name);
    }
}

/* Where Smith's masking of the light does not matter, the form that knows no camera is the same. */
static void exact_is_the_explicit_model_where_nothing_is_masked(void **state)
{
    (void)state;
    const surface_setting s = {
        "Glint_Beckmann",      "Glint_Exact_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.03, 0.011, 3U, 25.0, 35.0,
        .light_distance = 50.0
    };
    compare_flakes(&s, "exact");
}

/* ---- the analytic form is libglint's smooth model ---- */

static void analytic_is_the_smooth_model_to_half_precision(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_GGX", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_GGX, 0.3, 0.05, 0.01, 0U, 40.0, 25.0,
          .light_distance = 4.0, .matt = true },
        { "Glint_Beckmann", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.05, 0.01, 0U, 60.0,
          50.0, .light_distance = 3.0, .matt = true },
        { "Glint_GGX", "Glint_Analytic_Texture(%s, %s)", GLINT_DISTRIBUTION_GGX, 0.9, 0.05, 0.01, 0U, 70.0, 10.0,
          .light_distance = 2.0, .matt = true },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        image picture = surface_render(&settings[i], "analytic");
        glint_material *m = surface_material(&settings[i], GLINT_MODEL_SMOOTH);
        double worst = 0.0;
        for (int y = 0; y < SURFACE_SIDE; ++y)
            for (int x = 0; x < SURFACE_SIDE; ++x) {
                double rgb[3];
                surface_expect(&settings[i], m, x, y, rgb);
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

static void smooth_is_nearly_the_smooth_model(void **state)
{
    (void)state;
    static const surface_setting settings[] = {
        { "Glint_GGX", "Glint_Smooth_Texture()", GLINT_DISTRIBUTION_GGX, 0.3, 0.05, 0.01, 0U, 40.0, 25.0,
          .light_distance = 4.0, .matt = true },
        { "Glint_Beckmann", "Glint_Smooth_Texture()", GLINT_DISTRIBUTION_BECKMANN, 0.2, 0.05, 0.01, 0U, 20.0, 50.0,
          .light_distance = 3.0, .matt = true },
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
        image picture = surface_render(&settings[i], "smooth");
        glint_material *m = surface_material(&settings[i], GLINT_MODEL_SMOOTH);
        double found[3] = { 0 }, expected[3] = { 0 };
        for (int y = 0; y < SURFACE_SIDE; ++y)
            for (int x = 0; x < SURFACE_SIDE; ++x) {
                double rgb[3];
                surface_expect(&settings[i], m, x, y, rgb);
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
        cmocka_unit_test_setup_teardown(flakes_have_the_tints_of_the_explicit_model, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(analytic_is_the_smooth_model_to_half_precision, workplace_enter,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(smooth_is_nearly_the_smooth_model, workplace_enter, workplace_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
