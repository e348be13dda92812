/* A path at a time, or many through each of their steps together. */
#include "preview/path.h"

#include "preview/hash.h"

/* The largest single-precision number below 1: uniforms must not reach 1. */
#define BELOW_ONE 0x1.fffffep-1F

static float to_uniform(double u)
{
    return fminf((float)u, BELOW_ONE);
}

hit_task path_hit(vertex *v)
{
    return (hit_task){ &v->ray, &v->step, &v->found, &v->hit, &v->hit_step };
}

void path_look(const world *w, vertex *v, const sampler *random, int depth)
{
    double choice[2] = { 0.0, 0.0 };
    if (shade_wants_choice(&w->shader, &v->hit))
        sampler_pair(random, path_dimension(depth, DIM_PLACE), choice);
    shade_prepare(&w->shader, &v->hit, &v->hit_step, v3_scale(v->ray.direction, -1.0), to_uniform(choice[0]),
                  &v->point);
    if (!EFFECT_DRAWS || !v->point.draws)
        return;
    for (int i = 0; i < shade_layers(&v->point); ++i)
        v->point.layers[i].footprint.draw =
            hash_combine(sampler_bits(random, path_dimension(depth, DIM_DRAW)), (uint32_t)i);
}

/* ---- the steps of a path ---- */

static void add_light(radiance *sum, const float throughput[3], const float added[3])
{
    for (int c = 0; c < 3; ++c) {
        sum->discrete[c] += throughput[c] * added[c];
        sum->smooth[c] += throughput[c] * added[c];
    }
}

/* The uniforms that a ray is drawn by. */
typedef struct ray_draw {
    double lobe[2], direction[2];
} ray_draw;

/* Draws the next ray of a path, with the differential of a reflection about the half vector: the facet that sends the
 * ray there turns with the surface. False: the path ends. */
static bool draw_ray(const world *w, vertex *v, const sampler *random, int depth, const ray_draw *u,
                     shade_direction *next)
{
    const float three[3] = { to_uniform(u->lobe[0]), to_uniform(u->direction[0]), to_uniform(u->direction[1]) };
    if (!shade_sample(&v->point, to_uniform(u->lobe[1]), three, next) || !(next->pdf > 0.0F))
        return false;
    if (v3_dot(next->wi, v->hit.geometric_normal) <= 0.0) /* into the surface, through a bent normal */
        return false;

    const vec3 half = v3_normalize(v3_sub(next->wi, v->ray.direction));
    v->step = differential_reflect(&v->step, v->ray.direction, half, &v->hit_step.position, &v->turn);
    differential_widen(&v->step, next->wi, fmin(1.0 / ((double)next->pdf * w->spp), 2.0 * PREVIEW_PI));
    v->ray =
        (trace_ray){ .origin = hit_leave(&v->hit, v->hit.position), .direction = next->wi, .far = (double)INFINITY };
    if (w->is_blended)
        v->ray.random = sampler_bits(random, path_dimension(depth, DIM_BLEND));
    return true;
}

static bool has_indirect_light(const world *w)
{
    return EFFECT_BOUNCES && (w->bounces > 0 || w->has_sky);
}

static void begin(const vertex *from, const sampler *random, radiance *sum, path *p)
{
    p->v = *from;
    p->v.turn = hit_turn(&p->v.hit, &p->v.hit_step);
    p->throughput[0] = p->throughput[1] = p->throughput[2] = 1.0F;
    p->random = random;
    p->sum = sum;
}

/* False: the path ends. */
static bool leave(const world *w, path *p, int depth, const ray_draw *u, ray_counts *counts)
{
    if (w->emitters != NULL)
        p->left = p->v.point;
    if (!draw_ray(w, &p->v, p->random, depth - 1, u, &p->next))
        return false;
    ++counts->bounce_rays;
    return true;
}

/* What the ray brings by itself that has met nothing, or goes too far. False: the path ends.
 *
 * What glows or surrounds is dark behind a back: that throws a shadow, as rays towards the lights find, and the other
 * half of what the balance heuristic shares out would be missing. Surfaces that only reflect are seen through it. */
static bool has_met(const world *w, const path *p, bool met, int depth, ray_counts *counts)
{
    if (!met && !p->v.found.through_back)
        add_escaped_light(w, &p->v.point, &p->next, p->throughput, p->sum, counts);
    return met && depth <= w->bounces;
}

/* What it brings from the surface that it has met. */
static void arrive(const world *w, path *p, int depth, ray_counts *counts)
{
    vertex *const v = &p->v;
    const bool dark = v->found.through_back;
    path_look(w, v, p->random, depth);
    v->turn = hit_turn(&v->hit, &v->hit_step);
    const bool sampled =
        !dark && w->emitters != NULL &&
        add_found_glow(w, &p->left, &p->next, &v->found, &v->hit, v->point.emission, p->throughput, p->sum, counts);
    for (int c = 0; c < 3; ++c)
        p->throughput[c] *= p->next.weight[c];
    shade_widen(&v->point, differential_half_vector_variance(&v->step, &v->turn));
    if (!sampled && !dark)
        add_light(p->sum, p->throughput, v->point.emission);
}

/* ---- one ---- */

void add_indirect_light(const world *w, const vertex *from, const sampler *random, radiance *sum, ray_counts *counts)
{
    path p;
    if (!has_indirect_light(w))
        return;
    begin(from, random, sum, &p);
    for (int depth = 1; depth <= w->bounces || w->has_sky; ++depth) {
        ray_draw u;
        sampler_pair(random, path_dimension(depth - 1, DIM_LOBE), u.lobe);
        sampler_pair(random, path_dimension(depth - 1, DIM_DIRECTION), u.direction);
        if (!leave(w, &p, depth, &u, counts))
            return;
        const bool met = trace_closest(w->trace, &p.v.ray, TRACE_BLEND_RANDOM, &p.v.found);
        if (!has_met(w, &p, met, depth, counts))
            return;
        const hit_task task = path_hit(&p.v);
        hit_resolve(w->geometry, &task);
        arrive(w, &p, depth, counts);
        const direct_point point = { &p.v, random, p.throughput, sum, NULL, 0 };
        add_direct_light(w, &point, path_dimension(depth, DIM_LIGHTS), counts);
        if (depth < w->bounces)
            add_glow(w, &p.v.hit, &p.v.point, random, path_dimension(depth, DIM_GLOW), p.throughput, sum, NULL, counts);
        add_surroundings(w, &p.v.hit, &p.v.point, random, path_dimension(depth, DIM_SURROUNDINGS), p.throughput, sum,
                         NULL, counts);
    }
}

/* ---- many ---- */

/* Returns how many paths are left, the first of active and of rays. */
static int leave_all(const world *w, int active, int depth, path_scratch *s, ray_counts *counts)
{
    int left = 0;
    for (int i = 0; i < active; ++i) {
        pair_batch_set(&s->lobes, i, s->active[i]->random);
        pair_batch_set(&s->directions, i, s->active[i]->random);
    }
    pair_batch_draw(w->kernels, path_dimension(depth - 1, DIM_LOBE), active, &s->lobes);
    pair_batch_draw(w->kernels, path_dimension(depth - 1, DIM_DIRECTION), active, &s->directions);
    for (int i = 0; i < active; ++i) {
        path *const p = s->active[i];
        const ray_draw u = { { s->lobes.u[0][i], s->lobes.u[1][i] }, { s->directions.u[0][i], s->directions.u[1][i] } };
        if (!leave(w, p, depth, &u, counts))
            continue;
        s->rays[left] = &p->v.ray;
        s->active[left++] = p;
    }
    return left;
}

/* Returns how many paths are left, the first of active and of points. */
static int go_on(const world *w, int active, int depth, path_scratch *s, ray_counts *counts)
{
    const int left = leave_all(w, active, depth, s, counts);
    int arrived = 0;
    trace_closest_many(w->trace, s->rays, left, TRACE_BLEND_RANDOM, s->hits, s->met);
    for (int i = 0; i < left; ++i) {
        path *const p = s->active[i];
        p->v.found = s->hits[i];
        if (!has_met(w, p, s->met[i], depth, counts))
            continue;
        s->tasks[arrived] = path_hit(&p->v);
        s->active[arrived++] = p;
    }
    hit_resolve_many(w->geometry, w->kernels, s->tasks, arrived);
    for (int i = 0; i < arrived; ++i) {
        path *const p = s->active[i];
        arrive(w, p, depth, counts);
        s->points[i] = (direct_point){ &p->v, p->random, p->throughput, p->sum, NULL, i };
    }
    return arrived;
}

void add_indirect_light_to_many(const world *w, const direct_point *points, int count, path_scratch *s,
                                ray_counts *counts)
{
    if (!has_indirect_light(w))
        return;
    for (int i = 0; i < count; ++i) {
        s->active[i] = &s->paths[i];
        begin(points[i].vertex, points[i].random, points[i].light, &s->paths[i]);
    }
    for (int depth = 1, active = count; active > 0 && (depth <= w->bounces || w->has_sky); ++depth) {
        active = go_on(w, active, depth, s, counts);
        add_direct_light_to_many(w, s->points, active, path_dimension(depth, DIM_LIGHTS), &s->direct, counts);
        if (depth < w->bounces)
            add_glow_to_many(w, s->points, active, path_dimension(depth, DIM_GLOW), &s->surroundings, counts);
        add_surroundings_to_many(w, s->points, active, path_dimension(depth, DIM_SURROUNDINGS), &s->surroundings,
                                 counts);
    }
}
