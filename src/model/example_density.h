/* Density of slopes under a footprint: Eq. 6 of Xing et al. 2024, with Eq. 7 for whole tiles. */
#ifndef MODEL_EXAMPLE_DENSITY_H
#define MODEL_EXAMPLE_DENSITY_H

#include "model/example.h"

/* At the lattice slope, blurred by the light's variance in lattice slopes. */
float example_density(const example *e, const example_footprint *f, const float slope[2], float light_variance,
                      uint32_t seed);

#endif
