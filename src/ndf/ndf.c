/* Microfacet normal distributions: the choice between GGX and Beckmann, and what both share. */
#include "ndf/ndf.h"

#define GLINT_LANES 1
#include "ndf/distributions.h"
#include "ndf/ndf_lanes.h"

float ndf_density(const ndf *n, vec3 h)
{
    if (!(h.z > 0.0F))
        return 0.0F;
    return n->kind == NDF_GGX ? ggx_density(n->alpha_x, n->alpha_y, h) : beckmann_density(n->alpha_x, n->alpha_y, h);
}

float ndf_masked(const ndf *n, vec3 v)
{
    return n->kind == NDF_GGX ? ggx_masked(n->alpha_x, n->alpha_y, v) : beckmann_masked(n->alpha_x, n->alpha_y, v);
}

float ndf_masking_over_cosine(const ndf *n, vec3 wo, vec3 wi)
{
    return ndf_correlated_masking(wo.z, ndf_masked(n, wo), wi.z, ndf_masked(n, wi));
}

float ndf_total_area(const ndf *n)
{
    return ndf_total_area_of(n->kind, n->alpha_x, n->alpha_y);
}

vec3 ndf_sample_visible(const ndf *n, vec3 wo, float u1, float u2)
{
    return n->kind == NDF_GGX ? ggx_sample_visible(n->alpha_x, n->alpha_y, wo, u1, u2)
                              : beckmann_sample_visible(n->alpha_x, n->alpha_y, wo, u1, u2);
}

float ndf_lit_solid_angle(ndf_kind kind, float half_vectors_sr, float facet_alpha)
{
    return ndf_lit_solid_angle_of(kind, half_vectors_sr, facet_alpha);
}
