/* What a kernel counts at one light: a binomial count for each of 36 realisations, and their weighted sum. In lanes.
 *
 * The surface holds 4 grids x 3 cells; each cell has its own lattice in the plane of half vectors, and the three
 * corners around h are blended. So 36 realisations of the law add up, nine of each grid sharing one (N, p). Kneiphof
 * and Klein 2024, Eq. 21, on the grids of Deliot and Belcour 2023.
 */
#ifndef MODEL_COUNTING_COUNT_H
#define MODEL_COUNTING_COUNT_H

#include "math/binomial.h"
#include "model/counting_place.h"

static const binomial_many realisations = { GRID_DRAWS, CORNER_SCALE };

/* What is counted on each grid. */
typedef struct grid_counts {
    binomial_law law[GRID_COUNT];
    angular_draws draws[GRID_COUNT];
} grid_counts;

/* Cells of so many grids, 1 or all, known to the compiler. */
typedef struct grid_cells_read {
    const vuint *cell;
    const vfloat *weight;
    const vint *lane; /* as counting_read_u takes it */
} grid_cells_read;

static inline __attribute__((always_inline)) void prepare(const angular_lattice *lattice, const int grids,
                                                          const grid_cells_read *cells, const binomial_chance *chance,
                                                          const vfloat *trials, grid_counts *c)
{
    vuint hash[GRID_COUNT];
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++) {
        c->law[g] = binomial_law_of(trials[g], chance);
        hash[g] = (vuint)binomial_turned(&c->law[g], splat_i((int32_t)HASH_TOP));
    }
    angular_draws_of(lattice, grids, cells->cell, cells->weight, cells->lane, hash, c->draws);
}

/* What so many grids count. */
static inline __attribute__((always_inline)) vfloat count(const angular_lattice *lattice, const int grids,
                                                          const grid_cells_read *cells, vfloat dither,
                                                          const binomial_chance *chance, const vfloat *trials)
{
    grid_counts c;
    binomial_start start[GRID_COUNT];
    vfloat sum = splat(0.0F);
    prepare(lattice, grids, cells, chance, trials, &c);
    /* All that comes before the first branch, for all grids. */
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++)
        start[g] = binomial_start_of(&c.law[g], chance, c.draws[g].uniform, dither, GRID_DRAWS);
    for (int g = 0; g < grids; g++)
        sum = sum + binomial_weighted_draws(&c.law[g], chance, &start[g], c.draws[g].uniform, c.draws[g].weight, NULL,
                                            realisations);
    return sum;
}

/* The same where every mean is large: nothing is made ready for a walk. */
static inline __attribute__((always_inline)) vfloat count_many(const angular_lattice *lattice, const int grids,
                                                               const grid_cells_read *cells,
                                                               const binomial_chance *chance, const vfloat *trials)
{
    grid_counts c;
    vfloat sum = splat(0.0F);
    prepare(lattice, grids, cells, chance, trials, &c);
    for (int g = 0; g < grids; g++)
        sum = sum + binomial_expanded_draws(&c.law[g], chance, c.draws[g].uniform, c.draws[g].weight, realisations);
    return sum;
}

/* Whether it is: a law's mean is at least trials min(p, 1 - p), but for rounding. */
static inline int are_many(vfloat least_trials, vfloat p)
{
    return !any(less(least_trials * min_f(p, 1.0F - p), splat(1.001F * BINOMIAL_WALK_MEAN)));
}

#endif
