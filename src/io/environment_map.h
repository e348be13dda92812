/* Light from all around as a picture: a latitude-longitude map, from a file or from the faces of a cube.
 *
 * Row 0 is around the zenith (+y), the last row around the nadir. The middle of the picture is +x, and to the right of
 * it lies +z: a direction (x, y, z) is found at u = 1/2 + atan2(z, x) / 2 pi, v = acos(y) / pi. Blender and three.js
 * place it likewise (Blender's z is our y, its y our -z).
 */
#ifndef IO_ENVIRONMENT_MAP_H
#define IO_ENVIRONMENT_MAP_H

#include <stdbool.h>

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct environment_map {
    int width, height; /* width = 2 height */
    float *rgb;        /* radiance, linear, row 0 on top; finite and not negative */
} environment_map;

/* Any picture of image_read that is twice as wide as high and has R, G and B. Texels that hold no light there can be
 * (NaN, negative, infinite) are mended with a warning. On failure *out is zeroed. */
bool environment_map_read(const char *path, environment_map *out, report *r);

/* The level-0 faces of the scene's EXT_lights_image_based, without its rotation and intensity: PNG with alpha is
 * RGBD (sRGB codes divided by alpha), the rest plain sRGB. Seen from the middle of the cube and not mirrored, the sides
 * are upright, the top of +y and the bottom of -y face -z. */
bool environment_map_from_cube(const scene *s, environment_map *out, report *r);

void environment_map_free(environment_map *m);

/* The unit vector of a place in the map, (0, 0) its upper left corner and (1, 1) its lower right, and back. */
void environment_map_direction(double u, double v, double direction[3]);
void environment_map_place(const double direction[3], double *u, double *v);

#ifdef __cplusplus
}
#endif

#endif
