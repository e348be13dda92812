/* Lights of real size by brute force: the microfacet lobe, its distribution and the cosine, summed over a fine grid of
 * the light in double precision. Written from the papers, without the library. */
#ifndef TESTS_AREA_TRUTH_H
#define TESTS_AREA_TRUTH_H

#include "glint.h"

typedef struct area_truth {
    double specular;  /* integral of G2 D / (4 cos_o): F = 1 */
    double schlick;   /* the same times (1 - h.wi)^5 */
    double facets;    /* integral of D / (4 h.wi): D over the half vectors that lie in the light */
    double projected; /* integral of D (n.h) over them */
    double cosine;    /* integral of cos theta_i */
    double solid_angle;
} area_truth;

typedef struct area_truth_lobe {
    int is_beckmann;
    double alpha_x, alpha_y;
} area_truth_lobe;

double area_truth_density(const area_truth_lobe *lobe, const double h[3]);
double area_truth_masking(const area_truth_lobe *lobe, const double wo[3], const double wi[3]); /* G2 */
/* What light from around a direction p, of any length, adds; nothing from below the horizon. */
void area_truth_add(area_truth *sum, const area_truth_lobe *l, const double wo[3], const double p[3],
                    double solid_angle);

/* side * side points. What is below the horizon adds nothing. */
area_truth area_truth_of(const area_truth_lobe *lobe, const float wo[3], const glint_area_light *light, int side);

#endif
