/* Camera rays: where they go, how they change from pixel to pixel, and what the framed camera holds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "preview/camera.h"
#include "preview/preview.h"
#include "scenes.h"

static const float EYE[3] = { 3.0F, 2.0F, 5.0F };
static const float TARGET[3] = { 0.5F, 0.0F, -0.25F };

static camera make(const scene_camera *from, int width, int height)
{
    report r = { 0 };
    camera c;
    assert_true(camera_make(from, width, height, &c, &r));
    return c;
}

static void assert_near(vec3 a, vec3 b, double bound)
{
    if (!(v3_length(v3_sub(a, b)) <= bound))
        fail_msg("(%g, %g, %g) is not (%g, %g, %g) within %g", a.x, a.y, a.z, b.x, b.y, b.z, bound);
}

static void the_middle_of_the_picture_looks_at_the_target(void **state)
{
    (void)state;
    const scene_projection kinds[2] = { SCENE_PERSPECTIVE, SCENE_ORTHOGRAPHIC };
    for (int k = 0; k < 2; ++k) {
        const scene_camera from = scenes_camera(kinds[k], EYE, TARGET, 0.7F);
        const camera c = make(&from, 64, 48);
        trace_ray ray;
        differential d;
        camera_ray(&c, 32.0, 24.0, &ray, &d);
        const double distance = v3_length(v3_sub(v3_from(TARGET), v3_from(EYE)));
        assert_near(v3_mad(ray.origin, ray.direction, distance), v3_from(TARGET), 1e-5); /* the matrix is float */
        assert_true(fabs(v3_length(ray.direction) - 1.0) < 1e-12);
    }
}

static void the_edges_of_a_perspective_picture_are_at_half_the_field_of_view(void **state)
{
    (void)state;
    const scene_camera from = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.7F);
    const camera c = make(&from, 64, 48);
    trace_ray ray;
    differential d;
    camera_ray(&c, 32.0, 0.0, &ray, &d);
    assert_true(fabs(acos(v3_dot(ray.direction, c.forward)) - 0.35) < 1e-6);
    assert_true(v3_dot(ray.direction, c.up) > 0.0);
    camera_ray(&c, 64.0, 24.0, &ray, &d);
    assert_true(fabs(v3_dot(ray.direction, c.right) / v3_dot(ray.direction, c.forward) - tan(0.35) * 64 / 48) < 1e-6);
}

static void an_orthographic_picture_is_as_large_as_its_magnification_says(void **state)
{
    (void)state;
    const scene_camera from = scenes_camera(SCENE_ORTHOGRAPHIC, EYE, TARGET, 1.5F);
    const camera c = make(&from, 50, 50);
    trace_ray left, right;
    differential d;
    camera_ray(&c, 0.0, 25.0, &left, &d);
    camera_ray(&c, 50.0, 25.0, &right, &d);
    assert_true(fabs(v3_length(v3_sub(right.origin, left.origin)) - 3.0) < 1e-6);
    assert_near(left.direction, right.direction, 0.0);
}

static void a_picture_of_another_shape_still_shows_all_that_the_camera_frames(void **state)
{
    (void)state;
    scene_camera from = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.7F);
    from.aspect = 2.0F;
    const camera wide = make(&from, 400, 100), tall = make(&from, 100, 400);
    const double y = tan(0.35), x = 2.0 * y;
    assert_true(fabs(wide.half_height - y) < 1e-6 && wide.half_width >= x);
    assert_true(fabs(tall.half_width - x) < 1e-6 && tall.half_height >= y);
    assert_true(fabs(wide.half_width / wide.half_height - 4.0) < 1e-12); /* square pixels */
    assert_true(fabs(tall.half_width / tall.half_height - 0.25) < 1e-12);
}

/* A central difference over 2 e pixels is off by e^2/6 of the third derivative, and by rounding of 1e-16 / e. */
static void differentials_are_the_difference_between_neighbouring_rays(void **state)
{
    (void)state;
    const double e = 1e-3, bound = 1e-9;
    const scene_projection kinds[2] = { SCENE_PERSPECTIVE, SCENE_ORTHOGRAPHIC };
    for (int k = 0; k < 2; ++k) {
        const scene_camera from = scenes_camera(kinds[k], EYE, TARGET, 0.9F);
        const camera c = make(&from, 64, 48);
        trace_ray ray, a, b;
        differential d, unused;
        const double x = 51.3, y = 7.9;
        camera_ray(&c, x, y, &ray, &d);
        camera_ray(&c, x - e, y, &a, &unused);
        camera_ray(&c, x + e, y, &b, &unused);
        assert_near(d.direction_dx, v3_scale(v3_sub(b.direction, a.direction), 0.5 / e), bound);
        assert_near(d.origin_dx, v3_scale(v3_sub(b.origin, a.origin), 0.5 / e), bound);
        camera_ray(&c, x, y - e, &a, &unused);
        camera_ray(&c, x, y + e, &b, &unused);
        assert_near(d.direction_dy, v3_scale(v3_sub(b.direction, a.direction), 0.5 / e), bound);
        assert_near(d.origin_dy, v3_scale(v3_sub(b.origin, a.origin), 0.5 / e), bound);
    }
}

static void clipping_planes_are_measured_along_the_viewing_direction(void **state)
{
    (void)state;
    scene_camera from = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.9F);
    from.znear = 0.5F;
    from.zfar = 8.0F;
    const camera c = make(&from, 64, 48);
    trace_ray ray;
    differential d;
    camera_ray(&c, 0.0, 0.0, &ray, &d);
    assert_true(fabs(camera_depth(&c, v3_mad(ray.origin, ray.direction, ray.near)) - 0.5) < 1e-12);
    assert_true(fabs(camera_depth(&c, v3_mad(ray.origin, ray.direction, ray.far)) - 8.0) < 1e-12);
}

static void the_scale_of_the_node_does_not_change_the_picture(void **state)
{
    (void)state;
    const scene_camera plain = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.9F);
    scene_camera scaled = plain;
    for (int i = 0; i < 12; ++i)
        scaled.to_world[i] *= 4.0F; /* a power of two: no rounding */
    const camera a = make(&plain, 64, 48), b = make(&scaled, 64, 48);
    assert_near(a.right, b.right, 1e-12);
    assert_near(a.up, b.up, 1e-12);
    assert_true(a.half_width == b.half_width);
}

static void a_flat_transform_is_an_error_that_names_the_camera(void **state)
{
    (void)state;
    scene_camera from = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.9F);
    char name[] = "front";
    from.name = name;
    for (int i = 0; i < 4; ++i)
        from.to_world[8 + i] = 0.0F;
    report r = { 0 };
    camera c;
    assert_false(camera_make(&from, 64, 48, &c, &r));
    assert_non_null(strstr(r.error, "front"));
}

/* Every corner of the bounds is in the picture, and one is near its edge, so that nothing is wasted. */
static void assert_framed(const scene *s, int width, int height)
{
    const scene_camera framed = preview_framed_camera(s, width, height);
    const camera c = make(&framed, width, height);
    double outermost = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p = v3((double)(corner & 1 ? s->bounds_max[0] : s->bounds_min[0]),
                          (double)(corner & 2 ? s->bounds_max[1] : s->bounds_min[1]),
                          (double)(corner & 4 ? s->bounds_max[2] : s->bounds_min[2]));
        const vec3 d = v3_sub(p, c.origin);
        const double depth = v3_dot(d, c.forward);
        assert_true(depth > 0.0);
        outermost = fmax(outermost, fabs(v3_dot(d, c.right)) / depth / c.half_width);
        outermost = fmax(outermost, fabs(v3_dot(d, c.up)) / depth / c.half_height);
    }
    assert_true(outermost < 1.0);
    assert_true(outermost > 0.9);
}

static void the_framed_camera_just_holds_the_scene(void **state)
{
    (void)state;
    const float low[3][3] = { { -1, -1, -1 }, { 100, 3, -7 }, { -1e-6F, 0, 0 } };
    const float high[3][3] = { { 1, 1, 1 }, { 101, 53, -6 }, { 1e-6F, 0, 3e-6F } };
    for (int i = 0; i < 3; ++i) {
        scene s = scenes_empty();
        memcpy(s.bounds_min, low[i], sizeof s.bounds_min);
        memcpy(s.bounds_max, high[i], sizeof s.bounds_max);
        assert_framed(&s, 160, 90);
        assert_framed(&s, 90, 160);
    }
}

static void a_scene_without_extent_still_gets_a_camera(void **state)
{
    (void)state;
    scene empty = scenes_empty(), point = scenes_empty();
    for (int k = 0; k < 3; ++k)
        point.bounds_min[k] = point.bounds_max[k] = 2.0F;
    const scene *const both[2] = { &empty, &point };
    for (int i = 0; i < 2; ++i) {
        const scene_camera framed = preview_framed_camera(both[i], 16, 9);
        const camera c = make(&framed, 16, 9);
        assert_true(isfinite(v3_length(c.origin)));
    }
}

/* A window says by itself what a symmetric camera says by its angle, and it can be shifted. */
static void a_window_is_the_part_of_the_plane_that_fills_the_picture(void **state)
{
    (void)state;
    const scene_projection kinds[2] = { SCENE_PERSPECTIVE, SCENE_ORTHOGRAPHIC };
    for (int k = 0; k < 2; ++k) {
        scene_camera from = scenes_camera(kinds[k], EYE, TARGET, 0.7F);
        const float window[4] = { -0.25F, 0.75F, -0.125F, 0.5F };
        memcpy(from.window, window, sizeof window);
        const camera c = make(&from, 64, 40);
        const double corners[2][2] = { { 0.0, 0.0 }, { 64.0, 40.0 } };
        const double expected[2][2] = { { -0.25, 0.5 }, { 0.75, -0.125 } };
        for (int i = 0; i < 2; ++i) {
            trace_ray ray;
            differential d;
            camera_ray(&c, corners[i][0], corners[i][1], &ray, &d);
            const double ahead = v3_dot(ray.direction, c.forward);
            const vec3 seen = v3_sub(v3_mad(ray.origin, ray.direction, 1.0 / ahead), v3_add(c.origin, c.forward));
            assert_true(fabs(v3_dot(seen, c.right) - expected[i][0]) < 1e-6);
            assert_true(fabs(v3_dot(seen, c.up) - expected[i][1]) < 1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_window_is_the_part_of_the_plane_that_fills_the_picture),
        cmocka_unit_test(the_middle_of_the_picture_looks_at_the_target),
        cmocka_unit_test(the_edges_of_a_perspective_picture_are_at_half_the_field_of_view),
        cmocka_unit_test(an_orthographic_picture_is_as_large_as_its_magnification_says),
        cmocka_unit_test(a_picture_of_another_shape_still_shows_all_that_the_camera_frames),
        cmocka_unit_test(differentials_are_the_difference_between_neighbouring_rays),
        cmocka_unit_test(clipping_planes_are_measured_along_the_viewing_direction),
        cmocka_unit_test(the_scale_of_the_node_does_not_change_the_picture),
        cmocka_unit_test(a_flat_transform_is_an_error_that_names_the_camera),
        cmocka_unit_test(the_framed_camera_just_holds_the_scene),
        cmocka_unit_test(a_scene_without_extent_still_gets_a_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
