/* A light of real size as one point sees it: the convex cone of directions towards it, cut at the horizon.
 *
 * The cone is a spherical polygon, or the cone over an ellipse, which is what disks, spheres and suns look like. All of
 * it is exact: the solid boundary, the horizon, and the integral of the direction over the light (Lambert's formula for
 * polygons; its closed form over arcs of an ellipse). Local frame of the point, z its normal. Double precision: a light
 * of 1e-9 sr still has its shape.
 */
#ifndef LIGHT_AREA_H
#define LIGHT_AREA_H

#include "light/conic.h"
#include "math/vec3d.h"

enum {
    AREA_MOST_CORNERS = 10, /* eight, and two where the horizon cuts */
    AREA_MOST_PIECES = AREA_MOST_CORNERS
};

typedef enum area_kind { AREA_NOTHING = 0, AREA_POLYGON, AREA_CONIC } area_kind;

typedef struct area_light {
    area_kind kind;
    int corner_count;
    vec3d corner[AREA_MOST_CORNERS]; /* above the horizon in one sense of rotation; unit from area_measure on */
    vec3d span[3];                   /* of a cone over an ellipse: towards its middle, and the half axes from there */
    int is_whole;                    /* that cone lies above the horizon */
    int has_axes;                    /* and its axes are known */
    conic cone;                      /* from area_measure */
    vec3d moment; /* from area_measure: integral of the direction over the light, sr; z: of the cosine */
    vec3d middle; /* from area_measure: a unit direction well within the light */
} area_light;

/* Each leaves kind AREA_NOTHING where the point sees nothing of the light: it is edge-on, below the horizon, turned
 * away (one-sided), of no area, or not made of finite numbers. Lengths in any one unit. */

/* Convex, 3 to 8 corners, lit on the side from which they run counter-clockwise. */
void area_make_polygon(area_light *light, const vec3d *corner, int count, int two_sided);
/* Lit on the side of half_x x half_y. */
void area_make_rectangle(area_light *light, vec3d center, vec3d half_x, vec3d half_y, int two_sided);
void area_make_ellipse(area_light *light, vec3d center, vec3d half_x, vec3d half_y, int two_sided);
/* A round cone of directions around the unit vector `axis`; the sine and cosine of its angular radius, >= 0. */
void area_make_round(area_light *light, vec3d axis, double sine, double cosine);

/* The cone over center + x half_x + y half_y, x^2 + y^2 <= 1, directions of any length. */
void area_make_cone(area_light *light, vec3d center, vec3d half_x, vec3d half_y);

/* Makes corners unit and fills in cone, moment and middle, which what follows needs. 0, and AREA_NOTHING: the light is
 * too small to have them. */
int area_measure(area_light *light);

/* Whether a measured light lies in this direction (any length). */
int area_contains(const area_light *light, vec3d direction);
/* The same, or by less than a millionth beside it. */
int area_touches(const area_light *light, vec3d direction);

/* The boundary in pieces, which follow each other and close. */
int area_piece_count(const area_light *light);
/* Where the boundary is at t in [0, 1] of a piece, not unit, and its derivative by t. */
void area_boundary(const area_light *light, int piece, double t, vec3d *at, vec3d *derivative);

#endif
