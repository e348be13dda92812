/* Fresnel reflectance of one facet, in lanes. cosine is that between a direction and the facet's normal, in [0, 1]. */
#ifndef NDF_FRESNEL_H
#define NDF_FRESNEL_H

#include "math/lanes.h"

/* Schlick 1994: from f0 head-on to f90 at grazing angles. */
static inline vfloat fresnel_schlick(vfloat cosine, vfloat f0, vfloat f90)
{
    const vfloat m = 1.0F - cosine;
    const vfloat m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

/* Exact, unpolarised; ior is that of the inside over the outside, > 1. */
static inline vfloat fresnel_dielectric(vfloat cosine, float ior)
{
    /* g = ior cos of the refracted angle; g^2 - cos^2 = ior^2 - 1. Written with this, neither cos - g nor ior^2 cos - g
     * is a difference of nearly equal numbers when ior is close to one. */
    const float excess = (ior - 1.0F) * (ior + 1.0F);
    const vfloat sum = cosine + sqrt_f(excess + cosine * cosine);
    const vfloat s = excess / (sum * sum);
    const vfloat p = excess * (cosine - 1.0F / sum) / (excess * cosine + sum);
    return 0.5F * (s * s + p * p);
}

/* Exact, unpolarised; the refractive index is eta + i k. */
static inline vfloat fresnel_conductor(vfloat cosine, float eta, float k)
{
    const vfloat cos2 = cosine * cosine, sin2 = 1.0F - cos2;
    const float eta2 = eta * eta, k2 = k * k;
    const vfloat t0 = eta2 - k2 - sin2;
    const vfloat a2b2 = sqrt_f(t0 * t0 + 4.0F * eta2 * k2);
    /* a^2 = (a2b2 + t0) / 2, without the difference where t0 is negative. */
    const vmask negative = less(t0, splat(0.0F));
    const vfloat difference = choose(negative, a2b2 - t0, splat(1.0F));
    const vfloat a = sqrt_f(choose(negative, 2.0F * eta2 * k2 / difference, 0.5F * (a2b2 + t0)));
    const vfloat s1 = a2b2 + cos2, s2 = 2.0F * a * cosine;
    const vfloat s = (s1 - s2) / (s1 + s2);
    const vfloat p1 = cos2 * a2b2 + sin2 * sin2, p2 = s2 * sin2;
    const vfloat p = s * (p1 - p2) / (p1 + p2);
    return 0.5F * (s + p);
}

#endif
