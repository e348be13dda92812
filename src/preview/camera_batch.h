/* Camera rays side by side, as a structure of arrays. */
#ifndef PREVIEW_CAMERA_BATCH_H
#define PREVIEW_CAMERA_BATCH_H

#include "preview/camera.h"

enum { CAMERA_BATCH = 64 };

typedef struct camera_batch {
    double x[CAMERA_BATCH], y[CAMERA_BATCH];                    /* pixels */
    uint32_t pixel[CAMERA_BATCH], reversed[CAMERA_BATCH];       /* of their samplers */
    uint32_t dimension;                                         /* where in the pixel */
    double scale;                                               /* of the steps: what a sample stands for */
    double jitter[2][CAMERA_BATCH];                             /* out: that place */
    double origin[3][CAMERA_BATCH], direction[3][CAMERA_BATCH]; /* out, this and the rest */
    double near[CAMERA_BATCH], far[CAMERA_BATCH];
    double origin_step[2][3][CAMERA_BATCH], direction_step[2][3][CAMERA_BATCH];
} camera_batch;

/* Ray number i, and its differential. */
void camera_batch_take(const camera_batch *b, int i, trace_ray *ray, differential *d);

#endif
