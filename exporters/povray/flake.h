/* The tilt and the tint of a flake, as glint.inc and libglint's explicit model have it. */
#ifndef EXPORTERS_POVRAY_FLAKE_H
#define EXPORTERS_POVRAY_FLAKE_H

#include <stdint.h>

#include "glint.h"

typedef struct flake_law {
    glint_distribution distribution;
    double alpha_x, alpha_y;
    double alpha;      /* of the round distribution with the same peak */
    double total_area; /* D_H */
} flake_law;

flake_law flake_law_of(glint_distribution distribution, double alpha_x, double alpha_y);

/* Slopes along x and y of the flake in a cell: the hash of POV-Ray's mode, tilts by area, cut at slope 7. */
void flake_slopes(const flake_law *law, int64_t x, int64_t y, uint32_t seed, double slopes[2]);

/* A number in [0, 1) that picks the tint of the flake in a cell. */
double flake_tint(int64_t x, int64_t y, uint32_t seed);

#endif
