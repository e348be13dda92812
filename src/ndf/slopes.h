/* Slopes of facets drawn from a distribution, for facets of equal projected area and of equal area. */
#ifndef NDF_SLOPES_H
#define NDF_SLOPES_H

#include "ndf/ndf.h"

typedef struct slope2 {
    float x, y;
} slope2;

/* Slopes with density P22(x, y). u, the distribution function of the radius, and azimuth in [0, 1). */
slope2 slopes_of_projected_area(const ndf *n, float u, float azimuth);

/* Slopes with density P22(x, y) sqrt(1 + x^2 + y^2) / D_H: every facet stands for the same area of its own. */
slope2 slopes_of_area(const ndf *n, float u, float azimuth);

#endif
