/* Slopes of facets drawn from a distribution, for facets of equal projected area and of equal area. */
#include "ndf/slopes.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"
#include "ndf/distributions.h"

static slope2 polar(const ndf *n, float radius, float azimuth)
{
    const float turn = 2.0F * azimuth;
    float sine, cosine;
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const float r = turn < 1.0F ? radius : -radius;
    return (slope2){ n->alpha_x * r * cosine, n->alpha_y * r * sine };
}

/* Radius at roughness one, from the chance q in (0, 1] that it is larger. */
static float radius_of_tail(ndf_kind kind, float q)
{
    return sqrtf(kind == NDF_GGX ? (1.0F - q) / q : -log_f(q));
}

slope2 slopes_of_projected_area(const ndf *n, float u, float azimuth)
{
    return polar(n, radius_of_tail(n->kind, fmaxf(1.0F - u, 1e-7F)), azimuth);
}

/* The area-weighted chance that the radius is larger, times D_H, for isotropic roughness a, as a function of the
 * unweighted chance q. With w = sqrt(1 + a^2 r^2) and b = sqrt(1 - a^2) it is
 *
 *   w q + a^2 atanh(b / w) / b               for GGX,
 *   q (w + sqrt(pi) / 2 a erfcx(w / a))      for Beckmann. */
static float tail_area(ndf_kind kind, float a, float q, float *w)
{
    const float r = radius_of_tail(kind, q);
    *w = sqrtf(1.0F + a * a * r * r);
    return kind == NDF_GGX ? *w * q + ggx_tail_area(a, *w) : q * (*w + beckmann_tail_area(a, *w));
}

slope2 slopes_of_area(const ndf *n, float u, float azimuth)
{
    /* In the plane of this azimuth (at roughness one) the surface has the roughness a, and carries D_H(a) of area:
     * azimuths are taken with that chance, a new one where it is refused; D_H is between 1 and 2. */
    uint32_t state = (uint32_t)(azimuth * 16777216.0F) * 256U;
    float a = n->alpha_x;
    for (int i = 0; i < 32 && n->alpha_x != n->alpha_y; i++) {
        const slope2 s = polar(n, 1.0F, azimuth);
        a = sqrtf(s.x * s.x + s.y * s.y);
        const ndf plane = { n->kind, a, a };
        state = hash_full(state + HASH_X);
        if ((float)(state >> 8) * (2.0F / 16777216.0F) < ndf_total_area(&plane))
            break;
        state = hash_full(state + HASH_Y);
        azimuth = (float)(state >> 8) * (1.0F / 16777216.0F);
    }
    const ndf plane = { n->kind, a, a };
    const float target = fmaxf(1.0F - u, 1e-7F) * ndf_total_area(&plane);
    /* Newton's method on q: d(tail area) / dq = w >= 1, smooth. */
    float q = fmaxf(1.0F - u, 1e-7F);
    for (int i = 0; i < 12; i++) {
        float w;
        const float step = (tail_area(n->kind, a, q, &w) - target) / w;
        q = fminf(fmaxf(q - step, 0.1F * q), 1.0F);
        if (fabsf(step) < 1e-7F * q)
            break;
    }
    return polar(n, radius_of_tail(n->kind, q), azimuth);
}
