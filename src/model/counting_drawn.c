/* The counting model's inner loop with one of the 36 realisations for all of them, drawn by its weight.
 *
 * Realisation i of grid g counts X of the N_g = N / 2 share_g facets of its grid and adds w_i X / m to the factor, with
 * m = N p / 2. Drawn with the chance q_g w_i, X / (m q_g) has the mean of the whole sum, whatever the facets are. The
 * variance is least for q_g in proportion to the root of E X^2 = m share_g (1 + m share_g): for many lit facets that is
 * share_g, and for few a grid of hardly any share is not drawn so rarely that its one facet is a firefly. With
 * q = share it would be
 *
 *     sum share_g (1 - p) / (m share_g) = 4 (1 - p) / m < 8 / (N p),
 *
 * so it is no more than that. It is noise of the samples of a pixel, to which each brings a number of its own, and not
 * of the facets.
 */
#include "model/counting_kernel.h"

#include "math/binomial.h"
#include "model/counting_place.h"

/* Where a number in [0, 1) falls among parts that add up to one: the index of the part, and where in it. */
typedef struct drawn_part {
    vfloat left;  /* of the number, from the start of the part */
    vmask passed; /* the part has been found before */
} drawn_part;

/* Whether it falls into this part, the next one. */
static inline vmask falls_into(drawn_part *d, vfloat size)
{
    const vmask here = less(d->left, size) & ~d->passed;
    d->left = choose(here | d->passed, d->left, d->left - size);
    d->passed = d->passed | here;
    return here;
}

/* A number in [0, 1) within a part of this size again. The last part takes what rounding leaves over. */
static inline vfloat rescaled(const drawn_part *d, vfloat size)
{
    return min_f(max_f(d->left, splat(0.0F)) / max_f(size, splat(1e-20F)), splat(0.99999994F));
}

/* A grid and the chance that it is taken. expected: m. */
static vfloat draw_grid(const grid_shape *shape, vfloat expected, vfloat random, grid_vertex *vertex, vfloat *share,
                        vfloat *chance)
{
    grid_vertex all[GRID_COUNT];
    vfloat shares[GRID_COUNT], size[GRID_COUNT], total = splat(0.0F);
    grid_tetrahedron(shape, all, shares);
    const vfloat inverse = 1.0F / max_f(expected, splat(1e-20F));
    for (int g = 0; g < GRID_COUNT; g++) {
        size[g] = sqrt_f(shares[g] * (shares[g] + inverse));
        total = total + size[g];
    }
    drawn_part part = { random * total, mask_none() };
    *vertex = all[GRID_COUNT - 1];
    *share = shares[GRID_COUNT - 1];
    vfloat taken = size[GRID_COUNT - 1];
    for (int g = 0; g < GRID_COUNT - 1; g++) {
        const vmask here = falls_into(&part, size[g]);
        *vertex = grid_select(here, all[g], *vertex);
        *share = choose(here, shares[g], *share);
        taken = choose(here, size[g], taken);
    }
    *chance = taken / total;
    return rescaled(&part, taken);
}

/* One of three, by weights that add up to one. What is left of the number is uniform again. */
static vuint draw_of(const vuint of[3], const vfloat weight[3], vfloat *random)
{
    drawn_part part = { *random, mask_none() };
    vfloat taken = weight[2];
    vuint drawn = of[2];
    for (int i = 0; i < 2; i++) {
        const vmask here = falls_into(&part, weight[i]);
        drawn = choose_u(here, of[i], drawn);
        taken = choose(here, weight[i], taken);
    }
    *random = rescaled(&part, taken);
    return drawn;
}

/* b(N, p) / (N p) of the realisation that random in [0, 1) chooses. */
static vfloat drawn_factor(const counting_points *points, size_t i, const grid_ellipse *ellipse, vfloat counted,
                           vfloat random)
{
    const vfloat p = load_f(points->p + i), drawn = counting_drawn_from(counted);
    const grid_shape shape = grid_shape_of(ellipse);
    grid_vertex vertex;
    vfloat share, taken;
    random = draw_grid(&shape, drawn * p, random, &vertex, &share, &taken);
    /* Of cells and of corners, too, only the one that is drawn is hashed. */
    vuint cells[GRID_CELLS], corners[ANGULAR_CORNERS];
    vfloat weights[GRID_CELLS], blend[ANGULAR_CORNERS];
    grid_around(&vertex, load_d(points->u + i), load_d(points->v + i), load_u(points->seed + i), cells, weights);
    const vuint cell = hash_full(draw_of(cells, weights, &random));

    const angular_lattice lattice =
        angular_locate(load_f(points->hx + i), load_f(points->hy + i), load_f(points->cap + i));
    const angular_place place = angular_place_of(&lattice, cell);
    angular_around(&place, cell, splat(1.0F / CORNER_SCALE), corners, blend);
    const vint uniform = (vint)hash_top(draw_of(corners, blend, &random), (vuint)splat_i((int32_t)HASH_TOP));

    const binomial_chance chance = binomial_chance_of(p);
    const vfloat count = binomial_draw(drawn * share, &chance, uniform, angular_dither(cell));
    const vmask smooth = less_equal(splat(1.0F), p) | less(drawn * p, splat(LEAST_COUNT));
    return choose(smooth, splat(1.0F), count / max_f(drawn * p * taken, splat(1e-30F)));
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(counting_drawn_, GLINT_LANES)(const counting_points *points, const uint32_t *draw, size_t count,
                                        float *factor, float *facets)
{
    for (size_t i = 0; i < count; i += GLINT_LANES) {
        grid_ellipse ellipse;
        const counting_pixel pixel = counting_pixel_of(points, i, &ellipse);
        const vfloat random = to_float((vint)(load_u(draw + i) >> 8)) * (1.0F / 16777216.0F);
        const vfloat f = drawn_factor(points, i, &ellipse, pixel.counted, random);
        store_f(factor + i, choose(counting_is_flat(&pixel), splat(1.0F), f));
        store_f(facets + i, pixel.facets);
    }
}
