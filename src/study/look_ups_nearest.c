/* The nearest of the 48 realisations, without any blending: what a table look-up without a filter is. */
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
        const counting_pixel pixel = counting_pixel_of(points, i);
        const grid_shape shape = grid_shape_of(&pixel.ellipse);
        grid_vertex vertex[GRID_COUNT];
        vfloat share[GRID_COUNT], weight[GRID_CELLS], corners[4], dither;
        vuint cell[GRID_CELLS];
        vint uniform[4];
        grid_tetrahedron(&shape, vertex, share);
        const int grid = heaviest(share, GRID_COUNT);
        grid_cells(&vertex[grid], points->u[i], points->v[i], points->seed[i], cell, weight);
        const angular_lattice lattice = angular_locate(points->hx[i], points->hy[i], points->cap[i]);
        angular_corners(&lattice, cell[heaviest(weight, GRID_CELLS)], 1.0F, uniform, corners, &dither);
        const binomial_chance chance = binomial_chance_of(points->p[i]);
        const float n = pixel.ellipse.area * pixel.density;
        const float drawn = binomial_draw(n, &chance, uniform[heaviest(corners, 4)], dither);
        factor[i] = drawn / (n * points->p[i]);
        facets[i] = pixel.area * pixel.density;
    }
}
