/* The counting model's inner loop: a binomial count on anisotropic grids, for GLINT_LANES points at a time.
 *
 * Deliot and Belcour 2023 (grids, sections 4 to 6), with the probability of Kneiphof and Klein 2024. The spatial part
 * is done once a point; the part that knows the light once per light.
 *
 * The surface holds 4 grids x 3 cells; each cell has its own lattice in the plane of half vectors, and the three
 * corners around h are blended. So 36 realisations of the law add up, nine of each grid sharing one (N, p).
 */
#include "model/counting_kernel.h"

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

#if GLINT_LANES == GRID_COUNT

void counting_alone(const counting_points *points, size_t size, float *factor, float *facets)
{
    for (size_t i = 0; i < size; i++) {
        counting_apart a;
        counting_take_apart(points, i, &a);
        const binomial_chance chance = binomial_chance_of(a.p);
        const vfloat trials = a.drawn * a.share;
        const grid_cells_read cells = { a.cell, a.weight, NULL };
        const vfloat counts = are_many(trials, a.p) ? count_many(&a.lattice, 1, &cells, &chance, &trials)
                                                    : count(&a.lattice, 1, &cells, a.dither, &chance, &trials);
        factor[i] = counting_together(&a, counting_factor(counting_across(counts), a.drawn, a.p));
        facets[i] = a.pixel.facets[0];
    }
}

#endif
