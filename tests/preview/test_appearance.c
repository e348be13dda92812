/* What a material says, seen in pictures: alpha, unlit, emission, normal maps, occlusion, clear coat. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

#define PI 3.14159265358979323846
#define FLOAT_BOUND 1e-6

static scene_material unlit(float color, float alpha)
{
    scene_material m = scenes_matte(color);
    m.unlit = true;
    m.base_color[3] = alpha;
    m.alpha_mode = alpha < 1.0F ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE;
    return m;
}

static void add_level(scene *s, const scene_material *m, float height, int node)
{
    float place[16];
    scenes_translation(place, 0.0F, height, 0.0F);
    scenes_add_instance(s, scenes_add_square(s, scenes_add_material(s, m), 5.0F), place, node);
}

static image picture_of(const scene *s)
{
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    return pictures_render(s, &o);
}

static void blended_layers_are_mixed_from_front_to_back(void **state)
{
    (void)state;
    const scene_material top = unlit(0.2F, 0.25F), middle = unlit(1.0F, 0.5F), bottom = unlit(0.8F, 1.0F);
    scene s = scenes_empty();
    add_level(&s, &bottom, 0.0F, 0);
    add_level(&s, &middle, 1.0F, 1);
    add_level(&s, &top, 2.0F, 2);
    image i = picture_of(&s);
    for (int x = 0; x < 16; ++x) {
        pictures_assert_relative(pictures_at(&i, "R", x, x), 0.25 * 0.2 + 0.75 * (0.5 + 0.5 * 0.8), FLOAT_BOUND);
        pictures_assert_relative(pictures_at(&i, "A", x, x), 1.0, FLOAT_BOUND);
    }
    image_free(&i);
    scene_free(&s);
}

static void alpha_is_the_coverage_and_multiplies_the_color(void **state)
{
    (void)state;
    const scene_material pane = unlit(0.2F, 0.25F);
    scene s = scenes_empty();
    add_level(&s, &pane, 0.0F, 0);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.transparent = true;
    image i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "A"), 0.25, FLOAT_BOUND);
    pictures_assert_relative(pictures_mean(&i, "G"), 0.05, FLOAT_BOUND);
    image_free(&i);
    scene_free(&s);
}

static const uint8_t HALVES[8] = { 255, 255, 255, 255, 255, 255, 255, 0 }; /* opaque on the left, clear on the right */

static void a_mask_covers_what_its_texture_says(void **state)
{
    (void)state;
    scene_material m = unlit(0.5F, 1.0F);
    scene s = scenes_empty();
    m.alpha_mode = SCENE_ALPHA_MASK;
    m.base_color_texture = scenes_add_texture(&s, HALVES, 2, 1);
    m.base_color_texture.srgb = true;
    add_level(&s, &m, 0.0F, 0);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.transparent = true;
    image i = pictures_render(&s, &o);
    for (int x = 0; x < 16; ++x) {
        assert_true(pictures_at(&i, "A", x, 5) == (x < 8 ? 1.0 : 0.0));
        assert_true(pictures_at(&i, "depth.Z", x, 5) == (x < 8 ? 10.0 : 0.0));
    }
    image_free(&i);
    scene_free(&s);
}

/* glTF: what is unlit shows base colour times texture times vertex colour, whatever the light. */
static void unlit_and_vertex_colors_multiply(void **state)
{
    (void)state;
    const scene_material m = unlit(0.5F, 1.0F);
    const float from[3] = { 0.0F, 1.0F, 0.0F };
    float color[16];
    scene s = scenes_empty();
    add_level(&s, &m, 0.0F, 0);
    for (int k = 0; k < 16; ++k)
        color[k] = k % 4 == 1 ? 0.25F : 1.0F;
    s.meshes[0].color = color;
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 5.0F);
    image i = picture_of(&s);
    pictures_assert_relative(pictures_mean(&i, "R"), 0.5, FLOAT_BOUND);
    pictures_assert_relative(pictures_mean(&i, "G"), 0.125, FLOAT_BOUND);
    pictures_assert_relative(pictures_mean(&i, "albedo.G"), 0.125, FLOAT_BOUND);
    image_free(&i);
    s.meshes[0].color = NULL; /* it is ours */
    scene_free(&s);
}

static void an_emitter_shows_its_radiance(void **state)
{
    (void)state;
    scene_material m = scenes_matte(0.5F);
    m.emissive[0] = 7.0F;
    scene s = scenes_empty();
    add_level(&s, &m, 0.0F, 0);
    image i = picture_of(&s);
    pictures_assert_relative(pictures_mean(&i, "R"), 7.0, FLOAT_BOUND);
    assert_true(pictures_mean(&i, "G") == 0.0);
    image_free(&i);
    scene_free(&s);
}

/* ---- normal maps ---- */

/* The texel (192, 160, 208): a tangent-space normal that leans to +x (the tangent) and to +y (the bitangent). */
static const uint8_t LEANING[4] = { 192, 160, 208, 255 };

/* The radiance of a white matte floor under a sun from `sun`, with a normal map. */
static double leaning_floor(float handedness, float strength, const float sun[3], double normal[3])
{
    scene_material m = scenes_matte(1.0F);
    scene s = scenes_empty();
    m.normal_texture = scenes_add_texture(&s, LEANING, 1, 1);
    m.normal_texture.strength = strength;
    add_level(&s, &m, 0.0F, 0);
    for (int v = 0; v < 4; ++v)
        s.meshes[0].tangent[4 * v + 3] = handedness;
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, sun, 1.0F);
    image i = picture_of(&s);
    const double result = pictures_mean(&i, "R");
    normal[0] = pictures_mean(&i, "normal.X");
    normal[1] = pictures_mean(&i, "normal.Y");
    normal[2] = pictures_mean(&i, "normal.Z");
    image_free(&i);
    scene_free(&s);
    return result;
}

static void a_normal_map_leans_along_tangent_and_bitangent(void **state)
{
    (void)state;
    const float sun[3] = { 0.5F, 1.0F, 0.3F };
    const float cases[3][2] = { { 1.0F, 1.0F }, { -1.0F, 1.0F }, { 1.0F, 0.5F } }; /* handedness, normalTexture.scale */
    for (int k = 0; k < 3; ++k) {
        double normal[3];
        const double value = leaning_floor(cases[k][0], cases[k][1], sun, normal);
        /* On the square the tangent is +x and the bitangent -z times the handedness. */
        const double scale = (double)cases[k][1];
        const double x = (2.0 * 192 / 255 - 1.0) * scale, y = (2.0 * 160 / 255 - 1.0) * scale,
                     z = 2.0 * 208 / 255 - 1.0;
        const double length = sqrt(x * x + y * y + z * z);
        const double n[3] = { x / length, z / length, -y / length * (double)cases[k][0] };
        for (int c = 0; c < 3; ++c)
            assert_true(fabs(normal[c] - n[c]) < 1e-5);
        const double cosine = (n[0] * 0.5 + n[1] + n[2] * 0.3) / sqrt(0.25 + 1.0 + 0.09);
        pictures_assert_relative(value, cosine / PI, 1e-5);
    }
}

/* ---- occlusion and coat ---- */

static const uint8_t HALF_OCCLUDED[4] = { 51, 0, 0, 255 }; /* R = 0.2 */

static void occlusion_darkens_the_sky_and_not_the_sun(void **state)
{
    (void)state;
    const preview_sky white = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    const float up[3] = { 0.0F, 1.0F, 0.0F };
    scene_material m = scenes_matte(0.6F);
    scene s = scenes_empty();
    m.occlusion_texture = scenes_add_texture(&s, HALF_OCCLUDED, 1, 1);
    m.occlusion_texture.strength = 0.5F;
    add_level(&s, &m, 0.0F, 0);
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, up, 1.0F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.sky = &white;
    image i = pictures_render(&s, &o);
    /* Sky: albedo * (1 + 0.5 * (0.2 - 1)); sun: albedo / pi. */
    pictures_assert_relative(pictures_mean(&i, "R"), 0.6 * 0.6 + 0.6 / PI, 3e-6);
    image_free(&i);
    scene_free(&s);
}

/* f = f_base (1 - c (1 - T)) + c f_coat with T = t(wo) t(wi) / t(n), t = 1 - F, F = 0.04 + 0.96 (1 - s cos)^5 and s of
 * libglint's model, 1 - .8 alpha; the lobes come from the library, which has tests of its own. */
static void a_clear_coat_takes_from_the_base_what_it_reflects(void **state)
{
    (void)state;
    const float from[3] = { 0.6F, 0.8F, 0.0F }, eye[3] = { -6.0F, 8.0F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    scene_material m = scene_material_default();
    m.roughness = 0.5F;
    m.base_color[1] = 0.3F;
    m.clearcoat = 0.7F;
    m.clearcoat_roughness = 0.4F;
    scene s = scenes_empty();
    add_level(&s, &m, 0.0F, 0);
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 2.0F);
    const scene_camera c = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 1.0F);
    const preview_options o = pictures_options(&c);
    image i = pictures_render(&s, &o);

    const float wo[3] = { -0.6F, 0.0F, 0.8F }, wi[3] = { 0.6F, 0.0F, 0.8F };
    glint_material_options base = GLINT_MATERIAL_OPTIONS_INIT, coat = GLINT_MATERIAL_OPTIONS_INIT;
    base.model = coat.model = GLINT_MODEL_SMOOTH;
    base.surface.alpha_x = base.surface.alpha_y = 0.25F;
    base.surface.f0[1] = 0.3F;
    coat.surface.alpha_x = coat.surface.alpha_y = 0.16F;
    coat.surface.f0[0] = coat.surface.f0[1] = coat.surface.f0[2] = 0.04F;
    glint_material *made[2];
    float f[2][3];
    assert_int_equal(glint_material_create(&base, &made[0], NULL, 0), GLINT_OK);
    assert_int_equal(glint_material_create(&coat, &made[1], NULL, 0), GLINT_OK);
    for (int k = 0; k < 2; ++k) {
        glint_eval(made[k], NULL, NULL, wo, wi, NULL, f[k]);
        glint_material_destroy(made[k]);
    }
    const double s_of_alpha = 1.0 - 0.8 * 0.16, along = 1.0 - 0.04 - 0.96 * pow(1.0 - 0.8 * s_of_alpha, 5.0);
    const double through = along * along / (1.0 - 0.04 - 0.96 * pow(1.0 - s_of_alpha, 5.0));
    const char *const channels[3] = { "R", "G", "B" };
    for (int k = 0; k < 3; ++k)
        pictures_assert_relative(pictures_mean(&i, channels[k]),
                                 2.0 * ((double)f[0][k] * (1.0 - 0.7 * (1.0 - through)) + 0.7 * (double)f[1][k]), 1e-5);
    image_free(&i);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blended_layers_are_mixed_from_front_to_back),
        cmocka_unit_test(alpha_is_the_coverage_and_multiplies_the_color),
        cmocka_unit_test(a_mask_covers_what_its_texture_says),
        cmocka_unit_test(unlit_and_vertex_colors_multiply),
        cmocka_unit_test(an_emitter_shows_its_radiance),
        cmocka_unit_test(a_normal_map_leans_along_tangent_and_bitangent),
        cmocka_unit_test(occlusion_darkens_the_sky_and_not_the_sun),
        cmocka_unit_test(a_clear_coat_takes_from_the_base_what_it_reflects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
