/* The smooth reflection of a light of real size, and the chance that a facet reflects it to the viewer. */
#include "model/area.h"

#define GLINT_LANES 1
#include "math/float_bits.h"
#include "math/real.h"
#include "model/area_facets.h"
#include "model/area_lit.h"
#include "model/lobe.h"

static void find_lit(const model_query *q, const area_facets *f, area_value *value)
{
    const lobe_query lobe = { .alpha_x = q->surface->alpha_x, .alpha_y = q->surface->alpha_y };
    const area_halves halves = { (float)f->facets, (float)f->x, (float)f->y, (float)f->projected, (float)f->cap };
    const area_lit lit = area_lit_of(&q->material->options, &lobe, q->total_area, &halves);
    value->h = (vec3){ lit.h.x, lit.h.y, lit.h.z };
    value->cap = lit.cap;
    value->lit_probability = lit.p;
}

/* ---- the base ---- */

/* The mean over the light of what the base reflects, by its share of the light: the form factor is exact, the albedo
 * hardly changes with the angle. */
static void integrate_base(const model_query *q, const area_light *light, area_value *value)
{
    const float *diffuse = q->surface->diffuse;
    if (!(diffuse[0] > 0.0F || diffuse[1] > 0.0F || diffuse[2] > 0.0F))
        return;
    area_light measured = *light;
    if (!area_measure(&measured))
        return;
    light = &measured;
    /* Gauss's points with two nodes, along the boundary and from the middle outwards. */
    static const double at[2] = { 0.21132486540518712, 0.78867513459481288 };
    double weight = 0.0, sum[3] = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < area_piece_count(light); i++)
        for (int k = 0; k < 4; k++) {
            vec3d rim, derivative;
            area_boundary(light, i, at[k & 1], &rim, &derivative);
            const double s = at[k >> 1];
            const vec3d x = vec3d_mad(vec3d_scale(light->middle, 1.0 - s), rim, s);
            const double length2 = vec3d_dot(x, x), height = x.z / sqrt(length2);
            /* Solid angle s |middle . (rim x rim')| / |x|^3 of the point's share, times the cosine. */
            const double w = s * fabs(vec3d_dot(light->middle, vec3d_cross(rim, derivative))) / length2 * x.z / length2;
            weight += w;
            for (int c = 0; c < 3; c++)
                sum[c] += w * (double)lobe_base_albedo(q, c, (float)real_min(real_max(height, 0.0), 1.0));
        }
    for (int c = 0; c < 3 && weight > 0.0; c++)
        value->diffuse[c] = (float)(light->moment.z * (1.0 / REAL_PI) * sum[c] / weight);
}

static float between(float a, float b, float share)
{
    return a + share * (b - a);
}

void area_mix(area_value *value, const area_value *other, float share)
{
    for (int c = 0; c < 3; c++) {
        value->specular[c] = between(value->specular[c], other->specular[c], share);
        value->diffuse[c] = between(value->diffuse[c], other->diffuse[c], share);
    }
    value->lit_probability = between(value->lit_probability, other->lit_probability, share);
    value->h = vec3_add(vec3_scale(value->h, 1.0F - share), vec3_scale(other->h, share));
    value->cap = between(value->cap, other->cap, share);
}

/* Of a light that the point sees. */
static void eval_seen(const model_query *q, const area_light *light, int is_exact, area_value *value)
{
    *value = (area_value){ { 0.0F }, { 0.0F }, 0.0F, { 0.0F, 0.0F, 1.0F }, 0.0F };
    area_facets facets;
    (is_exact ? area_facets_exact : area_facets_fast)(q, light, &facets);
    find_lit(q, &facets, value);
    integrate_base(q, light, value);
    const float seen = 1.0F - clamp_to(q->area_light->hidden, 0.0F, 1.0F);
    /* The cap stays whole: it sets the angular grid, and neighbouring samples that disagree a little on what is hidden
     * must count the same facets. */
    value->lit_probability *= seen;
    for (int c = 0; c < 3; c++) {
        value->specular[c] = seen * q->material->options.coverage * (float)facets.specular[c];
        value->diffuse[c] *= seen;
    }
}

void area_eval_any(const model_query *q, area_value *value)
{
    area_light light;
    *value = (area_value){ { 0.0F }, { 0.0F }, 0.0F, { 0.0F, 0.0F, 1.0F }, 0.0F };
    if (!area_see(q, &light))
        return;
    /* The table knows round roughness only; what rounding leaves between the two is none. */
    const float most = fmaxf(q->surface->alpha_x, q->surface->alpha_y);
    const int is_fast = q->material->options.area_light_method != GLINT_AREA_LIGHT_EXACT;
    const int is_exact = !is_fast || fabsf(q->surface->alpha_x - q->surface->alpha_y) > 1e-4F * most;
    /* Transformed cosines take fewer points than cells do, the exact integral far more. */
    const float left = is_fast && is_exact ? area_eval_parts(q, &light, value) : 1.0F;
    if (!(left > 0.0F))
        return;
    area_value other;
    eval_seen(q, &light, is_exact, &other);
    if (left < 1.0F)
        area_mix(value, &other, left);
    else
        *value = other;
}

void area_eval(const model_query *q, area_value *value)
{
    const float left = area_eval_plain(q, value);
    if (!(left > 0.0F))
        return;
    area_value other;
    area_eval_any(q, &other);
    if (left < 1.0F)
        area_mix(value, &other, left);
    else
        *value = other;
}
