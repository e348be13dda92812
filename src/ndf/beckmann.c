/* The Beckmann distribution (Cook and Torrance 1982) with Smith masking. */
#include "ndf/distributions.h"

#define GLINT_LANES 1
#include "ndf/ndf_lanes.h"

#define SQRT_PI 1.77245385F

/* 1 + erf(x). */
static float one_plus_erf(float x)
{
    const float tail = exp_negative(-x * x) * erfcx_f(fabsf(x));
    return x < 0.0F ? tail : 2.0F - tail;
}

float beckmann_density(float alpha_x, float alpha_y, vec3 h)
{
    return beckmann_density_of(alpha_x, alpha_y, (vfloat3){ h.x, h.y, h.z });
}

float beckmann_masked(float alpha_x, float alpha_y, vec3 v)
{
    return beckmann_masked_of(alpha_x, alpha_y, (vfloat3){ v.x, v.y, v.z });
}

float beckmann_tail_area(float alpha, float w)
{
    return beckmann_tail_of(alpha, w);
}

/* Slope along the view, with density proportional to (cos - x sin) exp(-x^2) for x below cot: its distribution function
 * is cos (1 + erf x) / 2 + sin exp(-x^2) / (2 sqrt pi), inverted by bisection with Newton steps (Heitz and d'Eon 2014).
 */
static float visible_slope(float cosine, float sine, float u)
{
    float low = -4.0F, high = sine > 0.25F * cosine ? cosine / sine : 4.0F;
    if (high > 4.0F)
        high = 4.0F;
    const float whole = 0.5F * cosine * one_plus_erf(high) + 0.5F / SQRT_PI * sine * exp_negative(-high * high);
    const float target = u * whole;
    float x = 0.5F * (low + high);
    for (int i = 0; i < 24 && high - low > 1e-6F; i++) {
        const float e = exp_negative(-x * x);
        const float excess = 0.5F * cosine * one_plus_erf(x) + 0.5F / SQRT_PI * sine * e - target;
        if (excess > 0.0F)
            high = x;
        else
            low = x;
        const float slope = (cosine - x * sine) * e * (1.0F / SQRT_PI);
        const float next = slope > 1e-12F ? x - excess / slope : low;
        if (fabsf(next - x) < 1e-7F)
            break;
        x = next > low && next < high ? next : 0.5F * (low + high);
    }
    return x;
}

vec3 beckmann_sample_visible(float alpha_x, float alpha_y, vec3 wo, float u1, float u2)
{
    /* Stretch to roughness one, sample slopes in the frame of the view, turn back, unstretch. */
    const vec3 v = vec3_normalize((vec3){ alpha_x * wo.x, alpha_y * wo.y, wo.z });
    const float sine = sqrtf(v.x * v.x + v.y * v.y);
    const float cx = sine > 1e-12F ? v.x / sine : 1.0F, cy = sine > 1e-12F ? v.y / sine : 0.0F;
    const float along = visible_slope(v.z, sine, u1);
    const float across = normal_quantile(2.0F * u2 - 1.0F) * 0.707106781F;
    const float sx = alpha_x * (cx * along - cy * across), sy = alpha_y * (cy * along + cx * across);
    return vec3_normalize((vec3){ -sx, -sy, 1.0F });
}
