/* Footprints in metres: whatever the mesh and its transform, density counts facets per square metre of true surface. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "preview/camera.h"
#include "preview/place.h"
#include "scenes.h"
#include "traced_scene.h"

static const float EYE[3] = { 1.0F, 3.0F, 5.0F };
static const float TARGET[3] = { 0.0F, 0.0F, 0.0F };

static double footprint_area(const glint_footprint *f)
{
    return fabs((double)f->dudx * (double)f->dvdy - (double)f->dudy * (double)f->dvdx);
}

static double true_area(const hit_step *s)
{
    return v3_length(v3_cross(s->position.dx, s->position.dy));
}

/* Calls check for hits all over the picture; fails when there are fewer than 100. */
static void each_hit(const scene *s, void (*check)(const hit *h, const hit_step *step))
{
    traced_scene t;
    report r = { 0 };
    camera c;
    const scene_camera from = scenes_camera(SCENE_PERSPECTIVE, EYE, TARGET, 0.5F);
    assert_true(camera_make(&from, 32, 32, &c, &r));
    traced_open(&t, s, NULL);
    int hits = 0;
    for (int i = 0; i < 32 * 32; ++i) {
        trace_ray ray;
        differential d;
        hit h;
        const int column = i % 32, row = i / 32;
        camera_ray(&c, column + 0.4, row + 0.6, &ray, &d);
        hit_step step;
        if (!traced_hit_step(&t, &ray, &d, &h, &step))
            continue;
        check(&h, &step);
        ++hits;
    }
    assert_true(hits > 100);
    traced_close(&t);
}

static void assert_counts_the_true_area(const scene_glint *g, const hit *h, const hit_step *step)
{
    for (int k = 0; k < 16; ++k) {
        float scale;
        const glint_footprint f = place_footprint(g, h, step, (float)k / 16.0F, &scale);
        const double counted = footprint_area(&f) * (double)scale, expected = true_area(step);
        if (!(fabs(counted - expected) <= 1e-5 * expected)) /* four float derivatives whose products cancel */
            fail_msg("%g m^2 are counted as %g", expected, counted);
    }
}

static void check_object_space(const hit *h, const hit_step *step)
{
    scene_glint g = scene_material_default().glint;
    g.space = SCENE_SPACE_OBJECT;
    assert_counts_the_true_area(&g, h, step);
}

/* A node with a rotation and three scales: the object's axes are metres of the world all the same. */
static void object_space_counts_the_true_area_on_any_slope_and_scale(void **state)
{
    (void)state;
    const float scaled[16] = { 0.6F * 0.8F, 0.8F * 0.8F, 0, 0, -0.8F * 1.5F, 0.6F * 1.5F, 0, 0, 0, 0, 1.1F, 0,
                               0,           0,           0, 1 };
    const float *const places[2] = { NULL, scaled };
    for (int k = 0; k < 2; ++k) {
        const scene_material m = scenes_flakes(0.5F, 1e6F);
        scene s = scenes_empty();
        scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &m), 1.0F, 48, 24), places[k], 0);
        each_hit(&s, check_object_space);
        scene_free(&s);
    }
}

/* The square has 2 m and one unit of texture a side: with 2 m per unit, u and v are metres. */
static void check_texture_space(const hit *h, const hit_step *step)
{
    scene_glint g = scene_material_default().glint;
    g.space = SCENE_SPACE_UV;
    g.uv_scale = 2.0F;
    assert_counts_the_true_area(&g, h, step);
    float scale;
    const glint_footprint f = place_footprint(&g, h, step, 0.0F, &scale);
    assert_true(fabs(f.u - (h->position.x + 1.0)) < 1e-6 && fabs(f.v - (h->position.z + 1.0)) < 1e-6);
    assert_true(fabs((double)f.dudx - step->position.dx.x) < 1e-8);
    assert_true(fabs((double)f.dvdy - step->position.dy.z) < 1e-8);
    assert_true(scale == 1.0F);
}

static void texture_space_is_metres_by_the_scale_of_the_material(void **state)
{
    (void)state;
    const scene_material m = scenes_flakes(0.5F, 1e6F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 1.0F), NULL, 0);
    each_hit(&s, check_texture_space);
    scene_free(&s);
}

/* A surface that faces an axis lies on that axis' plane, whatever the draw. */
static void check_plane_of_a_level_surface(const hit *h, const hit_step *step)
{
    scene_glint g = scene_material_default().glint;
    g.space = SCENE_SPACE_OBJECT;
    for (int k = 0; k < 16; ++k) {
        float scale;
        const glint_footprint f = place_footprint(&g, h, step, (float)k / 16.0F, &scale);
        assert_true(fabs(f.u - h->position.z) < 1e-6 && fabs(f.v - h->position.x) < 1e-6);
        assert_true(scale == 1.0F);
    }
}

static void a_level_surface_lies_on_one_plane(void **state)
{
    (void)state;
    const scene_material m = scenes_flakes(0.5F, 1e6F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 1.0F), NULL, 0);
    each_hit(&s, check_plane_of_a_level_surface);
    scene_free(&s);
}

static uint32_t seen_seed;

static void keep_seed(const hit *h, const hit_step *step)
{
    const scene_glint g = scene_material_default().glint;
    float scale;
    seen_seed = place_footprint(&g, h, step, 0.0F, &scale).seed;
}

static void every_node_has_facets_of_its_own(void **state)
{
    (void)state;
    uint32_t seeds[3];
    for (int node = 0; node < 3; ++node) {
        const scene_material m = scenes_flakes(0.5F, 1e6F);
        scene s = scenes_empty();
        scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 1.0F), NULL, node % 2);
        each_hit(&s, keep_seed);
        seeds[node] = seen_seed;
        scene_free(&s);
    }
    assert_int_not_equal(seeds[0], seeds[1]);
    assert_int_equal(seeds[0], seeds[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(object_space_counts_the_true_area_on_any_slope_and_scale),
        cmocka_unit_test(texture_space_is_metres_by_the_scale_of_the_material),
        cmocka_unit_test(a_level_surface_lies_on_one_plane),
        cmocka_unit_test(every_node_has_facets_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
