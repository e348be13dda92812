/* Linearly transformed cosines (Heitz et al. 2016): a microfacet lobe for one view as a clamped cosine whose directions
 * a matrix has moved, so that its integral over polygons and ellipses is that of the cosine over the moved light.
 *
 * The matrix maps the horizon to itself: a light that has been cut at the horizon stays so. The table is made by
 * light/fit/make_ltc_table.c, for round roughness, and looked up at the very grid that it was made for.
 */
#ifndef LIGHT_LTC_H
#define LIGHT_LTC_H

#include "light/area.h"
#include "ndf/ndf.h"

/* The grid: roughness sqrt(alpha) = i / (SIDE - 1), at least .01, and cos = 1 - .99 (j / (SIDE - 1))^2. Numbers: three
 * of the transform, directional albedo with F = 1 and with F = (1 - h.wi)^5, D_PR of Kneiphof and Klein 2024, Eq. 19.
 */
enum { LTC_SIDE = 32, LTC_NUMBERS = 6 };

extern const float ltc_table[2][LTC_SIDE][LTC_SIDE][LTC_NUMBERS];

typedef struct ltc {
    vec3d row[3];    /* of the matrix, which takes the lobe to the cosine */
    vec3d column[3]; /* of its inverse */
    double determinant;
    double albedo, schlick, facets;
} ltc;

/* wo.z > 0. */
ltc ltc_find(ndf_kind kind, double alpha, vec3d wo);

/* A light with its directions moved, where the lobe is a cosine. */
typedef struct ltc_light {
    double share;   /* of the lobe that it takes in, in [0, 1] */
    vec3d middle;   /* a unit direction well within */
    int side_count; /* straight sides of the rim, from a corner to the next */
    vec3d corner[AREA_MOST_CORNERS + 1], normal[AREA_MOST_CORNERS]; /* unit; corner i x corner i + 1 */
    int arc_count; /* and arcs of span 0 + cos t span 1 + sin t span 2, one after the other */
    vec3d span[3];
    double arc[CONIC_ARCS][2]; /* cos t and sin t where they begin */
    double half_turns;         /* the length of each in t, over pi */
} ltc_light;

/* Of a light that need not have been measured. 0: it is too small. */
int ltc_move(const ltc *l, const area_light *light, ltc_light *moved);

#endif
