/* One facet of the explicit surface: from the cell that it fills to its normal. */
#ifndef MODEL_FACET_H
#define MODEL_FACET_H

#include <stdint.h>

#include "glint.h"
#include "math/vec3.h"
#include "ndf/ndf.h"

typedef struct facet_uniforms {
    double radius, azimuth; /* [0, 1) */
} facet_uniforms;

/* The same numbers as the renderer that the mode is named after draws for this cell.
 * Cycles: White Noise 3D of (x, y, seed), Jenkins's lookup3 on the bits of the floats, channels 0 and 1; x and y below
 * 2^24. POV-Ray: ((h + k + c) mod M)^3 mod M chained over x, y and seed, exact in doubles. */
facet_uniforms facet_hash(glint_facet_hash mode, int64_t x, int64_t y, uint32_t seed);

/* One more number in [0, 1] of the same cell, for its tint. Cycles: channel 2 of the White Noise, its blue. POV-Ray:
 * one chain more, with the keys 2718281 and 31337. */
double facet_tint_hash(glint_facet_hash mode, int64_t x, int64_t y, uint32_t seed);

/* The normal for these uniforms. Facets of equal projected area: slopes follow P22, radius alpha sqrt(-ln(1 - u)) or
 * alpha sqrt(u / (1 - u)). Facets of equal area: slopes follow P22 sqrt(1 + slope^2) / D_H. */
vec3 facet_normal(const ndf *n, glint_weighting weighting, facet_uniforms u);

#endif
