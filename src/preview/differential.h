/* Ray differentials: how a ray changes when the picture point moves by one pixel (Igehy 1999). */
#ifndef PREVIEW_DIFFERENTIAL_H
#define PREVIEW_DIFFERENTIAL_H

#include "preview/vector.h"

/* Per pixel step to the right (x) and downwards (y). */
typedef struct differential {
    vec3 origin_dx, origin_dy;
    vec3 direction_dx, direction_dy; /* of the unit direction: perpendicular to it */
} differential;

typedef struct surface_step {
    vec3 dx, dy;
} surface_step;

/* All parts times s: a sample that stands for 1/n of a pixel has s = 1/sqrt(n). */
differential differential_scale(const differential *d, double s);

/* The differential of the ray reflected about the unit normal: Igehy, Eqs. 14 to 16.
 *
 * direction    of the incoming ray, towards the surface
 * point        how the origin of the reflected ray moves
 * normal_step  how the unit normal turns along the same steps */
differential differential_reflect(const differential *d, vec3 direction, vec3 normal, const surface_step *point,
                                  const surface_step *normal_step);

/* A ray drawn at random stands for all directions within solid_angle_sr around it. Where that is wider than what d
 * carries, it takes the place of d's spread; direction is the drawn one. */
void differential_widen(differential *d, vec3 direction, double solid_angle_sr);

/* Variance of the slope of the half vector over the surface, per axis, within the parallelogram of directions and
 * places that d stands for, under one light far away: the viewer turns by -d and turns h by half of it, the surface
 * turns by n. */
double differential_half_vector_variance(const differential *d, const surface_step *normal_step);

#endif
