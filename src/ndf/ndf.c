/* Microfacet normal distributions: the choice between GGX and Beckmann, and what both share. */
#include "ndf/ndf.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "ndf/distributions.h"

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
    float (*const of)(float) = n->kind == NDF_GGX ? ggx_total_area : beckmann_total_area;
    if (n->alpha_x == n->alpha_y)
        return of(n->alpha_x);
    /* In the plane of azimuth phi the surface has the isotropic roughness a(phi), and phi is uniform once slopes are
     * scaled by the roughness: D_H is the mean of the isotropic one. The midpoint rule converges exponentially on a
     * periodic function; 16 points a quarter turn leave 2e-5 even at alpha_x / alpha_y = 1000. */
    enum { POINTS = 16 };
    float sum = 0.0F;
    for (int i = 0; i < POINTS; i++) {
        float s, c;
        sincos_pi(((float)i + 0.5F) * (0.5F / POINTS), &s, &c);
        const float x = n->alpha_x * c, y = n->alpha_y * s;
        sum += of(sqrtf(x * x + y * y));
    }
    return sum * (1.0F / POINTS);
}

vec3 ndf_sample_visible(const ndf *n, vec3 wo, float u1, float u2)
{
    return n->kind == NDF_GGX ? ggx_sample_visible(n->alpha_x, n->alpha_y, wo, u1, u2)
                              : beckmann_sample_visible(n->alpha_x, n->alpha_y, wo, u1, u2);
}

/* The rim's part, 0 for a point. Coefficients: fits, see ndf.h. */
static float ggx_rim(float r, float alpha)
{
    const float blur = alpha * (1.0F + 0.966F * alpha / (alpha + 1.538F * r));
    return 4.93480220F * alpha * r * (r / (r + blur));
}

static float beckmann_rim(float r, float alpha)
{
    /* Two Gaussians blur to a third without a rim: it is gone soon. A point has none. */
    if (!(alpha < 10.0F * r))
        return 0.0F;
    const float x = alpha / r;
    return 2.50662827F * alpha * r / (1.0F + x * (2.044F + x * (9.896F * x - 0.5F)));
}

float ndf_lit_solid_angle(ndf_kind kind, float half_vectors_sr, float facet_alpha)
{
    if (!(facet_alpha > 0.0F))
        return half_vectors_sr;
    const float r = sqrtf(half_vectors_sr * (1.0F / MATH_PI));
    const float lobe = (kind == NDF_GGX ? 3.0F : 2.0F) * MATH_PI * facet_alpha * facet_alpha;
    const float rim = kind == NDF_GGX ? ggx_rim(r, facet_alpha) : beckmann_rim(r, facet_alpha);
    return half_vectors_sr + lobe + rim;
}
