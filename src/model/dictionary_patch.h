/* The cells of a MIP hierarchy under a footprint, with their Gaussian weights.
 *
 * Chermain et al. 2020, sections 5 and 6.1 and algorithms 1 and 2. Cells of level l are squares with sides of 2^l
 * metres, for every integer l.
 */
#ifndef MODEL_DICTIONARY_PATCH_H
#define MODEL_DICTIONARY_PATCH_H

#include <stdint.h>

#include "glint.h"

/* The longest footprint after clamping: 16 times as long as wide (glint_material_options.max_anisotropy). Its ellipse
 * on the finer level has half axes of sqrt(32^2 + 1) and sqrt(2^2 + 1) cells, on the coarser one of sqrt(16^2 + 1) and
 * sqrt(1 + 1). A convex figure of area A and perimeter P holds at most A + P / 2 + 1 cell centres: 297 and 108. */
enum { DICTIONARY_MAX_ANISOTROPY = 16, DICTIONARY_MAX_CELLS = 405 };

typedef struct dictionary_cell {
    uint32_t hash;
    float weight; /* share of the footprint, the weight of its level included */
    int level;    /* 0: the finer of the two levels, 1: the coarser */
} dictionary_cell;

typedef struct dictionary_patch {
    int count;
    float log4_facets[2];                       /* of one cell of either level */
    int grain_level[2];                         /* levels above the one where a cell has about one facet */
    dictionary_cell cell[DICTIONARY_MAX_CELLS]; /* weights sum to 1 */
} dictionary_patch;

/* The footprint has an area above zero and is not longer than 1e9 m; facets_per_m2 > 0. */
void dictionary_patch_find(dictionary_patch *patch, const glint_footprint *footprint, float facets_per_m2,
                           float max_anisotropy, uint32_t seed);

#endif
