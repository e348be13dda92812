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

static const binomial_many realisations = { 4 * GRID_CELLS, CORNER_SCALE };

/* What is counted on each grid. */
typedef struct grid_counts {
    binomial_law law[GRID_COUNT];
    binomial_start start[GRID_COUNT];
    angular_draws draws[GRID_COUNT];
} grid_counts;

/* All that comes before the first branch, for so many grids, 1 or all, known to the compiler. */
static inline __attribute__((always_inline)) void prepare(const angular_lattice *lattice, const int grids,
                                                          const vuint *cell, const vfloat *cell_weight, vfloat dither,
                                                          const binomial_chance *chance, const vfloat *trials,
                                                          grid_counts *c)
{
    vuint hash[GRID_COUNT];
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++) {
        c->law[g] = binomial_law_of(trials[g], chance);
        hash[g] = (vuint)binomial_turned(&c->law[g], splat_i((int32_t)HASH_TOP));
    }
    angular_draws_of(lattice, grids, cell, cell_weight, hash, c->draws);
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++)
        c->start[g] = binomial_start_of(&c->law[g], chance, c->draws[g].uniform, dither, realisations.draws);
}

static inline vfloat count(const grid_counts *c, int g, const binomial_chance *chance)
{
    return binomial_weighted_draws(&c->law[g], chance, &c->start[g], c->draws[g].uniform, c->draws[g].weight, NULL,
                                   realisations);
}

/* b(N, p) / (N p) for one light. */
static vfloat lit_factor(const grid_point *grid, vfloat facets, vfloat hx, vfloat hy, vfloat cap, vfloat p)
{
    const angular_lattice lattice = angular_locate(hx, hy, cap);
    const binomial_chance chance = binomial_chance_of(p);
    const vfloat drawn = counting_drawn_from(facets);
    vfloat trials[GRID_COUNT], sum = splat(0.0F);
    grid_counts counts;
    for (int g = 0; g < GRID_COUNT; g++)
        trials[g] = drawn * grid->share[g];
    prepare(&lattice, GRID_COUNT, grid->cell, grid->weight, angular_dither(grid->cell[0]), &chance, trials, &counts);
    for (int g = 0; g < GRID_COUNT; g++)
        sum = sum + count(&counts, g, &chance);
    return counting_factor(sum, drawn, p);
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
            const counting_spot *const spot = counting_spot_at(points, i, k, &block, &room);
            const vfloat f = lit_factor(&spot->grid, spot->pixel.counted, load_f(points->hx + i),
                                        load_f(points->hy + i), load_f(points->cap + i), load_f(points->p + i));
            store_f(factor + i, choose(counting_is_flat(&spot->pixel), splat(1.0F), f));
            store_f(facets + i, spot->pixel.facets);
        }
    }
}

#if GLINT_LANES == GRID_COUNT

void counting_alone(const counting_points *points, size_t size, float *factor, float *facets)
{
    for (size_t i = 0; i < size; i++) {
        counting_apart a;
        counting_take_apart(points, i, &a);
        const binomial_chance chance = binomial_chance_of(a.p);
        const vfloat trials = a.drawn * a.share;
        grid_counts own;
        prepare(&a.lattice, 1, a.cell, a.weight, a.dither, &chance, &trials, &own);
        const vfloat counts = count(&own, 0, &chance);
        factor[i] = counting_together(&a, counting_factor(counting_across(counts), a.drawn, a.p));
        facets[i] = a.pixel.facets[0];
    }
}

#endif
