/* Light by bounces against closed forms: furnaces, a glowing ball seen from within, a mirror. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

#define PI 3.14159265358979323846

static const preview_sky WHITE = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };

static void a_white_matte_ball_vanishes_in_a_white_sky(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(1.0F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 0.8F, 64, 32), NULL, 0);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.sky = &WHITE;
    o.bounces = 64; /* a bent normal sends a path into the facet beside it now and then */
    image i = pictures_render(&s, &o);
    /* Paths below a facet that its smooth normal allows end there: a facet of 1/64 turn leans by at most pi/64, and the
     * light of a band of that width above the horizon is at most pi/64 of all. */
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            assert_true(pictures_at(&i, "R", x, y) <= 1.0 + 1e-5);
            assert_true(pictures_at(&i, "R", x, y) >= 0.75); /* one of four samples lost */
        }
    assert_true(pictures_mean(&i, "R") >= 1.0 - PI / 64.0);
    image_free(&i);
    scene_free(&s);
}

static void a_matte_floor_reflects_its_albedo_of_the_sky(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(0.3F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 5.0F), NULL, 0);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.sky = &WHITE;
    image i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "R"), 0.3, 1e-6);
    image_free(&i);
    scene_free(&s);
}

/* Inside a closed matte ball of albedo a that glows with e, every point has the radiance e (1 + a + a^2 + ...), cut off
 * after the bounces. */
static void a_glowing_ball_sums_the_geometric_series(void **state)
{
    (void)state;
    scene_material matte = scenes_matte(0.5F);
    matte.double_sided = true;
    matte.emissive[0] = 2.0F;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 1.0F, 64, 32), NULL, 0);
    const float eye[3] = { 0.1F, 0.2F, 0.3F }, target[3] = { 0.0F, 0.0F, -1.0F };
    const scene_camera c = scenes_camera(SCENE_PERSPECTIVE, eye, target, 1.0F);
    const int bounces[4] = { 0, 1, 2, 5 };
    for (int k = 0; k < 4; ++k) {
        preview_options o = pictures_options(&c);
        o.bounces = bounces[k];
        o.spp = 64;
        image i = pictures_render(&s, &o);
        const double expected = 2.0 * (1.0 - pow(0.5, bounces[k] + 1)) / (1.0 - 0.5);
        /* Below a facet nothing is reflected: it loses less than pi / 64 of what is reflected. */
        const double value = pictures_mean(&i, "R");
        assert_true(value <= expected * (1.0 + 1e-5));
        assert_true(value >= expected - (expected - 2.0) * PI / 64.0);
        image_free(&i);
    }
    scene_free(&s);
}

/* The share of white light that a rough white metal reflects at 53 degrees, by the midpoint rule over the hemisphere
 * with the library's own lobe; 600^2 points are good to 1e-4 for this roughness. */
static double reflected_share(float alpha, const float wo[3])
{
    enum { STEPS = 600 };
    glint_material_options options = GLINT_MATERIAL_OPTIONS_INIT;
    options.model = GLINT_MODEL_SMOOTH;
    options.surface.alpha_x = options.surface.alpha_y = alpha;
    glint_material *m;
    assert_int_equal(glint_material_create(&options, &m, NULL, 0), GLINT_OK);
    double sum = 0.0;
    for (int a = 0; a < STEPS; ++a) {
        for (int b = 0; b < STEPS; ++b) {
            const double cosine = (a + 0.5) / STEPS, angle = 2.0 * PI * (b + 0.5) / STEPS;
            const double sine = sqrt(1.0 - cosine * cosine);
            const float wi[3] = { (float)(sine * cos(angle)), (float)(sine * sin(angle)), (float)cosine };
            float f[3];
            glint_eval(m, NULL, NULL, wo, wi, NULL, f);
            sum += (double)f[0];
        }
    }
    glint_material_destroy(m);
    return sum * 2.0 * PI / ((double)STEPS * STEPS);
}

static void a_rough_metal_reflects_the_sky_as_its_lobe_says(void **state)
{
    (void)state;
    scene_material metal = scene_material_default();
    metal.roughness = 0.7F;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &metal), 5.0F), NULL, 0);
    const float eye[3] = { -8.0F, 6.0F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera c = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 1.0F);
    preview_options o = pictures_options(&c);
    o.sky = &WHITE;
    o.spp = 256;
    image i = pictures_render(&s, &o);
    const float wo[3] = { -0.8F, 0.0F, 0.6F };
    const double expected = reflected_share(0.49F, wo), value = pictures_mean(&i, "R");
    double variance = 0.0;
    for (int k = 0; k < 256; ++k)
        variance += pow(pictures_at(&i, "R", k % 16, k / 16) - value, 2.0) / 255.0;
    const double sigma = sqrt(variance / 256.0);
    assert_true(expected < 0.95); /* a single bounce between facets loses light: else nothing is tested */
    if (!(fabs(value - expected) <= 5.0 * sigma + 2e-4))
        fail_msg("%.6g is not %.6g: %.1f sigma of %.2g", value, expected, (value - expected) / sigma, sigma);
    image_free(&i);
    scene_free(&s);
}

/* A mirror at 45 degrees shows the wall beside it as if it stood in front. */
static void a_mirror_shows_what_stands_beside_it(void **state)
{
    (void)state;
    const float mirror_place[16] = { 0.70710678F, 0.70710678F, 0, 0, -0.70710678F, 0.70710678F, 0, 0, 0, 0, 1, 0,
                                     0,           0,           0, 1 };
    const float wall_place[16] = { 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, -4, 0, 0, 1 };
    scene_material mirror = scene_material_default(), wall = scenes_matte(0.5F);
    mirror.roughness = 0.0F;
    wall.unlit = true;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &mirror), 3.0F), mirror_place, 0);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &wall), 3.0F), wall_place, 1);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.bounces = 1;
    image i = pictures_render(&s, &o);
    for (int x = 0; x < 16; ++x)
        pictures_assert_relative(pictures_at(&i, "R", x, x), 0.5,
                                 1e-3); /* alpha is 1e-4, not 0: masking takes a little */
    image_free(&i);
    o.bounces = 0;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "R") == 0.0);
    image_free(&i);
    scene_free(&s);
}

/* A glowing rectangle of 1 x 1 m, 1 m above a matte floor and facing it, in many triangles of different sizes: the
 * floor below its middle has albedo * L * four times the form factor of a quarter. */
static void a_glowing_panel_lights_by_its_form_factor_without_much_grain(void **state)
{
    (void)state;
    enum { STRIPS = 12 };
    scene_material glow = scenes_matte(0.0F);
    const scene_material matte = scenes_matte(0.5F);
    glow.emissive[0] = 2.0F;
    glow.emissive[1] = glow.emissive[2] = 2.0F;
    float corners[STRIPS][18];
    for (int k = 0; k < STRIPS; ++k) { /* widths grow as squares do */
        const float a = (float)(k * k) / (STRIPS * STRIPS) - 0.5F,
                    b = (float)((k + 1) * (k + 1)) / (STRIPS * STRIPS) - 0.5F;
        const float strip[18] = { a, 1, -0.5F, b, 1, -0.5F, b, 1, 0.5F, a, 1, -0.5F, b, 1, 0.5F, a, 1, 0.5F };
        memcpy(corners[k], strip, sizeof strip);
    }
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 5.0F), NULL, 0);
    scenes_add_instance(&s, scenes_add_triangles(&s, scenes_add_material(&s, &glow), corners[0], 2 * STRIPS), NULL, 1);
    const scene_camera c = pictures_from_above(1e-3F); /* through the panel's back, which is not there */
    preview_options o = pictures_options(&c);
    o.width = o.height = 32;
    o.bounces = 1;
    o.spp = 16;
    image i = pictures_render(&s, &o);
    const double p = sqrt(1.25), factor = 4.0 * 2.0 * (0.5 / p * atan(0.5 / p)) / (2.0 * PI);
    const double expected = 0.5 * 2.0 * factor, value = pictures_mean(&i, "G");
    double variance = 0.0;
    for (int k = 0; k < 1024; ++k)
        variance += pow(pictures_at(&i, "G", k % 32, k / 32) - value, 2.0) / 1023.0;
    const double sigma = sqrt(variance / 1024.0);
    if (!(fabs(value - expected) <= 5.0 * sigma))
        fail_msg("%.6g is not %.6g: %.1f sigma of %.2g", value, expected, (value - expected) / sigma, sigma);
    /* Bounces alone find it with the probability F = .24: sqrt((1 - F) / F / 16) = 45 percent of grain. */
    if (!(sqrt(variance) < 0.12 * expected))
        fail_msg("%.2g of grain in a pixel", sqrt(variance) / expected);
    image_free(&i);

    /* The back of it does not glow, and without bounces nothing finds it. */
    o.bounces = 0;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "G") == 0.0);
    image_free(&i);
    for (int k = 0; k < STRIPS; ++k)
        for (int v = 0; v < 6; ++v)
            s.meshes[1].position[18 * k + 3 * v + 1] = -1.0F;
    o.bounces = 1;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "G") == 0.0);
    image_free(&i);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_white_matte_ball_vanishes_in_a_white_sky),
        cmocka_unit_test(a_matte_floor_reflects_its_albedo_of_the_sky),
        cmocka_unit_test(a_glowing_ball_sums_the_geometric_series),
        cmocka_unit_test(a_rough_metal_reflects_the_sky_as_its_lobe_says),
        cmocka_unit_test(a_mirror_shows_what_stands_beside_it),
        cmocka_unit_test(a_glowing_panel_lights_by_its_form_factor_without_much_grain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
