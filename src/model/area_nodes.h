/* The sums of area_plain.h over the points of one light, eight of them at a time. */
#ifndef MODEL_AREA_NODES_H
#define MODEL_AREA_NODES_H

#include "light/cubature.h"
#include "math/vec3.h"

/* The directions middle + x u + y v of plain_light, and its size. */
typedef struct area_patch {
    vec3 middle, u, v;
    float size;
} area_patch;

/* What area_lobe has, and parts of a light, at most as many as a polygon has corners. */
typedef struct area_nodes {
    int is_ggx, is_schlick, has_base;
    vec3 wo;
    float visible_o, alpha_x, alpha_y;
    int count;
    area_patch patch[8];
} area_nodes;

/* plain_sums. */
typedef struct area_node_sums {
    float reflected, fresnel[2], facets, x, y, z, cap;
    float cosine[3]; /* zero without has_base */
} area_node_sums;

typedef void area_nodes_sum(const area_nodes *n, const cubature *rule, area_node_sums *sums);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
area_nodes_sum area_nodes_sum_base, area_nodes_sum_avx2;

#endif
