/* Light that comes to a point from environment and glowing surfaces, by their own samples and by those of the surface.
 */
#ifndef PREVIEW_SURROUNDINGS_H
#define PREVIEW_SURROUNDINGS_H

#include "preview/direct.h"

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

#endif
