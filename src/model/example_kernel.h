/* One question put to many squares of the lattice at a time, which hold the same example or mirror images of it and lie
 * differently under the footprint. Compiled once for each vector width; example_tiled.c chooses. */
#ifndef MODEL_EXAMPLE_KERNEL_H
#define MODEL_EXAMPLE_KERNEL_H

#include <stddef.h>

#include "model/example_view.h"
#include "model/machine_lanes.h"

/* 3.5 axes of at most two squares (MOST_SIGMA_ALIKE) and an eighth (a texel of the smallest map), which is 7.02 either
 * way: sixteen squares along a side where the middle is close to an edge of its own, fifteen elsewhere. */
enum { EXAMPLE_MOST_SQUARES = 256, EXAMPLE_SQUARES_ROOM = EXAMPLE_MOST_SQUARES + MOST_LANES };

/* Where the centre of the footprint lies in each of them, and which variant of the lattice each holds. */
typedef struct example_squares {
    size_t count;
    float x[EXAMPLE_SQUARES_ROOM], y[EXAMPLE_SQUARES_ROOM];
    int32_t kind[EXAMPLE_SQUARES_ROOM];
} example_squares;

/* All squares that the footprint may reach, and their centres on the lattice. */
void example_find_squares(const question *q, example_squares *squares, float centre[2][EXAMPLE_MOST_SQUARES]);

/* Adds what all of them show. views: by kind; they differ by their mirrors alone, and their own means are not read.
 * Nobody overlaps, and there are no tints. */
typedef void example_look(const example_view *views, const example_squares *squares, gathered *sum);

example_look example_look_1, example_look_4, example_look_8, example_look_16;

#endif
