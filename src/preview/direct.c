/* Direct light in three steps: gather the lights that the point sees, evaluate the surface for each, add them up. */
#include "preview/direct.h"

#include <math.h>

#include "preview/area_shadow.h"
#include "preview/choose_lights.h"

typedef struct light_query {
    light_view view;
    shade_area area; /* where the light is seen as a shape */
    bool is_area;
    glint_value value;
} light_query;

static bool in_shadow(const world *w, const hit *h, const light *l, const light_view *view, const sampler *random,
                      uint32_t dimension, ray_counts *counts)
{
    double u[2];
    if (l->unshadowed)
        return false;
    ++counts->shadow_rays;
    trace_ray ray = { .origin = hit_leave(h, h->shadow_origin), .random = sampler_bits(random, dimension) };
    sampler_pair(random, dimension, u);
    light_pick(l, view, ray.origin, u, &ray.direction, &ray.far);
    return trace_occluded(w->trace, &ray);
}

/* False: the light does not light the point. Inlined, so that scenes of a few lights do not pay for those of many. */
static inline __attribute__((always_inline)) bool gather_light(const world *w, const hit *h, const shade_point *p,
                                                               const sampler *random, uint32_t dimension, int index,
                                                               bool thorough, light_query *q, ray_counts *counts)
{
    const light *const l = &w->lights[index];
    if (!light_see(l, h->position, &q->view))
        return false;
    const bool is_round = q->view.sine > 0.0 && shade_tells_shape(p, q->view.wi, q->view.sine);
    q->is_area = light_is_area(l) || is_round;
    if (is_round)
        for (int c = 0; c < 3; ++c)
            q->view.irradiance[c] *= (float)light_radiance_per_irradiance(&q->view);
    dimension += (uint32_t)index;
    return q->is_area ? area_light_reaches(w, h, p, l, &q->view, random, dimension, thorough, &q->area, counts)
                      : shade_faces(p, q->view.wi) && !in_shadow(w, h, l, &q->view, random, dimension, counts);
}

static int gather(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                  bool thorough, light_query queries[MOST_LIGHTS], ray_counts *counts)
{
    int count = 0;
    for (int i = 0; i < w->light_count; ++i)
        count += gather_light(w, h, p, random, dimension, i, thorough, &queries[count], counts);
    return count;
}

static void evaluate(const shade_point *p, light_query *queries, int count, ray_counts *counts)
{
    for (int i = 0; i < count; ++i) {
        const glint_value *const value = &queries[i].value;
        if (queries[i].is_area)
            shade_eval_area(p, &queries[i].area, &queries[i].value);
        else
            shade_eval(p, queries[i].view.wi, queries[i].view.solid_angle_sr, &queries[i].value);
        if (value->over_limit) {
            ++counts->over_limit;
            counts->most_facets = fmaxf(counts->most_facets, value->facet_count);
        }
    }
    for (int i = 0; i < p->layer_count; ++i)
        *(p->layers[i].counts ? &counts->glint_evals : &counts->smooth_evals) += (uint64_t)count;
}

/* weights: what each stands for; NULL: for itself. */
static inline __attribute__((always_inline)) void add_up(const light_query *queries, const float *weights, int count,
                                                         const float throughput[3], radiance *sum,
                                                         direct_facets *facets)
{
    float brightest = 0.0F;
    for (int i = 0; i < count; ++i) {
        const light_query *const q = &queries[i];
        const float weight = weights != NULL ? weights[i] : 1.0F;
        float total = 0.0F;
        for (int c = 0; c < 3; ++c) {
            const float incoming = throughput[c] * q->view.irradiance[c];
            sum->discrete[c] += incoming * weight * q->value.rgb[c];
            sum->smooth[c] += incoming * weight * q->value.smooth[c];
            total += incoming * q->value.smooth[c];
        }
        if (facets != NULL && total > brightest) {
            brightest = total;
            *facets = (direct_facets){ q->value.facet_count, q->value.lit_probability };
        }
    }
}

/* Lights that stand for all of them. */
static void add_chosen_light(const world *w, const hit *h, const shade_point *p, const sampler *random,
                             uint32_t dimension, const float throughput[3], radiance *sum, direct_facets *facets,
                             ray_counts *counts)
{
    chosen_light chosen[MOST_LIGHTS];
    light_query queries[MOST_LIGHTS];
    float weights[MOST_LIGHTS];
    int count = 0;
    const int chosen_count =
        lights_choose(w->light_tree, p, h->position, random, dimension + (uint32_t)w->light_count, chosen);
    for (int i = 0; i < chosen_count; ++i) {
        weights[count] = 1.0F / chosen[i].probability;
        count += gather_light(w, h, p, random, dimension, chosen[i].index, facets != NULL, &queries[count], counts);
    }
    evaluate(p, queries, count, counts);
    add_up(queries, weights, count, throughput, sum, facets);
}

void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    if (w->light_count > MOST_LIGHTS) {
        add_chosen_light(w, h, p, random, dimension, throughput, sum, facets, counts);
        return;
    }
    light_query queries[MOST_LIGHTS];
    const int count = gather(w, h, p, random, dimension, facets != NULL, queries, counts);
    evaluate(p, queries, count, counts);
    add_up(queries, NULL, count, throughput, sum, facets);
}
