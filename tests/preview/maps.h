/* Environment maps made in C for tests. */
#ifndef MAPS_H
#define MAPS_H

#include "preview/preview.h"
#include "preview/vector.h"

/* width x width / 2 texels of one grey. */
environment_map maps_even(int width, float level);
void maps_set(environment_map *m, int x, int y, float level);
/* Sets all texels whose middles lie within radius (rad) of the direction; returns their solid angle. */
double maps_add_disc(environment_map *m, vec3 towards, double radius, float level);
/* Solid angle of a texel: difference of cosines times width. */
double maps_texel_sr(const environment_map *m, int y);
/* Integral of the green light over the sphere. */
double maps_light(const environment_map *m);

/* Not turned, as bright as it is. */
preview_environment maps_environment(const environment_map *m);
/* From a place in the map to a direction in the world and back, by the quaternion's definition, q d q*. */
vec3 maps_direction(const preview_environment *e, double u, double v);
void maps_place(const preview_environment *e, vec3 direction, double place[2]);

#endif
