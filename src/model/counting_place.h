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

/* What a pixel covers: facets of its own, and with those that a facet's size around it adds. */
typedef struct counting_pixel {
    vfloat facets, counted;
    vmask flat; /* A pixel without area is a mistake or the limit of one; it shows no single facet. */
} counting_pixel;

static inline counting_pixel counting_pixel_of(const counting_points *points, size_t i, grid_ellipse *ellipse)
{
    const vfloat dudx = load_f(points->dudx + i), dudy = load_f(points->dudy + i);
    const vfloat dvdx = load_f(points->dvdx + i), dvdy = load_f(points->dvdy + i);
    const vfloat area = grid_area(dudx, dudy, dvdx, dvdy);
    const vfloat density = max_f(load_f(points->density + i), splat(LEAST_DENSITY));
    *ellipse = grid_ellipse_of(dudx, dudy, dvdx, dvdy, area, FACET_SHARE / density);
    return (counting_pixel){ area * density, ellipse->area * density, less(area, splat(LEAST_AREA)) };
}

/* Points are placed in blocks, one pass after another: what a pass computes for one vector is a single long chain, and
 * a processor works at those of the next vectors meanwhile. */
#define COUNTING_BLOCK 64

typedef struct counting_block {
    size_t count; /* vectors */
    counting_pixel pixel[COUNTING_BLOCK / GLINT_LANES];
    grid_point grid[COUNTING_BLOCK / GLINT_LANES];
} counting_block;

/* The block that begins with point `start` of `count`. */
static inline void counting_place(const counting_points *points, size_t start, size_t count, counting_block *b)
{
    grid_vertex vertex[COUNTING_BLOCK / GLINT_LANES][GRID_COUNT];
    const size_t left = count - start;
    b->count = (left < COUNTING_BLOCK ? left : COUNTING_BLOCK) / GLINT_LANES;
    grid_shape shape[COUNTING_BLOCK / GLINT_LANES];
    for (size_t k = 0; k < b->count; k++) {
        grid_ellipse ellipse;
        b->pixel[k] = counting_pixel_of(points, start + GLINT_LANES * k, &ellipse);
        shape[k] = grid_shape_of(&ellipse);
    }
    for (size_t k = 0; k < b->count; k++)
        grid_tetrahedron(&shape[k], vertex[k], b->grid[k].share);
    for (size_t k = 0; k < b->count; k++) {
        const size_t i = start + GLINT_LANES * k;
        const vdouble u = load_d(points->u + i), v = load_d(points->v + i);
        const vuint seed = load_u(points->seed + i);
        grid_cells(vertex[k], GRID_COUNT, u, v, seed, b->grid[k].cell, b->grid[k].weight);
    }
}

/* Cells of half vectors are at least 2^-14 wide, so that 16 bits of fraction fit. */
#define ANGULAR_LEVELS 14

typedef struct angular_lattice {
    vint x, y;     /* h in units of 2^-16 cells of the finer level */
    vuint number;  /* of the finer level */
    vuint coarser; /* chance, of 2^16, that a cell uses the next coarser level */
} angular_lattice;

/* A facet stays lit while h is within the cap, so a cell has the cap's area. Levels are powers of two; each cell of the
 * surface takes one of the two nearest, with the chance that makes the mean area right: nothing moves when the cap
 * changes size. */
static inline angular_lattice angular_locate(vfloat hx, vfloat hy, vfloat cap)
{
    const vfloat area = min_f(max_f(cap, splat(1.0F / (1 << 2 * ANGULAR_LEVELS))), splat(1.0F));
    angular_lattice l;
    const vint level = (1 - exponent_of(area)) >> 1; /* 4^-level <= area < 4^(1 - level) */
    const vfloat scale = exp2_i(level);
    l.number = (vuint)level * HASH_Z;
    l.coarser = (vuint)to_int((area * scale * scale - 1.0F) * (65536.0F / 3.0F));
    l.x = to_int(hx * scale * 65536.0F);
    l.y = to_int(hy * scale * 65536.0F);
    return l;
}

/* Weights of corners are 2^32 times what they should be: so fractions of 16 bits can be taken as they are. */
#define CORNER_SCALE 4294967296.0F

/* Where h is in the lattice of one surface cell, in units of 2^-16. */
typedef struct angular_place {
    vint x, y;
    vuint number; /* of the level that the cell uses */
} angular_place;

static inline angular_place angular_place_of(const angular_lattice *l, vuint cell)
{
    /* The cell is a full hash: the top bits of a product are another one. */
    const vmask coarse = less_i((vint)(cell * HASH_TOP >> 16), (vint)l->coarser);
    angular_place p;
    /* Counted from h = 0, so that the coarser lattice of one level is the finer one of the next: when the cap passes a
     * power of four, corners keep their numbers. */
    p.x = choose_i(coarse, l->x >> 1, l->x) + (vint)(cell & 0xffffU);
    p.y = choose_i(coarse, l->y >> 1, l->y) + (vint)(cell >> 16);
    p.number = choose_u(coarse, l->number - HASH_Z, l->number);
    return p;
}

/* Uniforms and weights of the four corners around it. hash: the last factor of their hash, HASH_TOP. */
static inline void angular_corners(const angular_place *p, vuint cell, vfloat cell_weight, vuint hash, vint uniform[4],
                                   vfloat weight[4])
{
    const vfloat fx = to_float(p->x & 0xffff), fy = to_float(p->y & 0xffff);
    const vfloat gx = 65536.0F - fx;
    const vfloat up = cell_weight * fy, down = cell_weight * (65536.0F - fy);
    weight[0] = gx * down;
    weight[1] = fx * down;
    weight[2] = gx * up;
    weight[3] = fx * up;

    const vuint corner = (cell + (vuint)(p->x >> 16)) * HASH_X + (vuint)(p->y >> 16) * HASH_Y + p->number;
    uniform[0] = (vint)hash_top(corner, hash);
    uniform[1] = (vint)hash_top(corner + HASH_X, hash);
    uniform[2] = (vint)hash_top(corner + HASH_Y, hash);
    uniform[3] = (vint)hash_top(corner + (HASH_X + HASH_Y), hash);
}

/* What binomial_start_of adds to a chance, from a cell. */
static inline vfloat angular_dither(vuint cell)
{
    return to_float((vint)(cell * HASH_X >> 16)) * (1.0F / 65536.0F);
}

/* The realisations of a grid, which share one (N, p): four of each cell. */
typedef struct angular_draws {
    vint uniform[4 * GRID_CELLS];
    vfloat weight[4 * GRID_CELLS];
    vfloat dither;
} angular_draws;

/* Those of so many grids, 1 or all, known to the compiler. hash: for each grid, as for the corners. In steps, as
 * grid_cells. */
static inline __attribute__((always_inline)) void angular_draws_of(const angular_lattice *l, const int grids,
                                                                   const vuint *cell, const vfloat *cell_weight,
                                                                   const vuint *hash, angular_draws *draws)
{
    angular_place place[GRID_COUNT * GRID_CELLS];
#pragma GCC unroll 12
    for (int i = 0; i < GRID_CELLS * grids; i++)
        place[i] = angular_place_of(l, cell[i]);
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++) {
#pragma GCC unroll 3
        for (int c = 0; c < GRID_CELLS; c++) {
            const int i = GRID_CELLS * g + c;
            angular_corners(&place[i], cell[i], cell_weight[i], hash[g], draws[g].uniform + 4 * c,
                            draws[g].weight + 4 * c);
        }
        draws[g].dither = angular_dither(cell[GRID_CELLS * g]);
    }
}

/* How many facets realisations are drawn from. With more of them the weighted sum would be no float any more, and it
 * does not vary. */
static inline vfloat counting_drawn_from(vfloat facets)
{
    return min_f(facets * ANGULAR_SHARE, splat(1e28F));
}

/* b(N, p) / (N p) from the weighted sum of what all realisations count. 1 in the smooth limit. */
static inline vfloat counting_factor(vfloat sum, vfloat drawn, vfloat p)
{
    const vfloat expected = drawn * p;
    const vmask smooth = less_equal(splat(1.0F), p) | less(expected, splat(LEAST_COUNT));
    return choose(smooth, splat(1.0F), sum * (1.0F / CORNER_SCALE) / max_f(expected, splat(LEAST_COUNT)));
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
    vfloat drawn, share, p; /* drawn: for all grids; share: the grid's part of it */
} counting_apart;

static inline void counting_take_apart(const counting_points *points, size_t i, counting_apart *a)
{
    counting_copies copies;
    const counting_points same = counting_copy(points, i, &copies);
    grid_ellipse ellipse;
    a->pixel = counting_pixel_of(&same, 0, &ellipse);
    const grid_shape shape = grid_shape_of(&ellipse);
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
    grid_cells(&own, 1, load_d(same.u), load_d(same.v), load_u(same.seed), a->cell, a->weight);
    a->lattice = angular_locate(load_f(same.hx), load_f(same.hy), load_f(same.cap));
    a->drawn = counting_drawn_from(a->pixel.counted);
    a->p = load_f(same.p);
}

static inline float counting_together(const counting_apart *a, vfloat factor)
{
    return choose(a->pixel.flat, splat(1.0F), factor)[0];
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
