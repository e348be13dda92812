/* A microfacet lobe over sectors of directions, summed at four points of two of them at a time. */
#ifndef MODEL_AREA_QUAD_H
#define MODEL_AREA_QUAD_H

#include "light/ltc.h"

/* Round roughness. Directions are those of light/ltc.h, moved by the matrix whose inverse `back` holds. */
typedef struct quad_lobe {
    int is_ggx, is_schlick;
    float alpha, masked_o; /* ndf_masked of wo */
    vec3 wo;
    vec3 back[2]; /* x and y of where a moved direction comes from; z stays */
} quad_lobe;

/* Sums over all points, in units of pi / determinant of the matrix but for the weight. */
typedef struct quad_sums {
    float weight;               /* the cosine's integral over the sectors, times four */
    float reflected;            /* f cos theta_i with F = 1 */
    float fresnel[2];           /* Schlick: the same times (1 - h.wi)^5; else times h.wi and its square */
    float facets, x, y, z, cap; /* of D / (4 h.wi), the same times h; half vectors, seen from above */
} quad_sums;

/* Sectors over which the reflection is uneven are halved until it is not. */
typedef void area_quad_sum(const quad_lobe *lobe, const ltc_light *light, quad_sums *sums);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
area_quad_sum area_quad_sum_base, area_quad_sum_avx2;

#endif
