/* Many cells at a time: their names and weights, and their densities at one slope. Compiled once for each vector width;
 * dictionary_many.c chooses. */
#ifndef MODEL_DICTIONARY_KERNEL_H
#define MODEL_DICTIONARY_KERNEL_H

#include <stddef.h>

#include "model/dictionary_cell.h"
#include "model/dictionary_patch.h"
#include "model/machine_lanes.h"

enum { DICTIONARY_ROOM = DICTIONARY_MAX_CELLS + MOST_LANES }; /* for cells, padded to any width */

/* Corners of cells, and where their centres lie. */
typedef struct dictionary_corners {
    uint32_t row[DICTIONARY_ROOM];                        /* hash of the row */
    uint32_t low[DICTIONARY_ROOM], high[DICTIONARY_ROOM]; /* bits of the other coordinate, a double */
    float r2[DICTIONARY_ROOM];                            /* square of the distance from the centre, 1 on the ellipse */
} dictionary_corners;

/* Cells with 4^log4_facets facets, log4_facets >= 0, none of which is the target. */
typedef struct dictionary_cells {
    uint32_t hash[DICTIONARY_ROOM];
    float log4_facets[DICTIONARY_ROOM];
} dictionary_cells;

/* Hashes and weights, not yet normalised. Counts are multiples of the width. */
typedef void dictionary_weigh(const dictionary_corners *corners, size_t count, uint32_t *hash, float *weight);

/* density[i]: P22 of cell i at the slope (x, y) of the dictionary's roughness. */
typedef void dictionary_look(const dictionary *table, ndf_kind kind, const dictionary_cells *cells, size_t count,
                             float x, float y, float *density);

dictionary_weigh dictionary_weigh_1, dictionary_weigh_4, dictionary_weigh_8, dictionary_weigh_16;
dictionary_look dictionary_look_1, dictionary_look_4, dictionary_look_8, dictionary_look_16;

typedef struct dictionary_width {
    dictionary_weigh *weigh;
    dictionary_look *look;
} dictionary_width;

/* The widest that this machine runs, at most this wide. */
dictionary_width dictionary_widest(size_t most_lanes);

/* Arrays have room for DICTIONARY_ROOM; what follows the first count is filled up. */
void dictionary_corners_weigh(dictionary_corners *corners, size_t count, uint32_t *hash, float *weight);

/* P22 of cells at one slope, in 1 / slope^2; its integral over the plane is 1. Of cells that are the target it is any
 * number. */
void dictionary_cells_density(const dictionary_surface *surface, dictionary_cells *cells, size_t count, slope at,
                              float *density);

#endif
