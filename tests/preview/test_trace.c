/* What rays hit: instances, sides, masks, blended surfaces, and geometry that is no geometry. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "preview/hash.h"
#include "scenes.h"
#include "traced_scene.h"

static scene one_square(scene_material material, const float *to_world)
{
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &material), 1.0F), to_world, 0);
    return s;
}

static bool hits_from(const scene *s, vec3 from, vec3 through, hit *h)
{
    traced_scene t;
    traced_open(&t, s, NULL);
    const trace_ray ray = traced_ray(from, through);
    const bool found = traced_hit(&t, &ray, h);
    traced_close(&t);
    return found;
}

static void a_hit_is_where_the_ray_meets_the_transformed_triangle(void **state)
{
    (void)state;
    const float place[16] = { 2.0F, 0, 0, 0, 0, 3.0F, 0, 0, 0.5F, 0, -1.0F, 0, 5.0F, 1.0F, -2.0F, 1.0F };
    scene s = one_square(scenes_matte(1.0F), place);
    hit h;
    const vec3 target = v3(5.0 + 2.0 * 0.3 + 0.5 * 0.6, 1.0, -2.0 - 0.6); /* the square's (0.3, 0, 0.6) */
    assert_true(hits_from(&s, v3(4.0, 7.0, 1.0), target, &h));
    assert_true(v3_length(v3_sub(h.position, target)) < 1e-6);
    assert_true(v3_length(v3_sub(h.position_object, v3(0.3, 0.0, 0.6))) < 1e-6);
    double st[2];
    hit_texcoord(&h, 0, st);
    assert_true(fabs(st[0] - 0.65) < 1e-6 && fabs(st[1] - 0.8) < 1e-6);
    assert_true(v3_length(v3_sub(h.normal, v3(0.0, 1.0, 0.0))) < 1e-12);
    assert_true(v3_length(v3_sub(h.geometric_normal, v3(0.0, 1.0, 0.0))) < 1e-12);
    scene_free(&s);
}

/* glTF: the winding order says which side is the front, and a mirroring node turns it around, so the front stays put.
 */
static void the_back_of_a_single_sided_surface_is_not_there(void **state)
{
    (void)state;
    float mirrored[16];
    scenes_translation(mirrored, 0.0F, 0.0F, 0.0F);
    mirrored[0] = -1.0F;
    const float *const places[2] = { NULL, mirrored };
    for (int k = 0; k < 2; ++k) {
        hit h;
        scene s = one_square(scenes_matte(1.0F), places[k]);
        assert_true(hits_from(&s, v3(0.1, 1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
        assert_true(h.front && h.normal.y > 0.999);
        assert_false(hits_from(&s, v3(0.1, -1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
        s.materials[0].double_sided = true;
        assert_true(hits_from(&s, v3(0.1, -1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
        assert_true(!h.front && h.normal.y < -0.999 && h.geometric_normal.y < -0.999);
        scene_free(&s);
    }
}

/* The bitangent is cross(normal, tangent) * w on the mesh, and goes with the mesh: a mirroring node mirrors it too. */
static void the_bitangent_follows_the_handedness_of_the_tangent(void **state)
{
    (void)state;
    float mirrored[16];
    scenes_translation(mirrored, 0.0F, 0.0F, 0.0F);
    mirrored[0] = -1.0F;
    hit h;
    scene s = one_square(scenes_matte(1.0F), NULL);
    assert_true(hits_from(&s, v3(0.1, 1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
    assert_true(h.tangent.x > 0.999 && h.bitangent.z < -0.999);
    for (int v = 0; v < 4; ++v)
        s.meshes[0].tangent[4 * v + 3] = -1.0F;
    assert_true(hits_from(&s, v3(0.1, 1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
    assert_true(h.tangent.x > 0.999 && h.bitangent.z > 0.999);
    scene_free(&s);

    s = one_square(scenes_matte(1.0F), mirrored);
    assert_true(hits_from(&s, v3(0.1, 1.0, 0.2), v3(0.1, 0.0, 0.2), &h));
    assert_true(h.tangent.x < -0.999 && h.bitangent.z < -0.999);
    scene_free(&s);
}

/* ---- masks and blending ---- */

static float opaque_on_the_right(const void *user, const trace_hit *at)
{
    (void)user;
    /* The square's triangles: 0, 2, 1 and 1, 2, 3; corners 1 and 3 are those on the right. */
    const double right = at->triangle == 0 ? at->weights[1] : 1.0 - at->weights[0];
    return right > 0.5 ? 1.0F : 0.0F;
}

static float thirty_percent(const void *user, const trace_hit *at)
{
    (void)user;
    (void)at;
    return 0.3F;
}

static void a_mask_cuts_holes_for_camera_and_shadow_rays(void **state)
{
    (void)state;
    scene_material m = scenes_matte(1.0F);
    m.alpha_mode = SCENE_ALPHA_MASK;
    scene s = one_square(m, NULL);
    traced_scene t;
    traced_open(&t, &s, opaque_on_the_right);
    for (int k = -9; k <= 9; k += 2) {
        hit h;
        const vec3 at = v3(0.1 * k, 0.0, 0.33);
        const trace_ray ray = traced_ray(v3(0.0, 2.0, 0.0), at);
        assert_int_equal(traced_hit(&t, &ray, &h), k > 0);
        assert_int_equal(trace_occluded(t.trace, &ray), k > 0);
    }
    traced_close(&t);
    scene_free(&s);
}

/* Of n rays, n * 0.3 stop, with a standard deviation of sqrt(n * 0.3 * 0.7); five of these. */
static void a_blended_surface_stops_its_share_of_random_rays(void **state)
{
    (void)state;
    enum { RAYS = 20000 };
    scene_material m = scenes_matte(1.0F);
    m.alpha_mode = SCENE_ALPHA_BLEND;
    scene s = one_square(m, NULL);
    traced_scene t;
    traced_open(&t, &s, thirty_percent);
    trace_ray ray = traced_ray(v3(0.0, 2.0, 0.0), v3(0.2, 0.0, 0.3));
    int shadowed = 0, stopped = 0;
    trace_hit found;
    for (uint32_t i = 0; i < RAYS; ++i) {
        ray.random = hash_mix(i);
        shadowed += trace_occluded(t.trace, &ray);
        stopped += trace_closest(t.trace, &ray, TRACE_BLEND_RANDOM, &found);
    }
    const double bound = 5.0 * sqrt(RAYS * 0.3 * 0.7);
    assert_true(fabs(shadowed - 0.3 * RAYS) < bound);
    assert_int_equal(stopped, shadowed); /* the same draw */
    assert_true(trace_closest(t.trace, &ray, TRACE_BLEND_SOLID, &found));
    traced_close(&t);
    scene_free(&s);
}

/* ---- packets ---- */

/* Of the same triangle; Embree says where in single precision, and in a packet by other operations. */
static void assert_same_place(const traced_scene *t, const trace_ray *ray, trace_hit *a, trace_hit *b)
{
    const differential still = { { 0.0, 0.0, 0.0 } };
    hit_step steps[2];
    hit hits[2];
    const hit_task tasks[2] = { { ray, &still, a, &hits[0], &steps[0] }, { ray, &still, b, &hits[1], &steps[1] } };
    for (int i = 0; i < 2; ++i)
        hit_resolve(&t->geometry, &tasks[i]);
    assert_memory_equal(a->weights, b->weights, sizeof a->weights);
}

/* Opaque, masked and blended, all in the way of each other; rays from everywhere, of which every fifth is missing. */
static void a_packet_says_of_every_ray_what_it_says_alone(void **state)
{
    (void)state;
    scene_material pane = scenes_matte(1.0F), ball = scenes_matte(1.0F);
    pane.alpha_mode = SCENE_ALPHA_BLEND;
    pane.double_sided = true;
    scene s = one_square(pane, NULL);
    float place[16];
    scenes_translation(place, 0.0F, -0.8F, 0.0F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &ball), 0.7F, 20, 10), place, 1);
    traced_scene t;
    traced_open(&t, &s, thirty_percent);
    int hits = 0, shadows = 0;
    for (uint32_t k = 0; k < 500; ++k) {
        trace_ray rays[TRACE_PACKET];
        const trace_ray *packet[TRACE_PACKET];
        trace_hit found[TRACE_PACKET];
        for (uint32_t i = 0; i < TRACE_PACKET; ++i) {
            const uint32_t bits = hash_mix(k * TRACE_PACKET + i);
            const double x = (double)hash_uniform(hash_mix(bits + 1)), y = (double)hash_uniform(hash_mix(bits + 2));
            rays[i] = traced_ray(v3(0.3, k % 2 == 0 ? 2.0 : -2.0, 0.1), v3(2.0 * x - 1.0, -0.1, 2.0 * y - 1.0));
            rays[i].random = bits;
            packet[i] = k % 5 != 0 && i % 5 == k % 5 ? NULL : &rays[i];
        }
        const uint32_t met = trace_closest_packet(t.trace, packet, TRACE_BLEND_RANDOM, found);
        const uint32_t dark = trace_occluded_packet(t.trace, packet);
        for (uint32_t i = 0; i < TRACE_PACKET; ++i) {
            trace_hit alone;
            const bool is_there = packet[i] != NULL;
            assert_int_equal(met >> i & 1U, is_there && trace_closest(t.trace, &rays[i], TRACE_BLEND_RANDOM, &alone));
            assert_int_equal(dark >> i & 1U, is_there && trace_occluded(t.trace, &rays[i]));
            if (met >> i & 1U)
                assert_same_place(&t, &rays[i], &alone, &found[i]);
            hits += (int)(met >> i & 1U);
            shadows += (int)(dark >> i & 1U);
        }
    }
    assert_true(hits > 1000 && shadows > 1000 && hits < 7500);
    const trace_ray *nothing[TRACE_PACKET] = { NULL };
    trace_hit none[TRACE_PACKET];
    assert_int_equal(trace_closest_packet(t.trace, nothing, TRACE_BLEND_SOLID, none), 0);
    assert_int_equal(trace_occluded_packet(t.trace, nothing), 0);
    traced_close(&t);
    scene_free(&s);
}

/* ---- what is hardly geometry ---- */

static void an_empty_scene_is_hit_nowhere(void **state)
{
    (void)state;
    hit h;
    scene s = scenes_empty();
    assert_false(hits_from(&s, v3(0.0, 1.0, 0.0), v3(0.0, 0.0, 0.0), &h));
    scene_free(&s);
}

static void triangles_without_area_are_hit_nowhere(void **state)
{
    (void)state;
    const float flat[18] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0 }; /* a point and a line */
    const scene_material matte = scenes_matte(1.0F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_triangles(&s, scenes_add_material(&s, &matte), flat, 2), NULL, 0);
    hit h;
    assert_false(hits_from(&s, v3(0.0, 1.0, 0.0), v3(0.0, 0.0, 0.0), &h));
    assert_false(hits_from(&s, v3(0.0, 0.0, 5.0), v3(0.5, 0.0, 0.0), &h));
    scene_free(&s);
}

static void a_flattened_instance_is_left_out_with_a_warning(void **state)
{
    (void)state;
    float flat[16];
    scenes_translation(flat, 0.0F, 0.0F, 0.0F);
    flat[0] = 0.0F;
    scene s = one_square(scenes_matte(1.0F), flat);
    traced_scene t;
    traced_open(&t, &s, NULL);
    assert_int_equal(t.warnings, 1);
    hit h;
    const trace_ray ray = traced_ray(v3(0.0, 1.0, 0.0), v3(0.0, 0.0, 0.0));
    assert_false(traced_hit(&t, &ray, &h));
    traced_close(&t);
    scene_free(&s);
}

/* A small object is no flat one: the same square in micrometres and in kilometres, far from the origin. */
static void size_and_place_do_not_matter(void **state)
{
    (void)state;
    const float sizes[3] = { 1e-6F, 1.0F, 1e3F };
    for (int k = 0; k < 3; ++k) {
        float place[16];
        scenes_translation(place, 0.0F, 0.0F, 0.0F);
        place[0] = place[5] = place[10] = sizes[k];
        scene s = one_square(scenes_matte(1.0F), place);
        const double size = (double)sizes[k];
        hit h;
        assert_true(hits_from(&s, v3(0.0, 2.0 * size, 0.0), v3(0.3 * size, 0.0, 0.4 * size), &h));
        assert_true(v3_length(v3_sub(h.position, v3(0.3 * size, 0.0, 0.4 * size))) < 1e-6 * size);
        scene_free(&s);
    }
}

/* A ray that starts on a surface meets it no more, wherever the surface is; 1000 starts on a sphere far from the
 * origin. */
static void a_ray_that_leaves_a_surface_does_not_meet_it_again(void **state)
{
    (void)state;
    const scene_material matte = scenes_matte(1.0F);
    const float far_away[3] = { 0.0F, 30.0F, 3000.0F };
    for (int k = 0; k < 3; ++k) {
        scene s = scenes_empty();
        float place[16];
        scenes_translation(place, far_away[k], -far_away[k], far_away[k]);
        scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 1.0F, 32, 16), place, 0);
        s.materials[0].double_sided = true;
        const vec3 centre = v3((double)place[12], (double)place[13], (double)place[14]);
        traced_scene t;
        traced_open(&t, &s, NULL);
        for (uint32_t i = 0; i < 1000; ++i) {
            const vec3 d = v3_normalize(v3((double)hash_uniform(hash_mix(3 * i)) - 0.5,
                                           (double)hash_uniform(hash_mix(3 * i + 1)) - 0.5,
                                           (double)hash_uniform(hash_mix(3 * i + 2)) - 0.5));
            const trace_ray in = traced_ray(v3_mad(centre, d, 3.0), centre);
            hit h;
            assert_true(traced_hit(&t, &in, &h));
            trace_ray out = { .origin = hit_leave(&h, h.position),
                              .direction =
                                  v3_normalize(v3_mad(v3_any_tangent(h.geometric_normal), h.geometric_normal, 0.02)),
                              .far = (double)INFINITY };
            assert_false(trace_occluded(t.trace, &out));
        }
        traced_close(&t);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hit_is_where_the_ray_meets_the_transformed_triangle),
        cmocka_unit_test(the_back_of_a_single_sided_surface_is_not_there),
        cmocka_unit_test(the_bitangent_follows_the_handedness_of_the_tangent),
        cmocka_unit_test(a_mask_cuts_holes_for_camera_and_shadow_rays),
        cmocka_unit_test(a_blended_surface_stops_its_share_of_random_rays),
        cmocka_unit_test(a_packet_says_of_every_ray_what_it_says_alone),
        cmocka_unit_test(an_empty_scene_is_hit_nowhere),
        cmocka_unit_test(triangles_without_area_are_hit_nowhere),
        cmocka_unit_test(a_flattened_instance_is_left_out_with_a_warning),
        cmocka_unit_test(size_and_place_do_not_matter),
        cmocka_unit_test(a_ray_that_leaves_a_surface_does_not_meet_it_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
