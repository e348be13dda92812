/* The smooth reflection that every model shares: a Cook-Torrance lobe of facets over a Lambertian base. */
#ifndef MODEL_LOBE_H
#define MODEL_LOBE_H

#include "math/effects.h"
#include "model/model.h"
#include "ndf/ndf.h"

/* f |cos theta_i| in its two parts, and the density that made it. */
typedef struct lobe_value {
    float specular[3];
    float diffuse[3];
    float fresnel[3];     /* reflectance of one facet */
    float reflectance[3]; /* specular over density: coverage F G2 / (4 cos_o) */
    vec3 h;               /* unit half vector */
    float h_dot_wi;
    float density; /* D(h) */
} lobe_value;

/* The distribution of the facets at this point. */
static inline ndf lobe_ndf(const model_query *q)
{
    const int is_ggx = !LIBRARY_BECKMANN || q->material->options.distribution == GLINT_DISTRIBUTION_GGX;
    return (ndf){ is_ggx ? NDF_GGX : NDF_BECKMANN, q->surface->alpha_x,
                  LIBRARY_ANISOTROPY ? q->surface->alpha_y : q->surface->alpha_x };
}

/* F of one facet, for the cosine in [0, 1] between a direction and its normal. */
float lobe_facet_reflectance(const model_query *q, int channel, float cosine);

/* Albedo of the base below the facets for light at this angle. */
float lobe_base_albedo(const model_query *q, int channel, float cos_i);

/* f = coverage F D G2 / (4 cos_o cos_i) + diffuse / pi of what the facets let through, each times |cos theta_i|. */
void lobe_eval(const model_query *q, lobe_value *value);

/* The same in two steps, for a model with a density of its own: h and h_dot_wi, then, with density set, the rest from
 * G2 / cos_o. */
void lobe_halve(const model_query *q, lobe_value *value);
void lobe_shade(const model_query *q, float masking_over_cosine, lobe_value *value);

/* Solid angle of the facet normals that reflect some of the light to the viewer, sr: the light's and the facet's own
 * lobe. */
float lobe_lit_solid_angle(const model_query *q, const lobe_value *value);

/* p, that a facet has such a normal, in [0, 1]: D_Omega_h / D_H for facets of equal area (Kneiphof and Klein 2024, Eq.
 * 12), the integral of D(h)(n.h) for facets of equal projected area. D is taken as constant over the solid angle (Eq.
 * 20). */
float lobe_lit_probability(const model_query *q, const lobe_value *value, float solid_angle_sr);

/* Chance that sampling takes the facets rather than the base, in [0, 1]. */
float lobe_specular_chance(const model_query *q);

/* Cosine-distributed direction for the base. */
vec3 lobe_cosine_direction(float u1, float u2);

int lobe_sample(const model_query *q, const float random[3], glint_sample *sample);
float lobe_pdf(const model_query *q);

#endif
