/* A light of real size for a model that knows only single directions: points of the light, and directions of the model,
 * weighted by multiple importance. */
#include "model/area_points.h"

#include <string.h>

#include "light/scatter.h"
#include "math/float_bits.h"
#include "math/real.h"
#include "model/area.h"

#define GLINT_LANES 1
#include "math/hash.h"

/* SIDE * SIDE strata on the light and as many for the model: taste. docs/lights.md states the noise. */
enum { SIDE = 4, POINTS = SIDE * SIDE };

typedef struct point_sum {
    const model_query *q;
    const area_light *light;
    float share; /* solid angle of the light's share for one point, sr */
    double rgb[3], smooth[3];
    float facet_count;
} point_sum;

/* The same for the same pixel, whatever draws it: hashed from what the query says. */
static uint32_t seed_of(const model_query *q)
{
    uint32_t h = q->material->options.seed;
    if (q->footprint) {
        uint64_t place[2];
        memcpy(&place[0], &q->footprint->u, sizeof(place[0]));
        memcpy(&place[1], &q->footprint->v, sizeof(place[1]));
        h = hash_full(h + q->footprint->seed * HASH_X);
        for (int i = 0; i < 2; i++) {
            h = hash_full(h ^ (uint32_t)place[i]);
            h = hash_full(h ^ (uint32_t)(place[i] >> 32));
        }
    }
    h = hash_full(h ^ bits_of_float(q->wo.x));
    return hash_full(h ^ bits_of_float(q->wo.y));
}

/* A uniform in stratum i of n, below 1. */
static float stratified(uint32_t *state, int i, int n)
{
    *state = hash_full(*state + HASH_Z);
    const float u = ((float)i + (float)(*state >> 8) * (1.0F / 16777216.0F)) / (float)n;
    return u < 0.99999994F ? u : 0.99999994F;
}

/* f cos_i at wi, and the density with which the model draws it. */
static float look(point_sum *s, vec3 wi, glint_value *value)
{
    const struct model *model = s->q->material->model;
    model_query one = *s->q;
    one.area_light = NULL;
    one.solid_angle_sr = s->share;
    one.wi = wi;
    model->eval(&one, value);
    s->facet_count = value->facet_count;
    one.solid_angle_sr = 0.0F;
    const float density = model->pdf(&one);
    return is_below(density, 1e30F) && density > 0.0F ? density : 0.0F;
}

/* Balance heuristic: both kinds of points have as many, so a direction weighs 1 / (sum of densities). */
static void add(point_sum *s, const glint_value *value, double density)
{
    if (!(density > 0.0))
        return;
    const double weight = 1.0 / (POINTS * density);
    for (int c = 0; c < 3; c++) {
        s->rgb[c] += weight * (double)clamp_to(value->rgb[c], 0.0F, 1e30F);
        s->smooth[c] += weight * (double)clamp_to(value->smooth[c], 0.0F, 1e30F);
    }
}

static void add_light_point(point_sum *s, float u1, float u2)
{
    const vec3d w = scatter_direction(s->light, (double)u1, (double)u2);
    const vec3 wi = vec3d_narrow(w);
    if (!(wi.z > 0.0F))
        return;
    glint_value value;
    const float model = look(s, wi, &value);
    add(s, &value, (double)model + scatter_density(s->light, w));
}

static void add_model_direction(point_sum *s, const float random[3])
{
    model_query draw = *s->q;
    draw.area_light = NULL;
    glint_sample sample;
    if (!draw.material->model->sample(&draw, random, &sample))
        return;
    const vec3 wi = vec3_from(sample.wi);
    const vec3d w = vec3d_of(wi);
    if (!(wi.z > 0.0F) || !area_contains(s->light, w))
        return;
    glint_value value;
    const float model = look(s, wi, &value);
    add(s, &value, (double)model + scatter_density(s->light, w));
}

void area_points_eval(const model_query *q, glint_value *value)
{
    area_light light;
    *value = (glint_value){ 0 };
    if (!area_see(q, &light) || !area_measure(&light))
        return;
    const double size = scatter_density(&light, light.middle);
    point_sum s = { q, &light, (float)real_min(1.0 / (POINTS * real_max(size, 1e-9)), 6.2), { 0.0 }, { 0.0 }, 0.0F };
    uint32_t state = seed_of(q);
    for (int i = 0; i < POINTS; i++) {
        const float x = stratified(&state, i % SIDE, SIDE);
        add_light_point(&s, x, stratified(&state, i / SIDE, SIDE));
    }
    /* The lobe first, then its two dimensions in strata. */
    for (int i = 0; i < POINTS; i++) {
        float random[3];
        random[0] = stratified(&state, i * 5 % POINTS, POINTS);
        random[1] = stratified(&state, i % SIDE, SIDE);
        random[2] = stratified(&state, i / SIDE, SIDE);
        add_model_direction(&s, random);
    }
    area_value whole;
    area_eval(q, &whole);
    const float seen = 1.0F - clamp_to(q->area_light->hidden, 0.0F, 1.0F);
    for (int c = 0; c < 3; c++) {
        value->rgb[c] = seen * (float)s.rgb[c];
        value->smooth[c] = seen * (float)s.smooth[c];
    }
    value->facet_count = s.facet_count;
    value->lit_probability = whole.lit_probability;
}
