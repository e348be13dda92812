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
enum { LTC_SIDE = 32, LTC_NUMBERS = 6, LTC_STRIDE = 8 };

extern const float ltc_table[2][LTC_SIDE][LTC_SIDE][LTC_STRIDE];

typedef struct ltc {
    vec3d row[3];    /* of the matrix, which takes the lobe to the cosine */
    vec3d column[3]; /* of its inverse */
    double determinant;
    double albedo, schlick, facets;
} ltc;

/* wo.z > 0. */
typedef ltc ltc_find(ndf_kind kind, double alpha, vec3d wo);

static inline vec3d ltc_transform(const ltc *l, vec3d v)
{
    return (vec3d){ vec3d_dot(l->row[0], v), l->row[1].x * v.x + l->row[1].y * v.y, v.z };
}

/* Lights that take in less of a lobe are none. */
#define LTC_LEAST_SHARE 1e-26

enum { LTC_MOST_SIDES = 2 * AREA_MOST_CORNERS };

/* A light with its directions moved, where the lobe is a cosine, in sectors between an apex and its rim. Volumes are
 * over its share: floats do not hold those of small lights. */
typedef struct ltc_light {
    double share;                         /* of the lobe that it takes in, in [0, 1] */
    vec3 apex;                            /* where it is closest to the pole; unit */
    int side_count, side[LTC_MOST_SIDES]; /* sides of the rim that do not pass through the apex: from corner i to the
                                             next */
    float x[LTC_MOST_SIDES + 4], y[LTC_MOST_SIDES + 4], z[LTC_MOST_SIDES + 4]; /* corners, unit */
    float volume[LTC_MOST_SIDES];                                              /* apex . (corner i x corner i + 1) */
    float bend[LTC_MOST_SIDES]; /* corner + (t + bend t (1 - t) (1 - 2 t)) (next - corner) is even in angles */
    /* Of a round light: arcs of x = sine_x cos t, y = sine_y sin t along its own axes, and what is left of one along z,
     * so that they are even in angles however long the light is. */
    int arc_count;
    vec3 axis_x, axis_y, axis_z;
    float sine_x, sine_y;
    vec3 apex_in_axes;            /* over the share */
    float arc[CONIC_ARCS][2];     /* cos t and sin t where they begin */
    float half_turns[CONIC_ARCS]; /* the length of each in t, over pi */
} ltc_light;

/* bend of a side, by y = 1 - the cosine of its angle in [0, 1]: y (1 + y (2 + y 3)). A fit to the nodes of quadrature.
 */
#define LTC_BEND_1 0.3333
#define LTC_BEND_2 0.0857
#define LTC_BEND_3 0.0487

/* What ltc_move does with a cone. */
void ltc_move_round(const ltc *l, const area_light *light, ltc_light *moved);

/* Of a light that need not have been measured. 0: it is too small. */
typedef int ltc_move(const ltc *l, const area_light *light, ltc_light *moved);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
ltc_find ltc_find_base, ltc_find_avx2;
ltc_move ltc_move_base, ltc_move_avx2;

#endif
