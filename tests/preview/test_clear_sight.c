/* What is proven to see a light, sees it: against rays by the hundred thousand; and what should be proven is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "pictures.h"
#include "preview/clear_sight.h"
#include "scenes.h"
#include "statistics.h"
#include "traced_scene.h"

enum { MOST_PARTS = 5, LIGHTS = 3 };

/* ---- scenes ---- */

/* A box of half a metre, or, with a corner pushed in, one that is not convex. */
static int add_box(scene *s, int material, float corner)
{
    static const int quads[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                     { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    float at[8][3], positions[12 * 9];
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k)
            at[i][k] = (i >> k & 1) != 0 ? (i == 7 ? corner : 0.25F) : -0.25F;
    for (int t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k) {
            const int *const q = quads[t / 2];
            const int vertex = q[k == 0 ? 0 : k + t % 2];
            for (int c = 0; c < 3; ++c)
                positions[(t * 3 + k) * 3 + c] = at[vertex][c];
        }
    return scenes_add_triangles(s, material, positions, 12);
}

static int add_mesh(scene *s, int kind)
{
    const scene_material matte = scenes_matte(0.5F);
    const int material = scenes_add_material(s, &matte);
    switch (kind) {
    case 0:
        return scenes_add_square(s, material, 0.4F);
    case 1:
        return scenes_add_sphere(s, material, 0.3F, 12, 8);
    case 2:
        return add_box(s, material, 0.25F);
    case 3:
        return add_box(s, material, -0.1F);
    default:
        return scenes_add_square(s, material, 3.0F);
    }
}

/* Turned about a random axis, scaled along each of its own, sometimes mirrored. */
static void random_place(float m[16], uint64_t *random)
{
    vec3 x =
        v3(random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0));
    x = v3_normalize(x);
    const vec3 y = v3_any_tangent(x), z = v3_cross(x, y), axes[3] = { x, y, z };
    scenes_translation(m, (float)random_between(random, -1.5, 1.5), (float)random_between(random, 0.0, 1.5),
                       (float)random_between(random, -1.5, 1.5));
    for (int k = 0; k < 3; ++k) {
        const double scale = random_between(random, 0.3, 1.5) * (k == 0 && random_uniform(random) < 0.3 ? -1.0 : 1.0);
        m[4 * k] = (float)(axes[k].x * scale);
        m[4 * k + 1] = (float)(axes[k].y * scale);
        m[4 * k + 2] = (float)(axes[k].z * scale);
    }
}

static scene random_scene(uint64_t *random)
{
    scene s = scenes_empty();
    const int parts = 1 + (int)random_between(random, 0.0, MOST_PARTS);
    for (int i = 0; i < parts; ++i) {
        float place[16];
        const int kind = (int)random_between(random, 0.0, 5.0);
        random_place(place, random);
        /* A floor lies. */
        scenes_add_instance(&s, add_mesh(&s, kind), kind == 4 ? NULL : place, i);
    }
    for (int i = 0; i < LIGHTS; ++i) {
        static const scene_light_kind kinds[] = { SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT,
                                                  SCENE_LIGHT_RECT, SCENE_LIGHT_DISK };
        const float from[3] = { (float)random_between(random, -2.0, 2.0), (float)random_between(random, -1.0, 3.0),
                                (float)random_between(random, -2.0, 2.0) };
        scene_light *const l = scenes_add_light(&s, kinds[random_bits(random) % 5], from, 1.0F);
        l->angular_diameter_rad = (float)random_between(random, 0.0, 1.0);
        l->radius_m = (float)random_between(random, 0.0, 0.2);
        l->width_m = l->height_m = (float)random_between(random, 0.05, 0.6);
    }
    return s;
}

/* ---- rays ---- */

/* Not one of those at the poles of a ball that are no wider than a rounding, and that no ray finds. */
static triangle_corners random_triangle(const geometry *g, int instance, uint64_t *random)
{
    const scene_mesh *const mesh = &g->scene->meshes[g->scene->instances[instance].mesh];
    for (;;) {
        const triangle_corners c =
            geometry_triangle(g, instance, (uint32_t)(random_bits(random) % mesh->triangle_count));
        const vec3 across = v3_cross(v3_sub(c.position[1], c.position[0]), v3_sub(c.position[2], c.position[0]));
        if (v3_length(across) > 1e-6)
            return c;
    }
}

/* A point of an instance, as if the side that its normal points to, or the other, were seen. */
static hit random_point(const geometry *g, int instance, bool front, uint64_t *random)
{
    const double *const to_world = g->instances[instance].to_world;
    const triangle_corners c = random_triangle(g, instance, random);
    const double r = sqrt(random_uniform(random)), u = r * random_uniform(random);
    vec3 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = m4_point(to_world, c.position[k]);
    const vec3 flat = v3_cross(v3_sub(c.position[1], c.position[0]), v3_sub(c.position[2], c.position[0]));
    const vec3 n = v3_normalize(m4_transposed_vector(g->instances[instance].to_object, flat));
    hit h = { .position = v3_add(v3_add(v3_scale(p[0], 1.0 - r), v3_scale(p[1], r - u)), v3_scale(p[2], u)),
              .geometric_normal = front ? n : v3_scale(n, -1.0),
              .front = front };
    return h;
}

/* A ray to a random place of the light. False: nothing is claimed of it. */
static bool aim(clear_sight sight, const hit *h, const light *l, uint64_t *random, trace_ray *ray)
{
    light_view view;
    const double u[2] = { random_uniform(random), random_uniform(random) };
    if (!light_see(l, h->position, &view))
        return false;
    ray->near = 0.0;
    ray->origin = v3_mad(h->position, h->geometric_normal, 2e-5);
    if (light_is_area(l)) {
        const vec3 towards = v3_sub(light_point(l, u), ray->origin);
        ray->far = v3_length(towards);
        ray->direction = v3_normalize(towards);
        return clear_sight_of_flat(sight, h, l);
    }
    light_pick(l, &view, ray->origin, u, &ray->direction, &ray->far);
    return clear_sight_of_round(sight, h, l, &view);
}

typedef struct score {
    int proven, rays, pairs, unproven_but_free;
} score;

static bool is_any_blocked(const traced_scene *t, int instance, clear_sight sight, const light *l, uint64_t *random,
                           int *rays)
{
    for (int i = 0; i < 400; ++i) {
        trace_ray ray = { 0 };
        const hit h = random_point(&t->geometry, instance, sight == CLEAR_IN_FRONT || i % 2 == 0, random);
        if (!aim(sight, &h, l, random, &ray))
            continue;
        ++*rays;
        if (trace_occluded(t->trace, &ray))
            return true;
    }
    return false;
}

static void check_scene(const scene *s, uint64_t *random, score *total)
{
    traced_scene t;
    light lights[LIGHTS];
    uint8_t table[MOST_PARTS * LIGHTS];
    report r = { 0 };
    traced_open(&t, s, NULL);
    for (int i = 0; i < LIGHTS; ++i)
        lights[i] = light_make(&s->lights[i]);
    assert_true(clear_sight_find(&t.geometry, lights, LIGHTS, table, &r));
    for (int i = 0; i < s->instance_count; ++i)
        for (int k = 0; k < LIGHTS; ++k) {
            const clear_sight sight = (clear_sight)table[i * LIGHTS + k];
            int rays = 0;
            ++total->pairs;
            if (sight == CLEAR_UNKNOWN) {
                total->unproven_but_free += !is_any_blocked(&t, i, CLEAR_IN_FRONT, &lights[k], random, &rays);
                continue;
            }
            ++total->proven;
            if (is_any_blocked(&t, i, sight, &lights[k], random, &rays))
                fail_msg("part %d of %d is proven to see light %d, and something is between", i, s->instance_count, k);
            total->rays += rays;
        }
    traced_close(&t);
}

/* Each part has a material of its own. */
static void what_is_proven_is_never_blocked(void **state)
{
    (void)state;
    uint64_t random = 3;
    score total = { 0 };
    for (int k = 0; k < 600; ++k) {
        scene s = random_scene(&random);
        check_scene(&s, &random, &total);
        scene_free(&s);
    }
    printf("%d pairs of a part and a light, %d proven, by %d rays; of the others %d are as free, as far as rays tell\n",
           total.pairs, total.proven, total.rays, total.unproven_but_free);
    assert_true(total.proven > 500 && total.rays > 100000);
}

/* ---- what should be proven ---- */

/* A floor, and what stands on it; the light is above. */
typedef struct stand {
    scene scene;
    light light;
} stand;

static clear_sight sight_of(const stand *s, int material)
{
    geometry g;
    uint8_t table[8];
    report r = { 0 };
    assert_true(geometry_make(&s->scene, &g, &r));
    assert_true(clear_sight_find(&g, &s->light, 1, table, &r));
    geometry_free(&g);
    return (clear_sight)table[material];
}

static void add_ball(scene *s, float y, float radius)
{
    const scene_material matte = scenes_matte(0.5F);
    float place[16];
    scenes_translation(place, 0.0F, y, 0.0F);
    scenes_add_instance(s, scenes_add_sphere(s, scenes_add_material(s, &matte), radius, 24, 12), place, 1);
}

static void a_ball_on_a_floor_is_in_nobodys_shadow(void **state)
{
    (void)state;
    static const scene_light_kind kinds[] = { SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_POINT, SCENE_LIGHT_RECT };
    for (int k = 0; k < 3; ++k) {
        static const float from[3] = { 0.5F, 2.0F, 0.3F }, over[3] = { 0.0F, 2.0F, 0.0F };
        const scene_material matte = scenes_matte(0.5F);
        stand s = { .scene = scenes_empty() };
        scenes_add_instance(&s.scene, scenes_add_square(&s.scene, scenes_add_material(&s.scene, &matte), 3.0F), NULL,
                            0);
        scene_light *const l = scenes_add_light(&s.scene, kinds[k], k == 2 ? over : from, 1.0F);
        l->width_m = l->height_m = 0.2F;
        s.light = light_make(l);
        assert_int_equal(sight_of(&s, 0), CLEAR_BOTH_SIDES);
        /* On the floor, to a rounding. */
        add_ball(&s.scene, 0.5F, 0.5F);
        assert_int_equal(sight_of(&s, 0), CLEAR_UNKNOWN);
        assert_int_equal(sight_of(&s, 1), CLEAR_IN_FRONT);
        /* Beyond the light, and between. */
        if (kinds[k] != SCENE_LIGHT_DIRECTIONAL) {
            add_ball(&s.scene, 4.0F, 0.5F);
            assert_int_equal(sight_of(&s, 1), CLEAR_IN_FRONT);
            add_ball(&s.scene, 1.4F, 0.1F);
            assert_int_equal(sight_of(&s, 1), CLEAR_UNKNOWN);
        }
        scene_free(&s.scene);
    }
}

static void what_is_not_convex_shadows_itself(void **state)
{
    (void)state;
    static const float from[3] = { 0.5F, 2.0F, 0.3F };
    const float corners[2] = { 0.25F, -0.1F };
    for (int k = 0; k < 2; ++k) {
        const scene_material matte = scenes_matte(0.5F);
        stand s = { .scene = scenes_empty() };
        scenes_add_instance(&s.scene, add_box(&s.scene, scenes_add_material(&s.scene, &matte), corners[k]), NULL, 0);
        s.light = light_make(scenes_add_light(&s.scene, SCENE_LIGHT_POINT, from, 1.0F));
        assert_int_equal(sight_of(&s, 0), k == 0 ? CLEAR_IN_FRONT : CLEAR_UNKNOWN);
        scene_free(&s.scene);
    }
}

/* ---- pictures ---- */

static preview_statistics render(const scene *s, double accuracy, image *picture)
{
    static const float eye[3] = { 1.0F, 1.5F, 2.0F }, target[3] = { 0.0F, 0.3F, 0.0F };
    const scene_camera camera = scenes_camera(SCENE_PERSPECTIVE, eye, target, 0.6F);
    preview_options o = pictures_options(&camera);
    preview_statistics statistics;
    report r = { 0 };
    o.accuracy = accuracy;
    o.width = o.height = 48;
    assert_true(preview_render(s, &o, picture, &statistics, &r));
    return statistics;
}

/* A budget leaves nothing out of matte surfaces under small lights but rays to what is proven. */
static void shadows_that_are_left_out_change_no_bit(void **state)
{
    (void)state;
    static const float from[2][3] = { { 0.5F, 2.0F, 0.3F }, { -1.0F, 1.5F, 0.8F } };
    const scene_material matte = scenes_matte(0.5F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 3.0F), NULL, 0);
    scenes_add_light(&s, SCENE_LIGHT_POINT, from[0], 1.0F)->radius_m = 0.02F;
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from[1], 1.0F);
    for (int k = 0; k < 2; ++k) {
        image all, less;
        const preview_statistics whole = render(&s, 0.0, &all), cut = render(&s, 0.02, &less);
        printf("%s: %llu shadow rays, %llu with a plan\n", k == 0 ? "floor" : "ball on it",
               (unsigned long long)whole.shadow_rays, (unsigned long long)cut.shadow_rays);
        assert_memory_equal(all.pixels, less.pixels,
                            (size_t)(all.width * all.height * all.channel_count) * sizeof *all.pixels);
        assert_true(k == 0 ? cut.shadow_rays == 0 : cut.shadow_rays < whole.shadow_rays && cut.shadow_rays > 0);
        image_free(&all);
        image_free(&less);
        add_ball(&s, 0.4F, 0.4F);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_proven_is_never_blocked),
        cmocka_unit_test(a_ball_on_a_floor_is_in_nobodys_shadow),
        cmocka_unit_test(what_is_not_convex_shadows_itself),
        cmocka_unit_test(shadows_that_are_left_out_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
