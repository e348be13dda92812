/* The counting model's inner loop: a binomial count on anisotropic grids, for GLINT_LANES points at a time.
 *
 * Deliot and Belcour 2023 (grids, sections 4 to 6), with the probability of Kneiphof and Klein 2024. The spatial part
 * is done once a point; the part that knows the light once per light.
 *
 * The surface holds 4 grids x 3 cells; each cell has its own lattice in the plane of half vectors, and the four corners
 * around h are blended. So 48 realisations of the law add up, twelve of each grid sharing one (N, p).
 */
#include "model/counting_kernel.h"

#include "math/binomial.h"
#include "model/counting_place.h"

/* The twelve realisations of one grid, each with this many trials, weighted. */
static vfloat count_grid(const angular_lattice *lattice, const vuint cell[GRID_CELLS],
                         const vfloat cell_weight[GRID_CELLS], const binomial_chance *chance, vfloat trials)
{
    vint uniform[12];
    vfloat weight[12], dither[GRID_CELLS];
    angular_draws(lattice, cell, cell_weight, uniform, weight, dither);
    return binomial_weighted_sum(trials, chance, uniform, weight, dither);
}

/* b(N, p) / (N p) for one light. */
static vfloat lit_factor(const grid_point *grid, vfloat facets, vfloat hx, vfloat hy, vfloat cap, vfloat p)
{
    const angular_lattice lattice = angular_locate(hx, hy, cap);
    const binomial_chance chance = binomial_chance_of(p);
    const vfloat drawn = facets * ANGULAR_SHARE;
    vfloat sum = splat(0.0F);
    for (int g = 0; g < GRID_COUNT; g++)
        sum = sum + count_grid(&lattice, grid->cell + GRID_CELLS * g, grid->weight + GRID_CELLS * g, &chance,
                               drawn * grid->share[g]);
    return counting_factor(sum, drawn, p);
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(counting_kernel_, GLINT_LANES)(const counting_points *points, size_t count, float *factor, float *facets)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        const counting_pixel pixel = counting_pixel_of(points, i);
        grid_point grid;
        grid_locate(load_d(points->u + i), load_d(points->v + i), &pixel.ellipse, load_u(points->seed + i), &grid);
        const vfloat f = lit_factor(&grid, pixel.ellipse.area * pixel.density, load_f(points->hx + i),
                                    load_f(points->hy + i), load_f(points->cap + i), load_f(points->p + i));
        /* A pixel without area is a mistake or the limit of one; it shows no single facet. */
        const vmask flat = less(pixel.area, splat(LEAST_AREA));
        store_f(factor + i, choose(flat, splat(1.0F), f));
        store_f(facets + i, pixel.area * pixel.density);
    }
}

#if GLINT_LANES == GRID_COUNT

void counting_alone(const counting_points *points, size_t count, float *factor, float *facets)
{
    for (size_t i = 0; i < count; i++) {
        counting_apart a;
        counting_take_apart(points, i, &a);
        const binomial_chance chance = binomial_chance_of(a.p);
        const vfloat counts = count_grid(&a.lattice, a.cell, a.weight, &chance, a.drawn * a.share);
        factor[i] = counting_together(&a, counting_factor(counting_across(counts), a.drawn, a.p));
        facets[i] = a.pixel.area[0] * a.pixel.density[0];
    }
}

#endif
