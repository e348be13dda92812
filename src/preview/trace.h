/* What a ray hits first, and whether anything stands in its way. */
#ifndef PREVIEW_TRACE_H
#define PREVIEW_TRACE_H

#include "preview/geometry.h"

typedef struct trace_scene trace_scene;

typedef struct trace_ray {
    vec3 origin, direction; /* unit */
    double near, far;       /* metres along the ray */
    uint32_t random;        /* decides whether the ray passes a blended surface */
} trace_ray;

typedef struct trace_hit {
    int instance;
    uint32_t triangle;
    double distance;   /* metres */
    double weights[2]; /* of the triangle's corners 1 and 2 */
    bool through_back; /* a back that throws a shadow lies before it: set where nothing is hit, too */
} trace_hit;

/* Opacity in [0, 1] of a point; asked only for triangles whose material masks or blends. Called by any thread. */
typedef float (*trace_opacity)(const void *user, const trace_hit *at);

/* How a ray takes surfaces that let light through. */
typedef enum trace_blending {
    TRACE_BLEND_SOLID, /* it stops at a blended surface unless that is fully clear there: the caller mixes the layers */
    TRACE_BLEND_RANDOM /* it stops with the probability of the opacity, by ray.random: one path, right in the mean */
} trace_blending;

/* How the trees of the meshes are made. Of surfaces that coincide each tree may find another one first. */
typedef enum trace_trees {
    TRACE_TREES_FINE, /* by the surface of their boxes: for many rays */
    TRACE_TREES_QUICK /* along a curve through space: a fifth of the work, for few rays */
} trace_trees;

/* Which of them take the least work for so many samples of a picture. */
trace_trees trace_trees_for(const geometry *g, double samples);

/* The geometry must outlive the result. */
bool trace_build(const geometry *g, trace_trees trees, trace_opacity opacity, const void *user, trace_scene **out,
                 report *r);
void trace_free(trace_scene *t);

/* The closest surface; the back of a single-sided material and what a mask cuts away are not there. Where it is, *hit
 * says in single precision: hit_resolve makes that exact. */
bool trace_closest(const trace_scene *t, const trace_ray *ray, trace_blending blending, trace_hit *hit);

/* Whether anything lies between near and far. A single-sided surface throws its shadow from both sides. */
bool trace_occluded(const trace_scene *t, const trace_ray *ray);

/* The same two for rays that run side by side, and with TRACE_BLEND_SOLID in much the same direction; bit i of the
 * result is what they say of ray i. NULL: there is no such ray. Of surfaces that coincide, another ray of the packet
 * may decide which is hit; nothing else depends on them. */
enum { TRACE_PACKET = 16 };
uint32_t trace_closest_packet(const trace_scene *t, const trace_ray *const rays[TRACE_PACKET], trace_blending blending,
                              trace_hit hits[TRACE_PACKET]);
uint32_t trace_occluded_packet(const trace_scene *t, const trace_ray *const rays[TRACE_PACKET]);

/* For any number of rays, in packets of neighbours. */
void trace_closest_many(const trace_scene *t, const trace_ray *const *rays, int count, trace_blending blending,
                        trace_hit *hits, bool *met);
void trace_occluded_many(const trace_scene *t, const trace_ray *rays, int count, bool *dark);

#endif
