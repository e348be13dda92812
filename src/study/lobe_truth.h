/* The smooth lobe by its textbook formulas in long double, from the floats that the library gets: the truth of tests
 * and of what a formula loses in float. */
#ifndef STUDY_LOBE_TRUTH_H
#define STUDY_LOBE_TRUTH_H

#include "glint.h"
#include "wide.h"

typedef struct wide_lobe {
    int is_ggx;
    wide alpha_x, alpha_y;
} wide_lobe;

/* Square of the slope of v over the roughness in its direction, times v_z^2. */
static inline wide wide_slope2(const wide_lobe *l, const wide v[3])
{
    return v[0] * v[0] / (l->alpha_x * l->alpha_x) + v[1] * v[1] / (l->alpha_y * l->alpha_y);
}

/* D(h), h of length one. */
static inline wide wide_density(const wide_lobe *l, const wide h[3])
{
    const wide z2 = h[2] * h[2], scale = 1.0L / (WIDE_PI * l->alpha_x * l->alpha_y);
    const wide slope2 = wide_slope2(l, h) / z2;
    return l->is_ggx ? scale / (z2 * z2 * (1.0L + slope2) * (1.0L + slope2)) : scale * expl(-slope2) / (z2 * z2);
}

/* cos Lambda(v) for v_z > 0. */
static inline wide wide_masked(const wide_lobe *l, const wide v[3])
{
    const wide s2 = l->alpha_x * l->alpha_x * v[0] * v[0] + l->alpha_y * l->alpha_y * v[1] * v[1];
    if (s2 == 0.0L)
        return 0.0L;
    const wide a = v[2] / sqrtl(s2);
    if (l->is_ggx)
        return 0.5L * s2 / (sqrtl(s2 + v[2] * v[2]) + v[2]);
    return 0.5L * v[2] * expl(-a * a) * (1.0L / (a * sqrtl(WIDE_PI)) - wide_erfcx(a));
}

/* D_H for equal roughness both ways. */
static inline wide wide_total_area(int is_ggx, wide a)
{
    const wide b = sqrtl((1.0L - a) * (1.0L + a));
    if (is_ggx)
        return b > 0.0L ? 1.0L + a * a * atanhl(b) / b : 2.0L;
    return 1.0L + 0.5L * sqrtl(WIDE_PI) * a * wide_erfcx(1.0L / a);
}

typedef struct wide_geometry {
    wide wo[3], wi[3], h[3];
    wide h_dot_wi;
    wide sum; /* |wo + wi| */
} wide_geometry;

static inline wide_geometry wide_geometry_of(const float wo[3], const float wi[3])
{
    wide_geometry g;
    wide length2 = 0.0L;
    for (int k = 0; k < 3; k++) {
        g.wo[k] = (wide)wo[k];
        g.wi[k] = (wide)wi[k];
        g.h[k] = g.wo[k] + g.wi[k];
        length2 += g.h[k] * g.h[k];
    }
    g.sum = sqrtl(length2);
    for (int k = 0; k < 3; k++)
        g.h[k] = g.sum > 0.0L ? g.h[k] / g.sum : 0.0L;
    g.h_dot_wi = fminl(0.5L * g.sum, 1.0L);
    return g;
}

/* D G2 / (4 cos_o): what f cos_i is with F = 1. */
static inline wide wide_reflected(const wide_lobe *l, const wide_geometry *g)
{
    const wide o = wide_masked(l, g->wo), i = wide_masked(l, g->wi);
    return 0.25L * wide_density(l, g->h) * g->wi[2] / (g->wo[2] * g->wi[2] + o * g->wi[2] + i * g->wo[2]);
}

/* Reflectance of a boundary with refractive index eta + i k, by complex arithmetic in its real form (unpolarised). */
static inline wide wide_fresnel(wide cosine, wide eta, wide k)
{
    /* g^2 = (eta + i k)^2 - sin^2 */
    const wide re = eta * eta - k * k - 1.0L + cosine * cosine, im = 2.0L * eta * k;
    const wide size = hypotl(re, im);
    wide a = sqrtl(0.5L * (size + re)), b;
    if (re < 0.0L) {
        b = sqrtl(0.5L * (size - re));
        a = im / (2.0L * b);
    } else {
        b = a > 0.0L ? im / (2.0L * a) : 0.0L;
    }
    const wide s = ((cosine - a) * (cosine - a) + b * b) / ((cosine + a) * (cosine + a) + b * b);
    const wide e2 = eta * eta - k * k, e2i = 2.0L * eta * k;
    const wide nr = e2 * cosine - a, ni = e2i * cosine - b, dr = e2 * cosine + a, di = e2i * cosine + b;
    return 0.5L * (s + (nr * nr + ni * ni) / (dr * dr + di * di));
}

#endif
