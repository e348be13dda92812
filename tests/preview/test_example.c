/* Normal maps of the example model in pictures: which way they lean on a surface, however it lies, and that threads do
 * not matter. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

/* A metal whose map leans everywhere to the same side: (x, y) of the normal as the picture stores it, y up. */
static int add_leaning(scene *s, double x, double y, scene_glint_space space)
{
    uint8_t rgba[64 * 4];
    for (int i = 0; i < 64; ++i) {
        const double n[4] = { x, y, sqrt(1.0 - x * x - y * y), 1.0 };
        for (int c = 0; c < 4; ++c)
            rgba[4 * i + c] = (uint8_t)lround(127.5 * (n[c] + 1.0));
    }
    scene_material m = scenes_flakes(0.3F, 1e4F);
    m.glint.structure = SCENE_STRUCTURE_EXAMPLE;
    m.glint.example_texture = scenes_add_texture(s, rgba, 8, 8);
    m.glint.example_placement = SCENE_PLACEMENT_TILED;
    m.glint.example_size = 0.1F;
    m.glint.space = space;
    m.glint.facet_roughness = 0.3F;
    m.glint.uv_scale = 10.0F; /* the square has 10 m */
    m.anisotropy = 0.5F;      /* of the fallback: it must not turn the map */
    m.anisotropy_rotation = 1.0F;
    m.double_sided = true;
    return scenes_add_material(s, &m);
}

/* How bright the square is, seen from above, where the map's normal leans towards (x, z) in the world, and where it
 * leans the other way: the light stands where such a normal reflects it to the viewer. */
static void assert_leans(scene *s, double x, double z, const char *what)
{
    static const double LEAN = 0.3;
    double seen[2];
    for (int k = 0; k < 2; ++k) {
        const double side = k == 0 ? 1.0 : -1.0, twice = 2.0 * asin(LEAN);
        const float from[3] = { (float)(side * x * sin(twice)), (float)cos(twice), (float)(side * z * sin(twice)) };
        s->light_count = 0;
        scenes_add_light(s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F);
        const scene_camera c = pictures_from_above(1.0F);
        const preview_options o = pictures_options(&c);
        image i = pictures_render(s, &o);
        seen[k] = pictures_mean(&i, "R");
        image_free(&i);
    }
    if (!(seen[0] > 100.0 * seen[1]))
        fail_msg("%s: %g where the normal should lean to, %g on the other side", what, seen[0], seen[1]);
}

/* The square's s runs along +x and its t along +z; up in the picture is -z. */
static void red_leans_along_s_and_green_against_t(void **state)
{
    (void)state;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, add_leaning(&s, 0.3, 0.0, SCENE_SPACE_UV), 5.0F), NULL, 0);
    assert_leans(&s, 1.0, 0.0, "red");
    scene_free(&s);
    s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, add_leaning(&s, 0.0, 0.3, SCENE_SPACE_UV), 5.0F), NULL, 0);
    assert_leans(&s, 0.0, -1.0, "green");
    scene_free(&s);
}

/* On the plane of x and z u runs along z and v along x, and green is against v. */
static void in_object_space_the_map_lies_along_the_axes(void **state)
{
    (void)state;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, add_leaning(&s, 0.3, 0.0, SCENE_SPACE_OBJECT), 5.0F), NULL, 0);
    assert_leans(&s, 0.0, 1.0, "red");
    scene_free(&s);
    s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, add_leaning(&s, 0.0, 0.3, SCENE_SPACE_OBJECT), 5.0F), NULL, 0);
    assert_leans(&s, -1.0, 0.0, "green");
    scene_free(&s);
}

/* Column-major: x to -x, y and z as they are. */
static const float mirrored[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
/* A quarter turn about y: x to -z, z to x. */
static const float turned[16] = { 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1 };
/* Half a turn about x: seen from behind, s still along +x, t along -z. */
static const float upside_down[16] = { 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1 };

static void the_map_goes_with_the_object(void **state)
{
    (void)state;
    static const struct {
        const float *to_world;
        double lean[2], x, z;
        const char *what;
    } rows[] = {
        { mirrored, { 0.3, 0.0 }, -1.0, 0.0, "mirrored, red" },
        { mirrored, { 0.0, 0.3 }, 0.0, -1.0, "mirrored, green" },
        { turned, { 0.3, 0.0 }, 0.0, -1.0, "turned, red" },
        { turned, { 0.0, 0.3 }, -1.0, 0.0, "turned, green" },
        /* The normal leans to +x of a front that looks down; seen from behind it is (-x, +y). */
        { upside_down, { 0.3, 0.0 }, -1.0, 0.0, "from behind, red" },
        { upside_down, { 0.0, 0.3 }, 0.0, -1.0, "from behind, green" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        scene s = scenes_empty();
        const int material = add_leaning(&s, rows[i].lean[0], rows[i].lean[1], SCENE_SPACE_UV);
        scenes_add_instance(&s, scenes_add_square(&s, material, 5.0F), rows[i].to_world, 0);
        assert_leans(&s, rows[i].x, rows[i].z, rows[i].what);
        scene_free(&s);
    }
}

/* KHR_texture_transform: counter-clockwise in the picture, where t runs down. A quarter turn takes what was up to the
 * left: the texture coordinate (s, t) shows the texel (t, -s), so that the texture's u runs along t. */
static void a_turned_texture_turns_its_normals(void **state)
{
    (void)state;
    scene s = scenes_empty();
    const int material = add_leaning(&s, 0.3, 0.0, SCENE_SPACE_UV);
    s.materials[material].glint.example_texture.rotation = 1.57079633F;
    scenes_add_instance(&s, scenes_add_square(&s, material, 5.0F), NULL, 0);
    assert_leans(&s, 0.0, 1.0, "a quarter turn, red");
    scene_free(&s);
}

/* Brushed grooves along u spread light across them, along v. */
static void grooves_spread_light_across(void **state)
{
    (void)state;
    enum { N = 32 };
    static float normals[N * N][3];
    static uint8_t rgba[N * N * 4];
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_BRUSHED, N, &shape, 1U, normals[0]), GLINT_OK);
    for (int i = 0; i < N * N; ++i) {
        rgba[4 * i] = (uint8_t)lround(127.5 * ((double)normals[i][0] + 1.0));
        rgba[4 * i + 1] = (uint8_t)lround(127.5 * (1.0 - (double)normals[i][1]));
        rgba[4 * i + 2] = (uint8_t)lround(127.5 * ((double)normals[i][2] + 1.0));
        rgba[4 * i + 3] = 255;
    }
    scene s = scenes_empty();
    const int material = add_leaning(&s, 0.0, 0.0, SCENE_SPACE_UV);
    s.materials[material].glint.example_texture = scenes_add_texture(&s, rgba, N, N);
    scenes_add_instance(&s, scenes_add_square(&s, material, 5.0F), NULL, 0);
    double seen[2];
    for (int k = 0; k < 2; ++k) {
        /* Off the mirror direction by a slope of .2, across and along. */
        const float from[3] = { k ? 0.4F : 0.0F, 1.0F, k ? 0.0F : 0.4F };
        s.light_count = 0;
        scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F);
        const scene_camera c = pictures_from_above(1.0F);
        const preview_options o = pictures_options(&c);
        image i = pictures_render(&s, &o);
        seen[k] = pictures_mean(&i, "R");
        image_free(&i);
    }
    if (!(seen[0] > 3.0 * seen[1]))
        fail_msg("%g across the grooves, %g along them", seen[0], seen[1]);
    scene_free(&s);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    scene s = scenes_empty();
    const int material = add_leaning(&s, 0.1, 0.1, SCENE_SPACE_UV);
    s.materials[material].glint.example_placement = SCENE_PLACEMENT_SCATTERED;
    scenes_add_instance(&s, scenes_add_sphere(&s, material, 1.0F, 24, 16), NULL, 0);
    const float from[3] = { 0.3F, 1.0F, 0.2F };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F);
    const scene_camera c = pictures_from_above(1.2F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 48;
    image one = pictures_render(&s, &o);
    o.threads = 2;
    image two = pictures_render(&s, &o);
    assert_memory_equal(one.pixels, two.pixels, 48U * 48U * (size_t)one.channel_count * sizeof(float));
    assert_true(pictures_mean(&one, "R") > 0.0);
    image_free(&one);
    image_free(&two);
    scene_free(&s);
}

static void keep_warning(const char *text, void *user)
{
    snprintf(user, 512, "%s", text);
}

static void a_model_that_does_not_fit_says_so(void **state)
{
    (void)state;
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, add_leaning(&s, 0.3, 0.0, SCENE_SPACE_UV), 5.0F), NULL, 0);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    char warning[512] = "";
    report r = { .warn = keep_warning, .user = warning };
    image i;
    assert_true(preview_render(&s, &o, &i, NULL, &r));
    assert_string_equal(warning, "");
    image_free(&i);
    o.model = GLINT_MODEL_COUNTING;
    assert_true(preview_render(&s, &o, &i, NULL, &r));
    assert_non_null(strstr(warning, "glintStructure \"example\" is not rendered by the counting model"));
    image_free(&i);
    s.materials[0].glint.structure = SCENE_STRUCTURE_FLAKES;
    o.model = GLINT_MODEL_EXAMPLE;
    assert_true(preview_render(&s, &o, &i, NULL, &r));
    assert_non_null(strstr(warning, "has no glintExampleTexture for the example model; 16 x 16 flat facets"));
    image_free(&i);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(red_leans_along_s_and_green_against_t),
        cmocka_unit_test(in_object_space_the_map_lies_along_the_axes),
        cmocka_unit_test(the_map_goes_with_the_object),
        cmocka_unit_test(a_turned_texture_turns_its_normals),
        cmocka_unit_test(grooves_spread_light_across),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_model_that_does_not_fit_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
