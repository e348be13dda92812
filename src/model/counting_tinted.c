/* The counting model's inner loop for facets of different colours: a count and the tints of what was counted.
 *
 * Each of the 36 realisations has a tint T of its own, hashed with its cell and corner: white, 1, in the mean and
 * independent of how many facets X are lit there. It adds X + sqrt(X) (T - 1), as X facets whose mean tint strays from
 * white by 1 / sqrt(X). With s^2 the variance of T,
 *
 *     E = N p,    Var = Var X + s^2 E X
 *
 * are those of a sum of X independent colours, exactly and for every pair of channels too; and since blending treats
 * both terms alike, block means have the variance of explicit facets, (1 - p + s^2) / (N p) (docs/models.md). Where a
 * facet more is lit the sum moves by no more than that facet, and the hue stays.
 */
#include "model/counting_kernel.h"

#include "math/binomial.h"
#include "model/counting_place.h"
#include "model/tint_lanes.h"

/* Where every facet is lit only the tints are left to chance: sqrt(X) for all the facets of a realisation, X a real
 * number; but of less than one facet no more than its own light, so that nothing is negative. */
static vfloat all_lit(vfloat trials)
{
    return min_f(sqrt_f(trials), trials);
}

/* Adds weight * root * (T - 1) over the realisations of a grid; root: of the facets that are lit in each. */
static void add_tints(const tint_palette *palette, const vuint *cell, const vint uniform[GRID_DRAWS],
                      const vfloat weight[GRID_DRAWS], const vfloat root[GRID_DRAWS], vfloat sum[3])
{
    for (int i = 0; i < GRID_DRAWS; i++) {
        if (!any(less(splat(0.0F), root[i])))
            continue;
        /* Not of the uniform alone: where a facet is lit rarely, only few uniforms do it. */
        const vuint hash = hash_full((vuint)uniform[i] + cell[i / ANGULAR_CORNERS] * HASH_Z);
        vfloat tint[3];
        tint_less_white(palette, tint_uniform_of(hash), tint);
        for (int c = 0; c < 3; c++)
            sum[c] = sum[c] + weight[i] * root[i] * tint[c];
    }
}

/* The realisations of one grid: what they count, and what their tints add to it. */
static vfloat count_grid(const angular_lattice *lattice, const vuint cell[GRID_CELLS],
                         const vfloat cell_weight[GRID_CELLS], vfloat dither, const binomial_chance *chance,
                         vfloat trials, const tint_palette *palette, vfloat tints[3])
{
    const vuint hash = (vuint)splat_i((int32_t)HASH_TOP);
    angular_draws d;
    vfloat count[GRID_DRAWS];
    angular_draws_of(lattice, 1, cell, cell_weight, NULL, &hash, &d);
    const vfloat sum = binomial_weighted_sum(trials, chance, d.uniform, d.weight, dither, count,
                                             (binomial_many){ GRID_DRAWS, CORNER_SCALE });
    const vmask sure = less_equal(splat(1.0F), chance->given);
    for (int i = 0; i < GRID_DRAWS; i++)
        count[i] = choose(sure, all_lit(trials), sqrt_f(count[i]));
    tints[0] = tints[1] = tints[2] = splat(0.0F);
    add_tints(palette, cell, d.uniform, d.weight, count, tints);
    return sum;
}

/* The factor of one channel from what all realisations count and what their tints add. */
static vfloat tinted_factor(vfloat sum, vfloat tints, vfloat drawn, vfloat p)
{
    const vfloat expected = drawn * p, bounded = max_f(expected, splat(LEAST_COUNT));
    const vmask rare = less(expected, splat(LEAST_COUNT)), sure = less_equal(splat(1.0F), p);
    sum = sum * (1.0F / CORNER_SCALE) / bounded;
    tints = tints * (1.0F / CORNER_SCALE) / bounded;
    return choose(rare, splat(1.0F), max_f(choose(sure, splat(1.0F), sum) + tints, splat(0.0F)));
}

/* The factors of the three channels for light i. */
static void lit_factors(const grid_point *grid, const vint *lane, vfloat facets, const counting_points *points,
                        size_t i, const tint_palette *palette, vfloat factor[3])
{
    const angular_lattice lattice =
        angular_locate(load_f(points->hx + i), load_f(points->hy + i), load_f(points->cap + i));
    const vfloat p = load_f(points->p + i), drawn = counting_drawn_from(facets);
    const binomial_chance chance = binomial_chance_of(p);
    const vfloat dither = angular_dither(counting_read_u(grid->cell, lane));
    vfloat sum = splat(0.0F), tints[3] = { splat(0.0F), splat(0.0F), splat(0.0F) };
    for (int g = 0; g < GRID_COUNT; g++) {
        const vuint *cell = grid->cell + GRID_CELLS * g;
        const vfloat *weight = grid->weight + GRID_CELLS * g;
        vuint picked[GRID_CELLS];
        vfloat picked_weight[GRID_CELLS], of_grid[3];
        for (int c = 0; lane && c < GRID_CELLS; c++) {
            picked[c] = counting_read_u(cell + c, lane);
            picked_weight[c] = counting_read_f(weight + c, lane);
        }
        if (lane) {
            cell = picked;
            weight = picked_weight;
        }
        sum = sum + count_grid(&lattice, cell, weight, dither, &chance, drawn * counting_read_f(grid->share + g, lane),
                               palette, of_grid);
        for (int c = 0; c < 3; c++)
            tints[c] = tints[c] + of_grid[c];
    }
    for (int c = 0; c < 3; c++)
        factor[c] = tinted_factor(sum, tints[c], drawn, p);
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(counting_tinted_, GLINT_LANES)(const counting_points *points, size_t count, const tint_palette *palette,
                                         float *const factor[3], float *facets)
{
    for (size_t start = 0; start < count; start += COUNTING_BLOCK) {
        counting_block block;
        const size_t vectors = counting_place(points, start, count, &block);
        for (size_t k = 0, i = start; k < vectors; k++, i += GLINT_LANES) {
            counting_spot room;
            const counting_view view = counting_view_at(points, i, k, &block, &room);
            const vint *const lane = view.picks ? &view.lane : NULL;
            const counting_pixel pixel = counting_read_pixel(&view.spot->pixel, lane);
            vfloat f[3];
            lit_factors(&view.spot->grid, lane, pixel.counted, points, i, palette, f);
            for (int c = 0; c < 3; c++)
                store_f(factor[c] + i, choose(counting_is_flat(&pixel), splat(1.0F), f[c]));
            store_f(facets + i, pixel.facets);
        }
    }
}

#if GLINT_LANES == GRID_COUNT

void counting_tinted_alone(const counting_points *points, size_t count, const tint_palette *palette,
                           float *const factor[3], float *facets)
{
    for (size_t i = 0; i < count; i++) {
        counting_apart a;
        counting_take_apart(points, i, &a);
        vfloat tints[3];
        const binomial_chance chance = binomial_chance_of(a.p);
        const vfloat counts =
            count_grid(&a.lattice, a.cell, a.weight, a.dither, &chance, a.drawn * a.share, palette, tints);
        for (int c = 0; c < 3; c++)
            factor[c][i] =
                counting_together(&a, tinted_factor(counting_across(counts), counting_across(tints[c]), a.drawn, a.p));
        facets[i] = a.pixel.facets[0];
    }
}

#endif
