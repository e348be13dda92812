/* Two estimates of the same light, weighted by the balance heuristic (Veach and Guibas 1995): where the map is bright,
 * and where the surface reflects. */
#include "preview/surroundings.h"

#include "preview/rig.h"

static shade_surroundings surroundings_of(const world *w, const environment_light *from)
{
    return (shade_surroundings){ from->wi, from->pdf, from->solid_angle_sr, (float)(w->glint_side * w->glint_side) };
}

static void count_evaluation(const shade_point *p, const glint_value *value, ray_counts *counts)
{
    for (int i = 0; i < shade_layers(p); ++i)
        ++*(p->layers[i].counts ? &counts->glint_evals : &counts->smooth_evals);
    if (value->over_limit) {
        ++counts->over_limit;
        counts->most_facets = fmaxf(counts->most_facets, value->facet_count);
    }
}

static void add_value(radiance *sum, const float throughput[3], const float incoming[3], const glint_value *value)
{
    for (int c = 0; c < 3; ++c) {
        sum->discrete[c] += throughput[c] * incoming[c] * value->rgb[c];
        sum->smooth[c] += throughput[c] * incoming[c] * value->smooth[c];
    }
}

/* Where no other light tells of the facets, the environment does. */
static void note_facets(direct_facets *facets, const glint_value *value)
{
    if (facets != NULL && facets->count == 0.0F)
        *facets = (direct_facets){ value->facet_count, value->lit_probability, 0.0F };
}

/* ---- one direction of the light's own: ask for a ray, and answer where it passes ---- */

static void answer(const float rgb[3], const glint_value *value, const shade_point *p, const float throughput[3],
                   radiance *sum, direct_facets *facets, ray_counts *counts)
{
    count_evaluation(p, value, counts);
    add_value(sum, throughput, rgb, value);
    note_facets(facets, value);
}

/* u: the sampler's pair of that dimension. False: it brings nothing. */
typedef bool asks(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                  const double u[2], surroundings_query *q, trace_ray *ray);

static bool ask_environment(const world *w, const hit *h, const shade_point *p, const sampler *random,
                            uint32_t dimension, const double u[2], surroundings_query *q, trace_ray *ray)
{
    environment_light from;
    if (!environment_sample(w->environment, u, &from) || !shade_faces(p, from.wi))
        return false;
    *ray = (trace_ray){ .origin = hit_leave(h, h->shadow_origin),
                        .direction = from.wi,
                        .far = (double)INFINITY,
                        .random = sampler_bits(random, dimension) };
    q->from = surroundings_of(w, &from);
    for (int c = 0; c < 3; ++c)
        q->rgb[c] = from.rgb[c];
    return true;
}

static void add_one(const world *w, asks *ask, const hit *h, const shade_point *p, const sampler *random,
                    uint32_t dimension, const float throughput[3], radiance *sum, direct_facets *facets,
                    ray_counts *counts)
{
    surroundings_query q;
    trace_ray ray;
    double u[2];
    sampler_pair(random, dimension, u);
    if (!ask(w, h, p, random, dimension, u, &q, &ray))
        return;
    ++counts->shadow_rays;
    if (trace_occluded(w->trace, &ray))
        return;
    glint_value value;
    shade_eval_surroundings(p, &q.from, &value);
    answer(q.rgb, &value, p, throughput, sum, facets, counts);
}

/* Lists the queries that nothing is in the way of. */
static int list_lit(surroundings_scratch *s, int asked)
{
    int lit = 0;
    for (int i = 0; i < asked; ++i) {
        if (s->dark[i])
            continue;
        s->lit[lit] = &s->queries[i].to->vertex->point;
        s->answers[lit] = &s->queries[i];
        s->from[lit++] = &s->queries[i].from;
    }
    return lit;
}

static void add_many(const world *w, asks *ask, const direct_point *points, int count, uint32_t dimension,
                     surroundings_scratch *s, ray_counts *counts)
{
    pair_batch *const pairs = &s->pairs;
    int asked = 0;
    for (int i = 0; i < count; ++i)
        pair_batch_set(pairs, i, points[i].random);
    pair_batch_draw(w->kernels, dimension, count, pairs);
    for (int i = 0; i < count; ++i) {
        const direct_point *const p = &points[i];
        const double u[2] = { pairs->u[0][i], pairs->u[1][i] };
        if (ask(w, &p->vertex->hit, &p->vertex->point, p->random, dimension, u, &s->queries[asked], &s->rays[asked]))
            s->queries[asked++].to = p;
    }
    counts->shadow_rays += (uint64_t)asked;
    trace_occluded_many(w->trace, s->rays, asked, s->dark);
    const int lit = list_lit(s, asked);
    shade_eval_surroundings_many(s->lit, s->from, lit, s->values);
    for (int i = 0; i < lit; ++i) {
        const direct_point *const p = s->answers[i]->to;
        answer(s->answers[i]->rgb, &s->values[i], s->lit[i], p->throughput, p->light, p->facets, counts);
    }
}

void add_surroundings(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    if (EFFECT_ENVIRONMENT && w->environment != NULL)
        add_one(w, ask_environment, h, p, random, dimension, throughput, sum, facets, counts);
}

void add_surroundings_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              surroundings_scratch *s, ray_counts *counts)
{
    if (EFFECT_ENVIRONMENT && w->environment != NULL)
        add_many(w, ask_environment, points, count, dimension, s, counts);
}

void add_escaped_light(const world *w, const shade_point *p, const shade_direction *found, const float throughput[3],
                       radiance *sum, ray_counts *counts)
{
    environment_light from = { .wi = found->wi };
    glint_value value;
    if (w->environment == NULL)
        sky_radiance(&w->sky, found->wi, from.rgb);
    else
        environment_from(w->environment, found->wi, &from);
    if (!(from.rgb[0] + from.rgb[1] + from.rgb[2] > 0.0F))
        return;
    const shade_surroundings s = surroundings_of(w, &from);
    shade_eval_found(p, &s, found, &value);
    if (s.solid_angle_sr > 0.0F)
        count_evaluation(p, &value, counts);
    add_value(sum, throughput, from.rgb, &value);
}

/* ---- glowing triangles ---- */

/* Shadow rays end this far before the triangle, relative to the distance: it is a surface, too. */
#define SHORT_OF 1e-4

/* Of a point of a triangle as seen from a distance: a density per area becomes one per solid angle. */
static shade_surroundings glow_of(const world *w, const emitter_point *from, vec3 wi, double distance)
{
    const double cosine = fabs(v3_dot(wi, from->normal));
    const double area_per_steradian = distance * distance / fmax(cosine, 1e-12);
    return (shade_surroundings){ wi, (float)(from->pdf_per_area * area_per_steradian),
                                 (float)(from->area_m2 / area_per_steradian), (float)(w->glint_side * w->glint_side) };
}

static bool ask_glow(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                     const double u[2], surroundings_query *q, trace_ray *ray)
{
    emitter_point from;
    emitters_sample(w->emitters, u, &from);
    *ray = (trace_ray){ .origin = hit_leave(h, h->shadow_origin), .random = sampler_bits(random, dimension) };
    const vec3 towards = v3_sub(from.position, ray->origin);
    const double distance = v3_length(towards);
    ray->direction = v3_normalize(towards);
    ray->far = distance * (1.0 - SHORT_OF);
    if (!(distance > 0.0) || (!from.two_sided && v3_dot(ray->direction, from.normal) >= 0.0) ||
        !shade_faces(p, ray->direction))
        return false;
    shade_emission(&w->shader, w->geometry, &from.at, q->rgb);
    q->from = glow_of(w, &from, ray->direction, distance);
    return true;
}

void add_glow(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
              const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts)
{
    if (EFFECT_EMITTERS && w->emitters != NULL)
        add_one(w, ask_glow, h, p, random, dimension, throughput, sum, facets, counts);
}

void add_glow_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                      surroundings_scratch *s, ray_counts *counts)
{
    if (EFFECT_EMITTERS && w->emitters != NULL)
        add_many(w, ask_glow, points, count, dimension, s, counts);
}

bool add_found_glow(const world *w, const shade_point *p, const shade_direction *found, const trace_hit *at,
                    const hit *h, const float emission[3], const float throughput[3], radiance *sum, ray_counts *counts)
{
    emitter_point from;
    glint_value value;
    if (!emitters_find(w->emitters, at, &from))
        return false;
    const shade_surroundings s = glow_of(w, &from, found->wi, h->distance);
    shade_eval_found(p, &s, found, &value);
    if (s.solid_angle_sr > 0.0F)
        count_evaluation(p, &value, counts);
    add_value(sum, throughput, emission, &value);
    return true;
}
