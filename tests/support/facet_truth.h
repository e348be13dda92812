/* Mean and variance of what a surface of explicit facets shows, in double precision and without drawing one.
 *
 * Facets fill the square cells of a grid that lies anywhere, one each, and are independent of each other. A picture
 * element that sees cell k by the share S_k shows sum S_k X_k, X what one facet adds: mean E X, variance (E X^2 - (E
 * X)^2) E sum S_k^2.
 */
#ifndef TESTS_FACET_TRUTH_H
#define TESTS_FACET_TRUTH_H

#include "glint.h"

/* Of one facet, in units of the smooth value, which takes D at the middle of the light. */
typedef struct facet_moments {
    double mean, square;
} facet_moments;

/* Under a cap of light, by quadrature over it. Facets are mirrors (facet_alpha 0). */
facet_moments facet_moments_of(const glint_material_options *o, const float wo[3], const float wi[3],
                               double solid_angle_sr);

/* D of the options' distribution, per steradian. */
double facet_distribution(const glint_material_options *o, const double h[3]);
/* Its integral over the hemisphere, D_H. */
double facet_total_area(const glint_material_options *o);

typedef enum facet_filter { FACET_BOX, FACET_TENT } facet_filter;

/* E sum S_k^2 of the mean of k x k pixels, each seen through a box of one pixel or a tent of two.
 * jacobian: dudx, dudy, dvdx, dvdy in units of cells. */
double facet_overlap(facet_filter filter, int k, const double jacobian[4]);

#endif
