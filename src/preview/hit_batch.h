/* Hits side by side, as a structure of arrays: what a batch of them reads, and what comes of it. */
#ifndef PREVIEW_HIT_BATCH_H
#define PREVIEW_HIT_BATCH_H

#include "preview/hit.h"

enum { HIT_BATCH = 16 };

typedef struct hit_batch {
    const geometry_instance *placed[HIT_BATCH];
    /* What the mesh has at each corner, by its axes. */
    float position[3][3][HIT_BATCH], normal[3][3][HIT_BATCH];
    float tangent[3][3][HIT_BATCH]; /* zeros where the mesh has none; set where has_tangents */
    bool has_tangents;              /* any of them */
    double handedness[HIT_BATCH];   /* 1 or -1: right and left swapped, by the tangents or by the node */
    double origin[3][HIT_BATCH], direction[3][HIT_BATCH], step[4][3][HIT_BATCH]; /* of the rays */
    /* In and out: what Embree says, made exact. */
    double weights[2][HIT_BATCH], distance[HIT_BATCH];
    /* Out. */
    double place[3][HIT_BATCH], place_object[3][HIT_BATCH], shadow_origin[3][HIT_BATCH], clearance[HIT_BATCH];
    double flat[3][HIT_BATCH], smooth[3][HIT_BATCH], along[3][HIT_BATCH], across[3][HIT_BATCH];
    double side[HIT_BATCH]; /* 1: seen from the front; -1 */
    double place_step[2][3][HIT_BATCH], weights_step[2][2][HIT_BATCH];
} hit_batch;

#endif
