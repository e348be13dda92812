/* Ray differentials against finite differences of rays that are really traced. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "preview/camera.h"
#include "scenes.h"
#include "traced_scene.h"

#define STEP 1e-3 /* pixels */

static const float EYE[3] = { 1.5F, 2.0F, 4.0F };
static const float TARGET[3] = { 0.1F, 0.05F, 0.2F };

/* Everything below is smooth within a triangle; a central difference over 2e is right to (e^2)/6 of the third
 * derivative, which for pixels of 1/50 of the scene is 1e-6 * (1/50)^2 of the first one, and to rounding, 1e-16/e. */
static void assert_derivative(vec3 derivative, vec3 before, vec3 after)
{
    const vec3 difference = v3_scale(v3_sub(after, before), 0.5 / STEP);
    const double bound = 1e-6 * v3_length(difference) + 1e-10;
    if (!(v3_length(v3_sub(derivative, difference)) <= bound))
        fail_msg("(%.9g, %.9g, %.9g) is not (%.9g, %.9g, %.9g)", derivative.x, derivative.y, derivative.z, difference.x,
                 difference.y, difference.z);
}

static hit hit_at(const traced_scene *t, const camera *c, double x, double y, trace_ray *ray, differential *d,
                  hit_step *step)
{
    hit h;
    camera_ray(c, x, y, ray, d);
    assert_true(traced_hit_step(t, ray, d, &h, step));
    return h;
}

static vec3 mirrored(vec3 direction, vec3 normal)
{
    return v3_mad(direction, normal, -2.0 * v3_dot(direction, normal));
}

/* A ray, what it hits, its neighbours at both sides, and the reflections of all of them. */
static void compare_with_neighbours(const traced_scene *t, const camera *c, double x, double y)
{
    trace_ray ray, ray_a, ray_b;
    differential d, unused;
    hit_step s, unused_step;
    const hit h = hit_at(t, c, x, y, &ray, &d, &s);
    const surface_step normal = hit_turn(&h, &s);
    const differential reflected = differential_reflect(&d, ray.direction, h.normal, &s.position, &normal);
    double dx[2], dy[2];
    hit_texcoord_step(&h, &s, 0, dx, dy);

    for (int axis = 0; axis < 2; ++axis) {
        const double ex = axis == 0 ? STEP : 0.0, ey = axis == 1 ? STEP : 0.0;
        const hit a = hit_at(t, c, x - ex, y - ey, &ray_a, &unused, &unused_step);
        const hit b = hit_at(t, c, x + ex, y + ey, &ray_b, &unused, &unused_step);
        assert_int_equal(a.corner[0], b.corner[0]); /* the same triangle */
        assert_int_equal(a.corner[1], b.corner[1]);
        assert_derivative(axis == 0 ? s.position.dx : s.position.dy, a.position, b.position);
        assert_derivative(axis == 0 ? normal.dx : normal.dy, a.normal, b.normal);
        assert_derivative(axis == 0 ? reflected.direction_dx : reflected.direction_dy,
                          mirrored(ray_a.direction, a.normal), mirrored(ray_b.direction, b.normal));
        const double *const st = axis == 0 ? dx : dy;
        double st_a[2], st_b[2];
        hit_texcoord(&a, 0, st_a);
        hit_texcoord(&b, 0, st_b);
        assert_derivative(v3(st[0], st[1], 0.0), v3(st_a[0], st_a[1], 0.0), v3(st_b[0], st_b[1], 0.0));
    }
}

static void compare_over_the_picture(const scene *s, scene_projection projection, float size)
{
    traced_scene t;
    report r = { 0 };
    camera c;
    const scene_camera from = scenes_camera(projection, EYE, TARGET, size);
    assert_true(camera_make(&from, 64, 64, &c, &r));
    traced_open(&t, s, NULL);
    int compared = 0;
    for (double y = 24.37; y < 42.0; y += 5.0) {
        for (double x = 24.61; x < 42.0; x += 5.0) {
            compare_with_neighbours(&t, &c, x, y);
            ++compared;
        }
    }
    assert_int_equal(compared, 16);
    traced_close(&t);
}

static void a_tilted_square_matches_finite_differences(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(1.0F);
    scene s = scenes_empty();
    const float tilted[16] = { 0.8F, 0.6F, 0.0F, 0.0F, -1.2F, 1.6F, 0.0F, 0.0F,
                               0.3F, 0.0F, 1.1F, 0.0F, 0.1F,  0.0F, 0.2F, 1.0F };
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 2.0F), tilted, 0);
    compare_over_the_picture(&s, SCENE_PERSPECTIVE, 0.5F);
    compare_over_the_picture(&s, SCENE_ORTHOGRAPHIC, 1.0F);
    scene_free(&s);
}

static void a_curved_mirror_matches_finite_differences(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(1.0F);
    scene s = scenes_empty();
    const float stretched[16] = { 1.3F, 0, 0, 0, 0, 0.9F, 0, 0, 0.2F, 0, 1, 0, 0, 0, 0, 1 };
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 1.0F, 24, 12), stretched, 0);
    compare_over_the_picture(&s, SCENE_PERSPECTIVE, 0.5F);
    compare_over_the_picture(&s, SCENE_ORTHOGRAPHIC, 1.0F);
    scene_free(&s);
}

/* What a step of the ray does on a square on the ground, in the triangle that Embree would have found. */
static surface_step step_on_square(vec3 origin, vec3 direction, const differential *d, trace_hit found)
{
    const scene_material matte = scenes_matte(1.0F);
    const trace_ray ray = { .origin = origin, .direction = direction };
    scene s = scenes_empty();
    traced_scene t;
    hit h;
    hit_step step;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 1.0F), NULL, 0);
    traced_open(&t, &s, NULL);
    hit_resolve(&t.geometry, &(hit_task){ &ray, d, &found, &h, &step });
    traced_close(&t);
    scene_free(&s);
    return step.position;
}

/* Igehy's first example: a flat mirror leaves the spread of a ray as it is. */
static void a_flat_mirror_keeps_the_spread(void **state)
{
    (void)state;
    const vec3 direction = v3_normalize(v3(1.0, -2.0, 0.5)), up = v3(0.0, 1.0, 0.0), zero = v3(0.0, 0.0, 0.0);
    const vec3 across = v3_any_tangent(direction);
    const differential d = { zero, zero, v3_scale(across, 0.01), v3_scale(v3_cross(direction, across), 0.02) };
    const trace_hit middle = { .triangle = 0, .weights = { 0.3, 0.3 } };
    const surface_step point = step_on_square(v3_scale(direction, -3.0), direction, &d, middle);
    const surface_step still = { zero, zero };
    const differential r = differential_reflect(&d, direction, up, &point, &still);
    assert_true(fabs(v3_length(r.direction_dx) - 0.01) < 1e-15);
    assert_true(fabs(v3_length(r.direction_dy) - 0.02) < 1e-15);
    assert_true(fabs(v3_dot(point.dx, up)) < 1e-15 && fabs(v3_dot(point.dy, up)) < 1e-15);
    /* Three metres of spread, along the ground. */
    assert_true(fabs(v3_length(v3_reject(point.dx, direction)) - 0.03) < 1e-15);
}

static void a_plane_seen_edge_on_gives_finite_steps(void **state)
{
    (void)state;
    const vec3 direction = v3(1.0, 0.0, 0.0), zero = v3(0.0, 0.0, 0.0);
    const differential d = { zero, zero, v3(0.0, 0.01, 0.0), v3(0.0, 0.0, 0.01) };
    const trace_hit grazed = { .triangle = 0, .weights = { 0.3, 0.3 }, .distance = 3.0 };
    const surface_step s = step_on_square(v3(-3.0, 0.0, 0.0), direction, &d, grazed);
    assert_true(isfinite(v3_length(s.dx)) && isfinite(v3_length(s.dy)));
}

static void a_drawn_direction_takes_the_spread_that_it_stands_for(void **state)
{
    (void)state;
    const vec3 direction = v3_normalize(v3(1.0, -2.0, 0.5)), zero = v3(0.0, 0.0, 0.0);
    differential d = { zero, zero, v3_scale(v3_any_tangent(direction), 1e-3),
                       v3_scale(v3_cross(direction, v3_any_tangent(direction)), 1e-3) };
    const differential before = d;
    differential_widen(&d, direction, 0.5e-6); /* narrower than what is there, 1e-6 sr */
    assert_memory_equal(&d, &before, sizeof d);
    differential_widen(&d, direction, 0.04);
    assert_true(fabs(v3_length(v3_cross(d.direction_dx, d.direction_dy)) - 0.04) < 1e-12);
    assert_true(fabs(v3_dot(d.direction_dx, direction)) < 1e-12 && fabs(v3_dot(d.direction_dy, direction)) < 1e-12);
}

/* The half vector between a light straight above and viewers spread evenly over a parallelogram, on a surface that
 * turns under them: the variance of its slope against the surface's normal by adding up a grid. Steps of 0.02 make the
 * half vector a linear function of them to 1e-4. */
static void the_half_vector_varies_as_a_grid_of_viewers_says(void **state)
{
    (void)state;
    enum { GRID = 50 };
    const vec3 zero = v3(0.0, 0.0, 0.0), light = v3(0.0, 0.0, 1.0);
    const vec3 view_dx = v3(0.02, 0.005, 0.0), view_dy = v3(-0.004, 0.01, 0.0);
    const differential d = { zero, zero, v3_scale(view_dx, -1.0), v3_scale(view_dy, -1.0) }; /* of the ray towards us */
    const surface_step turn = { v3(0.003, 0.0, 0.0), v3(0.0, -0.008, 0.0) };
    double squares = 0.0;
    for (int i = 0; i < GRID * GRID; ++i) {
        const int column = i % GRID, row = i / GRID;
        const double a = (column + 0.5) / GRID - 0.5, b = (row + 0.5) / GRID - 0.5;
        const vec3 wo = v3_normalize(v3_mad(v3_mad(light, view_dx, a), view_dy, b));
        const vec3 n = v3_normalize(v3_mad(v3_mad(light, turn.dx, a), turn.dy, b));
        const vec3 h = v3_normalize(v3_add(wo, light));
        const double x = h.x / h.z - n.x / n.z, y = h.y / h.z - n.y / n.z;
        squares += (x * x + y * y) / (2.0 * GRID * GRID);
    }
    const double variance = differential_half_vector_variance(&d, &turn);
    assert_true(fabs(variance - squares) < 1e-3 * squares);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tilted_square_matches_finite_differences),
        cmocka_unit_test(a_curved_mirror_matches_finite_differences),
        cmocka_unit_test(a_flat_mirror_keeps_the_spread),
        cmocka_unit_test(a_plane_seen_edge_on_gives_finite_steps),
        cmocka_unit_test(a_drawn_direction_takes_the_spread_that_it_stands_for),
        cmocka_unit_test(the_half_vector_varies_as_a_grid_of_viewers_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
