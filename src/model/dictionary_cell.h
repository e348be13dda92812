/* The slope distribution of one cell: two marginals of the dictionary, rotated and scaled to the surface's roughness.
 *
 * Chermain et al. 2020, sections 4 and 5 and algorithm 3.
 */
#ifndef MODEL_DICTIONARY_CELL_H
#define MODEL_DICTIONARY_CELL_H

#include "model/dictionary_table.h"
#include "ndf/ndf.h"

/* Slopes of a facet, along and across the tangent: (-x, -y) / z of its normal. */
typedef struct slope {
    float x, y;
} slope;

/* What all cells of one footprint share. */
typedef struct dictionary_surface {
    const dictionary *table;
    ndf target;
    float coverage;          /* beta */
    float density_variation; /* zeta */
} dictionary_surface;

/* One product of marginals. GGX is a mixture of several with different scales, Beckmann has one. */
typedef struct dictionary_lobes {
    float weight; /* share of the cell's facets; those of a cell sum to 1 */
    float scale;  /* slopes of the dictionary over slopes of the surface, on top of roughness */
    float cosine, sine;
    const uint16_t *along, *across; /* marginals; NULL: the target, a Gaussian */
} dictionary_lobes;

enum { DICTIONARY_MAX_SCALES = 12 };

typedef struct dictionary_cell_slopes {
    int count; /* 0: so many that the cell has the target's slopes */
    dictionary_lobes lobes[DICTIONARY_MAX_SCALES];
} dictionary_cell_slopes;

/* Share of the cell with this hash that carries facets, in [0, 1]; its mean over hashes is the surface's coverage.
 * grain_level: see dictionary_patch. */
float dictionary_cell_coverage(const dictionary_surface *surface, uint32_t hash, int grain_level);

/* The logarithm of how many facets a cell has, in [0, DICTIONARY_LEVELS]. log4_facets: in the mean, see
 * dictionary_patch; coverage > 0: of this cell. */
float dictionary_cell_log4(const dictionary_surface *surface, uint32_t hash, float log4_facets, float coverage);

/* How many facets these are, at least 1. */
float dictionary_cell_facets(float log4_facets);

/* Whether a cell of so many, log4_facets >= 0, cannot be told from the target. */
static inline int dictionary_cell_is_target(float log4_facets)
{
    return log4_facets >= (float)DICTIONARY_LEVELS - 0.5F;
}

/* Fills *s for a cell with facets. log4_facets: of this cell. */
void dictionary_cell_find(dictionary_cell_slopes *s, const dictionary_surface *surface, uint32_t hash,
                          float log4_facets);

/* Whether every cell with so many facets has the target's slopes and the mean coverage, whatever its hash. */
int dictionary_is_smooth(const dictionary_surface *surface, float log4_facets);

/* A slope of the cell, with the density that dictionary_cells_density has; *choice, u1 and u2 uniform in [0, 1).
 * *choice is uniform again afterwards. */
slope dictionary_cell_sample(const dictionary_cell_slopes *s, const ndf *target, float *choice, float u1, float u2);

/* A slope of the target itself. */
slope dictionary_target_sample(const ndf *target, float u1, float u2);

#endif
