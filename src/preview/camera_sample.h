/* A sample of a pixel step by step, for whoever takes many of them through each step together. */
#ifndef PREVIEW_CAMERA_SAMPLE_H
#define PREVIEW_CAMERA_SAMPLE_H

#include "preview/direct.h"

typedef struct camera_sample {
    sampler random;
    double jitter[2]; /* where in its pixel */
    vertex vertex;    /* what it sees first */
    radiance light;   /* that comes from there */
    direct_facets facets;
} camera_sample;

/* The dimensions of the sampler for the lights at what it sees first. */
uint32_t camera_sample_lights(void);

/* Sample number index of the pixel (x, y): its ray. */
void camera_sample_leave(const world *w, int x, int y, uint32_t index, camera_sample *s);
/* The ray has met vertex.found, of layers the first, with TRACE_BLEND_SOLID: what that emits. */
void camera_sample_look(const world *w, camera_sample *s);
/* It has met nothing. */
void camera_sample_miss(const world *w, const camera_sample *s, pixel_sample *out);
/* Direct light has been added: all the rest, and the surfaces behind. described: all of *out, not only light and
 * alpha. */
void camera_sample_end(const world *w, camera_sample *s, bool described, pixel_sample *out, ray_counts *counts);

#endif
