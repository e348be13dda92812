/* Light that comes to a point straight from the scene's lights. */
#ifndef PREVIEW_DIRECT_H
#define PREVIEW_DIRECT_H

#include "preview/area_shadow.h"
#include "preview/light_batch.h"

/* What single facets did at the point: under the light that is brightest there. */
typedef struct direct_facets {
    float count, lit_probability, brightest;
} direct_facets;

/* A point that waits for light. */
typedef struct direct_point {
    const vertex *vertex;
    const sampler *random;
    const float *throughput;
    radiance *light;
    direct_facets *facets; /* of the point that the camera sees, whose shadows get more care; else NULL */
    int entry;             /* the caller's */
} direct_point;

/* Adds throughput * (the sum over lights of E f |cos theta_i|) to the point's light; dimension: the first of
 * light_count of the sampler's dimensions that are free. */
void add_direct_light(const world *w, const direct_point *p, uint32_t dimension, ray_counts *counts);

/* About how much a light with a shape would be off as a cap, and the cap: relative, infinite where it cannot be one. */
double direct_cap_error(const light *l, const shade_point *p, vec3 position, light_view *cap);
/* The share of samples that take a cap which is off by this where it may be off by so much. */
double direct_cap_share(double error, double most);

/* ---- many points at once ---- */

/* One light at one point. */
typedef struct light_query {
    bool is_asked; /* else the light does not reach the point */
    shade_query shade;
    float irradiance[3]; /* radiance where it is seen as a shape */
    float weight;        /* how many lights it stands for */
    area_shadow shadow;  /* of a cap too: one ray */
    int first_ray;       /* that it waits for */
    float draw;          /* where shapes may be caps: uniform in [0, 1) */
    const direct_point *to;
} light_query;

enum { DIRECT_MOST_RAYS = SHADE_MOST_QUERIES * AREA_MOST_RAYS };

/* What the work on many points needs, made before the first of them. */
typedef struct direct_scratch {
    light_query queries[SHADE_MOST_QUERIES]; /* as many places a point as it may have lights */
    light_query *lit[SHADE_MOST_QUERIES];
    shade_query *shades[SHADE_MOST_QUERIES];
    glint_value values[2 * SHADE_MOST_QUERIES];
    trace_ray rays[DIRECT_MOST_RAYS];
    bool dark[DIRECT_MOST_RAYS]; /* which of them met something */
    int ray_count;
    light_batch batch;
} direct_scratch;

/* add_direct_light for each of them, bit for bit. */
void add_direct_light_to_many(const world *w, const direct_point *points, int count, uint32_t dimension,
                              direct_scratch *s, ray_counts *counts);

#endif
