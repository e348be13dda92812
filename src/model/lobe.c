/* The smooth reflection that every model shares: a Cook-Torrance lobe of facets over a Lambertian base. */
#include "model/lobe.h"

#include "light/cap.h"
#include "ndf/fresnel.h"
#include "ndf/ndf.h"

#define GLINT_LANES 1
#include "math/elementary.h"

float lobe_facet_reflectance(const model_query *q, int channel, float cosine)
{
    const glint_material_options *o = &q->material->options;
    switch (o->fresnel) {
    case GLINT_FRESNEL_DIELECTRIC:
        return fresnel_dielectric(cosine, o->ior);
    case GLINT_FRESNEL_CONDUCTOR:
        return fresnel_conductor(cosine, o->eta[channel], o->k[channel]);
    case GLINT_FRESNEL_SCHLICK:
        break;
    }
    return fresnel_schlick(cosine, q->surface->f0[channel], q->surface->f90[channel]);
}

static float clamp01(float x)
{
    return x < 0.0F ? 0.0F : x > 1.0F ? 1.0F : x;
}

/* What is left for the base of light that enters at one angle and leaves at the other: (1 - F_o)(1 - F_i) / (1 - F_0).
 * glTF's own 1 - F(h.wo) is the same head-on but gives more light than came in at grazing angles; this is reciprocal
 * and never above one. */
float lobe_base_albedo(const model_query *q, int channel, float cos_i)
{
    if (!(q->surface->diffuse[channel] > 0.0F))
        return 0.0F;
    const float coverage = q->material->options.coverage;
    const float head_on = 1.0F - coverage * lobe_facet_reflectance(q, channel, 1.0F);
    if (!(head_on > 0.0F))
        return 0.0F;
    const float out = 1.0F - coverage * lobe_facet_reflectance(q, channel, q->wo.z < 1.0F ? q->wo.z : 1.0F);
    const float in = 1.0F - coverage * lobe_facet_reflectance(q, channel, cos_i < 1.0F ? cos_i : 1.0F);
    /* Where facets reflect most head-on, as metals nearly do, no more is left than came in at either angle. */
    const float least = in < out ? in : out, both = out * (in / head_on);
    return q->surface->diffuse[channel] * (both < least ? both : least);
}

void lobe_halve(const model_query *q, lobe_value *value)
{
    vec3 sum = vec3_add(q->wo, q->wi);
    float length2 = vec3_dot(sum, sum), unit = 1.0F;
    /* Opposite along the ground, the sum is so short that its square is no number; its direction is one all the same.
     */
    if (!(length2 > 1e-30F)) {
        sum = vec3_scale(sum, 1e30F);
        length2 = vec3_dot(sum, sum);
        unit = 1e-30F;
    }
    value->h = vec3_normalize(sum);
    /* h.wi = h.wo = |wo + wi| / 2: the same bits from both sides, so that reciprocity is exact. */
    value->h_dot_wi = clamp01(0.5F * sqrtf(length2) * unit);
}

void lobe_shade(const model_query *q, float masking_over_cosine, lobe_value *value)
{
    const float masking = 0.25F * masking_over_cosine;
    const float coverage = q->material->options.coverage;
    for (int c = 0; c < 3; c++) {
        value->fresnel[c] = lobe_facet_reflectance(q, c, value->h_dot_wi);
        value->reflectance[c] = coverage * value->fresnel[c] * masking;
        value->specular[c] = value->reflectance[c] * value->density;
        value->diffuse[c] = lobe_base_albedo(q, c, q->wi.z) * (q->wi.z / MATH_PI);
    }
}

void lobe_eval(const model_query *q, lobe_value *value)
{
    const ndf n = lobe_ndf(q);
    lobe_halve(q, value);
    value->density = ndf_density(&n, value->h);
    lobe_shade(q, ndf_masking_over_cosine(&n, q->wo, q->wi), value);
}

float lobe_lit_solid_angle(const model_query *q, const lobe_value *value)
{
    return ndf_lit_solid_angle(lobe_ndf(q).kind, cap_half_vector_solid_angle(q->solid_angle_sr, value->h_dot_wi),
                               q->material->options.facet_alpha);
}

float lobe_lit_probability(const model_query *q, const lobe_value *value, float solid_angle_sr)
{
    const ndf n = lobe_ndf(q);
    float p = value->density * solid_angle_sr;
    if (q->material->options.weighting == GLINT_WEIGHTING_EQUAL_PROJECTED_AREA)
        p *= value->h.z;
    else
        p /= q->total_area > 0.0F ? q->total_area : ndf_total_area(&n);
    return p < 1.0F ? p : 1.0F;
}

/* Their shares of the light, guessed head-on to the viewer. */
float lobe_specular_chance(const model_query *q)
{
    float specular = 0.0F, diffuse = 0.0F;
    for (int c = 0; c < 3; c++) {
        specular += q->material->options.coverage * lobe_facet_reflectance(q, c, q->wo.z < 1.0F ? q->wo.z : 1.0F);
        diffuse += lobe_base_albedo(q, c, 1.0F);
    }
    if (!(diffuse > 0.0F))
        return 1.0F;
    if (!(specular > 0.0F))
        return 0.0F;
    /* At least a tenth each: the guess knows nothing about wi. */
    const float chance = specular / (specular + diffuse);
    return chance < 0.1F ? 0.1F : chance > 0.9F ? 0.9F : chance;
}

float lobe_pdf(const model_query *q)
{
    const ndf n = lobe_ndf(q);
    const float chance = lobe_specular_chance(q);
    const vec3 h = vec3_normalize(vec3_add(q->wo, q->wi));
    /* Visible normals over the reflection's Jacobian: G1 D / (4 cos_o), G1 / cos_o = 1 / (cos_o + masked). */
    const float specular = ndf_density(&n, h) / (4.0F * (q->wo.z + ndf_masked(&n, q->wo)));
    return chance * specular + (1.0F - chance) * (q->wi.z / MATH_PI);
}

/* A uniform point of the disk, lifted. */
vec3 lobe_cosine_direction(float u1, float u2)
{
    const float turn = 2.0F * u1;
    float sine, cosine;
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const float r = (turn < 1.0F ? 1.0F : -1.0F) * sqrtf(u2);
    return (vec3){ r * cosine, r * sine, sqrtf(1.0F - u2) };
}

int lobe_sample(const model_query *q, const float random[3], glint_sample *sample)
{
    const ndf n = lobe_ndf(q);
    model_query lit = *q;
    if (random[0] < lobe_specular_chance(q)) {
        const vec3 h = ndf_sample_visible(&n, q->wo, random[1], random[2]);
        lit.wi = vec3_normalize(vec3_add(vec3_scale(h, 2.0F * vec3_dot(q->wo, h)), vec3_scale(q->wo, -1.0F)));
    } else {
        lit.wi = lobe_cosine_direction(random[1], random[2]);
    }
    if (!(lit.wi.z > 0.0F))
        return 0;
    lobe_value value;
    lobe_eval(&lit, &value);
    const float pdf = lobe_pdf(&lit);
    if (!(pdf > 0.0F))
        return 0;
    *sample = (glint_sample){ { lit.wi.x, lit.wi.y, lit.wi.z }, pdf, { 0.0F, 0.0F, 0.0F } };
    for (int c = 0; c < 3; c++)
        sample->weight[c] = (value.specular[c] + value.diffuse[c]) / pdf;
    return 1;
}
