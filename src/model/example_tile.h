/* What is asked about a tile of the example, whoever walks through them: does the footprint vary across it, how dense
 * is the slope in it (Xing et al. 2024, section 6.3). */
#ifndef MODEL_EXAMPLE_TILE_H
#define MODEL_EXAMPLE_TILE_H

#include "model/example_view.h"

/* Most that the Gaussian may vary across a tile that is taken whole, in units of its peak (fit: see
 * tests/unit/test_example_truth.c). */
#define MOST_VARIATION 0.5F

/* Tiles that will be divided are looked up in their maps from this level on (cost): a large tile's map knows better
 * than the range of its slopes whether there is anything to look for. */
#define LEAST_TRIED_LEVEL 2

/* Density of the mean of a tile's seeds: Eq. 7. */
static inline float tile_density(const example_view *v, int level, uint32_t x, uint32_t y)
{
    const uint32_t chain = v->e->first_chain[level] + example_tile(v->e, (uint32_t)level, x, y);
    return slope_maps_blended(&v->e->tiles, chain, &v->blend, v->slope[0], v->slope[1]);
}

/* How much the Gaussian varies across a tile of this level by its curvature alone. */
static inline float tile_curve(const example_view *v, int level)
{
    return (float)(1 << 2 * level) * v->quad_curve;
}

#endif
