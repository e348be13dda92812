/* Flakes as a normal map: facets that, each with a narrower lobe, together reflect as the smooth material does.
 *
 * A viewer that knows only glTF 2.0 shades every texel with GGX of roughness alpha_rest around the texel's normal. The
 * mean over texels shall be the lobe D of the material (alpha_x, alpha_y, GGX or Beckmann). At normal incidence a texel
 * with normal n reflects D_rest(n.h) / (4 n.v), the material D(h) / (4 cos): so the texels' normals need a density M
 * with integral of M(n) D_rest(n.h) / n.v dn = D(h), which Richardson and Lucy's iteration finds without ever leaving
 * the densities (Richardson 1972, Lucy 1974). Stretched slopes make it anisotropic.
 */
#ifndef EXPORTERS_GLTF_FLAKES_H
#define EXPORTERS_GLTF_FLAKES_H

#include <stdbool.h>
#include <stdint.h>

#include "glint.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { FLAKES_SIDE = 256, FLAKES_COUNT = FLAKES_SIDE * FLAKES_SIDE, FLAKES_RINGS = 128 };

typedef struct flakes_request {
    glint_distribution distribution;
    float alpha_x, alpha_y, facet_alpha;
    double direction_rad; /* of alpha_x, from the tangent */
    uint32_t seed;
} flakes_request;

/* Densities as functions of the angle with the normal. */
typedef struct flakes_rings {
    double edge[FLAKES_RINGS + 1];             /* slopes */
    double angle[FLAKES_RINGS];                /* of the middles */
    double wanted[FLAKES_RINGS];               /* D at the middles */
    double weight[FLAKES_RINGS];               /* solid angle times cosine */
    double mass[FLAKES_RINGS];                 /* of M in a ring */
    double kernel[FLAKES_RINGS][FLAKES_RINGS]; /* [of h][of n] */
} flakes_rings;

typedef struct flakes {
    float alpha_rest;              /* what is left for the roughness of the material */
    float scale;                   /* normalTexture.scale: slopes are stored larger, so that eight bits suffice */
    uint8_t rgb[3 * FLAKES_COUNT]; /* row 0 on top */
    flakes_rings work;             /* working memory */
    uint32_t places[FLAKES_COUNT]; /* likewise: where each facet lies */
} flakes;

/* Returns false where facets are no narrower than the lobe, so that there is nothing to show. */
bool flakes_make(const flakes_request *request, flakes *out);

#ifdef __cplusplus
}
#endif

#endif
