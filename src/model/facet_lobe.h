/* How much of a rough facet's own reflection falls within a round light. */
#ifndef MODEL_FACET_LOBE_H
#define MODEL_FACET_LOBE_H

#include "ndf/ndf.h"

/* A narrower lobe is a mirror: directions of floats do not tell it from one, and its square would be lost. */
#define LEAST_FACET_ALPHA 1e-6F

/* Mass of a round lobe of mass 1 within a disk of radius r whose middle lies at distance d from the lobe's, both
 * squared, at most 1e12, and in units of the lobe's width. GGX: 1 / (pi (1 + s^2)^2) at distance s; Beckmann: exp(-s^2)
 * / pi. */
float facet_lobe_disk_mass(ndf_kind kind, float d2, float r2);

#endif
