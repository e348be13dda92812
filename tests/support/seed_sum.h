/* The truth of the example model: every seed Gaussian of an explicitly exported surface, summed in double precision
 * (Yan et al. 2016; Xing et al. 2024, Eqs. 4 to 6). */
#ifndef TESTS_SEED_SUM_H
#define TESTS_SEED_SUM_H

#include <stddef.h>

#include "glint.h"

typedef struct seed_matrix {
    double xx, xy, yx, yy;
} seed_matrix;

/* One texel of the exported surface, which is measured in squares of the lattice. */
typedef struct seed_gaussian {
    double at[2], slope[2];
    seed_matrix jacobian;          /* of the slope along the surface */
    double place[3], roughness[3]; /* covariances (xx, xy, yy) of its place and of its slope */
    double area;
} seed_gaussian;

typedef struct seed_surface {
    seed_gaussian *seeds;
    size_t count;
} seed_surface;

/* One example that lies at a place, under a linear map. */
typedef struct seed_instance {
    double at[2];
    seed_matrix map;
    int is_ground; /* flat, and below all others */
} seed_instance;

/* Exports what is seen of instances: of each texel's centre the nearest instance that covers it. sigma_r: see
 * glint_example; for the ground 1 / size of a square is a texel. */
seed_surface seed_surface_export(const glint_example *e, double sigma_r, const seed_instance *instances, size_t count);

/* The slope of the surface at a place: that of the texel that is seen there. */
void seed_surface_slope(const glint_example *e, const seed_instance *instances, size_t count, const double at[2],
                        double slope[2]);

/* The same sum for a part of them: density of the slope under the Gaussian footprint (covariance xx, xy, yy). */
double seed_surface_density(const seed_surface *s, const double at[2], const double spread[3], const double slope[2],
                            double light_variance);

#endif
