/* The triangles that glow, as a light that can be sampled. */
#ifndef PREVIEW_EMITTERS_H
#define PREVIEW_EMITTERS_H

#include "preview/trace.h"

typedef struct emitter {
    int instance;
    uint32_t triangle;
    double area_m2;
} emitter;

/* Triangles of opaque materials that emit and have no coat over their glow. */
typedef struct emitters {
    const geometry *geometry;
    emitter *triangles;
    double *edges; /* count + 1: the share of the power before a triangle */
    int count;
    int *first; /* of every instance: where its triangles begin, or -1 */
} emitters;

/* count is 0 where nothing glows. The geometry must outlive the result. */
bool emitters_make(const geometry *g, emitters *out, report *r);
void emitters_free(emitters *e);

typedef struct emitter_point {
    trace_hit at; /* distance 0 */
    vec3 position;
    vec3 normal; /* unit, of the front */
    bool two_sided;
    double area_m2;      /* of the triangle */
    double pdf_per_area; /* per m^2 */
} emitter_point;

/* Draws a triangle by its power and a point on it, evenly. count > 0. */
void emitters_sample(const emitters *e, const double u[2], emitter_point *out);
/* Where a ray that was not drawn from here met a triangle. False: it is none of these. */
bool emitters_find(const emitters *e, const trace_hit *at, emitter_point *out);

#endif
