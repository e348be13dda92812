/* Direct light in three steps: gather the lights that a point sees, evaluate the surface for each, add them up. Of many
 * points the shadow rays run side by side, and so does the evaluation. */
#include "preview/direct.h"

#include <math.h>

#include "preview/choose_lights.h"
#include "preview/hash.h"

/* A light as the cap that it is to point k of the batch. */
static void gather_cap(const world *w, const light_batch *b, int k, const sampler *random, uint32_t dimension,
                       light_query *q, trace_ray *ray)
{
    q->shade.wi = v3(b->wi[0][k], b->wi[1][k], b->wi[2][k]);
    q->shade.solid_angle_sr = b->solid_angle_sr[k];
    q->shadow.is_shared = false;
    q->shadow.ray_count = q->shadow.light->unshadowed || q->shadow.is_clear ? 0 : 1;
    if (EFFECT_ALPHA && w->is_blended)
        ray->random = sampler_bits(random, dimension);
}

/* The same as a shape. False: it lies below the horizon. */
static bool gather_shape(const light_batch *b, int k, const direct_point *p, uint32_t dimension, light_query *q,
                         trace_ray *rays)
{
    q->shadow.view = light_batch_view(b, k);
    if (!light_is_area(q->shadow.light)) {
        const float scale = (float)light_radiance_per_irradiance(&q->shadow.view);
        for (int c = 0; c < 3; ++c)
            q->irradiance[c] *= scale;
    }
    return area_shadow_begin(&p->vertex->hit, q->shade.point, p->random, dimension, p->facets != NULL, &q->shadow, rays,
                             &q->shade.area);
}

/* Whether the plan has it proven that nothing comes between the point and one of the world's lights. */
static bool is_clear(const world *w, const hit *h, const light *l, const light_batch *b, int k)
{
    if (w->sights == NULL)
        return false;
    const light_view view = light_batch_view(b, k);
    const size_t index = (size_t)h->mesh->material * (size_t)w->light_count + (size_t)(l - w->lights);
    const clear_sight sight = (clear_sight)w->sights[index];
    return light_is_area(l) ? clear_sight_of_flat(sight, h, l) : clear_sight_of_round(sight, h, l, &view);
}

/* A point that sees the light: number k of the batch. rays: room for those that the query then waits for. False: the
 * light does not reach the point, and nothing has to be asked for it. */
static bool gather_light(const world *w, const light_batch *b, int k, const direct_point *p, uint32_t dimension,
                         const light *l, light_query *q, trace_ray *rays, ray_counts *counts)
{
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = b->irradiance[c][k];
    q->weight = 1.0F;
    q->to = p;
    q->shadow.light = l;
    q->shadow.is_clear = is_clear(w, &p->vertex->hit, l, b, k);
    q->shade.point = &p->vertex->point;
    q->shade.is_area = (b->shapes >> k & 1U) != 0 && (EFFECT_ROUND_SHAPES || light_is_area(l));
    rays[0] = (trace_ray){ .origin = v3(b->origin[0][k], b->origin[1][k], b->origin[2][k]),
                           .direction = v3(b->direction[0][k], b->direction[1][k], b->direction[2][k]),
                           .far = b->far[k] };
    if (!shade_is_area(&q->shade))
        gather_cap(w, b, k, p->random, dimension, q, rays);
    else if (!gather_shape(b, k, p, dimension, q, rays))
        return false;
    counts->shadow_rays += (uint64_t)q->shadow.ray_count;
    if (shade_is_area(&q->shade) && w->cap_error > 0.0)
        q->draw = hash_uniform(hash_mix(sampler_bits(p->random, dimension)));
    return true;
}

double direct_cap_error(const light *l, const shade_point *p, vec3 position, light_view *cap)
{
    if (light_is_area(l) ? !light_see_round(l, position, cap) : !light_see(l, position, cap) || !(cap->sine > 0.0))
        return (double)INFINITY;
    return shade_cap_error(p, cap->wi, cap->sine) + light_round_error(l, cap);
}

/* Up to half of the error that may be all samples take the cap, beyond it ever fewer, so that no seam shows where
 * shapes begin. */
double direct_cap_share(double error, double most)
{
    return error < most ? smaller_of(2.0 - 2.0 * error / most, 1.0) : 0.0;
}

/* A shape that all of the point sees becomes a cap where the view allows that. */
static void take_cap(const world *w, light_query *q)
{
    light_view cap;
    if (q->shade.area.hidden > 0.0F)
        return;
    const vec3 position = q->to->vertex->hit.position;
    const double error = direct_cap_error(q->shadow.light, q->shade.point, position, &cap), most = w->cap_error;
    if (!(direct_cap_share(error, most) > 1.0 - (double)q->draw) || !shade_faces(q->shade.point, cap.wi))
        return;
    q->shade.is_area = false;
    q->shade.wi = cap.wi;
    q->shade.solid_angle_sr = cap.solid_angle_sr;
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = cap.irradiance[c];
}

/* dark: which of its rays met something. */
static bool is_lit(const world *w, light_query *q, const trace_ray *rays, const bool *dark)
{
    if (!shade_is_area(&q->shade))
        return q->shadow.ray_count == 0 || !dark[0];
    if (!area_shadow_end(&q->shadow, q->shade.point, rays, dark, &q->shade.area))
        return false;
    if (w->cap_error > 0.0)
        take_cap(w, q);
    return true;
}

static void note_limit(const glint_value *value, ray_counts *counts)
{
    if (!EFFECT_FACET_LIMIT || !value->over_limit)
        return;
    ++counts->over_limit;
    counts->most_facets = fmaxf(counts->most_facets, value->facet_count);
}

static void add_up(const light_query *q, const glint_value *value)
{
    const direct_point *const p = q->to;
    radiance *const sum = p->light;
    float total = 0.0F;
    for (int c = 0; c < 3; ++c) {
        const float incoming = p->throughput[c] * q->irradiance[c];
        sum->discrete[c] += incoming * q->weight * value->rgb[c];
        sum->smooth[c] += incoming * q->weight * value->smooth[c];
        total += incoming * value->smooth[c];
    }
    if (p->facets != NULL && total > p->facets->brightest)
        *p->facets = (direct_facets){ value->facet_count, value->lit_probability, total };
}

/* One light at one point, from its ray to its sum. */
static void add_light(const world *w, light_query *q, const trace_ray *rays, ray_counts *counts)
{
    shade_query *const s = &q->shade;
    glint_value value;
    bool dark[AREA_MOST_RAYS] = { false };
    for (int i = 0; i < q->shadow.ray_count; ++i)
        dark[i] = trace_occluded(w->trace, &rays[i]);
    if (!is_lit(w, q, rays, dark))
        return;
    if (shade_is_area(s))
        shade_eval_area(s->point, &s->area, &value);
    else
        shade_eval(s->point, s->wi, s->solid_angle_sr, &value);
    for (int i = 0; i < shade_layers(s->point); ++i)
        ++*(s->point->layers[i].counts ? &counts->glint_evals : &counts->smooth_evals);
    note_limit(&value, counts);
    add_up(q, &value);
}

/* Lights that stand for all of them, of more than MOST_LIGHTS. */
static int choose(const world *w, const direct_point *p, uint32_t dimension, chosen_light chosen[MOST_LIGHTS])
{
    return lights_choose(w->light_tree, &p->vertex->point, p->vertex->hit.position, p->random,
                         dimension + (uint32_t)w->light_count, chosen);
}

/* A batch of one point. */
static void look_alone(const direct_point *p, light_batch *b)
{
    b->count = 1;
    b->layers = shade_layers(&p->vertex->point) == 2 ? 2 : 1;
    light_batch_set(b, 0, &p->vertex->hit, &p->vertex->point, p->random);
}

void add_direct_light(const world *w, const direct_point *p, uint32_t dimension, ray_counts *counts)
{
    chosen_light chosen[MOST_LIGHTS];
    light_query q;
    trace_ray rays[AREA_MOST_RAYS];
    light_batch batch;
    const bool is_any = EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS;
    const int count = is_any ? choose(w, p, dimension, chosen) : w->light_count;
    look_alone(p, &batch);
    for (int i = 0; i < count; ++i) {
        const int index = is_any ? chosen[i].index : i;
        const light *const l = &w->lights[index];
        kernels_1.light(l, dimension + (uint32_t)index, &batch);
        if (batch.seen == 0 || !gather_light(w, &batch, 0, p, dimension + (uint32_t)index, l, &q, rays, counts))
            continue;
        if (is_any)
            q.weight = 1.0F / chosen[i].probability;
        add_light(w, &q, rays, counts);
    }
}

/* ---- many points ---- */

/* Lights that a point has at most. */
static int most_lights(const world *w)
{
    return EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS ? MOST_LIGHTS : w->light_count;
}

/* A light at one of the points, number k of the batch, that sees it. */
static void gather_at(const world *w, int k, const direct_point *p, uint32_t dimension, int index, light_query *q,
                      direct_scratch *s, ray_counts *counts)
{
    q->is_asked = gather_light(w, &s->batch, k, p, dimension + (uint32_t)index, &w->lights[index], q,
                               &s->rays[s->ray_count], counts);
    if (!q->is_asked)
        return;
    q->first_ray = s->ray_count;
    s->ray_count += q->shadow.ray_count;
}

/* All points, and those that fill the last vector. */
static void look_together(const world *w, const direct_point *points, int count, light_batch *b)
{
    b->count = count;
    b->layers = 1;
    for (int k = 0; EFFECT_COATS && w->has_coats && k < count; ++k)
        if (shade_layers(&points[k].vertex->point) == 2)
            b->layers = 2;
    for (int k = 0; k < count || k % w->kernels->lanes != 0; ++k) {
        const direct_point *const p = &points[k < count ? k : count - 1];
        light_batch_set(b, k, &p->vertex->hit, &p->vertex->point, p->random);
    }
}

/* Light by light, so that rays to one light run side by side; the queries of a point lie together. */
static void gather_all(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                       ray_counts *counts)
{
    light_batch *const b = &s->batch;
    look_together(w, points, count, b);
    for (int i = 0; i < w->light_count; ++i) {
        w->kernels->light(&w->lights[i], dimension + (uint32_t)i, b);
        for (uint64_t left = b->seen; left != 0; left &= left - 1U) {
            const int k = __builtin_ctzll(left);
            gather_at(w, k, &points[k], dimension, i, &s->queries[k * w->light_count + i], s, counts);
        }
    }
}

static void gather_chosen(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                          ray_counts *counts)
{
    for (int k = 0; k < count; ++k) {
        const direct_point *const p = &points[k];
        chosen_light chosen[MOST_LIGHTS];
        const int chosen_count = choose(w, p, dimension, chosen);
        look_alone(p, &s->batch);
        for (int i = 0; i < chosen_count; ++i) {
            light_query *const q = &s->queries[k * MOST_LIGHTS + i];
            kernels_1.light(&w->lights[chosen[i].index], dimension + (uint32_t)chosen[i].index, &s->batch);
            if (s->batch.seen == 0)
                continue;
            gather_at(w, 0, p, dimension, chosen[i].index, q, s, counts);
            q->weight = 1.0F / chosen[i].probability;
        }
    }
}

/* Lists those that something is left of, point by point: the library places a point that lights share once. */
static int list_lit(const world *w, int query_count, direct_scratch *s)
{
    int count = 0;
    for (int i = 0; i < query_count; ++i) {
        light_query *const q = &s->queries[i];
        if (!q->is_asked || !is_lit(w, q, &s->rays[q->first_ray], &s->dark[q->first_ray]))
            continue;
        s->shades[count] = &q->shade;
        s->lit[count++] = q;
    }
    return count;
}

/* Points of at most SHADE_MOST_QUERIES lights together. */
static void add_some(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                     ray_counts *counts)
{
    const int query_count = count * most_lights(w);
    s->ray_count = 0;
    for (int i = 0; i < query_count; ++i)
        s->queries[i].is_asked = false;
    if (EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS)
        gather_chosen(w, points, count, dimension, s, counts);
    else
        gather_all(w, points, count, dimension, s, counts);
    trace_occluded_many(w->trace, s->rays, s->ray_count, s->dark);
    const int lit = list_lit(w, query_count, s);
    uint64_t evaluated[2] = { 0 };
    shade_eval_many(s->shades, lit, s->values, evaluated);
    counts->smooth_evals += evaluated[0];
    counts->glint_evals += evaluated[1];
    for (int i = 0; i < lit; ++i) {
        note_limit(s->shades[i]->value, counts);
        add_up(s->lit[i], s->shades[i]->value);
    }
}

void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts)
{
    const int lights = most_lights(w);
    if (lights == 0)
        return;
    const int room = SHADE_MOST_QUERIES / lights, most = room < LIGHT_BATCH ? room : LIGHT_BATCH;
    for (int k = 0; k < count; k += most)
        add_some(w, &points[k], count - k < most ? count - k : most, dimension, s, counts);
}
