/* How large a scene is. */
#ifndef IO_SCENE_BOUNDS_H
#define IO_SCENE_BOUNDS_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fills bounds_min and bounds_max from all instances: exact for scenes of usual size; past 2^28 vertices over all
 * instances, boxes around the turned boxes of the meshes, which are a little larger. min is 1 and max is -1 when there
 * are no instances. */
void scene_compute_bounds(scene *s);

/* Area of a triangle of an instance, m^2. */
double scene_triangle_area(const scene *s, const scene_instance *instance, uint32_t triangle);

#ifdef __cplusplus
}
#endif

#endif
