/* The nearest of the 36 realisations, without any blending: what a table look-up without a filter is. */
#include "study/look_ups.h"

#define GLINT_LANES 1
#include "math/binomial.h"
#include "model/counting_place.h"

static int heaviest(const vfloat *weight, int count)
{
    int best = 0;
    for (int i = 1; i < count; i++)
        best = weight[i] > weight[best] ? i : best;
    return best;
}

void look_up_nearest(const counting_points *points, size_t count, float *factor, float *facets)
{
    for (size_t i = 0; i < count; i++) {
        grid_ellipse ellipse;
        grid_point grid;
        const counting_pixel pixel = counting_pixel_of(points, i, &ellipse);
        grid_locate(points->u[i], points->v[i], &ellipse, points->seed[i], &grid);
        const int first = GRID_CELLS * heaviest(grid.share, GRID_COUNT);
        const vuint cell = grid.cell[first + heaviest(grid.weight + first, GRID_CELLS)];

        vint uniform[ANGULAR_CORNERS];
        vfloat corners[ANGULAR_CORNERS];
        const angular_lattice lattice = angular_locate(points->hx[i], points->hy[i], points->cap[i]);
        const angular_place place = angular_place_of(&lattice, cell);
        angular_corners(&place, cell, 1.0F, HASH_TOP, uniform, corners);
        const binomial_chance chance = binomial_chance_of(points->p[i]);
        const float drawn =
            binomial_draw(pixel.counted, &chance, uniform[heaviest(corners, ANGULAR_CORNERS)], angular_dither(cell));
        factor[i] = drawn / (pixel.counted * points->p[i]);
        facets[i] = pixel.facets;
    }
}
