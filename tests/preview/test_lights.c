/* Size and place of lights: solid angles, soft edges, and what happens inside a light. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "preview/light.h"
#include "preview/rig.h"
#include "scenes.h"

static light make(scene_light_kind kind, const float from[3], double size)
{
    scene s = scenes_empty();
    scene_light *const l = scenes_add_light(&s, kind, from, 1.0F);
    l->angular_diameter_rad = l->radius_m = (float)size;
    const light made = light_make(l);
    scene_free(&s);
    return made;
}

static void assert_close(double value, double expected, double bound)
{
    if (!(fabs(value - expected) <= bound * fabs(expected)))
        fail_msg("%.9g is not %.9g within %g", value, expected, bound);
}

static const float ABOVE[3] = { 0.0F, 2.0F, 0.0F };

static void the_sun_covers_the_cap_of_its_diameter(void **state)
{
    (void)state;
    light_view v;
    const light sun = make(SCENE_LIGHT_DIRECTIONAL, ABOVE, 0.00929);
    assert_true(light_see(&sun, v3(0.0, 0.0, 0.0), &v));
    assert_close((double)v.solid_angle_sr, 6.778e-5, 1e-4); /* pi/4 * 0.00929^2: the cap is flat to 1e-6 */
    const light half_sky = make(SCENE_LIGHT_DIRECTIONAL, ABOVE, 0.5);
    assert_true(light_see(&half_sky, v3(0.0, 0.0, 0.0), &v));
    assert_close((double)v.solid_angle_sr, 2.0 * PREVIEW_PI * (1.0 - cos(0.25)), 1e-6);
}

/* A sphere of radius r at the distance d hides a cap with sin = r / d: 2 pi (1 - sqrt(1 - r^2 / d^2)). */
static void a_point_light_covers_the_cap_of_its_sphere(void **state)
{
    (void)state;
    light_view v;
    const light bulb = make(SCENE_LIGHT_POINT, ABOVE, 0.3);
    assert_true(light_see(&bulb, v3(0.0, 1.0, 0.0), &v));
    assert_close((double)v.solid_angle_sr, 2.0 * PREVIEW_PI * (1.0 - sqrt(1.0 - 0.09)), 1e-6);
    assert_close((double)v.irradiance[0], 1.0, 1e-6);
}

static void inside_a_light_its_cap_stays_below_a_hemisphere(void **state)
{
    (void)state;
    light_view v;
    const light bulb = make(SCENE_LIGHT_POINT, ABOVE, 0.3);
    assert_true(light_see(&bulb, v3(0.0, 1.9, 0.0), &v));
    assert_true(v.solid_angle_sr < (float)(2.0 * PREVIEW_PI));
    assert_true(v.solid_angle_sr > 6.28F);
    assert_true(light_see(&bulb, v3(0.0, 1.7, 0.0), &v)); /* on its surface */
    assert_true(v.solid_angle_sr < (float)(2.0 * PREVIEW_PI));
    assert_false(light_see(&bulb, v3(0.0, 2.0, 0.0), &v)); /* in its centre there is no direction */
}

static void a_light_without_size_still_has_a_solid_angle(void **state)
{
    (void)state;
    light_view v;
    const light star = make(SCENE_LIGHT_DIRECTIONAL, ABOVE, 0.0), spark = make(SCENE_LIGHT_POINT, ABOVE, 0.0);
    assert_true(light_see(&star, v3(0.0, 0.0, 0.0), &v) && v.solid_angle_sr > 0.0F);
    assert_true(light_see(&spark, v3(0.0, 0.0, 0.0), &v) && v.solid_angle_sr > 0.0F);
}

/* Even over a cap means that cos is uniform between 1 and cos(radius); the mean of 64 x 64 midpoints is exact to 1e-4.
 */
static void shadow_rays_cover_the_light_evenly(void **state)
{
    (void)state;
    const vec3 here = v3(0.0, 0.0, 0.0), up = v3(0.0, 1.0, 0.0);
    const light sun = make(SCENE_LIGHT_DIRECTIONAL, ABOVE, 1.0), bulb = make(SCENE_LIGHT_POINT, ABOVE, 0.3);
    light_view sun_view, bulb_view;
    assert_true(light_see(&sun, here, &sun_view) && light_see(&bulb, here, &bulb_view));
    double cosine = 0.0, squared_radius = 0.0;
    vec3 sum = here;
    for (int i = 0; i < 64 * 64; ++i) {
        const int column = i % 64, row = i / 64;
        const double u[2] = { (column + 0.5) / 64.0, (row + 0.5) / 64.0 };
        vec3 direction;
        double distance;
        light_pick(&sun, &sun_view, here, u, &direction, &distance);
        assert_true(v3_dot(direction, up) >= cos(0.5) - 1e-12 && isinf(distance));
        cosine += v3_dot(direction, up) / (64.0 * 64.0);
        sum = v3_add(sum, direction);
        light_pick(&bulb, &bulb_view, here, u, &direction, &distance);
        const vec3 at = v3_scale(direction, distance);
        assert_true(fabs(at.y - 2.0) < 1e-9); /* on the disc that faces the point */
        squared_radius += (at.x * at.x + at.z * at.z) / (64.0 * 64.0);
    }
    assert_close(cosine, 0.5 * (1.0 + cos(0.5)), 1e-4);
    assert_close(squared_radius, 0.5 * 0.09, 1e-4);
    assert_true(fabs(sum.x) < 1e-9 && fabs(sum.z) < 1e-9);
}

/* As on a photographer's table: the key in front and on the left, the rim behind, all from above. */
static void the_rig_stands_around_the_camera(void **state)
{
    (void)state;
    const float eye[3] = { 4.0F, 1.0F, -2.0F }, straight_down[3] = { 0.0F, 5.0F, 0.0F }, target[3] = { 0 };
    const float *const eyes[2] = { eye, straight_down };
    for (int i = 0; i < 2; ++i) {
        const scene_camera c = scenes_camera(SCENE_PERSPECTIVE, eyes[i], target, 0.5F);
        scene_light lights[RIG_LIGHT_COUNT];
        rig_lights(&c, lights);
        const vec3 right = v3((double)c.to_world[0], (double)c.to_world[1], (double)c.to_world[2]);
        for (int k = 0; k < RIG_LIGHT_COUNT; ++k) {
            const light l = light_make(&lights[k]);
            assert_true(fabs(v3_length(l.axis) - 1.0) < 1e-6);
            assert_true(l.axis.y > 0.1 && l.intensity[0] > 0.0F);
            if (k == 0)
                assert_true(v3_dot(l.axis, right) < -0.1);
        }
    }
}

/* A scene without lights, and the same with the rig in it and its sky around it, are one picture. */
static void the_rig_can_be_put_into_the_scene(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(0.5F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 1.0F, 24, 12), NULL, 0);
    preview_options o = pictures_options(NULL);
    o.sky = NULL;
    image studio = pictures_render(&s, &o);
    report r = { 0 };
    assert_true(preview_add_lookdev_rig(&s, &r));
    assert_int_equal(s.light_count, RIG_LIGHT_COUNT);
    for (int k = 0; k < RIG_LIGHT_COUNT; ++k)
        assert_non_null(s.lights[k].name);
    const preview_sky sky = rig_sky();
    o.sky = &sky;
    image added = pictures_render(&s, &o);
    assert_memory_equal(studio.pixels, added.pixels, sizeof(float) * 16 * 16 * (size_t)studio.channel_count);
    o.sky = NULL; /* now that there are lights, there is no sky */
    image lights_only = pictures_render(&s, &o);
    assert_true(pictures_mean(&lights_only, "R") < pictures_mean(&added, "R"));
    assert_true(pictures_at(&lights_only, "A", 0, 0) == 0.0);
    image_free(&studio);
    image_free(&added);
    image_free(&lights_only);
    scene_free(&s);
}

/* ---- light sets ---- */

/* A matte ball on a floor, all of it `scale` times as large, seen by a camera that went along. */
static image ball_under(int set, float scale)
{
    scene s = scenes_empty();
    const scene_material matte = scenes_matte(0.5F);
    const int material = scenes_add_material(&s, &matte);
    float place[16];
    scenes_translation(place, 0.0F, scale, 0.0F);
    scenes_add_instance(&s, scenes_add_sphere(&s, material, scale, 48, 24), place, 0);
    scenes_add_instance(&s, scenes_add_square(&s, material, 20.0F * scale), NULL, 1);
    const float eye[3] = { 2.0F * scale, 3.0F * scale, 8.0F * scale }, target[3] = { 0.0F, scale, 0.0F };
    scene_camera c = scenes_camera(SCENE_PERSPECTIVE, eye, target, 0.4F);
    preview_sky sky;
    report r = { 0 };
    assert_true(preview_use_light_set(&s, set, &c, &sky, &r));
    preview_options o = pictures_options(&c);
    o.sky = &sky;
    image i = pictures_render(&s, &o);
    scene_free(&s);
    return i;
}

/* Lights stand around what is seen, as far away and as large as it asks for: a scene in millimetres looks as one in
 * metres does, but for the rounding of single precision where a shadow begins, in a pixel or two. */
static void a_light_set_suits_scenes_of_any_size(void **state)
{
    (void)state;
    for (int set = 0; preview_light_set_name(set) != NULL; ++set) {
        image one = ball_under(set, 1.0F), small = ball_under(set, 0.0009765625F);
        int different = 0;
        for (int k = 0; k < 256; ++k) {
            const double a = pictures_at(&one, "G", k % 16, k / 16), b = pictures_at(&small, "G", k % 16, k / 16);
            different += fabs(a - b) > 1e-3 * (a + b);
        }
        if (different > 8)
            fail_msg("%s: %d of 256 pixels differ with the scale", preview_light_set_name(set), different);
        const double level = pictures_mean(&one, "G");
        if (strcmp(preview_light_set_name(set), "none") == 0)
            assert_true(level == 0.0);
        else if (!(level > 0.02 && level < 1.0)) /* neither night nor burnt out: a third of white is .16 */
            fail_msg("%s: the mean is %g", preview_light_set_name(set), level);
        image_free(&one);
        image_free(&small);
    }
}

/* The set replaces what the file brought, its image-based light as well. */
static void a_light_set_takes_the_place_of_the_lights(void **state)
{
    (void)state;
    scene s = scenes_empty();
    for (int i = 0; i < 3; ++i)
        scenes_add_light(&s, SCENE_LIGHT_POINT, ABOVE, 1e6F);
    s.environment.present = true;
    const scene_camera c = pictures_from_above(1.0F);
    preview_sky sky;
    report r = { 0 };
    assert_true(preview_use_light_set(&s, 0, &c, &sky, &r));
    assert_false(s.environment.present);
    assert_true(s.light_count > 0);
    for (int i = 0; i < s.light_count; ++i) {
        assert_int_equal(s.lights[i].kind, SCENE_LIGHT_RECT);
        assert_true(s.lights[i].width_m > 0.0F && isfinite(s.lights[i].intensity));
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sun_covers_the_cap_of_its_diameter),
        cmocka_unit_test(a_point_light_covers_the_cap_of_its_sphere),
        cmocka_unit_test(inside_a_light_its_cap_stays_below_a_hemisphere),
        cmocka_unit_test(a_light_without_size_still_has_a_solid_angle),
        cmocka_unit_test(shadow_rays_cover_the_light_evenly),
        cmocka_unit_test(the_rig_stands_around_the_camera),
        cmocka_unit_test(the_rig_can_be_put_into_the_scene),
        cmocka_unit_test(a_light_set_suits_scenes_of_any_size),
        cmocka_unit_test(a_light_set_takes_the_place_of_the_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
