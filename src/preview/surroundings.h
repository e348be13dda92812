/* Light that comes to a point from environment and glowing surfaces, by their own samples and by those of the surface.
 */
#ifndef PREVIEW_SURROUNDINGS_H
#define PREVIEW_SURROUNDINGS_H

#include "preview/direct.h"
#include "preview/pair_batch.h"

/* Adds throughput * (what one direction from the environment's own distribution brings) to *sum; nothing without an
 * environment. facets as in add_direct_light. */
void add_surroundings(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts);

/* Adds what a ray brings that left p in a direction of shade_sample and met nothing: environment or sky. throughput: up
 * to p. */
void add_escaped_light(const world *w, const shade_point *p, const shade_direction *found, const float throughput[3],
                       radiance *sum, ray_counts *counts);

/* Adds throughput * (what one point of the triangles that glow brings); nothing where none does. */
void add_glow(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
              const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts);

/* Adds what a ray brings that left p in a direction of shade_sample and met a triangle which add_glow may draw, too.
 * False: it is none of these, and nothing was added. */
bool add_found_glow(const world *w, const shade_point *p, const shade_direction *found, const trace_hit *at,
                    const hit *h, const float emission[3], const float throughput[3], radiance *sum,
                    ray_counts *counts);

/* ---- the first and the third for many points, bit for bit ---- */

enum { SURROUNDINGS_MOST = PAIR_BATCH };

/* Light from one direction, which waits for its shadow ray. */
typedef struct surroundings_query {
    shade_surroundings from;
    float rgb[3];
    const direct_point *to;
} surroundings_query;

/* What the work on many points needs, made before the first of them. */
typedef struct surroundings_scratch {
    pair_batch pairs;
    surroundings_query queries[SURROUNDINGS_MOST];
    trace_ray rays[SURROUNDINGS_MOST];
    bool dark[SURROUNDINGS_MOST];
    const shade_point *lit[SURROUNDINGS_MOST]; /* where nothing is in the way */
    const shade_surroundings *from[SURROUNDINGS_MOST];
    const surroundings_query *answers[SURROUNDINGS_MOST];
    glint_value values[SURROUNDINGS_MOST];
} surroundings_scratch;

/* count: at most SURROUNDINGS_MOST. */
void add_surroundings_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              surroundings_scratch *s, ray_counts *counts);
void add_glow_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                      surroundings_scratch *s, ray_counts *counts);

#endif
