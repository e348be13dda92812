/* Microfacet normal distributions with anisotropic roughness: density, masking, total area, visible normals.
 *
 * Local frame, z the normal. alpha_x and alpha_y in [1e-4, 1]. Masking is Smith's, height-correlated (Heitz 2014).
 */
#ifndef NDF_NDF_H
#define NDF_NDF_H

#include "math/vec3.h"

typedef enum ndf_kind { NDF_GGX, NDF_BECKMANN } ndf_kind;

typedef struct ndf {
    ndf_kind kind;
    float alpha_x, alpha_y;
} ndf;

/* D(h), per steradian: area of facets with normal h over area of surface. h unit with h.z >= 0; 0 for h.z = 0. */
float ndf_density(const ndf *n, vec3 h);

/* cos(theta) Lambda(v): what Smith's masking adds to the projected area. It stays finite at grazing angles, where
 * Lambda does not. v unit, v.z >= 0. G1(v) = cos / (cos + this). */
float ndf_masked(const ndf *n, vec3 v);

/* G2 / cos(theta_o) from what both directions' masking adds: G2 = 1 / (1 + Lambda_o + Lambda_i), multiplied through by
 * both cosines. */
static inline float ndf_correlated_masking(float cos_o, float masked_o, float cos_i, float masked_i)
{
    return cos_i / (cos_o * cos_i + masked_o * cos_i + masked_i * cos_o);
}

/* G2(wo, wi) / cos(theta_o), finite for every wo and wi with z > 0. */
float ndf_masking_over_cosine(const ndf *n, vec3 wo, vec3 wi);

/* D_H, integral of D over the hemisphere: the area of all facets over that of the surface, in [1, 2].
 * Kneiphof and Klein 2024, Eqs. 29 and 30, averaged over azimuth where the roughness is anisotropic. */
float ndf_total_area(const ndf *n);

/* A normal with density G1(wo) D(h) max(0, wo.h) / cos(theta_o). wo unit, wo.z > 0; u1, u2 in [0, 1). */
vec3 ndf_sample_visible(const ndf *n, vec3 wo, float u1, float u2);

/* Solid angle of the facet normals that show a light, for rough facets: as many facets, each fully lit or not at all,
 * would have the same mean and the same variance. half_vectors_sr, >= 0: what mirrors would show, taken as a round disk
 * of radius r. With l, the lobe of a facet over the disk, by where the facet points, it is (integral of l)^2 / integral
 * of l^2: the disk, the lobe's own 3 pi alpha^2 (GGX) or 2 pi alpha^2 (Beckmann), and what the blurred rim adds. The
 * last is exact for a straight rim (alpha << r: pi^2 / 2 alpha r, sqrt(2 pi) alpha r) and for a point, and a fit
 * between them: the whole is right to .4 %. */
float ndf_lit_solid_angle(ndf_kind kind, float half_vectors_sr, float facet_alpha);

#endif
