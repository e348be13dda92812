/* Light that comes to a point from all around: the environment, by its own samples and by those of the surface. */
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

#endif
