/* Samples of a block of pixels, taken through each step together: rays in packets, light in batches. */
#ifndef PREVIEW_BLOCK_H
#define PREVIEW_BLOCK_H

#include "preview/camera_sample.h"

enum { BLOCK_SIDE = 8, BLOCK_PIXELS = BLOCK_SIDE * BLOCK_SIDE };

typedef struct block_window {
    int left, top, right, bottom; /* pixels of the picture, the last two not included */
} block_window;

/* What a thread works on. */
typedef struct block {
    int x[BLOCK_PIXELS], y[BLOCK_PIXELS]; /* pixels of the picture */
    bool is_seen[BLOCK_PIXELS];           /* it is in the window */
    pixel_sample seen[BLOCK_PIXELS];      /* what comes of it, where it is in the picture */
    camera_batch camera;
    camera_sample samples[BLOCK_PIXELS];
    /* Those that look at a surface, and what light is added to it. */
    int point_count;
    direct_point points[BLOCK_PIXELS];
    path_scratch scratch;
} block;

/* The block whose first pixel is (x, y), multiples of BLOCK_SIDE; seed: of the render. */
void block_begin(block *b, int x, int y, const block_window *window, uint32_t seed);

/* integrate, bit for bit, for sample number index of the block's pixels. */
void block_integrate(const world *w, block *b, uint32_t index, bool described, ray_counts *counts);

#endif
