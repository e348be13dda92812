/* Lights of real size at many points, compiled once for each vector width; area_many.c gathers and chooses. */
#ifndef MODEL_AREA_KERNEL_H
#define MODEL_AREA_KERNEL_H

#include "model/lobe_kernel.h"

/* Points of one material, each under a light of its own, as glint_area_light has it. */
typedef struct area_crowd {
    float wo[3][LOBE_MOST], alpha_x[LOBE_MOST], alpha_y[LOBE_MOST];
    float diffuse[3][LOBE_MOST], f0[3][LOBE_MOST], f90[3][LOBE_MOST];
    float total_area[LOBE_MOST];
    float hidden[LOBE_MOST]; /* in [0, 1] */
    int32_t kind[LOBE_MOST], two_sided[LOBE_MOST];
    float center[3][LOBE_MOST], half_x[3][LOBE_MOST], half_y[3][LOBE_MOST];
    float size[LOBE_MOST];           /* radius of a sphere, solid angle of a sun */
    int most_corners;                /* of all polygons, made even; 0: there are none, and what follows is not set */
    int32_t corner_count[LOBE_MOST]; /* 0: not a polygon, or none of this many */
    float corner[GLINT_MAX_CORNERS][3][LOBE_MOST]; /* up to most_corners; the first is repeated */
} area_crowd;

/* What area_eval_plain gives, bit for bit, and in left what it returns. count: a multiple of the width. counts: whether
 * facets will be counted. */
typedef void area_kernel(const glint_material_options *options, const area_crowd *crowd, size_t count, int counts,
                         lobe_lit *lit, float left[LOBE_MOST]);

area_kernel area_kernel_1, area_kernel_4, area_kernel_8, area_kernel_16;

/* The widest that this machine runs, at most this wide. */
area_kernel *area_kernel_widest(size_t most_lanes);

/* Of at most LOBE_MOST queries of one material, all of them under area lights. */
void area_eval_many(const model_query *q, size_t count, int counts, lobe_lit *lit);

#endif
