/* A light of any size in cells over which the lobe hardly bends, each summed over as few points as a plain light is
 * (area_plain.h), eight at a time. */
#ifndef MODEL_AREA_CELLS_H
#define MODEL_AREA_CELLS_H

#include "model/area_nodes.h"

/* Maps of the square to all directions of a light, x and y in [-1, 1].
 *
 * Of a polygon there are some: middle + x u + y v + x y w, over unit corners. Seen from the origin their area is
 * size[0] + x size[1] + y size[2] + x y size[3].
 *
 * Of a cone over an ellipse there is one, by chords: with s and c the sine and cosine of pi turn (1 + x) / 2, middle -
 * 2 s^2 v + 2 s c y u, from its highest direction, the middle, down. Its area is size[0] s^2 c^2. */
typedef struct area_patches {
    int is_round, count;
    float middle[3][AREA_ROOM], u[3][AREA_ROOM], v[3][AREA_ROOM], w[3][AREA_ROOM];
    float size[4][AREA_ROOM];
    float turn; /* up to 1/2 */
} area_patches;

/* Returns the share of the result that is left to another method: 1 where the sums are not set. */
typedef float area_cells_sum(const area_eye *eye, const area_patches *patches, area_node_sums *sums);

/* The same source, and so the same bits, for the processor that the library is compiled for and for one with AVX2. */
area_cells_sum area_cells_sum_base, area_cells_sum_avx2;

#endif
