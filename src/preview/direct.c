/* Direct light in three steps: gather the lights that a point sees, evaluate the surface for each, add them up. Of many
 * points the shadow rays run side by side, and so does the evaluation. */
#include "preview/direct.h"

#include <math.h>

#include "preview/area_shadow.h"
#include "preview/choose_lights.h"
#include "preview/hash.h"

/* The ray that a cap waits for, towards a place of the light. */
static void aim(const world *w, const hit *h, const light *l, const light_view *view, const sampler *random,
                uint32_t dimension, trace_ray *ray, ray_counts *counts)
{
    double u[2] = { 0.0, 0.0 };
    ++counts->shadow_rays;
    *ray = (trace_ray){ .origin = hit_leave(h, h->shadow_origin) };
    if (w->is_blended)
        ray->random = sampler_bits(random, dimension);
    if (light_is_soft(l))
        sampler_pair(random, dimension, u);
    light_pick(l, view, ray->origin, u, &ray->direction, &ray->far);
}

double direct_cap_error(const light *l, const shade_point *p, vec3 position, light_view *cap)
{
    if (light_is_area(l) ? !light_see_round(l, position, cap) : !light_see(l, position, cap) || !(cap->sine > 0.0))
        return (double)INFINITY;
    return shade_cap_error(p, cap->wi, cap->sine) + light_round_error(l, cap);
}

/* A shape that all of the point sees becomes a cap where the view allows that. Up to half of the error that may be all
 * samples take the cap, beyond it ever fewer, so that no seam shows where shapes begin. */
static void take_cap(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                     const light *l, light_query *q)
{
    light_view cap;
    if (q->shade.area.hidden > 0.0F)
        return;
    const double error = direct_cap_error(l, p, h->position, &cap), most = w->cap_error;
    if (!(error < most) || !shade_faces(p, cap.wi))
        return;
    if (2.0 * error > most) {
        const double draw = (double)hash_uniform(hash_mix(sampler_bits(random, dimension)));
        if (2.0 * error > most * (1.0 + draw))
            return;
    }
    q->shade.is_area = false;
    q->shade.wi = cap.wi;
    q->shade.solid_angle_sr = cap.solid_angle_sr;
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = cap.irradiance[c];
}

/* False: the light does not reach the point, and nothing has to be asked for it. */
static bool gather_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                         const light *l, bool thorough, light_query *q, ray_counts *counts)
{
    light_view view;
    if (!light_see(l, h->position, &view))
        return false;
    const bool is_round = view.sine > 0.0 && shade_tells_shape(p, view.wi, view.sine);
    const float scale = is_round ? (float)light_radiance_per_irradiance(&view) : 1.0F;
    for (int c = 0; c < 3; ++c)
        q->irradiance[c] = view.irradiance[c] * scale;
    q->waits = false;
    q->weight = 1.0F;
    q->shade.point = p;
    q->shade.is_area = is_round || light_is_area(l);
    if (q->shade.is_area) {
        if (!area_light_reaches(w, h, p, l, &view, random, dimension, thorough, &q->shade.area, counts))
            return false;
        if (w->cap_error > 0.0)
            take_cap(w, h, p, random, dimension, l, q);
        return true;
    }
    if (!shade_faces(p, view.wi))
        return false;
    q->shade.wi = view.wi;
    q->shade.solid_angle_sr = view.solid_angle_sr;
    q->waits = !l->unshadowed;
    if (q->waits)
        aim(w, h, l, &view, random, dimension, &q->shadow, counts);
    return true;
}

static void count_evaluation(const shade_query *q, ray_counts *counts)
{
    for (int i = 0; i < q->point->layer_count; ++i)
        ++*(q->point->layers[i].counts ? &counts->glint_evals : &counts->smooth_evals);
    if (q->value.over_limit) {
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
static void add_light(const world *w, light_query *q, const float throughput[3], radiance *sum, direct_facets *facets,
                      ray_counts *counts)
{
    shade_query *const s = &q->shade;
    if (q->waits && trace_occluded(w->trace, &q->shadow))
        return;
    if (s->is_area)
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
    const bool is_any = w->light_count > MOST_LIGHTS;
    const int count = is_any ? choose(w, h, p, random, dimension, chosen) : w->light_count;
    for (int i = 0; i < count; ++i) {
        const int index = is_any ? chosen[i].index : i;
        if (!gather_light(w, h, p, random, dimension + (uint32_t)index, &w->lights[index], facets != NULL, &q, counts))
            continue;
        if (is_any)
            q.weight = 1.0F / chosen[i].probability;
        add_light(w, &q, throughput, sum, facets, counts);
    }
}

/* ---- many points ---- */

static int gather_at(const world *w, const direct_point *p, uint32_t dimension, int index, light_query *q,
                     ray_counts *counts)
{
    q->to = p;
    return gather_light(w, p->hit, p->point, p->random, dimension + (uint32_t)index, &w->lights[index], true, q,
                        counts);
}

/* Light by light, so that rays to one light run side by side. */
static int gather_all(const world *w, const direct_point *points, int count, uint32_t dimension, light_query *queries,
                      ray_counts *counts)
{
    int found = 0;
    for (int i = 0; i < w->light_count; ++i)
        for (int k = 0; k < count; ++k)
            found += gather_at(w, &points[k], dimension, i, &queries[found], counts);
    return found;
}

static int gather_chosen(const world *w, const direct_point *points, int count, uint32_t dimension,
                         light_query *queries, ray_counts *counts)
{
    int found = 0;
    for (int k = 0; k < count; ++k) {
        const direct_point *const p = &points[k];
        chosen_light chosen[MOST_LIGHTS];
        const int chosen_count = choose(w, p->hit, p->point, p->random, dimension, chosen);
        for (int i = 0; i < chosen_count; ++i) {
            if (!gather_at(w, p, dimension, chosen[i].index, &queries[found], counts))
                continue;
            queries[found++].weight = 1.0F / chosen[i].probability;
        }
    }
    return found;
}

/* Leaves those in the list that nothing stands before. */
static int trace_shadows(const world *w, light_query *queries, int count, light_query **lit)
{
    int lit_count = 0;
    for (int first = 0; first < count; first += TRACE_PACKET) {
        const trace_ray *rays[TRACE_PACKET] = { NULL };
        for (int i = first; i < count && i < first + TRACE_PACKET; ++i)
            rays[i - first] = queries[i].waits ? &queries[i].shadow : NULL;
        const uint32_t dark = trace_occluded_packet(w->trace, rays);
        for (int i = first; i < count && i < first + TRACE_PACKET; ++i)
            if (!(dark >> (i - first) & 1U))
                lit[lit_count++] = &queries[i];
    }
    return lit_count;
}

static const float whole[3] = { 1.0F, 1.0F, 1.0F };

/* Points of at most SHADE_MOST_QUERIES lights together. */
static void add_some(const world *w, const direct_point *points, int count, uint32_t dimension, direct_scratch *s,
                     ray_counts *counts)
{
    const int found = w->light_count > MOST_LIGHTS ? gather_chosen(w, points, count, dimension, s->queries, counts)
                                                   : gather_all(w, points, count, dimension, s->queries, counts);
    const int lit = trace_shadows(w, s->queries, found, s->lit);
    for (int i = 0; i < lit; ++i)
        s->shades[i] = &s->lit[i]->shade;
    shade_eval_many(s->shades, lit);
    for (int i = 0; i < lit; ++i) {
        count_evaluation(s->shades[i], counts);
        add_up(s->lit[i], whole, s->lit[i]->to->light, s->lit[i]->to->facets);
    }
}

void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts)
{
    const int lights = w->light_count < MOST_LIGHTS ? w->light_count : MOST_LIGHTS;
    if (lights == 0)
        return;
    const int most = SHADE_MOST_QUERIES / lights;
    for (int k = 0; k < count; k += most)
        add_some(w, &points[k], count - k < most ? count - k : most, dimension, s, counts);
}
