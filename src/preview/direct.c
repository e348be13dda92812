/* Direct light in three steps: gather the lights that the point sees, evaluate the surface for each, add them up. */
#include "preview/direct.h"

#include <math.h>

#include "preview/area_shadow.h"

/* Lights that are gathered at a time. */
#define CHUNK 16

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

/* Those of a chunk of lights that light the point. */
static int gather(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                  int first, bool thorough, light_query queries[CHUNK], ray_counts *counts)
{
    int count = 0;
    for (int i = first; i < w->light_count && i < first + CHUNK; ++i) {
        light_query *const q = &queries[count];
        const light *const l = &w->lights[i];
        if (!light_see(l, h->position, &q->view))
            continue;
        const bool is_round = q->view.sine > 0.0 && shade_tells_shape(p, q->view.wi, q->view.sine);
        q->is_area = light_is_area(l) || is_round;
        if (is_round)
            for (int c = 0; c < 3; ++c)
                q->view.irradiance[c] *= (float)light_radiance_per_irradiance(&q->view);
        const bool lit =
            q->is_area
                ? area_light_reaches(w, h, p, l, &q->view, random, dimension + (uint32_t)i, thorough, &q->area, counts)
                : shade_faces(p, q->view.wi) && !in_shadow(w, h, l, &q->view, random, dimension + (uint32_t)i, counts);
        count += lit;
    }
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

void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    light_query queries[CHUNK];
    float brightest = 0.0F;
    for (int first = 0; first < w->light_count; first += CHUNK) {
        const int count = gather(w, h, p, random, dimension, first, facets != NULL, queries, counts);
        evaluate(p, queries, count, counts);
        for (int i = 0; i < count; ++i) {
            const light_query *const q = &queries[i];
            float total = 0.0F;
            for (int c = 0; c < 3; ++c) {
                const float incoming = throughput[c] * q->view.irradiance[c];
                sum->discrete[c] += incoming * q->value.rgb[c];
                sum->smooth[c] += incoming * q->value.smooth[c];
                total += incoming * q->value.smooth[c];
            }
            if (facets != NULL && total > brightest) {
                brightest = total;
                *facets = (direct_facets){ q->value.facet_count, q->value.lit_probability };
            }
        }
    }
}
