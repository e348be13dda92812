/* Points to count at: what pixels ask of the kernel. */
#ifndef BENCH_WORKLOAD_H
#define BENCH_WORKLOAD_H

#include "model/counting_kernel.h"

enum { WORKLOAD_POINTS = 4096 };

typedef struct workload {
    const char *name;
    counting_points points;
    double u[WORKLOAD_POINTS], v[WORKLOAD_POINTS];
    float dudx[WORKLOAD_POINTS], dudy[WORKLOAD_POINTS], dvdx[WORKLOAD_POINTS], dvdy[WORKLOAD_POINTS];
    float density[WORKLOAD_POINTS], hx[WORKLOAD_POINTS], hy[WORKLOAD_POINTS], cap[WORKLOAD_POINTS], p[WORKLOAD_POINTS];
    uint32_t seed[WORKLOAD_POINTS], place[WORKLOAD_POINTS];
    float factor[WORKLOAD_POINTS], facets[WORKLOAD_POINTS]; /* room for what comes out */
} workload;

/* The lit facets N p and the probability p are log-uniform in these ranges. */
typedef struct workload_kind {
    const char *name;
    double lit_low, lit_high, p_low, p_high;
    int group; /* so many neighbouring pixels in a row look alike; 1: every point is on its own */
} workload_kind;

/* mix, sparse, dense in groups of 16, and mix without groups. */
enum { WORKLOAD_KINDS = 4 };
extern const workload_kind workload_kinds[WORKLOAD_KINDS];

void workload_fill(workload *w, const workload_kind *kind);
/* Makes it WORKLOAD_POINTS lights, so many at each of the first points. They share the points, or each is at a point of
 * its own that is like the others'. */
void workload_add_lights(workload *w, int each, int share);

#endif
