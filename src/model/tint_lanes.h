/* The colour of one facet from one uniform, in lanes: what every model draws its tints with. */
#ifndef MODEL_TINT_LANES_H
#define MODEL_TINT_LANES_H

#include "math/elementary.h"
#include "model/tint.h"

/* 24 bits in [0, 1). */
static inline vfloat tint_uniform_of(vuint hash)
{
    return to_float((vint)(hash >> 8)) * 0x1p-24F;
}

/* The tint less white, for a uniform in [0, 1): -1 or more, zero in the mean.
 *
 * A hue t turns channel c to 1 + variation cos(2 pi (t + c / 3)): never negative, the sum of the channels is 3. */
static inline void tint_less_white(const tint_palette *palette, vfloat uniform, vfloat rgb[3])
{
    const vfloat place = uniform * palette->count; /* below count, for 24 bits and up to eight colours */
    const vint pick = to_int(place);
    for (int c = 0; c < 3; c++)
        rgb[c] = lookup_f(palette->color[c], pick);
    if (palette->variation > 0.0F) {
        const vfloat hue = place - to_float(pick);
        for (int c = 0; c < 3; c++) {
            const vfloat turned = hue + (float)c * (1.0F / 3.0F);
            vfloat sine, cosine;
            sincos_pi(choose(less(turned, splat(1.0F)), turned, turned - 1.0F), &sine, &cosine);
            /* cos(2 pi t) = 1 - 2 sin^2(pi t) */
            rgb[c] = rgb[c] * (1.0F + palette->variation * (1.0F - 2.0F * min_f(sine * sine, splat(1.0F))));
        }
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = rgb[c] - 1.0F;
}

#endif
