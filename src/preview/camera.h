/* Camera rays with their differentials, perspective and orthographic. */
#ifndef PREVIEW_CAMERA_H
#define PREVIEW_CAMERA_H

#include "preview/differential.h"
#include "preview/trace.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef struct camera {
    scene_projection projection;
    vec3 origin, right, up, forward; /* unit, world */
    double half_width, half_height;  /* perspective: at 1 m in front; orthographic: metres */
    double middle_x, middle_y;       /* likewise, of the picture's middle: 0 but for a shifted lens */
    double near, far;                /* metres along forward; far may be infinite */
    int width, height;               /* pixels */
} camera;

/* Pixels are square. Where the picture's shape is not the camera's, all that the camera frames is seen, and more at two
 * sides. A transform without three axes is an error. */
bool camera_make(const scene_camera *from, int width, int height, camera *out, report *r);

/* The ray through the point (x, y) of the picture in pixels, (0, 0) the upper left corner; random is not set. */
void camera_ray(const camera *c, double x, double y, trace_ray *ray, differential *d);

/* Metres along the viewing direction. */
double camera_depth(const camera *c, vec3 position);

#endif
