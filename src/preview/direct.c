/* Direct light in three steps: gather the lights that a point sees, evaluate the surface for each, add them up. Of many
 * points the shadow rays run side by side, and so does the evaluation. */
#include "preview/direct.h"

#include <math.h>

#include "preview/area_shadow.h"

/* Lights that are gathered at a time. */
#define CHUNK 16

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
    q->shade.point = p;
    q->shade.is_area = is_round || light_is_area(l);
    if (q->shade.is_area)
        return area_light_reaches(w, h, p, l, &view, random, dimension, thorough, &q->shade.area, counts);
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
        sum->discrete[c] += incoming * value->rgb[c];
        sum->smooth[c] += incoming * value->smooth[c];
        total += incoming * value->smooth[c];
    }
    if (facets != NULL && total > facets->brightest)
        *facets = (direct_facets){ value->facet_count, value->lit_probability, total };
}

void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    light_query q;
    for (int i = 0; i < w->light_count; ++i) {
        shade_query *const s = &q.shade;
        if (!gather_light(w, h, p, random, dimension + (uint32_t)i, &w->lights[i], facets != NULL, &q, counts) ||
            (q.waits && trace_occluded(w->trace, &q.shadow)))
            continue;
        if (s->is_area)
            shade_eval_area(p, &s->area, &s->value);
        else
            shade_eval(p, s->wi, s->solid_angle_sr, &s->value);
        count_evaluation(s, counts);
        add_up(&q, throughput, sum, facets);
    }
}

/* ---- many points ---- */

/* Light by light, so that rays to one light run side by side. */
static int gather(const world *w, const direct_point *points, int count, uint32_t dimension, int first, int end,
                  light_query *queries, ray_counts *counts)
{
    int found = 0;
    for (int i = first; i < end; ++i)
        for (int k = 0; k < count; ++k) {
            const direct_point *const p = &points[k];
            queries[found].to = p;
            found += gather_light(w, p->hit, p->point, p->random, dimension + (uint32_t)i, &w->lights[i], true,
                                  &queries[found], counts);
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

static void add_chunk(const world *w, const direct_point *points, int count, uint32_t dimension, int first, int end,
                      direct_scratch *s, ray_counts *counts)
{
    static const float all[3] = { 1.0F, 1.0F, 1.0F };
    const int found = gather(w, points, count, dimension, first, end, s->queries, counts);
    const int lit = trace_shadows(w, s->queries, found, s->lit);
    for (int i = 0; i < lit; ++i)
        s->shades[i] = &s->lit[i]->shade;
    shade_eval_many(s->shades, lit);
    for (int i = 0; i < lit; ++i) {
        count_evaluation(s->shades[i], counts);
        add_up(s->lit[i], all, s->lit[i]->to->light, s->lit[i]->to->facets);
    }
}

void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts)
{
    const int lights = w->light_count < CHUNK ? w->light_count : CHUNK;
    if (lights == 0)
        return;
    const int most = SHADE_MOST_QUERIES / lights;
    for (int k = 0; k < count; k += most) {
        const int some = count - k < most ? count - k : most;
        for (int first = 0; first < w->light_count; first += CHUNK)
            add_chunk(w, &points[k], some, dimension, first,
                      first + CHUNK < w->light_count ? first + CHUNK : w->light_count, s, counts);
    }
}
