/* The counting model's inner loop: a binomial count on anisotropic grids, for GLINT_LANES points at a time.
 *
 * Deliot and Belcour 2023 (grids, sections 4 to 6), with the probability of Kneiphof and Klein 2024. The spatial part
 * is done once a point; the part that knows the light once per light.
 */
#include "model/counting_kernel.h"

#include "model/counting_count.h"

static inline vfloat least_share(const grid_point *grid)
{
    return min_f(min_f(grid->share[0], grid->share[1]), min_f(grid->share[2], grid->share[3]));
}

/* b(N, p) / (N p) for light i. many: whether every mean is large, known to the compiler. */
static inline __attribute__((always_inline)) vfloat lit_factor(const grid_point *grid, const vint *lane,
                                                               const counting_points *points, size_t i, vfloat drawn,
                                                               const int many)
{
    const vfloat p = load_f(points->p + i);
    const angular_lattice lattice =
        angular_locate(load_f(points->hx + i), load_f(points->hy + i), load_f(points->cap + i));
    const binomial_chance chance = binomial_chance_of(p);
    const grid_cells_read cells = { grid->cell, grid->weight, lane };
    vfloat trials[GRID_COUNT];
    for (int g = 0; g < GRID_COUNT; g++)
        trials[g] = drawn * counting_read_f(grid->share + g, lane);
    const vfloat sum =
        many ? count_many(&lattice, GRID_COUNT, &cells, &chance, trials)
             : count(&lattice, GRID_COUNT, &cells, angular_dither(counting_read_u(grid->cell, lane)), &chance, trials);
    return counting_factor(sum, drawn, p);
}

/* Functions of their own: together, and with what places points, they would have too few registers. */
static __attribute__((noinline)) vfloat factor_of_few(const grid_point *grid, const counting_points *points, size_t i,
                                                      vfloat drawn)
{
    return lit_factor(grid, NULL, points, i, drawn, 0);
}

static __attribute__((noinline)) vfloat factor_of_many(const grid_point *grid, const counting_points *points, size_t i,
                                                       vfloat drawn)
{
    return lit_factor(grid, NULL, points, i, drawn, 1);
}

static __attribute__((noinline)) vfloat picked_of_few(const grid_point *grid, vint lane, const counting_points *points,
                                                      size_t i, vfloat drawn)
{
    return lit_factor(grid, &lane, points, i, drawn, 0);
}

static __attribute__((noinline)) vfloat picked_of_many(const grid_point *grid, vint lane, const counting_points *points,
                                                       size_t i, vfloat drawn)
{
    return lit_factor(grid, &lane, points, i, drawn, 1);
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(counting_kernel_, GLINT_LANES)(const counting_points *points, size_t size, float *factor, float *facets)
{
    for (size_t start = 0; start < size; start += COUNTING_BLOCK) {
        counting_block block;
        const size_t vectors = counting_place(points, start, size, &block);
        for (size_t k = 0, i = start; k < vectors; k++, i += GLINT_LANES) {
            counting_spot room;
            const counting_view view = counting_view_at(points, i, k, &block, &room);
            const grid_point *const grid = &view.spot->grid;
            const vint *const lane = view.picks ? &view.lane : NULL;
            const counting_pixel pixel = counting_read_pixel(&view.spot->pixel, lane);
            const vfloat drawn = counting_drawn_from(pixel.counted), share = least_share(grid);
            const int many = are_many(drawn * counting_read_f(&share, lane), load_f(points->p + i));
            vfloat f;
            if (lane)
                f = (many ? picked_of_many : picked_of_few)(grid, view.lane, points, i, drawn);
            else
                f = (many ? factor_of_many : factor_of_few)(grid, points, i, drawn);
            store_f(factor + i, choose(counting_is_flat(&pixel), splat(1.0F), f));
            store_f(facets + i, pixel.facets);
        }
    }
}
