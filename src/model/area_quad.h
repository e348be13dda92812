/* A microfacet lobe over sectors of directions, summed at four points of each at a time. */
#ifndef MODEL_AREA_QUAD_H
#define MODEL_AREA_QUAD_H

#include "math/vec3.h"

enum { QUAD_MOST_SECTORS = 10 };

/* Round roughness. Directions are those of light/ltc.h, moved by the matrix whose inverse `back` holds. */
typedef struct quad_lobe {
    int is_ggx, is_schlick;
    float alpha, masked_o; /* ndf_masked of wo */
    vec3 wo;
    vec3 back[2]; /* x and y of where a moved direction comes from; z stays */
} quad_lobe;

/* What lies between a direction `middle` and a part of the rim. */
typedef struct quad_sector {
    int is_arc;
    vec3 a, b;                 /* a straight side: unit, its ends */
    float volume;              /* middle . (a x b) */
    float from[2], half_turns; /* an arc: cos t and sin t where it begins, and its length in t, over pi */
} quad_sector;

typedef struct quad_light {
    vec3 middle;       /* unit */
    vec3 center, x, y; /* arcs lie on center + cos t x + sin t y */
    float turn[3];     /* middle . (rim x rim') = turn 0 + turn 1 cos t + turn 2 sin t */
    int count;
    quad_sector sector[QUAD_MOST_SECTORS];
} quad_light;

/* Sums over all points, in units of pi / determinant of the matrix but for the weight. */
typedef struct quad_sums {
    float weight;               /* the cosine's integral over the sectors, times eight */
    float reflected;            /* f cos theta_i with F = 1 */
    float fresnel[2];           /* Schlick: the same times (1 - h.wi)^5; else times h.wi and its square */
    float facets, x, y, z, cap; /* of D / (4 h.wi), the same times h; half vectors, seen from above */
    int is_uneven;              /* most_quads were not enough */
} quad_sums;

/* Sectors over which the reflection is uneven are divided until it is not, with at most most_quads more quads. */
typedef void area_quad_sum(const quad_lobe *lobe, const quad_light *light, int most_quads, quad_sums *sums);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
area_quad_sum area_quad_sum_base, area_quad_sum_avx2;

#endif
