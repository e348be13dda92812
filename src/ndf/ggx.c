/* The GGX distribution (Walter et al. 2007) with Smith masking. */
#include "ndf/distributions.h"

#define GLINT_LANES 1
#include "ndf/ndf_lanes.h"

float ggx_density(float alpha_x, float alpha_y, vec3 h)
{
    return ggx_density_of(alpha_x, alpha_y, (vfloat3){ h.x, h.y, h.z });
}

float ggx_masked(float alpha_x, float alpha_y, vec3 v)
{
    return ggx_masked_of(alpha_x, alpha_y, (vfloat3){ v.x, v.y, v.z });
}

float ggx_tail_area(float alpha, float w)
{
    return ggx_tail_of(alpha, w);
}

vec3 ggx_sample_visible(float alpha_x, float alpha_y, vec3 wo, float u1, float u2)
{
    /* Spherical caps: Dupuy and Benyoub 2023. */
    const vec3 v = vec3_normalize((vec3){ alpha_x * wo.x, alpha_y * wo.y, wo.z });
    const float turn = 2.0F * u1;
    float sine, cosine;
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const float sign = turn < 1.0F ? 1.0F : -1.0F;
    /* The cap's point has height z = up - v.z. Written with this, 1 - z and 1 + z keep their digits at the pole and in
     * the tail, and so does z + v.z. */
    const float up = (1.0F - u2) * (1.0F + v.z);
    const float versine = (v.x * v.x + v.y * v.y) / (1.0F + v.z);
    const float r = sqrtf(u2 * (1.0F + v.z) * (up + versine));
    const vec3 h = { sign * r * cosine + v.x, sign * r * sine + v.y, up };
    return vec3_normalize((vec3){ alpha_x * h.x, alpha_y * h.y, fmaxf(h.z, 1e-12F) });
}
