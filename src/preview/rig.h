/* What lights a file that brings no light of its own: three lights and a sky. */
#ifndef PREVIEW_RIG_H
#define PREVIEW_RIG_H

#include "preview/preview.h"
#include "preview/vector.h"

#define RIG_LIGHT_COUNT 3

/* How the view of a camera lies in the world, for lights that stand around it: level, but for straight views. */
typedef struct rig_axes {
    vec3 towards_camera, right, up;
} rig_axes;
rig_axes rig_axes_of(const scene_camera *camera);
/* A direction from the subject: azimuth to the right of the camera, elevation above the ground; radians. */
vec3 rig_direction(const rig_axes *axes, double azimuth, double elevation);

/* Key, fill and rim, placed around the view of the camera; without names. */
void rig_lights(const scene_camera *camera, scene_light lights[RIG_LIGHT_COUNT]);

/* The studio around the rig. */
preview_sky rig_sky(void);

/* Radiance from a direction (world, unit). */
void sky_radiance(const preview_sky *sky, vec3 direction, float rgb[3]);

#endif
