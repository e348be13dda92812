/* What ndf.h means, in lanes: both distributions, their masking, their area, and the normals that show a light. */
#ifndef NDF_NDF_LANES_H
#define NDF_NDF_LANES_H

#include "math/effects.h"
#include "math/elementary.h"
#include "math/lanes3.h"
#include "ndf/beckmann_masked.h"
#include "ndf/ndf.h"

#define HALF_SQRT_PI 0.886226925F

/* ---- GGX (Walter et al. 2007) ---- */

static inline vfloat ggx_density_of(vfloat alpha_x, vfloat alpha_y, vfloat3 h)
{
    const vfloat x = h.x / alpha_x, y = h.y / alpha_y;
    const vfloat t = x * x + y * y + h.z * h.z;
    return 1.0F / (MATH_PI * alpha_x * alpha_y * t * t);
}

static inline vfloat ggx_masked_of(vfloat alpha_x, vfloat alpha_y, vfloat3 v)
{
    /* cos Lambda = (sqrt(alpha_x^2 x^2 + alpha_y^2 y^2 + z^2) - z) / 2, without the difference of nearly equal numbers.
     */
    const vfloat x = alpha_x * v.x, y = alpha_y * v.y;
    const vfloat t = x * x + y * y;
    const vfloat length = sqrt_f(t + v.z * v.z);
    const vmask is_long = less(splat(0.0F), length);
    return choose(is_long, 0.5F * t / choose(is_long, length + v.z, splat(1.0F)), splat(0.0F));
}

static inline vfloat ggx_tail_of(vfloat alpha, vfloat w)
{
    /* alpha^2 atanh(b / w) / b with b = sqrt(1 - alpha^2); a series where the quotient is small. */
    const vfloat b2 = (1.0F - alpha) * (1.0F + alpha);
    const vfloat x2 = b2 / (w * w);
    const vmask small = less(x2, splat(0.01F));
    const vfloat series = alpha * alpha / w * (1.0F + x2 * (1.0F / 3.0F + x2 * (0.2F + x2 * (1.0F / 7.0F))));
    const vfloat b = choose(small, splat(1.0F), sqrt_f(max_f(b2, splat(0.0F))));
    /* w - b = (w^2 - b^2) / (w + b) loses nothing when alpha is small: w^2 - b^2 = (w^2 - 1) + alpha^2. */
    const vfloat difference = (w - 1.0F) * (w + 1.0F) + alpha * alpha;
    return choose(small, series, alpha * alpha * log_f((w + b) / sqrt_f(difference)) / b);
}

/* The rim's part of ndf_lit_solid_angle, 0 for a point. Coefficients: fits, see ndf.h. */
static inline vfloat ggx_rim_of(vfloat r, float alpha)
{
    const vfloat blur = alpha * (1.0F + 0.966F * alpha / (alpha + 1.538F * r));
    return 4.93480220F * alpha * r * (r / (r + blur));
}

/* ---- Beckmann (Cook and Torrance 1982) ---- */

static inline vfloat beckmann_density_of(vfloat alpha_x, vfloat alpha_y, vfloat3 h)
{
    const vfloat z2 = h.z * h.z;
    const vfloat x = h.x / alpha_x, y = h.y / alpha_y;
    const vfloat slope2 = (x * x + y * y) / max_f(z2, splat(1e-30F));
    const vmask seen = less(slope2, splat(87.0F));
    const vfloat z4 = choose(seen, MATH_PI * alpha_x * alpha_y * z2 * z2, splat(1.0F));
    return choose(seen, exp_negative(-slope2) / z4, splat(0.0F));
}

static inline vfloat beckmann_masked_of(vfloat alpha_x, vfloat alpha_y, vfloat3 v)
{
    const vfloat x = alpha_x * v.x, y = alpha_y * v.y;
    return beckmann_masked_at(sqrt_f(x * x + y * y), v.z);
}

static inline vfloat beckmann_tail_of(vfloat alpha, vfloat w)
{
    return HALF_SQRT_PI * alpha * erfcx_f(w / alpha);
}

static inline vfloat beckmann_rim_of(vfloat r, float alpha)
{
    /* Two Gaussians blur to a third without a rim: it is gone soon. A point has none. */
    const vmask seen = less(splat(alpha), 10.0F * r);
    const vfloat x = alpha / choose(seen, r, splat(1.0F));
    const vfloat rim = 2.50662827F * alpha * r / (1.0F + x * (2.044F + x * (9.896F * x - 0.5F)));
    return choose(seen, rim, splat(0.0F));
}

/* ---- either ---- */

/* h.z >= 0 need not hold: 0 where it does not. */
static inline vfloat ndf_density_of(ndf_kind kind, vfloat alpha_x, vfloat alpha_y, vfloat3 h)
{
    const vmask above = less(splat(0.0F), h.z);
    const vfloat3 up = { choose(above, h.x, splat(0.0F)), choose(above, h.y, splat(0.0F)),
                         choose(above, h.z, splat(1.0F)) };
    const vfloat d = kind == NDF_GGX ? ggx_density_of(alpha_x, alpha_y, up) : beckmann_density_of(alpha_x, alpha_y, up);
    return choose(above, d, splat(0.0F));
}

static inline vfloat ndf_masked_of(ndf_kind kind, vfloat alpha_x, vfloat alpha_y, vfloat3 v)
{
    return kind == NDF_GGX ? ggx_masked_of(alpha_x, alpha_y, v) : beckmann_masked_of(alpha_x, alpha_y, v);
}

static inline vfloat ndf_masking_over_cosine_of(vfloat cos_o, vfloat masked_o, vfloat cos_i, vfloat masked_i)
{
    return cos_i / (cos_o * cos_i + masked_o * cos_i + masked_i * cos_o);
}

static inline vfloat ndf_round_area_of(ndf_kind kind, vfloat alpha)
{
    return 1.0F + (kind == NDF_GGX ? ggx_tail_of(alpha, splat(1.0F)) : beckmann_tail_of(alpha, splat(1.0F)));
}

static inline vfloat ndf_total_area_of(ndf_kind kind, vfloat alpha_x, vfloat alpha_y)
{
    const vfloat area = ndf_round_area_of(kind, alpha_x);
    const vmask uneven = less(alpha_x, alpha_y) | less(alpha_y, alpha_x);
    if (!LIBRARY_ANISOTROPY || !any(uneven))
        return area;
    /* In the plane of azimuth phi the surface has the isotropic roughness a(phi), and phi is uniform once slopes are
     * scaled by the roughness: D_H is the mean of the isotropic one. The midpoint rule converges exponentially on a
     * periodic function; 16 points a quarter turn leave 2e-5 even at alpha_x / alpha_y = 1000. */
    enum { POINTS = 16 };
    vfloat sum = splat(0.0F);
    for (int i = 0; i < POINTS; i++) {
        vfloat s, c;
        sincos_pi(splat(((float)i + 0.5F) * (0.5F / POINTS)), &s, &c);
        const vfloat x = alpha_x * c, y = alpha_y * s;
        sum = sum + ndf_round_area_of(kind, sqrt_f(x * x + y * y));
    }
    return choose(uneven, sum * (1.0F / POINTS), area);
}

static inline vfloat ndf_lit_solid_angle_of(ndf_kind kind, vfloat half_vectors_sr, float facet_alpha)
{
    if (!LIBRARY_ROUGH_FACETS || !(facet_alpha > 0.0F))
        return half_vectors_sr;
    const vfloat r = sqrt_f(half_vectors_sr * (1.0F / MATH_PI));
    const float lobe = (kind == NDF_GGX ? 3.0F : 2.0F) * MATH_PI * facet_alpha * facet_alpha;
    const vfloat rim = kind == NDF_GGX ? ggx_rim_of(r, facet_alpha) : beckmann_rim_of(r, facet_alpha);
    return half_vectors_sr + lobe + rim;
}

#endif
