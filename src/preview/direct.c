/* Direct light in three steps: gather the lights that a point sees, evaluate the surface for each, add them up. Of many
 * points the shadow rays run side by side, and so does the evaluation. */
#include "preview/direct.h"

#include <math.h>

#include "preview/choose_lights.h"
#include "preview/hash.h"

/* The ray that a cap waits for, towards a place of the light. */
static void aim(const world *w, const hit *h, const light *l, const light_view *view, const sampler *random,
                uint32_t dimension, trace_ray *ray)
{
    double u[2] = { 0.0, 0.0 };
    *ray = (trace_ray){ .origin = hit_leave(h, h->shadow_origin) };
    if (EFFECT_ALPHA && w->is_blended)
        ray->random = sampler_bits(random, dimension);
    if (light_is_soft(l))
        sampler_pair(random, dimension, u);
    light_pick(l, view, ray->origin, u, &ray->direction, &ray->far);
}

/* A light as the cap that it is to the point. */
static void gather_cap(const world *w, const hit *h, const sampler *random, uint32_t dimension, light_query *q,
                       trace_ray *ray)
{
    const light_view *const view = &q->shadow.view;
    q->shade.wi = view->wi;
    q->shade.solid_angle_sr = view->solid_angle_sr;
    q->shadow.is_shared = false;
    q->shadow.ray_count = q->shadow.light->unshadowed || q->shadow.is_clear ? 0 : 1;
    if (q->shadow.ray_count > 0)
        aim(w, h, q->shadow.light, view, random, dimension, ray);
}

/* The same as a shape. False: it lies below the horizon. */
static bool gather_shape(const hit *h, const sampler *random, uint32_t dimension, bool thorough, light_query *q,
                         trace_ray *rays)
{
    if (!light_is_area(q->shadow.light)) {
        const float scale = (float)light_radiance_per_irradiance(&q->shadow.view);
        for (int c = 0; c < 3; ++c)
            q->irradiance[c] *= scale;
    }
    return area_shadow_begin(h, q->shade.point, random, dimension, thorough, &q->shadow, rays, &q->shade.area);
}

/* Whether the plan has it proven that nothing comes between the point and one of the world's lights. */
static bool is_clear(const world *w, const hit *h, const light *l, const light_view *view)
{
    if (w->sights == NULL)
        return false;
    const size_t index = (size_t)h->mesh->material * (size_t)w->light_count + (size_t)(l - w->lights);
    const clear_sight sight = (clear_sight)w->sights[index];
    return light_is_area(l) ? clear_sight_of_flat(sight, h, l) : clear_sight_of_round(sight, h, l, view);
}

/* rays: room for those that the query then waits for. False: the light does not reach the point, and nothing has to be
 * asked for it. */
static bool gather_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                         const light *l, bool thorough, light_query *q, trace_ray *rays, ray_counts *counts)
{
    light_view *const view = &q->shadow.view;
    if (!light_see(l, h->position, view))
        return false;
    const shade_sight sight = light_is_area(l) ? SHADE_SHAPE : shade_see(p, &view->wi, view->sine);
    if (sight == SHADE_UNSEEN)
        return false;
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = view->irradiance[c];
    q->weight = 1.0F;
    q->shadow.light = l;
    q->shadow.is_clear = is_clear(w, h, l, view);
    q->shade.point = p;
    q->shade.is_area = sight == SHADE_SHAPE;
    if (!shade_is_area(&q->shade))
        gather_cap(w, h, random, dimension, q, rays);
    else if (!gather_shape(h, random, dimension, thorough, q, rays))
        return false;
    counts->shadow_rays += (uint64_t)q->shadow.ray_count;
    if (shade_is_area(&q->shade) && w->cap_error > 0.0)
        q->draw = hash_uniform(hash_mix(sampler_bits(random, dimension)));
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
static void take_cap(const world *w, const hit *h, light_query *q)
{
    light_view cap;
    if (q->shade.area.hidden > 0.0F)
        return;
    const double error = direct_cap_error(q->shadow.light, q->shade.point, h->position, &cap), most = w->cap_error;
    if (!(direct_cap_share(error, most) > 1.0 - (double)q->draw) || !shade_faces(q->shade.point, cap.wi))
        return;
    q->shade.is_area = false;
    q->shade.wi = cap.wi;
    q->shade.solid_angle_sr = cap.solid_angle_sr;
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = cap.irradiance[c];
}

/* dark: which of its rays met something. */
static bool is_lit(const world *w, const hit *h, light_query *q, const trace_ray *rays, const bool *dark)
{
    if (!shade_is_area(&q->shade))
        return q->shadow.ray_count == 0 || !dark[0];
    if (!area_shadow_end(&q->shadow, q->shade.point, rays, dark, &q->shade.area))
        return false;
    if (w->cap_error > 0.0)
        take_cap(w, h, q);
    return true;
}

static void count_evaluation(const shade_query *q, ray_counts *counts)
{
    for (int i = 0; i < shade_layers(q->point); ++i)
        ++*(q->point->layers[i].counts ? &counts->glint_evals : &counts->smooth_evals);
    if (EFFECT_FACET_LIMIT && q->value.over_limit) {
        ++counts->over_limit;
        counts->most_facets = fmaxf(counts->most_facets, q->value.facet_count);
    }
}

/* facets: of the light that is brightest so far; NULL: no one asks. */
static void add_up(const light_query *q, const float throughput[3], radiance *sum, direct_facets *facets)
{
    const glint_value *const value = &q->shade.value;
    float total = 0.0F;
    for (int c = 0; c < 3; ++c) {
        const float incoming = throughput[c] * q->irradiance[c];
        sum->discrete[c] += incoming * q->weight * value->rgb[c];
        sum->smooth[c] += incoming * q->weight * value->smooth[c];
        total += incoming * value->smooth[c];
    }
    if (facets != NULL && total > facets->brightest)
        *facets = (direct_facets){ value->facet_count, value->lit_probability, total };
}

/* One light at one point, from its ray to its sum. */
static void add_light(const world *w, const hit *h, light_query *q, const trace_ray *rays, const float throughput[3],
                      radiance *sum, direct_facets *facets, ray_counts *counts)
{
    shade_query *const s = &q->shade;
    bool dark[AREA_MOST_RAYS] = { false };
    for (int i = 0; i < q->shadow.ray_count; ++i)
        dark[i] = trace_occluded(w->trace, &rays[i]);
    if (!is_lit(w, h, q, rays, dark))
        return;
    if (shade_is_area(s))
        shade_eval_area(s->point, &s->area, &s->value);
    else
        shade_eval(s->point, s->wi, s->solid_angle_sr, &s->value);
    count_evaluation(s, counts);
    add_up(q, throughput, sum, facets);
}

/* Lights that stand for all of them, of more than MOST_LIGHTS. */
static int choose(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                  chosen_light chosen[MOST_LIGHTS])
{
    return lights_choose(w->light_tree, p, h->position, random, dimension + (uint32_t)w->light_count, chosen);
}

void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    chosen_light chosen[MOST_LIGHTS];
    light_query q;
    trace_ray rays[AREA_MOST_RAYS];
    const bool is_any = EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS;
    const int count = is_any ? choose(w, h, p, random, dimension, chosen) : w->light_count;
    for (int i = 0; i < count; ++i) {
        const int index = is_any ? chosen[i].index : i;
        if (!gather_light(w, h, p, random, dimension + (uint32_t)index, &w->lights[index], facets != NULL, &q, rays,
                          counts))
            continue;
        if (is_any)
            q.weight = 1.0F / chosen[i].probability;
        add_light(w, h, &q, rays, throughput, sum, facets, counts);
    }
}

/* ---- many points ---- */

/* A light that stands for `weight` lights, at one of the points. */
static void gather_at(const world *w, const direct_point *p, uint32_t dimension, int index, float weight,
                      direct_scratch *s, ray_counts *counts)
{
    light_query *const q = &s->queries[s->query_count];
    if (!gather_light(w, &p->vertex->hit, &p->vertex->point, p->random, dimension + (uint32_t)index, &w->lights[index],
                      p->facets != NULL, q, &s->rays[s->ray_count], counts))
        return;
    q->to = p;
    q->weight = weight;
    q->first_ray = s->ray_count;
    s->ray_count += q->shadow.ray_count;
    ++s->query_count;
}

/* Light by light, so that rays to one light run side by side. */
static void gather_all(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                       ray_counts *counts)
{
    for (int i = 0; i < w->light_count; ++i)
        for (int k = 0; k < count; ++k)
            gather_at(w, &points[k], dimension, i, 1.0F, s, counts);
}

static void gather_chosen(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                          ray_counts *counts)
{
    for (int k = 0; k < count; ++k) {
        const direct_point *const p = &points[k];
        chosen_light chosen[MOST_LIGHTS];
        const int chosen_count = choose(w, &p->vertex->hit, &p->vertex->point, p->random, dimension, chosen);
        for (int i = 0; i < chosen_count; ++i)
            gather_at(w, p, dimension, chosen[i].index, 1.0F / chosen[i].probability, s, counts);
    }
}

/* Lists those that something is left of. */
static int list_lit(const world *w, direct_scratch *s)
{
    int count = 0;
    for (int i = 0; i < s->query_count; ++i) {
        light_query *const q = &s->queries[i];
        if (!is_lit(w, &q->to->vertex->hit, q, &s->rays[q->first_ray], &s->dark[q->first_ray]))
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
    s->query_count = s->ray_count = 0;
    if (EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS)
        gather_chosen(w, points, count, dimension, s, counts);
    else
        gather_all(w, points, count, dimension, s, counts);
    trace_occluded_many(w->trace, s->rays, s->ray_count, s->dark);
    const int lit = list_lit(w, s);
    shade_eval_many(s->shades, lit);
    for (int i = 0; i < lit; ++i) {
        const direct_point *const to = s->lit[i]->to;
        count_evaluation(s->shades[i], counts);
        add_up(s->lit[i], to->throughput, to->light, to->facets);
    }
}

void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts)
{
    const int lights = EFFECT_MANY_LIGHTS && w->light_count > MOST_LIGHTS ? MOST_LIGHTS : w->light_count;
    if (lights == 0)
        return;
    const int most = SHADE_MOST_QUERIES / lights;
    for (int k = 0; k < count; k += most)
        add_some(w, &points[k], count - k < most ? count - k : most, dimension, s, counts);
}
