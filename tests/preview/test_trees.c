/* Fine trees and quick ones: both know what a ray meets first, and few samples of many triangles take the quick ones.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "preview/hash.h"
#include "scenes.h"
#include "traced_scene.h"

static double uniform(uint32_t bits)
{
    return (double)hash_uniform(bits);
}

enum { SHARDS = 3000, MANY_SHARDS = 40000 };

/* Triangles of very different sizes in a cube, in no order, one through the other; then the same again. */
static scene shattered(uint32_t count, uint32_t copies)
{
    static float positions[9 * MANY_SHARDS];
    for (uint32_t i = 0; i < count * copies; ++i) {
        const uint32_t own = i % count;
        const double size = exp2(-6.0 * uniform(hash_combine(own, 99U)));
        for (uint32_t k = 0; k < 9; ++k)
            positions[9 * i + k] = (float)(2.0 * uniform(hash_combine(own, k % 3U)) - 1.0 +
                                           size * (uniform(hash_combine(own, 3U + k)) - 0.5));
    }
    scene s = scenes_empty();
    scene_material m = scenes_matte(1.0F);
    m.double_sided = true;
    scenes_add_instance(&s, scenes_add_triangles(&s, scenes_add_material(&s, &m), positions, count * copies), NULL, 0);
    return s;
}

/* By all triangles in turn, in double precision (Moeller and Trumbore 1997). False: the ray passes an edge so closely
 * that single precision may see it on the other side. */
static bool meet_all(const traced_scene *t, const trace_ray *ray, int *nearest)
{
    double least = (double)INFINITY;
    *nearest = -1;
    for (uint32_t i = 0; i < SHARDS; ++i) {
        const triangle_corners c = geometry_triangle(&t->geometry, 0, i);
        const vec3 a = v3_sub(c.position[1], c.position[0]), b = v3_sub(c.position[2], c.position[0]);
        const vec3 across = v3_cross(ray->direction, b), from = v3_sub(ray->origin, c.position[0]);
        const double scale = 1.0 / v3_dot(a, across), u = scale * v3_dot(from, across);
        const double v = scale * v3_dot(ray->direction, v3_cross(from, a)),
                     distance = scale * v3_dot(b, v3_cross(from, a));
        const double margin = fmin(fmin(u, v), 1.0 - u - v);
        if (!(fabs(margin) > 1e-3))
            return false;
        if (margin > 0.0 && distance > 0.0 && distance < least) {
            least = distance;
            *nearest = (int)i;
        }
    }
    return true;
}

static vec3 anywhere(uint32_t i, uint32_t which, double reach)
{
    const uint32_t own = hash_combine(hash_mix(which), i);
    return v3(reach * (2.0 * uniform(hash_combine(own, 0U)) - 1.0),
              reach * (2.0 * uniform(hash_combine(own, 1U)) - 1.0),
              reach * (2.0 * uniform(hash_combine(own, 2U)) - 1.0));
}

static void trees_of_either_kind_know_the_nearest_triangle(void **state)
{
    (void)state;
    enum { RAYS = 2000 };
    scene s = shattered(SHARDS, 1);
    for (int trees = TRACE_TREES_FINE; trees <= TRACE_TREES_QUICK; ++trees) {
        traced_scene t;
        int sure = 0, met = 0;
        traced_open_in(&t, &s, (trace_trees)trees, NULL);
        for (uint32_t i = 0; i < RAYS; ++i) {
            const trace_ray ray = traced_ray(anywhere(i, 1U, 2.0), anywhere(i, 2U, 1.0));
            trace_hit found = { .triangle = UINT32_MAX };
            int nearest;
            if (!meet_all(&t, &ray, &nearest))
                continue;
            ++sure;
            met += nearest >= 0;
            assert_int_equal(trace_closest(t.trace, &ray, TRACE_BLEND_SOLID, &found), nearest >= 0);
            assert_int_equal((int)found.triangle, nearest);
            assert_int_equal(trace_occluded(t.trace, &ray), nearest >= 0);
        }
        assert_true(sure > RAYS / 4 && met > sure / 4 && met < sure);
        traced_close(&t);
    }
    scene_free(&s);
}

/* However the builder's threads share the work. */
static void every_build_takes_the_same_of_triangles_that_coincide(void **state)
{
    (void)state;
    enum { RAYS = 1000, BUILDS = 4 };
    static uint32_t first[RAYS];
    scene s = shattered(MANY_SHARDS / 2, 2);
    for (int trees = TRACE_TREES_FINE; trees <= TRACE_TREES_QUICK; ++trees) {
        for (int build = 0; build < BUILDS; ++build) {
            traced_scene t;
            int met = 0;
            traced_open_in(&t, &s, (trace_trees)trees, NULL);
            for (uint32_t i = 0; i < RAYS; ++i) {
                const trace_ray ray = traced_ray(anywhere(i, 1U, 2.0), anywhere(i, 2U, 1.0));
                trace_hit found = { .triangle = UINT32_MAX };
                met += trace_closest(t.trace, &ray, TRACE_BLEND_SOLID, &found);
                if (build == 0)
                    first[i] = found.triangle;
                assert_int_equal(found.triangle, first[i]);
            }
            assert_true(met > RAYS / 4);
            traced_close(&t);
        }
    }
    scene_free(&s);
}

static void few_samples_of_many_triangles_take_quick_trees(void **state)
{
    (void)state;
    enum { ENOUGH = SHARDS / 3 };
    scene s = shattered(SHARDS, 1);
    traced_scene t;
    traced_open(&t, &s, NULL);
    assert_int_equal(trace_trees_for(&t.geometry, ENOUGH - 1), TRACE_TREES_QUICK);
    assert_int_equal(trace_trees_for(&t.geometry, ENOUGH), TRACE_TREES_FINE);
    assert_int_equal(trace_trees_for(&t.geometry, (double)INFINITY), TRACE_TREES_FINE);
    traced_close(&t);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_of_either_kind_know_the_nearest_triangle),
        cmocka_unit_test(every_build_takes_the_same_of_triangles_that_coincide),
        cmocka_unit_test(few_samples_of_many_triangles_take_quick_trees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
