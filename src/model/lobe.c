/* The smooth reflection that every model shares: a Cook-Torrance lobe of facets over a Lambertian base. */
#include "model/lobe.h"

#define GLINT_LANES 1
#include "light/cap.h"
#include "model/lobe_lanes.h"

float lobe_facet_reflectance(const model_query *q, int channel, float cosine)
{
    return lobe_reflectance_of(&q->material->options, channel, q->surface->f0[channel], q->surface->f90[channel],
                               cosine);
}

float lobe_base_albedo(const model_query *q, int channel, float cos_i)
{
    const glint_surface *s = q->surface;
    return lobe_base_albedo_of(&q->material->options, channel, s->diffuse[channel], s->f0[channel], s->f90[channel],
                               q->wo.z, cos_i);
}

static lobe_query one_query(const model_query *q)
{
    const glint_surface *s = q->surface;
    return (lobe_query){ { q->wo.x, q->wo.y, q->wo.z },
                         { q->wi.x, q->wi.y, q->wi.z },
                         s->alpha_x,
                         LIBRARY_ANISOTROPY ? s->alpha_y : s->alpha_x,
                         { s->diffuse[0], s->diffuse[1], s->diffuse[2] },
                         { s->f0[0], s->f0[1], s->f0[2] },
                         { s->f90[0], s->f90[1], s->f90[2] } };
}

void lobe_halve(const model_query *q, lobe_value *value)
{
    const vfloat3 h =
        lobe_halve_of((vfloat3){ q->wo.x, q->wo.y, q->wo.z }, (vfloat3){ q->wi.x, q->wi.y, q->wi.z }, &value->h_dot_wi);
    value->h = (vec3){ h.x, h.y, h.z };
}

void lobe_shade(const model_query *q, float masking_over_cosine, lobe_value *value)
{
    const lobe_query one = one_query(q);
    lobe_shaded s;
    lobe_shade_of(&q->material->options, &one, value->h_dot_wi, value->density, masking_over_cosine, &s);
    for (int c = 0; c < 3; c++) {
        value->fresnel[c] = s.fresnel[c];
        value->reflectance[c] = s.reflectance[c];
        value->specular[c] = s.specular[c];
        value->diffuse[c] = s.diffuse[c];
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
    const lobe_query one = one_query(q);
    return lobe_lit_probability_of(&q->material->options, &one, q->total_area, value->density, value->h.z,
                                   solid_angle_sr);
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

/* chance: lobe_specular_chance */
static float pdf_of(const model_query *q, const ndf *n, float chance)
{
    const vec3 h = vec3_normalize(vec3_add(q->wo, q->wi));
    /* Visible normals over the reflection's Jacobian: G1 D / (4 cos_o), G1 / cos_o = 1 / (cos_o + masked). */
    const float specular = ndf_density(n, h) / (4.0F * (q->wo.z + ndf_masked(n, q->wo)));
    return chance * specular + (1.0F - chance) * (q->wi.z / MATH_PI);
}

float lobe_pdf(const model_query *q)
{
    const ndf n = lobe_ndf(q);
    return pdf_of(q, &n, lobe_specular_chance(q));
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
    const float chance = lobe_specular_chance(q);
    if (random[0] < chance) {
        const vec3 h = ndf_sample_visible(&n, q->wo, random[1], random[2]);
        lit.wi = vec3_normalize(vec3_add(vec3_scale(h, 2.0F * vec3_dot(q->wo, h)), vec3_scale(q->wo, -1.0F)));
    } else {
        lit.wi = lobe_cosine_direction(random[1], random[2]);
    }
    if (!(lit.wi.z > 0.0F))
        return 0;
    lobe_value value;
    lobe_eval(&lit, &value);
    const float pdf = pdf_of(&lit, &n, chance);
    if (!(pdf > 0.0F))
        return 0;
    *sample = (glint_sample){ { lit.wi.x, lit.wi.y, lit.wi.z }, pdf, { 0.0F, 0.0F, 0.0F } };
    for (int c = 0; c < 3; c++)
        sample->weight[c] = (value.specular[c] + value.diffuse[c]) / pdf;
    return 1;
}
