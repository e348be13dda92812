/* Direct light in pictures against closed forms: E f cos, inverse squares, cones, shadows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "preview/choose_lights.h"
#include "scenes.h"

#define PI 3.14159265358979323846
#define ALBEDO 0.6

/* A chain of about ten float operations, 6e-8 each. */
#define FLOAT_BOUND 1e-6

static int add_floor(scene *s, float half_size)
{
    const scene_material matte = scenes_matte((float)ALBEDO);
    const int mesh = scenes_add_square(s, scenes_add_material(s, &matte), half_size);
    scenes_add_instance(s, mesh, NULL, 0);
    return mesh;
}

/* What a point of the floor gets from a light at `from` with the given irradiance: L = E albedo / pi cos. */
static double lambert(double irradiance, double cosine)
{
    return irradiance * ALBEDO / PI * cosine;
}

static void a_directional_light_gives_E_f_cos(void **state)
{
    (void)state;
    const float from[3] = { 3.0F, 4.0F, 0.0F };
    scene s = scenes_empty();
    add_floor(&s, 5.0F);
    scene_light *const l = scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 2.5F);
    l->color[1] = 0.5F;
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    image i = pictures_render(&s, &o);
    for (int k = 0; k < 16; ++k) {
        pictures_assert_relative(pictures_at(&i, "R", k, 15 - k), lambert(2.5, 0.8), FLOAT_BOUND);
        pictures_assert_relative(pictures_at(&i, "G", k, k), lambert(1.25, 0.8), FLOAT_BOUND);
        assert_true(pictures_at(&i, "A", k, k) == 1.0);
    }
    image_free(&i);
    scene_free(&s);
}

/* A pixel so small that a point stands for it: the mean over it differs by (pixel / distance)^2 = 1e-6. */
static void a_point_light_falls_off_with_the_square_of_the_distance(void **state)
{
    (void)state;
    scene s = scenes_empty();
    add_floor(&s, 5.0F);
    const float from[3] = { 0.9F, 1.2F, 0.0F }; /* distance 1.5, cosine 0.8 */
    scenes_add_light(&s, SCENE_LIGHT_POINT, from, 7.0F);
    const scene_camera c = pictures_from_above(1e-4F);
    const preview_options o = pictures_options(&c);
    image i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "G"), lambert(7.0 / 2.25, 0.8), 3e-6);
    image_free(&i);

    s.lights[0].range = 3.0F; /* 1 - (1.5 / 3)^4 */
    i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "G"), lambert(7.0 / 2.25 * (1.0 - 0.0625), 0.8), 3e-6);
    image_free(&i);
    s.lights[0].range = 1.4F;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "G") == 0.0);
    image_free(&i);
    scene_free(&s);
}

/* A spot 2 m above the floor: inside the inner cone all light, outside the outer one none, in between the square of the
 * cosine's share (KHR_lights_punctual). */
static void a_spot_light_fades_from_its_inner_to_its_outer_cone(void **state)
{
    (void)state;
    scene s = scenes_empty();
    add_floor(&s, 5.0F);
    const float from[3] = { 0.0F, 2.0F, 0.0F };
    scene_light *const l = scenes_add_light(&s, SCENE_LIGHT_SPOT, from, 3.0F);
    l->inner_cone_rad = 0.3F;
    l->outer_cone_rad = 0.5F;
    const scene_camera c = pictures_from_above(1.6F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 201;
    o.spp = 1;
    image i = pictures_render(&s, &o);
    for (int x = 0; x < 201; ++x) {
        const double away = fabs((x - 100) * 3.2 / 201.0);
        const double pixel = 3.2 / 201.0; /* the sample may lie anywhere in it, across as well */
        double low = (double)INFINITY, high = 0.0;
        for (int k = 0; k <= 20; ++k) {
            const double at = fabs(away + pixel * (k / 20.0 - 0.5)), d = hypot(hypot(at, pixel / 2), 2.0);
            const double cosine = 2.0 / hypot(at, 2.0);
            const double cosine_far = 2.0 / d;
            const double share = fmin(fmax((cosine - cos(0.5)) / (cos(0.3) - cos(0.5)), 0.0), 1.0);
            const double share_far = fmin(fmax((cosine_far - cos(0.5)) / (cos(0.3) - cos(0.5)), 0.0), 1.0);
            low = fmin(low, lambert(3.0 / (d * d) * share_far * share_far, cosine_far));
            high = fmax(high, lambert(3.0 / (4.0 + at * at) * share * share, cosine));
        }
        const double value = pictures_at(&i, "R", x, 100);
        assert_true(value >= low * (1.0 - 1e-5) && value <= high * (1.0 + 1e-5));
    }
    assert_true(pictures_at(&i, "R", 100, 100) > 0.1);
    assert_true(pictures_at(&i, "R", 20, 100) == 0.0);
    image_free(&i);
    scene_free(&s);
}

/* A square of side 1 m at height 1 m under a sun straight above: its shadow has its size, and half-shadows are as wide
 * as the sun, 1 m * 0.00929, a hundredth of the shadow's side at each edge, fair to both sides. */
static void a_shadow_has_the_area_of_what_throws_it(void **state)
{
    (void)state;
    scene s = scenes_empty();
    const int floor = add_floor(&s, 5.0F);
    scene_mesh *const mesh = &s.meshes[floor];
    float place[16];
    scenes_translation(place, 0.0F, 1.0F, 0.0F);
    place[0] = place[10] = 0.1F; /* of the floor's 10 m */
    scenes_add_instance(&s, floor, place, 1);
    assert_int_equal(mesh->vertex_count, 4);
    const float from[3] = { 0.0F, 1.0F, 0.0F };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F);

    const float eye[3] = { 0.0F, 0.5F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F }; /* from below the square */
    const scene_camera c = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 1.0F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 128;
    o.spp = 16;
    image i = pictures_render(&s, &o);
    const double lit = lambert(1.0, 1.0);
    const double shadow_area = 4.0 * (1.0 - pictures_mean(&i, "R") / lit);
    /* Of 128^2 * 16 samples only those in the half-shadow, a share of 4 * 0.00929 / 4, are random: a standard error of
     * at most 4 * sqrt(0.00929 / 4) / 512 m^2 = 4e-4; five of these. */
    assert_true(fabs(shadow_area - 1.0) < 2e-3);
    assert_true(pictures_at(&i, "R", 64, 64) == 0.0);
    pictures_assert_relative(pictures_at(&i, "R", 2, 2), lit, FLOAT_BOUND);
    image_free(&i);
    scene_free(&s);
}

/* The light behind a surface does not shine through it, whatever the side that it is seen from. */
static void light_does_not_pass_a_surface(void **state)
{
    (void)state;
    scene s = scenes_empty();
    add_floor(&s, 5.0F);
    s.materials[0].double_sided = true;
    const float below[3] = { 0.2F, -1.0F, 0.1F };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, below, 1.0F);
    const scene_camera above = pictures_from_above(1.0F);
    preview_options o = pictures_options(&above);
    image i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "R") == 0.0 && pictures_mean(&i, "A") == 1.0);
    image_free(&i);

    const float eye[3] = { 0.0F, -10.0F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera under = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 1.0F);
    o.camera = &under;
    i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "R"), lambert(1.0, 1.0 / sqrt(1.05)), FLOAT_BOUND);
    assert_true(pictures_mean(&i, "normal.Y") < -0.999);
    image_free(&i);
    scene_free(&s);
}

/* With more lights than are gathered at a time, every one still counts once. */
static void lights_add_up(void **state)
{
    (void)state;
    scene s = scenes_empty();
    add_floor(&s, 5.0F);
    double expected = 0.0;
    for (int k = 0; k < MOST_LIGHTS; ++k) {
        const float from[3] = { 0.1F * (float)k, 1.0F, 0.0F };
        scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 0.1F);
        expected += lambert(0.1, 1.0 / sqrt(1.0 + 0.01 * k * k));
    }
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    image i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_mean(&i, "B"), expected, 1e-5);
    image_free(&i);
    scene_free(&s);
}

/* A coarse sphere with smooth normals under a light from the side: without care its facets shade themselves, and the
 * lit half shows black triangles at the terminator. */
static void smooth_shading_has_no_black_facets_at_the_terminator(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte((float)ALBEDO);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 1.0F, 16, 8), NULL, 0);
    /* 8.25 degrees aside: on facets of 22.5 degrees whose middle leans away from the light by 3, the smooth normal
     * still leans towards it by up to 8.25, a cosine of 0.14. */
    const float from[3] = { 0.98965139F, 0.0F, 0.14349262F };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F)->angular_diameter_rad = 0.0F;
    const scene_camera c = pictures_from_above(0.9F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 64;
    image i = pictures_render(&s, &o);
    /* Where the shading normal leans towards the light by more than a fifth of the angle of a facet (2 pi / 16). */
    for (int y = 8; y < 56; ++y) {
        for (int x = 8; x < 56; ++x) {
            const double cosine = pictures_at(&i, "normal.X", x, y) * (double)from[0] +
                                  pictures_at(&i, "normal.Z", x, y) * (double)from[2];
            if (cosine > 0.08)
                assert_true(pictures_at(&i, "R", x, y) > 0.5 * lambert(1.0, cosine));
        }
    }
    image_free(&i);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_directional_light_gives_E_f_cos),
        cmocka_unit_test(a_point_light_falls_off_with_the_square_of_the_distance),
        cmocka_unit_test(a_spot_light_fades_from_its_inner_to_its_outer_cone),
        cmocka_unit_test(a_shadow_has_the_area_of_what_throws_it),
        cmocka_unit_test(light_does_not_pass_a_surface),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(smooth_shading_has_no_black_facets_at_the_terminator),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
