/* How a layer sees a round light, in lanes: not at all, as a cap of even light, or as a shape. */
#ifndef PREVIEW_SIGHT_LANES_H
#define PREVIEW_SIGHT_LANES_H

#include "preview/shade.h"
#include "preview/wide.h"

/* A layer: its frame, the viewer in it, and its roughness. */
typedef struct wide_layer {
    wide3 x, y, z;
    wide wo[3], alpha_x, alpha_y;
} wide_layer;

/* The same layer in every lane. */
static inline wide_layer sight_layer_of(const shade_layer *l)
{
    return (
        wide_layer){ .x = w3_splat(l->x),
                     .y = w3_splat(l->y),
                     .z = w3_splat(l->z),
                     .wo = { wide_splat((double)l->wo[0]), wide_splat((double)l->wo[1]), wide_splat((double)l->wo[2]) },
                     .alpha_x = wide_splat((double)l->surface.alpha_x),
                     .alpha_y = wide_splat((double)l->surface.alpha_y) };
}

static inline wide smaller_alpha(const wide_layer *l)
{
    return wide_smaller(l->alpha_x, l->alpha_y);
}

/* A cap takes the distribution as even over the half vectors that light the viewer. Their slopes over the roughness
 * spread by g = sine / (2 h.wi (n.h)^2 alpha) around s, and the mean of a distribution over a disk of that radius
 * differs by g^2 / 8 of its Laplacian: of GGX, D = 1 / (1 + s^2)^2, by g^2 |2 s^2 - 1| / (1 + s^2)^2 of itself, which
 * is g^2 in the middle of a highlight and 2 g^2 / s^2 far from it. So a real sun is a shape in the highlight of a
 * lacquer, and a cap wherever else, at a third of the cost. A Beckmann lobe is off by half of that in its middle; by
 * more in its tail, but by less than that of what the middle is. local: wi in the frame. */
static inline wide cap_error(const wide_layer *l, const wide local[3], wide sine)
{
    const wide3 sum = { local[0] + l->wo[0], local[1] + l->wo[1], local[2] + l->wo[2] };
    const wide length = wide_larger(w3_length(sum), wide_splat(2e-3)), h_dot_wi = 0.5 * length;
    const wide cosine = wide_larger(sum.z / length, wide_splat(1e-3));
    const wide x = sum.x / (length * cosine * l->alpha_x);
    const wide y = sum.y / (length * cosine * l->alpha_y);
    const wide g = sine / (2.0 * h_dot_wi * cosine * cosine * smaller_alpha(l)), s2 = x * x + y * y;
    /* More than |2 s^2 - 1|, which vanishes where the next term does not. */
    return g * g * (1.0 + 2.0 * s2) / ((1.0 + s2) * (1.0 + s2));
}

/* Numbers of the local frame are single precision, as the library gets them. */
static inline void to_local(const wide_layer *l, wide3 wi, wide local[3])
{
    local[0] = wide_rounded(w3_dot(wi, l->x));
    local[1] = wide_rounded(w3_dot(wi, l->y));
    local[2] = wide_rounded(w3_dot(wi, l->z));
}

#define MOST_SPREAD 0.1 /* of g in the middle of a highlight: its square is SHADE_CAP_ERROR */

/* Whether a light stands above the horizon and its cap is never off: with |wi + wo| = 2 h.wi at most 2, g is at most
 * 2 sine / (((wi + wo).n)^2 alpha), and the error is nowhere larger than for s = 0. cosine: wi.n. */
static inline wide_mask is_surely_cap(const wide_layer *l, wide cosine, wide sine)
{
    const wide sum = cosine + l->wo[2];
    return wide_less(wide_splat(0.0), l->wo[2]) & wide_less(sine, cosine) &
           wide_at_most(sine, 0.5 * MOST_SPREAD * smaller_alpha(l) * (sum * sum));
}

/* Whether it stands astride the layer's horizon, or the reflection changes over it. */
static inline wide_mask is_shape(const wide_layer *l, wide3 wi, wide cosine, wide sine)
{
    wide local[3];
    to_local(l, wi, local);
    return wide_less(wide_abs(cosine), sine) | wide_less(wide_splat(SHADE_CAP_ERROR), cap_error(l, local, sine));
}

/* What layers say is added to *is_lit and *shape; sine: of its angular radius, 0: it is no shape to anyone. */
static inline void layer_sees(const wide_layer *l, wide3 wi, wide sine, wide_mask *is_lit, wide_mask *shape)
{
    const wide zero = wide_splat(0.0), cosine = w3_dot(wi, l->z);
    const wide_mask asks = wide_less(zero, sine) & ~is_surely_cap(l, cosine, sine);
    if (wide_any(asks))
        *shape = *shape | (asks & is_shape(l, wi, cosine, sine));
    *is_lit = *is_lit | (wide_less(zero, l->wo[2]) & wide_less(zero, cosine));
}

#endif
