/* A scene ready for rays, for tests that need no picture. */
#ifndef TRACED_SCENE_H
#define TRACED_SCENE_H

#include "preview/hit.h"

typedef struct traced_scene {
    geometry geometry;
    trace_scene *trace;
    int warnings;
} traced_scene;

/* opacity may be NULL: 1 everywhere. Fails the test when the scene cannot be built. */
void traced_open(traced_scene *t, const scene *s, trace_opacity opacity);
/* The same with trees of either kind. */
void traced_open_in(traced_scene *t, const scene *s, trace_trees trees, trace_opacity opacity);
void traced_close(traced_scene *t);

/* A ray from one point through another. */
trace_ray traced_ray(vec3 from, vec3 through);
/* False: nothing is hit. */
bool traced_hit(const traced_scene *t, const trace_ray *ray, hit *out);
/* The same, and what a step of the ray does on the surface. */
bool traced_hit_step(const traced_scene *t, const trace_ray *ray, const differential *d, hit *out, hit_step *step);

#endif
