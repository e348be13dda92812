/* Light that comes to a point straight from the scene's lights. */
#ifndef PREVIEW_DIRECT_H
#define PREVIEW_DIRECT_H

#include "preview/integrator.h"
#include "preview/sampler.h"

/* What single facets did at the point: under the light that is brightest there. */
typedef struct direct_facets {
    float count, lit_probability;
} direct_facets;

/* Adds throughput * (the sum over lights of E f |cos theta_i|) to *sum; dimension: the first of light_count of the
 * sampler's dimensions that are free. facets: of the point that the camera sees, whose
 * shadows get more care; else NULL. */
void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts);

#endif
