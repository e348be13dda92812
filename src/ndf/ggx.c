/* The GGX distribution (Walter et al. 2007) with Smith masking. */
#include "ndf/distributions.h"

#define GLINT_LANES 1
#include "math/elementary.h"

float ggx_density(float alpha_x, float alpha_y, vec3 h)
{
    const float x = h.x / alpha_x, y = h.y / alpha_y;
    const float t = x * x + y * y + h.z * h.z;
    return 1.0F / (MATH_PI * alpha_x * alpha_y * t * t);
}

float ggx_masked(float alpha_x, float alpha_y, vec3 v)
{
    /* cos Lambda = (sqrt(alpha_x^2 x^2 + alpha_y^2 y^2 + z^2) - z) / 2, without the difference of nearly equal numbers.
     */
    const float x = alpha_x * v.x, y = alpha_y * v.y;
    const float t = x * x + y * y;
    const float length = sqrtf(t + v.z * v.z);
    return length > 0.0F ? 0.5F * t / (length + v.z) : 0.0F;
}

float ggx_tail_area(float alpha, float w)
{
    /* alpha^2 atanh(b / w) / b with b = sqrt(1 - alpha^2); a series where the quotient is small. */
    const float b2 = (1.0F - alpha) * (1.0F + alpha);
    const float x2 = b2 / (w * w);
    if (x2 < 0.01F)
        return alpha * alpha / w * (1.0F + x2 * (1.0F / 3.0F + x2 * (0.2F + x2 * (1.0F / 7.0F))));
    const float b = sqrtf(b2);
    /* w - b = (w^2 - b^2) / (w + b) loses nothing when alpha is small: w^2 - b^2 = (w^2 - 1) + alpha^2. */
    const float difference = (w - 1.0F) * (w + 1.0F) + alpha * alpha;
    return alpha * alpha * log_f((w + b) / sqrtf(difference)) / b;
}

float ggx_total_area(float alpha)
{
    return 1.0F + ggx_tail_area(alpha, 1.0F);
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
