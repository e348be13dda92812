/* The densities of many cells at one slope, compiled once for each vector width; dictionary_many.c gathers and chooses.
 */
#ifndef MODEL_DICTIONARY_KERNEL_H
#define MODEL_DICTIONARY_KERNEL_H

#include <stddef.h>

#include "model/dictionary_cell.h"
#include "model/dictionary_patch.h"
#include "model/machine_lanes.h"

enum { DICTIONARY_ROOM = DICTIONARY_MAX_CELLS + MOST_LANES }; /* for cells, padded to any width */

/* Cells with one product of marginals each, as Beckmann's are. */
typedef struct dictionary_cells {
    uint32_t hash[DICTIONARY_ROOM];
    int32_t level[DICTIONARY_ROOM]; /* of the dictionary, below DICTIONARY_LEVELS */
} dictionary_cells;

/* density[i]: P22 of cell i at the slope (x, y) of the dictionary's roughness. count: a multiple of the width. */
typedef void dictionary_kernel(const dictionary *table, const dictionary_cells *cells, size_t count, float x, float y,
                               float *density);

dictionary_kernel dictionary_kernel_1, dictionary_kernel_4, dictionary_kernel_8, dictionary_kernel_16;

/* The widest that this machine runs, at most this wide. */
dictionary_kernel *dictionary_kernel_widest(size_t most_lanes);

/* dictionary_cell_density of the first count cells, for a surface whose distribution is Beckmann's. cells and density
 * have room for DICTIONARY_ROOM. */
void dictionary_cells_density(const dictionary_surface *surface, dictionary_cells *cells, size_t count, slope at,
                              float *density);

#endif
