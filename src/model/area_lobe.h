/* A microfacet lobe at directions in lanes: what each adds to the integrals over a light. */
#ifndef MODEL_AREA_LOBE_H
#define MODEL_AREA_LOBE_H

#include "ndf/ndf_lanes.h"

typedef struct area_lobe {
    int is_ggx, is_schlick;
    vfloat3 wo;
    vfloat visible_o; /* wo.z + ndf_masked of wo */
    vfloat alpha_x, alpha_y, inverse_alpha_x, inverse_alpha_y, scale;
} area_lobe;

static inline area_lobe area_lobe_of(int is_ggx, int is_schlick, vfloat3 wo, vfloat visible_o, vfloat alpha_x,
                                     vfloat alpha_y)
{
    return (area_lobe){ .is_ggx = is_ggx,
                        .is_schlick = is_schlick,
                        .wo = wo,
                        .visible_o = visible_o,
                        .alpha_x = alpha_x,
                        .alpha_y = alpha_y,
                        .inverse_alpha_x = 1.0F / alpha_x,
                        .inverse_alpha_y = 1.0F / alpha_y,
                        .scale = 1.0F / (MATH_PI * alpha_x * alpha_y) };
}

/* What a direction adds, or many. */
typedef struct area_terms {
    vfloat reflected;       /* f cos theta_i with F = 1 */
    vfloat fresnel[2];      /* Schlick: the same times (1 - h.wi)^5; else times h.wi and its square */
    vfloat facets, x, y, z; /* of D / (4 h.wi), the same times h */
    vfloat cap;             /* half vectors, seen from above */
} area_terms;

static inline void area_add_terms(area_terms *sum, const area_terms *more)
{
    sum->reflected = sum->reflected + more->reflected;
    sum->fresnel[0] = sum->fresnel[0] + more->fresnel[0];
    sum->fresnel[1] = sum->fresnel[1] + more->fresnel[1];
    sum->facets = sum->facets + more->facets;
    sum->x = sum->x + more->x;
    sum->y = sum->y + more->y;
    sum->z = sum->z + more->z;
    sum->cap = sum->cap + more->cap;
}

static inline area_terms area_choose_terms(vmask m, const area_terms *a, const area_terms *b)
{
    return (area_terms){ choose(m, a->reflected, b->reflected),
                         { choose(m, a->fresnel[0], b->fresnel[0]), choose(m, a->fresnel[1], b->fresnel[1]) },
                         choose(m, a->facets, b->facets),
                         choose(m, a->x, b->x),
                         choose(m, a->y, b->y),
                         choose(m, a->z, b->z),
                         choose(m, a->cap, b->cap) };
}

/* D(h), for h of squared length h2. */
static inline vfloat area_density(const area_lobe *l, vfloat3 h, vfloat h2)
{
    const vfloat x = h.x * l->inverse_alpha_x, y = h.y * l->inverse_alpha_y, slope2 = x * x + y * y, z2 = h.z * h.z;
    if (l->is_ggx) {
        const vfloat t = h2 / (slope2 + z2); /* at most 1, for alpha is */
        return l->scale * t * t;
    }
    const vfloat exponent = slope2 / max_f(z2, splat(1e-24F)), inverse = h2 / max_f(z2, splat(1e-3F) * h2);
    return choose(less(exponent, splat(87.0F)), l->scale * inverse * inverse * exp_negative(-exponent), splat(0.0F));
}

/* G2 / (4 cos_o cos_i) (see ndf_correlated_masking), of unit directions. */
static inline vfloat area_masking(const area_lobe *l, vfloat3 w)
{
    const vfloat x = l->alpha_x * w.x, y = l->alpha_y * w.y, t = x * x + y * y;
    const vfloat from_o = l->visible_o * w.z, least = splat(1e-12F);
    if (!l->is_ggx)
        return 0.25F / max_f(from_o + beckmann_masked_at(sqrt_f(t), w.z) * l->wo.z, least);
    /* masked = t / 2 / (length + cos): one division for both. */
    const vfloat sum = sqrt_f(t + w.z * w.z) + w.z;
    return 0.25F * sum / max_f(from_o * sum + 0.5F * t * l->wo.z, least * sum);
}

/* Of the unit direction wi, z > 0, that stands for so many sr. */
static inline void area_terms_at(const area_lobe *l, vfloat3 wi, vfloat solid_angle, area_terms *out)
{
    const vfloat3 h = add_3(wi, l->wo);
    const vfloat h2 = max_f(dot_3(h, h), splat(1e-12F)), cosine = min_f(0.5F * sqrt_f(h2), splat(1.0F));
    const vfloat d = area_density(l, h, h2), unit = 0.5F / cosine, half_vectors = 0.5F * solid_angle * unit;
    out->reflected = solid_angle * wi.z * d * area_masking(l, wi);
    const vfloat m = 1.0F - cosine, m2 = m * m;
    out->fresnel[0] = out->reflected * (l->is_schlick ? m2 * m2 * m : cosine);
    out->fresnel[1] = out->fresnel[0] * cosine;
    out->facets = half_vectors * d;
    const vfloat along = out->facets * unit;
    out->x = along * h.x;
    out->y = along * h.y;
    out->z = along * h.z;
    out->cap = half_vectors * (h.z * unit);
}

#endif
