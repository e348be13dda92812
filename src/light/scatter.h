/* Points of a light: directions to it, and the density with which they are drawn. */
#ifndef LIGHT_SCATTER_H
#define LIGHT_SCATTER_H

#include "light/area.h"

/* A unit direction from two uniforms in [0, 1). It may lie below the horizon where the horizon cuts a round light. */
vec3d scatter_direction(const area_light *light, double u1, double u2);

/* The density of the above, per steradian, for any unit direction in the light. */
double scatter_density(const area_light *light, vec3d direction);

#endif
