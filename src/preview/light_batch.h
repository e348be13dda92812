/* Points side by side, as a structure of arrays, and how they see one light after the other. */
#ifndef PREVIEW_LIGHT_BATCH_H
#define PREVIEW_LIGHT_BATCH_H

#include "preview/light.h"
#include "preview/sampler.h"
#include "preview/shade.h"

enum { LIGHT_BATCH = 64 };

typedef struct light_layer {
    double x[3][LIGHT_BATCH], y[3][LIGHT_BATCH], z[3][LIGHT_BATCH]; /* the frame */
    float wo[3][LIGHT_BATCH], alpha_x[LIGHT_BATCH], alpha_y[LIGHT_BATCH];
} light_layer;

typedef struct light_batch {
    int count, layers;                                    /* beyond count, up to a whole vector, points are set, too */
    double place[3][LIGHT_BATCH], origin[3][LIGHT_BATCH]; /* of the point, and of its shadow rays */
    light_layer layer[2];                                 /* points with fewer have one of them twice */
    uint32_t pixel[LIGHT_BATCH], reversed[LIGHT_BATCH];   /* of their samplers */
    /* Out: the light's view, see light_view, and the ray to a place of a round light, even over it. */
    double wi[3][LIGHT_BATCH], distance[LIGHT_BATCH], sine[LIGHT_BATCH];
    double direction[3][LIGHT_BATCH], far[LIGHT_BATCH];
    float irradiance[3][LIGHT_BATCH], solid_angle_sr[LIGHT_BATCH];
    /* Bit k for point k: it sees the light, as a cap or a shape; it sees a shape. */
    uint64_t seen, shapes;
} light_batch;

/* Point number i of a batch that has so many layers, at least as many as the point. */
void light_batch_set(light_batch *b, int i, const hit *h, const shade_point *p, const sampler *random);

/* How the point sees the light. */
light_view light_batch_view(const light_batch *b, int point);

#endif
