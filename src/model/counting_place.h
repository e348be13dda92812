/* Where the counting model counts, for all of its kernels: cells of the surface, and the lattice of half vectors that
 * each of them has. In lanes.
 *
 * Deliot and Belcour 2023: grids, sections 4 to 6; angular cells, Eq. 14.
 */
#ifndef MODEL_COUNTING_PLACE_H
#define MODEL_COUNTING_PLACE_H

#include "footprint/grid.h"
#include "math/hash.h"
#include "model/counting_kernel.h"

/* Blending four corners with bilinear weights v divides the variance by 1 / sum v^2, 9/4 in the mean. Drawing with 4/9
 * of the facets gives it back: over a large patch the variance is that of the facets themselves. */
#define ANGULAR_SHARE 0.444444444F

/* Below this expected count nothing is counted: a lit facet would be 3e9 times the smooth light and seen never. A
 * chance is known to 2^-47 (binomial_threshold), which on four grids is 1e-4 of this. */
#define LEAST_COUNT 3e-10F

/* A pixel well inside one facet sees it lit or not: variance (1 - p) / p. The blending over cells leaves half of the
 * variance of a count, so the cells have half of a facet's area. Over a large patch the size of the cells does not
 * matter. */
#define FACET_SHARE 0.5F

/* One facet on a square of a thousand kilometres: sparser than that counts as that. */
#define LEAST_DENSITY 1e-12F
#define LEAST_AREA 1e-30F

/* What a pixel covers. */
typedef struct counting_pixel {
    grid_ellipse ellipse; /* convolved with a facet */
    vfloat area, density; /* of the pixel itself; facets per m^2 */
} counting_pixel;

static inline counting_pixel counting_pixel_of(const counting_points *points, size_t i)
{
    const vfloat dudx = load_f(points->dudx + i), dudy = load_f(points->dudy + i);
    const vfloat dvdx = load_f(points->dvdx + i), dvdy = load_f(points->dvdy + i);
    counting_pixel p;
    p.area = grid_area(dudx, dudy, dvdx, dvdy);
    p.density = max_f(load_f(points->density + i), splat(LEAST_DENSITY));
    p.ellipse = grid_ellipse_of(dudx, dudy, dvdx, dvdy, p.area, FACET_SHARE / p.density);
    return p;
}

/* Cells of half vectors are at least 2^-14 wide, so that 16 bits of fraction fit. */
#define ANGULAR_LEVELS 14

typedef struct angular_lattice {
    vint x, y;     /* h in units of 2^-16 cells of the finer level */
    vint level;    /* log2 of cells per unit */
    vuint coarser; /* chance, of 2^16, that a cell uses the next coarser level */
} angular_lattice;

/* A facet stays lit while h is within the cap, so a cell has the cap's area. Levels are powers of two; each cell of the
 * surface takes one of the two nearest, with the chance that makes the mean area right: nothing moves when the cap
 * changes size. */
static inline angular_lattice angular_locate(vfloat hx, vfloat hy, vfloat cap)
{
    const vfloat area = min_f(max_f(cap, splat(1.0F / (1 << 2 * ANGULAR_LEVELS))), splat(1.0F));
    angular_lattice l;
    l.level = (1 - exponent_of(area)) >> 1; /* 4^-level <= area < 4^(1 - level) */
    const vfloat scale = exp2_i(l.level);
    l.coarser = (vuint)to_int((area * scale * scale - 1.0F) * (65536.0F / 3.0F));
    l.x = to_int(hx * scale * 65536.0F);
    l.y = to_int(hy * scale * 65536.0F);
    return l;
}

/* Uniforms and weights of the four corners around h in the lattice of one surface cell. */
static inline void angular_corners(const angular_lattice *l, vuint cell, vfloat cell_weight, vint uniform[4],
                                   vfloat weight[4], vfloat *dither)
{
    const vuint bits = hash_top(cell + HASH_X);
    const vmask coarse = less_i((vint)(bits >> 16), (vint)l->coarser);
    *dither = to_float((vint)(bits & 0xffffU)) * (1.0F / 65536.0F);
    /* Counted from h = 0, so that the coarser lattice of one level is the finer one of the next: when the cap passes a
     * power of four, corners keep their numbers. */
    const vint x = choose_i(coarse, l->x >> 1, l->x) + (vint)(cell & 0xffffU);
    const vint y = choose_i(coarse, l->y >> 1, l->y) + (vint)(cell >> 16);

    const vfloat fx = to_float(x & 0xffff), fy = to_float(y & 0xffff);
    const vfloat gx = 65536.0F - fx;
    const vfloat scaled = cell_weight * 2.3283064e-10F; /* 2^-32 */
    const vfloat up = scaled * fy, down = scaled * (65536.0F - fy);
    weight[0] = gx * down;
    weight[1] = fx * down;
    weight[2] = gx * up;
    weight[3] = fx * up;

    const vuint lattice = (vuint)(l->level + mask_bits(coarse)) * HASH_Z;
    const vuint corner = (cell + (vuint)(x >> 16)) * HASH_X + (vuint)(y >> 16) * HASH_Y + lattice;
    uniform[0] = (vint)hash_top(corner);
    uniform[1] = (vint)hash_top(corner + HASH_X);
    uniform[2] = (vint)hash_top(corner + HASH_Y);
    uniform[3] = (vint)hash_top(corner + (HASH_X + HASH_Y));
}

/* The twelve realisations of one grid, which share one (N, p). */
static inline void angular_draws(const angular_lattice *l, const vuint cell[GRID_CELLS],
                                 const vfloat cell_weight[GRID_CELLS], vint uniform[12], vfloat weight[12],
                                 vfloat dither[GRID_CELLS])
{
    for (int c = 0; c < GRID_CELLS; c++)
        angular_corners(l, cell[c], cell_weight[c], uniform + 4 * c, weight + 4 * c, dither + c);
}

/* b(N, p) / (N p) from what all realisations count; drawn: N times the angular share. 1 in the smooth limit. */
static inline vfloat counting_factor(vfloat sum, vfloat drawn, vfloat p)
{
    const vfloat expected = drawn * p;
    const vmask smooth = less_equal(splat(1.0F), p) | less(expected, splat(LEAST_COUNT));
    return choose(smooth, splat(1.0F), sum / max_f(expected, splat(LEAST_COUNT)));
}

/* ---- one point alone: its four grids in four lanes, for a caller without a batch ---- */

#if GLINT_LANES == GRID_COUNT

/* One point, once in every lane. */
typedef struct counting_copies {
    double u[GRID_COUNT], v[GRID_COUNT];
    float dudx[GRID_COUNT], dudy[GRID_COUNT], dvdx[GRID_COUNT], dvdy[GRID_COUNT];
    float density[GRID_COUNT], hx[GRID_COUNT], hy[GRID_COUNT], cap[GRID_COUNT], p[GRID_COUNT];
    uint32_t seed[GRID_COUNT];
} counting_copies;

static inline counting_points counting_copy(const counting_points *from, size_t i, counting_copies *to)
{
    for (int g = 0; g < GRID_COUNT; g++) {
        to->u[g] = from->u[i];
        to->v[g] = from->v[i];
        to->dudx[g] = from->dudx[i];
        to->dudy[g] = from->dudy[i];
        to->dvdx[g] = from->dvdx[i];
        to->dvdy[g] = from->dvdy[i];
        to->density[g] = from->density[i];
        to->hx[g] = from->hx[i];
        to->hy[g] = from->hy[i];
        to->cap[g] = from->cap[i];
        to->p[g] = from->p[i];
        to->seed[g] = from->seed[i];
    }
    return (counting_points){ to->u,       to->v,    to->dudx, to->dudy, to->dvdx, to->dvdy,
                              to->density, to->seed, to->hx,   to->hy,   to->cap,  to->p };
}

/* What a point is to its four grids, grid g in lane g. */
typedef struct counting_apart {
    counting_pixel pixel;
    angular_lattice lattice;
    vuint cell[GRID_CELLS];
    vfloat weight[GRID_CELLS];
    vfloat drawn, share, p; /* N times the angular share, and the grid's part of it */
} counting_apart;

static inline void counting_take_apart(const counting_points *points, size_t i, counting_apart *a)
{
    counting_copies copies;
    const counting_points same = counting_copy(points, i, &copies);
    a->pixel = counting_pixel_of(&same, 0);
    const grid_shape shape = grid_shape_of(&a->pixel.ellipse);
    grid_vertex all[GRID_COUNT];
    vfloat shares[GRID_COUNT];
    grid_tetrahedron(&shape, all, shares);
    grid_vertex own = all[0];
    a->share = shares[0];
    for (int g = 1; g < GRID_COUNT; g++) {
        own.direction[g] = all[g].direction[g];
        own.ratio[g] = all[g].ratio[g];
        own.level[g] = all[g].level[g];
        a->share[g] = shares[g][g];
    }
    grid_cells(&own, load_d(same.u), load_d(same.v), load_u(same.seed), a->cell, a->weight);
    a->lattice = angular_locate(load_f(same.hx), load_f(same.hy), load_f(same.cap));
    a->drawn = a->pixel.ellipse.area * a->pixel.density * ANGULAR_SHARE;
    a->p = load_f(same.p);
}

/* A pixel without area shows no single facet. */
static inline float counting_together(const counting_apart *a, vfloat factor)
{
    return a->pixel.area[0] < LEAST_AREA ? 1.0F : factor[0];
}

/* The sum over the grids, in their order, in every lane. */
static inline vfloat counting_across(vfloat x)
{
    float sum = 0.0F;
    for (int g = 0; g < GRID_COUNT; g++)
        sum = sum + x[g];
    return splat(sum);
}

#endif

#endif
