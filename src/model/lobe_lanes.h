/* The smooth reflection of lobe.h in lanes: what a single evaluation and the batches of every width compute. */
#ifndef MODEL_LOBE_LANES_H
#define MODEL_LOBE_LANES_H

#include "math/effects.h"
#include "math/lanes3.h"
#include "model/model.h"
#include "ndf/fresnel.h"
#include "ndf/ndf_lanes.h"

/* Surface and directions. */
typedef struct lobe_query {
    vfloat3 wo, wi;
    vfloat alpha_x, alpha_y;
    vfloat diffuse[3], f0[3], f90[3];
} lobe_query;

static inline ndf_kind lobe_kind(const glint_material_options *o)
{
    return !LIBRARY_BECKMANN || o->distribution == GLINT_DISTRIBUTION_GGX ? NDF_GGX : NDF_BECKMANN;
}

static inline vfloat lobe_reflectance_of(const glint_material_options *o, int channel, vfloat f0, vfloat f90,
                                         vfloat cosine)
{
    switch (LIBRARY_FRESNEL_TERMS ? o->fresnel : GLINT_FRESNEL_SCHLICK) {
    case GLINT_FRESNEL_DIELECTRIC:
        return fresnel_dielectric(cosine, o->ior);
    case GLINT_FRESNEL_CONDUCTOR:
        return fresnel_conductor(cosine, o->eta[channel], o->k[channel]);
    case GLINT_FRESNEL_SCHLICK:
        break;
    }
    return fresnel_schlick(cosine, f0, f90);
}

/* What is left for the base of light that enters at one angle and leaves at the other: (1 - F_o)(1 - F_i) / (1 - F_0).
 * glTF's own 1 - F(h.wo) is the same head-on but gives more light than came in at grazing angles; this is reciprocal
 * and never above one. */
static inline vfloat lobe_base_albedo_of(const glint_material_options *o, int channel, vfloat diffuse, vfloat f0,
                                         vfloat f90, vfloat cos_o, vfloat cos_i)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    vmask seen = less(zero, diffuse);
    if (!any(seen))
        return zero;
    const float coverage = o->coverage;
    const vfloat head_on = 1.0F - coverage * lobe_reflectance_of(o, channel, f0, f90, one);
    seen = seen & less(zero, head_on);
    const vfloat out = 1.0F - coverage * lobe_reflectance_of(o, channel, f0, f90, min_f(cos_o, one));
    const vfloat in = 1.0F - coverage * lobe_reflectance_of(o, channel, f0, f90, min_f(cos_i, one));
    /* Where facets reflect most head-on, as metals nearly do, no more is left than came in at either angle. */
    const vfloat least = min_f(in, out), both = out * (in / choose(seen, head_on, one));
    return choose(seen, diffuse * min_f(both, least), zero);
}

/* The unit half vector, and what it makes with either direction. */
static inline vfloat3 lobe_halve_of(vfloat3 wo, vfloat3 wi, vfloat *h_dot_wi)
{
    const vfloat3 plain = add_3(wo, wi);
    /* Opposite along the ground, the sum is so short that its square is no number; its direction is one all the same.
     */
    const vmask is_long = less(splat(1e-30F), dot_3(plain, plain));
    const vfloat3 sum = scale_3(plain, choose(is_long, splat(1.0F), splat(1e30F)));
    /* h.wi = h.wo = |wo + wi| / 2: the same bits from both sides, so that reciprocity is exact. */
    const vfloat half = 0.5F * sqrt_f(dot_3(sum, sum)) * choose(is_long, splat(1.0F), splat(1e-30F));
    *h_dot_wi = min_f(max_f(half, splat(0.0F)), splat(1.0F));
    return normalize_3(sum);
}

/* f |cos theta_i| in its parts, as lobe_value. */
typedef struct lobe_shaded {
    vfloat fresnel[3], reflectance[3], specular[3], diffuse[3];
} lobe_shaded;

static inline void lobe_shade_of(const glint_material_options *o, const lobe_query *q, vfloat h_dot_wi, vfloat density,
                                 vfloat masking_over_cosine, lobe_shaded *s)
{
    const vfloat masking = 0.25F * masking_over_cosine;
    const vfloat cosine_share = q->wi.z / MATH_PI;
    for (int c = 0; c < 3; c++) {
        s->fresnel[c] = lobe_reflectance_of(o, c, q->f0[c], q->f90[c], h_dot_wi);
        s->reflectance[c] = o->coverage * s->fresnel[c] * masking;
        s->specular[c] = s->reflectance[c] * density;
        s->diffuse[c] = lobe_base_albedo_of(o, c, q->diffuse[c], q->f0[c], q->f90[c], q->wo.z, q->wi.z) * cosine_share;
    }
}

static inline vfloat lobe_masking_of(const glint_material_options *o, const lobe_query *q)
{
    const ndf_kind kind = lobe_kind(o);
    return ndf_masking_over_cosine_of(q->wo.z, ndf_masked_of(kind, q->alpha_x, q->alpha_y, q->wo), q->wi.z,
                                      ndf_masked_of(kind, q->alpha_x, q->alpha_y, q->wi));
}

/* total_area: D_H, 0 where it is not known yet. */
static inline vfloat lobe_lit_probability_of(const glint_material_options *o, const lobe_query *q, vfloat total_area,
                                             vfloat density, vfloat h_z, vfloat solid_angle_sr)
{
    vfloat p = density * solid_angle_sr;
    if (LIBRARY_WEIGHTINGS && o->weighting == GLINT_WEIGHTING_EQUAL_PROJECTED_AREA) {
        p = p * h_z;
    } else {
        const vmask known = less(splat(0.0F), total_area);
        if (any(~known))
            total_area = choose(known, total_area, ndf_total_area_of(lobe_kind(o), q->alpha_x, q->alpha_y));
        p = p / total_area;
    }
    return min_f(p, splat(1.0F));
}

#endif
