/* Light that comes to a point straight from the scene's lights. */
#ifndef PREVIEW_DIRECT_H
#define PREVIEW_DIRECT_H

#include "preview/integrator.h"
#include "preview/sampler.h"

/* What single facets did at the point: under the light that is brightest there. */
typedef struct direct_facets {
    float count, lit_probability, brightest;
} direct_facets;

/* Adds throughput * (the sum over lights of E f |cos theta_i|) to *sum; dimension: the first of light_count of the
 * sampler's dimensions that are free. facets: of the point that the camera sees, whose
 * shadows get more care; else NULL. */
void add_direct_light(const world *w, const hit *h, const shade_point *p, const sampler *random, uint32_t dimension,
                      const float throughput[3], radiance *sum, direct_facets *facets, ray_counts *counts);

/* About how much a light with a shape would be off as a cap, and the cap: relative, infinite where it cannot be one. */
double direct_cap_error(const light *l, const shade_point *p, vec3 position, light_view *cap);

/* ---- many points at once ---- */

/* One that the camera sees. */
typedef struct direct_point {
    const hit *hit;
    const shade_point *point;
    const sampler *random;
    radiance *light;
    direct_facets *facets;
    int entry; /* the caller's */
} direct_point;

/* One light at one point. */
typedef struct light_query {
    shade_query shade;
    float irradiance[3]; /* radiance where it is seen as a shape */
    float weight;        /* how many lights it stands for */
    bool waits;          /* for its shadow ray */
    trace_ray shadow;
    const direct_point *to;
} light_query;

/* What the work on many points needs, made before the first of them. */
typedef struct direct_scratch {
    light_query queries[SHADE_MOST_QUERIES], *lit[SHADE_MOST_QUERIES];
    shade_query *shades[SHADE_MOST_QUERIES];
} direct_scratch;

/* add_direct_light for each of them, with a throughput of 1, bit for bit. */
void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts);

#endif
