/* A sample of a pixel step by step, for whoever takes many of them through each step together. */
#ifndef PREVIEW_CAMERA_SAMPLE_H
#define PREVIEW_CAMERA_SAMPLE_H

#include "preview/camera_batch.h"
#include "preview/path.h"

typedef struct camera_sample {
    sampler first, random; /* of the first surface, and of the one that is looked at */
    double jitter[2];      /* where in its pixel */
    int layer;             /* blended surfaces that the ray has passed */
    float transmittance;   /* of those */
    vertex vertex;         /* what it sees behind them */
    radiance light;        /* that comes from there */
    direct_facets facets;
} camera_sample;

/* What light of the surface that is looked at is multiplied with. */
extern const float camera_sample_throughput[3];

/* Sample number index of the pixel (x, y): its ray, which is to be traced with TRACE_BLEND_SOLID. */
void camera_sample_leave(const world *w, int x, int y, uint32_t index, camera_sample *s);
/* The same for sample number index of a block of pixels; pixels: hashes of a sampler's own. */
void camera_sample_leave_many(const world *w, uint32_t index, camera_batch *b, camera_sample samples[CAMERA_BATCH]);
/* The ray has met vertex.hit: what that emits. */
void camera_sample_look(const world *w, camera_sample *s);
/* It has met nothing, and the sample ends. */
void camera_sample_miss(const world *w, const camera_sample *s, pixel_sample *out);
/* All light of the surface has been added. described: all of *out, not only light and alpha. */
void camera_sample_end(const world *w, const camera_sample *s, bool described, pixel_sample *out);
/* The ray to the next surface behind. False: nothing can be seen of that, and the sample ends. */
bool camera_sample_go_on(camera_sample *s);

#endif
