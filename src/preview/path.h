/* Indirect light: paths from surface to surface, with direct light at every hit. */
#ifndef PREVIEW_PATH_H
#define PREVIEW_PATH_H

#include "preview/surroundings.h"

/* What the sampler's dimensions are for. Those of the lights follow the others, up to that of the surroundings. */
typedef enum path_purpose {
    DIM_PIXEL,
    DIM_PLACE,
    DIM_LOBE,
    DIM_DIRECTION,
    DIM_BLEND,
    DIM_LIGHTS,
    DIM_DRAW = (1 << 20) - 3,
    DIM_GLOW,
    DIM_SURROUNDINGS
} path_purpose;

/* Every depth of a path has dimensions of its own, with room for 2^19 lights, of which each may ask for two. */
static inline uint32_t path_dimension(int depth, path_purpose purpose)
{
    return ((uint32_t)depth << 20) + (uint32_t)purpose;
}

/* What makes the hit of v.ray and v.found ready. */
hit_task path_hit(vertex *v);

/* Makes the surface at the hit, which is ready, ready for light. */
void path_look(const world *w, vertex *v, const sampler *random, int depth);

/* Light that arrives at the vertex from the sky and from other surfaces. */
void add_indirect_light(const world *w, const vertex *from, const sampler *random, radiance *sum, ray_counts *counts);

/* ---- many paths side by side ---- */

typedef struct path {
    vertex v;
    shade_point left;     /* where the last ray came from; set where surfaces glow */
    shade_direction next; /* of that ray */
    float throughput[3];
    const sampler *random;
    radiance *sum;
} path;

enum { PATH_MOST = SURROUNDINGS_MOST };

/* What the work on many paths needs, made before the first of them. */
typedef struct path_scratch {
    path paths[PATH_MOST], *active[PATH_MOST];
    pair_batch lobes, directions; /* uniforms that draw their next rays */
    const trace_ray *rays[PATH_MOST];
    trace_hit hits[PATH_MOST];
    hit_task tasks[PATH_MOST];
    bool met[PATH_MOST];
    direct_point points[PATH_MOST];
    direct_scratch direct;
    surroundings_scratch surroundings;
} path_scratch;

/* add_indirect_light for each of them, bit for bit; at most PATH_MOST, of throughput 1. */
void add_indirect_light_to_many(const world *w, const direct_point *points, int count, path_scratch *s,
                                ray_counts *counts);

#endif
