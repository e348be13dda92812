/* The lights of a scene as one of its points sees them: direction, irradiance and solid angle, or a flat shape. */
#ifndef PREVIEW_LIGHT_H
#define PREVIEW_LIGHT_H

#include "preview/effects.h"
#include "preview/vector.h"
#include "scene/scene.h"

/* The cap may not cover the hemisphere: a hair less than 2 pi, so that single precision stays below it too. */
#define LIGHT_LARGEST_CAP (2.0 * PREVIEW_PI * (1.0 - 1e-6))
/* A light without size would light no facet: an angular radius of 1e-5 rad, a 50th of a planet's disc. Taste. */
#define LIGHT_SMALLEST_ANGLE 1e-5
#define LIGHT_SMALLEST_CAP (PREVIEW_PI * LIGHT_SMALLEST_ANGLE * LIGHT_SMALLEST_ANGLE)
/* On a point that all but lies in the light: what is added up of it is still a number. */
#define LIGHT_MOST_IRRADIANCE 1e30

typedef struct light {
    scene_light_kind kind;
    vec3 position;
    vec3 axis;           /* unit, against the direction in which it shines */
    vec3 half_x, half_y; /* rectangle, disk: from the middle to the edge; half_x x half_y is where it shines */
    float intensity[3];  /* as in the file, in the unit of its kind, colour multiplied in */
    double range;        /* metres, infinite where there is none */
    double cone_scale, cone_offset; /* spot: saturate(cos * scale + offset)^2 */
    double radius;                  /* metres: point and spot */
    double cosine;                  /* directional: of its angular radius */
    double sine;                    /* likewise; 0 where it is no shape */
    float solid_angle_sr;           /* directional */
    bool unshadowed;                /* what it would bring if nothing stood in its way: for whoever compares */
} light;

light light_make(const scene_light *from);

typedef struct light_view {
    vec3 wi;              /* unit, towards the centre of the light */
    double distance;      /* metres, infinite for a directional light */
    float irradiance[3];  /* on a surface that faces the light; no shadow. Rectangle, disk: radiance */
    float solid_angle_sr; /* (0, 2 pi); not of rectangle and disk */
    double sine;          /* of the angular radius, of lights that are round and smaller than a hemisphere; else 0 */
} light_view;

/* Whether it has a flat shape, which is evaluated as a whole: see area_shadow.h. */
static inline bool light_is_area(const light *l)
{
    return EFFECT_FLAT_LIGHTS && (l->kind == SCENE_LIGHT_RECT || l->kind == SCENE_LIGHT_DISK);
}

/* Whether light_pick has a choice. */
static inline bool light_is_soft(const light *l)
{
    return l->kind == SCENE_LIGHT_DIRECTIONAL ? l->cosine < 1.0 : l->radius > 0.0;
}

/* Radiance of a light that is round, over what it sends to a surface that faces it. */
double light_radiance_per_irradiance(const light_view *view);

/* False when no light comes this way: behind a spot's cone or an area light, out of range, black. */
bool light_see(const light *l, vec3 position, light_view *out);

/* How a rectangle or a disk is seen that is so far away that it might as well be round: direction, solid angle, sine of
 * the circle around it, irradiance. False: it shows its other side, or is too near for any of that. */
bool light_see_round(const light *l, vec3 position, light_view *out);
/* What that is off: cos / d^2 changes over a flat light. */
double light_round_error(const light *l, const light_view *view);

/* A point of a rectangle or a disk, even over its area. */
vec3 light_point(const light *l, const double u[2]);
double light_area_m2(const light *l);

/* A point of a round light for a shadow ray, from two uniforms in [0, 1): its unit direction and how far the ray goes.
 */
void light_pick(const light *l, const light_view *view, vec3 position, const double u[2], vec3 *direction,
                double *distance);

/* Solid angle of a cap, 2 pi (1 - cos), without the cancellation at small angles. */
double light_cap_sr(double angular_radius_rad);

#endif
