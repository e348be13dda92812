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

/* The light, moved, and measured. 0: too small for that. */
int ltc_move(const ltc *l, const area_light *light, area_light *moved);

/* Density of the lobe, per steradian, over the unit direction's cosine: its integral over the light is
 * moved.moment.z / pi. */
double ltc_density_over_cosine(const ltc *l, vec3d direction);

#endif
