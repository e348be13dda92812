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

/* Blending three corners with barycentric weights v divides the variance by 1 / sum v^2, 2 in the mean. Drawing with
 * half of the facets gives it back: over a large patch the variance is that of the facets themselves. */
#define ANGULAR_SHARE 0.5F

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
    vfloat facets, counted, area;
} counting_pixel;

/* A pixel without area is a mistake or the limit of one; it shows no single facet. */
static inline vmask counting_is_flat(const counting_pixel *pixel)
{
    return less(pixel->area, splat(LEAST_AREA));
}

static inline counting_pixel counting_pixel_of(const counting_points *points, size_t i, grid_ellipse *ellipse)
{
    const vfloat dudx = load_f(points->dudx + i), dudy = load_f(points->dudy + i);
    const vfloat dvdx = load_f(points->dvdx + i), dvdy = load_f(points->dvdy + i);
    const vfloat area = grid_area(dudx, dudy, dvdx, dvdy);
    const vfloat density = max_f(load_f(points->density + i), splat(LEAST_DENSITY));
    *ellipse = grid_ellipse_of(dudx, dudy, dvdx, dvdy, area, FACET_SHARE / density);
    return (counting_pixel){ area * density, ellipse->area * density, area };
}

/* All that is known of points before their lights are: vectors of numbers and nothing else. */
typedef struct counting_spot {
    counting_pixel pixel;
    grid_point grid;
} counting_spot;

/* Points are placed in blocks, one pass after another: what a pass computes for one vector is a single long chain, and
 * a processor works at those of the next vectors meanwhile. */
#define COUNTING_BLOCK 64

typedef struct counting_block {
    size_t first; /* point */
    size_t count; /* vectors */
    counting_spot spot[COUNTING_BLOCK / GLINT_LANES + 1];
} counting_block;

/* b->first and b->count, at least 1, are set. */
static inline void counting_place_spots(const counting_points *points, counting_block *b)
{
    grid_shape shape[COUNTING_BLOCK / GLINT_LANES + 1];
    grid_simplex simplex[COUNTING_BLOCK / GLINT_LANES + 1];
    size_t begun = 0;
    do {
        grid_ellipse ellipse;
        b->spot[begun].pixel = counting_pixel_of(points, b->first + GLINT_LANES * begun, &ellipse);
        shape[begun] = grid_shape_of(&ellipse);
    } while (++begun < b->count);
    for (size_t k = 0; k < b->count; k++)
        grid_simplex_of(&shape[k], &simplex[k]);
    for (size_t k = 0; k < b->count; k++) {
        const size_t i = b->first + GLINT_LANES * k;
        grid_point_of(&simplex[k], load_d(points->u + i), load_d(points->v + i), load_u(points->seed + i),
                      &b->spot[k].grid);
    }
}

/* The block of entries that begins with `start` of `count`; returns how many vectors they are. */
static inline size_t counting_place(const counting_points *points, size_t start, size_t count, counting_block *b)
{
    const size_t left = count - start, entries = left < COUNTING_BLOCK ? left : COUNTING_BLOCK;
    b->first = start;
    b->count = entries / GLINT_LANES;
    if (points->place) {
        b->first = points->place[start] / GLINT_LANES * GLINT_LANES;
        b->count = (points->place[start + entries - 1] - b->first) / GLINT_LANES + 1;
    }
    counting_place_spots(points, b);
    return entries / GLINT_LANES;
}

/* Where the spots of a vector of lights are: lane by lane at spot, or where lane says. */
typedef struct counting_view {
    const counting_spot *spot;
    vint lane;
    int picks; /* whether lane says anything */
} counting_view;

static inline vuint counting_vector_at(const counting_spot *spot, size_t byte)
{
    vuint v;
    memcpy(&v, (const char *)spot + byte, sizeof(v));
    return v;
}

/* Lanes of two vectors of the block that follow each other, the first of which is from. */
static inline void counting_gather_spots(const counting_spot *from, vint lane, vmask is_next, counting_spot *to)
{
    for (size_t byte = 0; byte < sizeof(*to); byte += sizeof(vuint)) {
        const vuint here = pick_u(counting_vector_at(from, byte), lane);
        const vuint picked = choose_u(is_next, pick_u(counting_vector_at(from + 1, byte), lane), here);
        memcpy((char *)to + byte, &picked, sizeof(picked));
    }
}

/* Of the entries from i on, which are vector k of the block. Several may be at one point; then they are in one vector
 * of points, or in two that follow each other, and from two they are gathered in *room. */
static inline counting_view counting_view_at(const counting_points *points, size_t i, size_t k, const counting_block *b,
                                             counting_spot *room)
{
    if (!points->place)
        return (counting_view){ &b->spot[k], splat_i(0), 0 };
    const size_t vector = (points->place[i] - b->first) / GLINT_LANES;
    const vint lane = (vint)(load_u(points->place + i) - (uint32_t)(b->first + GLINT_LANES * vector));
    const vmask is_next = less_i(splat_i(GLINT_LANES - 1), lane);
    if (!any(is_next))
        return (counting_view){ &b->spot[vector], lane, 1 };
    counting_gather_spots(&b->spot[vector], lane, is_next, room);
    return (counting_view){ room, splat_i(0), 0 };
}

/* What a light reads of its point. lane: NULL, or where it is. What is picked where it is used, by a function
 * that is compiled for it, is neither stored nor loaded again. */
static inline vuint counting_read_u(const vuint *from, const vint *lane)
{
    return lane ? pick_u(*from, *lane) : *from;
}

static inline vfloat counting_read_f(const vfloat *from, const vint *lane)
{
    return lane ? float_from_bits(pick_u(bits_of(*from), *lane)) : *from;
}

static inline counting_pixel counting_read_pixel(const counting_pixel *from, const vint *lane)
{
    return (counting_pixel){ counting_read_f(&from->facets, lane), counting_read_f(&from->counted, lane),
                             counting_read_f(&from->area, lane) };
}

#define ANGULAR_CORNERS 3

/* Cells of half vectors are at least 2^-14 wide, so that 16 bits of fraction fit. */
#define ANGULAR_LEVELS 14

typedef struct angular_lattice {
    vuint x; /* h in units of 2^-16 cells of the finer level */
    vint y;
    vint coarser; /* below it a uniform of 32 bits chooses the next coarser level */
} angular_lattice;

/* A facet stays lit while h is within the cap, so a cell, a rhombus of two triangles, has the cap's area. Levels are
 * powers of two; each cell of the surface takes one of the two nearest, with the chance that makes the mean area right:
 * nothing moves when the cap changes size. */
static inline angular_lattice angular_locate(vfloat hx, vfloat hy, vfloat cap)
{
    const vfloat area = min_f(max_f(cap, splat(1.0F / (1 << 2 * ANGULAR_LEVELS))), splat(1.0F));
    angular_lattice l;
    const vint level = (1 - exponent_of(area)) >> 1; /* 4^-level <= area < 4^(1 - level) */
    const vfloat scale = exp2_i(level);
    l.coarser = (vint)((vuint)to_int((area * scale * scale - 1.0F) * (65536.0F / 3.0F)) << 16 ^ 0x80000000U);
    /* Skewed, so that triangles are equilateral; the determinant is 1. */
    const vfloat x = 0.930604859F * hx - 0.537284966F * hy, y = 1.07456993F * hy;
    /* Two units of h further on: so where two levels have corners of the same numbers, h is far from each other. */
    l.x = (vuint)to_int(x * scale * 65536.0F) + ((vuint)to_int(scale) << 17);
    l.y = to_int(y * scale * 65536.0F);
    return l;
}

/* Weights of corners are 2^16 times what they should be: so fractions of 16 bits can be taken as they are. */
#define CORNER_SCALE 65536.0F

/* Where h is in the lattice of one surface cell, in units of 2^-16. */
typedef struct angular_place {
    vuint x;
    vint y;
} angular_place;

static inline angular_place angular_place_of(const angular_lattice *l, vuint cell)
{
    /* The cell is a full hash. What chooses the level begins with bits that move its lattice by less than 2^-8. */
    const vmask coarse = less_i((vint)(cell << 8), l->coarser);
    /* Halved from level to level, so that the coarser lattice of one level is the finer one of the next: when the cap
     * passes a power of four, corners keep their numbers. */
    return (angular_place){ choose_u(coarse, l->x >> 1, l->x) + (cell & 0xffffU),
                            choose_i(coarse, l->y >> 1, l->y) + (vint)(cell >> 16) };
}

/* The three corners around it: numbers, not yet hashed, and barycentric weights times cell_weight. */
static inline void angular_around(const angular_place *p, vuint cell, vfloat cell_weight, vuint corner[ANGULAR_CORNERS],
                                  vfloat weight[ANGULAR_CORNERS])
{
    const vfloat fx = to_float((vint)(p->x & 0xffffU)), fy = to_float(p->y & 0xffff);
    const vfloat rest = 65536.0F - fx - fy, over = min_f(rest, splat(0.0F));
    weight[0] = cell_weight * abs_f(rest);
    weight[1] = cell_weight * (fx + over);
    weight[2] = cell_weight * (fy + over);

    const vuint origin = (cell + (p->x >> 16)) * HASH_X + (vuint)(p->y >> 16) * HASH_Y;
    corner[0] = choose_u(less(rest, splat(0.0F)), origin + (HASH_X + HASH_Y), origin);
    corner[1] = origin + HASH_X;
    corner[2] = origin + HASH_Y;
}

/* Their uniforms and weights. hash: the last factor of the hash, HASH_TOP. */
static inline void angular_corners(const angular_place *p, vuint cell, vfloat cell_weight, vuint hash,
                                   vint uniform[ANGULAR_CORNERS], vfloat weight[ANGULAR_CORNERS])
{
    vuint corner[ANGULAR_CORNERS];
    angular_around(p, cell, cell_weight, corner, weight);
    for (int i = 0; i < ANGULAR_CORNERS; i++)
        uniform[i] = (vint)hash_top(corner[i], hash);
}

/* What binomial_start_of adds to a chance, from any cell. */
static inline vfloat angular_dither(vuint cell)
{
    return to_float((vint)(cell * HASH_X >> 16)) * (1.0F / 65536.0F);
}

/* The realisations of a grid, which share one (N, p): three of each cell. */
#define GRID_DRAWS (ANGULAR_CORNERS * GRID_CELLS)

typedef struct angular_draws {
    vint uniform[GRID_DRAWS];
    vfloat weight[GRID_DRAWS];
} angular_draws;

/* Those of so many grids, 1 or all, known to the compiler. lane: as counting_read_u takes it. hash: for each grid, as
 * for the corners. */
static inline __attribute__((always_inline)) void angular_draws_of(const angular_lattice *l, const int grids,
                                                                   const vuint *cell, const vfloat *cell_weight,
                                                                   const vint *lane, const vuint *hash,
                                                                   angular_draws *draws)
{
#pragma GCC unroll 4
    for (int g = 0; g < grids; g++) {
#pragma GCC unroll 3
        for (int c = 0; c < GRID_CELLS; c++) {
            const int i = GRID_CELLS * g + c;
            const vuint own = counting_read_u(cell + i, lane);
            const angular_place place = angular_place_of(l, own);
            angular_corners(&place, own, counting_read_f(cell_weight + i, lane), hash[g],
                            draws[g].uniform + ANGULAR_CORNERS * c, draws[g].weight + ANGULAR_CORNERS * c);
        }
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
    const size_t place = from->place ? from->place[i] : i;
    for (int g = 0; g < GRID_COUNT; g++) {
        to->u[g] = from->u[place];
        to->v[g] = from->v[place];
        to->dudx[g] = from->dudx[place];
        to->dudy[g] = from->dudy[place];
        to->dvdx[g] = from->dvdx[place];
        to->dvdy[g] = from->dvdy[place];
        to->density[g] = from->density[place];
        to->hx[g] = from->hx[i];
        to->hy[g] = from->hy[i];
        to->cap[g] = from->cap[i];
        to->p[g] = from->p[i];
        to->seed[g] = from->seed[place];
    }
    return (counting_points){ to->u,    to->v,  to->dudx, to->dudy, to->dvdx, to->dvdy, to->density,
                              to->seed, to->hx, to->hy,   to->cap,  to->p,    NULL };
}

/* What a point is to its four grids, grid g in lane g. */
typedef struct counting_apart {
    counting_pixel pixel;
    angular_lattice lattice;
    vuint cell[GRID_CELLS];
    vfloat weight[GRID_CELLS];
    vfloat drawn, share, p; /* drawn: for all grids; share: the grid's part of it */
    vfloat dither;          /* of the first grid */
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
    grid_cells(&own, load_d(same.u), load_d(same.v), load_u(same.seed), a->cell, a->weight);
    a->lattice = angular_locate(load_f(same.hx), load_f(same.hy), load_f(same.cap));
    a->drawn = counting_drawn_from(a->pixel.counted);
    a->p = load_f(same.p);
    a->dither = splat(angular_dither(a->cell[0])[0]);
}

static inline float counting_together(const counting_apart *a, vfloat factor)
{
    return choose(counting_is_flat(&a->pixel), splat(1.0F), factor)[0];
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
