/* The smooth reflection of many points, compiled once for each vector width; lobe_many.c gathers and chooses. */
#ifndef MODEL_LOBE_KERNEL_H
#define MODEL_LOBE_KERNEL_H

#include <stddef.h>

#include "model/model.h"

enum { LOBE_MOST = 64 }; /* points at a time, a multiple of every width */

/* Points of one material, under caps. */
typedef struct lobe_points {
    float wo[3][LOBE_MOST], wi[3][LOBE_MOST], alpha_x[LOBE_MOST], alpha_y[LOBE_MOST];
    float diffuse[3][LOBE_MOST], f0[3][LOBE_MOST], f90[3][LOBE_MOST];
    float total_area[LOBE_MOST], solid_angle[LOBE_MOST];
} lobe_points;

/* What lobe_eval, lobe_lit_solid_angle and lobe_lit_probability give, bit for bit. */
typedef struct lobe_lit {
    float specular[3][LOBE_MOST], diffuse[3][LOBE_MOST];
    /* Half vector, lit cap of half vectors seen from above, lit probability: not set where no light is counted. */
    float h[2][LOBE_MOST], cap[LOBE_MOST], p[LOBE_MOST];
} lobe_lit;

/* count: a multiple of the width. counts: whether facets will be counted. */
typedef void lobe_kernel(const glint_material_options *options, const lobe_points *points, size_t count, int counts,
                         lobe_lit *lit);

lobe_kernel lobe_kernel_1, lobe_kernel_4, lobe_kernel_8, lobe_kernel_16;

/* The widest that this machine runs, at most this wide. */
lobe_kernel *lobe_kernel_widest(size_t most_lanes);

/* Of at most LOBE_MOST queries of one material, none of them under an area light. */
void lobe_eval_many(const model_query *q, size_t count, int counts, lobe_lit *lit);

#endif
