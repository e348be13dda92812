/* Light that reaches the camera through one point of the picture: a path with direct light at every hit. */
#ifndef PREVIEW_INTEGRATOR_H
#define PREVIEW_INTEGRATOR_H

#include "preview/camera.h"
#include "preview/clear_sight.h"
#include "preview/emitters.h"
#include "preview/environment.h"
#include "preview/light_tree.h"
#include "preview/preview.h"
#include "preview/shade.h"

/* All that a sample reads; nothing of it changes while rendering. */
typedef struct world {
    const kernels *kernels;
    const geometry *geometry;
    const trace_scene *trace;
    const camera *camera;
    const light *lights;
    int light_count;
    const light_tree *light_tree; /* where there are more lights than MOST_LIGHTS */
    const emitters *emitters;     /* NULL: nothing glows, or bounces that would find it are not asked for */
    shader shader;
    preview_sky sky;
    const environment *environment; /* in place of the sky; NULL: none */
    bool has_sky, sky_seen;         /* seen: by the camera */
    bool is_blended;                /* a surface lets rays through at random */
    bool has_coats;                 /* a surface has two layers */
    int bounces, spp;
    /* The samples' footprints tile a pixel, side x side of them: the largest power of two whose square is at most spp,
     * so that each has as many samples. */
    int footprint_side;
    /* Facets are counted under tiles that may be larger, glint_side x glint_side of them: no more than 4 x 4, whatever
     * the number of samples. A model that counts whole tiles shows other facets under other tiles; so the picture has a
     * limit to which samples bring it, and it is the same facets at 16 samples and at 1024. The explicit model adds up
     * facets, and its picture is the same under any tiles. docs/plan.md has what the number does to the statistics of
     * blocks. */
    int glint_side;
    uint32_t seed;
    const uint8_t *sights; /* a clear_sight of each light, material by material; NULL: nothing is proven */
    double cap_error; /* so much may a light with a shape be off where it is taken as round and small; 0: nothing */
} world;

/* The same light twice: with single facets and without. */
typedef struct radiance {
    float discrete[3], smooth[3];
} radiance;

typedef struct pixel_sample {
    radiance light; /* multiplied by alpha */
    float alpha;    /* coverage */
    float facet_count, lit_probability;
    float normal[3], albedo[3];
    float depth; /* metres; 0: nothing was hit */
} pixel_sample;

/* One place on a path: the ray that leads there and what it meets. */
typedef struct vertex {
    trace_ray ray;
    differential step;
    trace_hit found;
    hit hit;
    hit_step hit_step;
    surface_step turn; /* of the normal; where the path goes on */
    shade_point point;
} vertex;

/* The counters of a thread. */
typedef struct ray_counts {
    uint64_t camera_rays, shadow_rays, bounce_rays, glint_evals, smooth_evals;
    uint64_t over_limit; /* evaluations with more facets than the explicit model visits */
    float most_facets;   /* of those */
} ray_counts;

/* How many samples a pixel gets, and its footprints. model: of the options. */
void world_take_samples(world *w, int spp, int model);

/* What sample number index of the pixel (x, y) sees first. False: nothing. */
bool integrate_first(const world *w, int x, int y, uint32_t index, vertex *v);

/* Sample number index of the pixel (x, y), which stands for 1/spp of it. */
void integrate(const world *w, int x, int y, uint32_t index, pixel_sample *out, ray_counts *counts);

#endif
