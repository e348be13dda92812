/* The kernels of all vector widths give the same bits, for hard cases as well, and what they compute is true. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define WIDE_LANES 1
#include "preview/hash.h"
#include "preview/hit_batch.h"
#include "preview/light_batch.h"
#include "preview/turn.h"
#include "scenes.h"

/* In [-1, 1), by a number. */
static double draw(uint32_t *random)
{
    *random = hash_mix(*random + 1U);
    return 2.0 * (double)hash_uniform(*random) - 1.0;
}

static vec3 draw_vector(uint32_t *random)
{
    const double x = draw(random), y = draw(random);
    return v3(x, y, draw(random));
}

/* ---- sine and cosine ---- */

/* The angle is rounded once, at most pi / 4, the polynomials are off by less than an ulp, and their sum is rounded: 2.6
 * 2^-53 in all. */
static void a_turn_has_the_sine_and_cosine_of_its_angle(void **state)
{
    (void)state;
    for (int i = 0; i <= 100000; ++i) {
        const double turn = i / 100000.0;
        const long double angle = 2.0L * 3.14159265358979323846264338327950288L * (long double)turn;
        double sine, cosine;
        turn_sine_cosine(turn, &sine, &cosine);
        const double off =
            fmax(fabs((double)((long double)sine - sinl(angle))), fabs((double)((long double)cosine - cosl(angle))));
        if (!(off <= 2.6 * 0x1p-53))
            fail_msg("at %.17g off by %g, at most %g expected", turn, off, 2.6 * 0x1p-53);
    }
}

/* ---- hits ---- */

/* A triangle of this size as far from the origin as that, and a ray that meets it at this cosine. */
typedef struct hard_case {
    const char *name;
    double size, away, cosine;
} hard_case;

static const hard_case HARD[] = {
    { "a metre", 1.0, 0.0, 0.7 },
    { "far from the origin", 0.1, 1e6, 0.7 },
    { "tiny", 1e-6, 1.0, 0.7 },
    { "a few steps of a float", 0.02, 1e4, 0.7 },
    { "huge", 1e8, 1e8, 0.7 },
    { "grazing", 1.0, 10.0, 1e-3 },
    { "edge-on", 1.0, 10.0, 0.0 },
    { "without area", 0.0, 1.0, 0.7 },
    { "beyond floats", 1e38, 1e38, 0.7 },
};
enum { HARD_COUNT = sizeof HARD / sizeof HARD[0], TRIANGLES = 64 };

typedef struct hard_scene {
    scene scene;
    geometry geometry;
    trace_ray rays[TRIANGLES];
    trace_hit found[TRIANGLES];
} hard_scene;

static void add_triangle(float *corners, const hard_case *c, uint32_t *random, trace_ray *ray)
{
    const vec3 middle = v3_scale(draw_vector(random), c->away);
    const vec3 e1 = v3_scale(draw_vector(random), c->size), e2 = v3_scale(draw_vector(random), c->size);
    const vec3 places[3] = { middle, v3_add(middle, e1), v3_add(middle, e2) };
    for (int k = 0; k < 3; ++k) {
        corners[3 * k] = (float)places[k].x;
        corners[3 * k + 1] = (float)places[k].y;
        corners[3 * k + 2] = (float)places[k].z;
    }
    const vec3 p[3] = { v3_from(corners), v3_from(&corners[3]), v3_from(&corners[6]) };
    const vec3 n = v3_normalize(v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0])));
    const vec3 in_plane = v3_normalize(v3_sub(p[1], p[0]));
    const double sine = sqrt(1.0 - c->cosine * c->cosine);
    const vec3 towards = v3_normalize(v3_mad(v3_scale(in_plane, sine), n, -c->cosine));
    const vec3 target = v3_mad(v3_mad(p[0], v3_sub(p[1], p[0]), 0.3), v3_sub(p[2], p[0]), 0.4);
    *ray = (trace_ray){ .origin = v3_mad(target, towards, -fmax(c->size, 1e-3)), .direction = towards };
}

static void open_hard(hard_scene *s, const hard_case *c)
{
    static float corners[TRIANGLES * 9];
    static const float mirrored[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    const scene_material matte = scenes_matte(1.0F);
    report r = { 0 };
    uint32_t random = 1U;
    s->scene = scenes_empty();
    for (int i = 0; i < TRIANGLES; ++i)
        add_triangle(&corners[9 * i], c, &random, &s->rays[i]);
    const int mesh = scenes_add_triangles(&s->scene, scenes_add_material(&s->scene, &matte), corners, TRIANGLES);
    scenes_add_instance(&s->scene, mesh, NULL, 0);
    scenes_add_instance(&s->scene, mesh, mirrored, 1);
    assert_true(geometry_make(&s->scene, &s->geometry, &r));
    /* Every third is met by its mirror image, so that lanes have different matrices. */
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        s->found[i] = (trace_hit){ .instance = i % 3 == 2, .triangle = i, .weights = { 0.3, 0.4 }, .distance = 1.0 };
        if (i % 3 == 2) {
            s->rays[i].origin.x = -s->rays[i].origin.x;
            s->rays[i].direction.x = -s->rays[i].direction.x;
        }
    }
}

static void close_hard(hard_scene *s)
{
    geometry_free(&s->geometry);
    scene_free(&s->scene);
}

static void resolve_hard(const hard_scene *s, int lanes, int count, hit *hits, hit_step *steps)
{
    trace_hit found[TRIANGLES];
    hit_task tasks[TRIANGLES];
    static const differential step = { { 1e-4, 0, 0 }, { 0, 1e-4, 0 }, { 0, 1e-3, 0 }, { 0, 0, 1e-3 } };
    memset(hits, 0, TRIANGLES * sizeof *hits);
    memset(steps, 0, TRIANGLES * sizeof *steps);
    for (int i = 0; i < count; ++i) {
        found[i] = s->found[i];
        tasks[i] = (hit_task){ &s->rays[i], &step, &found[i], &hits[i], &steps[i] };
    }
    hit_resolve_many(&s->geometry, kernels_of_machine(lanes), tasks, count);
}

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* The same bits, or no numbers both: of two NaNs that are added compilers choose. */
static bool are_same(const void *a, const void *b, size_t count)
{
    const double *const x = a, *const y = b;
    for (size_t i = 0; i < count; ++i)
        if (bits_of(x[i]) != bits_of(y[i]) && !(isnan(x[i]) && isnan(y[i])))
            return false;
    return true;
}

static bool are_same_hits(const hit *a, const hit *b)
{
    enum { VECTOR = 3 };
    return are_same(a->weights, b->weights, 2) && are_same(&a->distance, &b->distance, 1) &&
           are_same(&a->position, &b->position, VECTOR) && are_same(&a->position_object, &b->position_object, VECTOR) &&
           a->front == b->front && are_same(&a->geometric_normal, &b->geometric_normal, VECTOR) &&
           are_same(&a->normal, &b->normal, VECTOR) && are_same(&a->tangent, &b->tangent, VECTOR) &&
           are_same(&a->bitangent, &b->bitangent, VECTOR) && are_same(&a->shadow_origin, &b->shadow_origin, VECTOR) &&
           are_same(&a->clearance, &b->clearance, 1);
}

static void hits_are_the_same_at_every_width(void **state)
{
    (void)state;
    static hard_scene s;
    static hit one[TRIANGLES], many[TRIANGLES];
    static hit_step one_step[TRIANGLES], many_step[TRIANGLES];
    for (int c = 0; c < HARD_COUNT; ++c) {
        open_hard(&s, &HARD[c]);
        for (int lanes = 1; lanes <= KERNELS_WIDEST; lanes *= 2)
            for (int count = TRIANGLES - 9; count <= TRIANGLES; ++count) {
                resolve_hard(&s, 1, count, one, one_step);
                resolve_hard(&s, lanes, count, many, many_step);
                for (int i = 0; i < count; ++i)
                    if (!are_same_hits(&one[i], &many[i]) ||
                        !are_same(&one_step[i], &many_step[i], sizeof one_step[i] / sizeof(double)))
                        fail_msg("%s: hit %d of %d differs at %d lanes", HARD[c].name, i, count, lanes);
            }
        close_hard(&s);
    }
}

/* In long double: how far the place lies from the ray, and from the plane of the triangle as the file has it. */
static double distance_from_ray(const trace_ray *ray, vec3 place)
{
    const long double d[3] = { (long double)ray->direction.x, (long double)ray->direction.y,
                               (long double)ray->direction.z };
    const long double p[3] = { (long double)place.x - (long double)ray->origin.x,
                               (long double)place.y - (long double)ray->origin.y,
                               (long double)place.z - (long double)ray->origin.z };
    const long double along = (p[0] * d[0] + p[1] * d[1] + p[2] * d[2]) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    long double square = 0.0L;
    for (int k = 0; k < 3; ++k)
        square += (p[k] - along * d[k]) * (p[k] - along * d[k]);
    return (double)sqrtl(square);
}

/* Some forty roundings of numbers as large as the largest coordinate, each by 2^-53 of it, before a division by the
 * cosine: 40 2^-53 of the largest over the cosine. */
static void a_hit_lies_on_its_ray_wherever_the_triangle_is(void **state)
{
    (void)state;
    static hard_scene s;
    static hit hits[TRIANGLES];
    static hit_step steps[TRIANGLES];
    for (int c = 0; c < HARD_COUNT; ++c) {
        if (!(HARD[c].cosine > 0.0) || !(HARD[c].size > 0.0) || HARD[c].size > 1e30)
            continue;
        open_hard(&s, &HARD[c]);
        resolve_hard(&s, KERNELS_WIDEST, TRIANGLES, hits, steps);
        int flat = 0; /* corners that are one, as floats */
        for (int i = 0; i < TRIANGLES; ++i) {
            if (!(v3_dot(hits[i].geometric_normal, hits[i].geometric_normal) > 0.0)) {
                ++flat;
                continue;
            }
            const double largest = fmax(v3_max_abs(hits[i].position), v3_max_abs(s.rays[i].origin));
            const double bound = 40.0 * 0x1p-53 * largest / HARD[c].cosine;
            const double off = distance_from_ray(&s.rays[i], hits[i].position);
            if (!(off <= bound))
                fail_msg("%s: hit %d is %g m off its ray, at most %g expected", HARD[c].name, i, off, bound);
        }
        assert_true(flat < TRIANGLES / 4);
        close_hard(&s);
    }
}

/* ---- lights ---- */

static scene_light any_light(int kind, uint32_t *random)
{
    scene_light l = { .kind = (scene_light_kind)kind, .color = { 1.0F, 0.5F, 0.0F }, .intensity = 3.0F };
    float m[16];
    m4_from_axes(v3(1, 0, 0), v3(0, 0, -1), v3(0, 1, 0), v3_scale(draw_vector(random), 2.0), m);
    memcpy(l.to_world, m, sizeof m);
    l.radius_m = kind % 2 == 0 ? 0.3F : 0.0F;
    l.range = (float)(3.0 + 2.0 * draw(random));
    l.angular_diameter_rad = 0.01F;
    l.inner_cone_rad = 0.2F;
    l.outer_cone_rad = 1.2F;
    l.width_m = 0.5F;
    l.height_m = 0.2F;
    return l;
}

/* Coats of a thousandth and rough bases; some points look from below, some lie in a light, one is no number. */
static void set_points(light_batch *b, const vec3 middle, uint32_t *random)
{
    b->count = LIGHT_BATCH - 3;
    b->layers = 2;
    for (int i = 0; i < LIGHT_BATCH; ++i) {
        const vec3 z = v3_normalize(draw_vector(random)), x = v3_any_tangent(z);
        hit h = { .position = i == 7 ? middle : v3_scale(draw_vector(random), 2.0), .geometric_normal = z };
        if (i == 11)
            h.position.x = (double)NAN;
        h.shadow_origin = h.position;
        h.clearance = 1e-6;
        shade_point p = { .layer_count = 1 + i % 2 };
        for (int k = 0; k < 2; ++k) {
            p.layers[k] =
                (shade_layer){ .x = x, .y = v3_cross(z, x), .z = z, .wo = { 0.6F, 0.0F, i % 5 ? 0.8F : -0.8F } };
            p.layers[k].surface.alpha_x = p.layers[k].surface.alpha_y = k == 0 ? 0.3F : 1e-3F;
        }
        const sampler s = sampler_make(i, 0, 3U, 7U);
        light_batch_set(b, i, &h, &p, &s);
    }
}

static bool are_same_views(const light_batch *a, const light_batch *b, int k)
{
    bool same = bits_of(a->far[k]) == bits_of(b->far[k]) && bits_of(a->distance[k]) == bits_of(b->distance[k]) &&
                bits_of(a->sine[k]) == bits_of(b->sine[k]) && a->solid_angle_sr[k] == b->solid_angle_sr[k];
    for (int c = 0; c < 3; ++c)
        same = same && bits_of(a->wi[c][k]) == bits_of(b->wi[c][k]) &&
               bits_of(a->direction[c][k]) == bits_of(b->direction[c][k]) && a->irradiance[c][k] == b->irradiance[c][k];
    return same;
}

static void lights_are_seen_alike_at_every_width(void **state)
{
    (void)state;
    static light_batch one, many;
    uint32_t random = 5U;
    int seen = 0, shapes = 0;
    for (int i = 0; i < 200; ++i) {
        const scene_light from = any_light(i % 5, &random);
        const light l = light_make(&from);
        memset(&one, 0, sizeof one);
        set_points(&one, l.position, &random);
        many = one;
        kernels_1.light(&l, 9U, &one);
        for (int lanes = 2; lanes <= KERNELS_WIDEST; lanes *= 2) {
            kernels_of_machine(lanes)->light(&l, 9U, &many);
            assert_true(one.seen == many.seen && one.shapes == many.shapes);
            for (int k = 0; k < one.count; ++k)
                if ((one.seen >> k & 1U) != 0 && !are_same_views(&one, &many, k))
                    fail_msg("light %d is seen otherwise from point %d at %d lanes", i, k, lanes);
        }
        seen += __builtin_popcountll(one.seen);
        shapes += __builtin_popcountll(one.shapes);
    }
    assert_true(seen > 1000 && shapes > 100 && shapes < seen);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turn_has_the_sine_and_cosine_of_its_angle),
        cmocka_unit_test(hits_are_the_same_at_every_width),
        cmocka_unit_test(a_hit_lies_on_its_ray_wherever_the_triangle_is),
        cmocka_unit_test(lights_are_seen_alike_at_every_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
