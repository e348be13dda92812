/* The anisotropic grids under a footprint: four grids share its facets, and three cells of each surround its centre.
 *
 * Deliot and Belcour 2023, sections 5 and 6: there is a grid for every level of size (the area, powers of two), of
 * aspect ratio (powers of two) and of direction (2^k directions at ratio 2^k). A footprint lies in one tetrahedron of
 * that lattice. On the surface each grid is a lattice of triangles, stretched along its direction.
 *
 * Where this differs from the paper: the four shares are linear in area, so that sum of share_i * area_i = area of the
 * footprint holds exactly (Eq. 10); without that the variance of a patch of pixels is off by up to 12 %. And levels of
 * size are half as far apart: with powers of two of the minor axis there are cells of a quarter of the pixel's area,
 * between which one sample a pixel steps over some, and the variance of blocks of 16 pixels is up to 18 % too large.
 */
#ifndef FOOTPRINT_GRID_H
#define FOOTPRINT_GRID_H

#include "math/elementary.h"
#include "math/hash.h"

#define GRID_COUNT 4
#define GRID_CELLS 3 /* of one grid */

/* Beyond this aspect ratio, 2^16, the minor axis is taken longer than it is. */
#define GRID_MAX_RATIO_LOG2 16

typedef struct grid_point {
    vfloat share[GRID_COUNT];               /* sum 1: the part of the facets that grid i draws */
    vuint cell[GRID_COUNT * GRID_CELLS];    /* hash of cell j of grid i at 3 i + j */
    vfloat weight[GRID_COUNT * GRID_CELLS]; /* barycentric, sum 1 over the cells of a grid */
} grid_point;

/* One vertex of the lattice of grids. */
typedef struct grid_vertex {
    vfloat direction; /* index of the direction, in [0, 2^ratio) */
    vint ratio;       /* log2 of the aspect ratio */
    vint level;       /* log2 of the minor axis squared */
} grid_vertex;

/* The footprint's size, shape and direction in units of the lattice of grids. */
typedef struct grid_shape {
    vint level, ratio;
    vfloat ratio_fraction; /* in [0, 1): linear in the aspect ratio */
    vfloat rise;           /* area over that of the level below, in units of 2^ratio, less the lower end */
    vfloat turn;           /* direction of the major axis over pi, in [0, 1) */
} grid_shape;

/* An ellipse on the surface: the symmetric matrix of its second moments, m^2, and the root of its determinant. */
typedef struct grid_ellipse {
    vfloat uu, vv, uv;
    vfloat area; /* > 0 */
} grid_ellipse;

/* Area of the parallelogram that one pixel covers, m^2. In double: at aspect 10^6 a float difference has no digit left.
 */
static inline vfloat grid_area(vfloat dudx, vfloat dudy, vfloat dvdx, vfloat dvdy)
{
    return abs_f(narrow(subtract_d(multiply_d(widen(dudx), widen(dvdy)), multiply_d(widen(dudy), widen(dvdx)))));
}

/* The pixel, convolved with a round facet of this area: J J^T + facet_area I. A pixel that is smaller than a facet,
 * along one axis or both, sees the facet's size instead of its own. */
static inline grid_ellipse grid_ellipse_of(vfloat dudx, vfloat dudy, vfloat dvdx, vfloat dvdy, vfloat area,
                                           vfloat facet_area)
{
    const vfloat uu = dudx * dudx + dudy * dudy;
    const vfloat vv = dvdx * dvdx + dvdy * dvdy;
    grid_ellipse e;
    e.uu = uu + facet_area;
    e.vv = vv + facet_area;
    e.uv = dudx * dvdx + dudy * dvdy;
    e.area = sqrt_f(area * area + facet_area * (uu + vv) + facet_area * facet_area);
    return e;
}

static inline grid_shape grid_shape_of(const grid_ellipse *e)
{
    const vfloat half_sum = 0.5F * (e->uu + e->vv), half_difference = 0.5F * (e->uu - e->vv);
    const vfloat radius = sqrt_f(half_difference * half_difference + e->uv * e->uv);
    const vfloat major2 = half_sum + radius; /* square of the larger singular value */
    const vfloat bounded = max_f(e->area, major2 * (1.0001F / (1 << GRID_MAX_RATIO_LOG2)));
    const vfloat aspect = max_f(major2 / bounded, splat(1.0F));
    /* A triangular lattice of spacing s has sqrt(3)/2 s^2 of area per vertex: this minor axis makes it the footprint's.
     */
    const vfloat minor2 = bounded / aspect * 1.15470054F;

    grid_shape s;
    s.ratio = exponent_of(aspect);
    s.ratio_fraction = mantissa_of(aspect) - 1.0F;
    s.level = exponent_of(minor2);
    s.rise = (1.0F + s.ratio_fraction) * (mantissa_of(minor2) - 1.0F);
    s.turn = turn_of(e->uv, half_difference);
    return s;
}

/* The triangle of (direction, ratio) around the shape: vertices in the order in which they rise to the next level,
 * which must be the same on both sides of every edge. */
static inline void grid_triangle(const grid_shape *s, grid_vertex vertex[3], vfloat weight[3])
{
    const vfloat y = s->ratio_fraction;
    const vfloat directions = exp2_i(s->ratio);
    const vfloat position = s->turn * directions;
    const vfloat left = floor_f(position);
    const vfloat x = position - left;
    const vmask right = less(splat(0.5F), x);
    const vfloat offset = choose(right, 1.0F - x, x); /* to the nearer coarse direction, in [0, 1/2] */
    vfloat near = choose(right, left + 1.0F, left), far = choose(right, left, left + 1.0F);
    near = choose(less_equal(directions, near), near - directions, near);
    far = choose(less_equal(directions, far), far - directions, far);

    /* Coarse directions lie at whole x, fine ones (next ratio) at whole and half x. */
    const vmask side = less(2.0F * offset, y); /* a triangle with one coarse vertex, else with two */
    vfloat a = choose(side, 1.0F - y, 1.0F - offset - 0.5F * y);
    vfloat b = choose(side, y - 2.0F * offset, offset - 0.5F * y);
    const vfloat c = min_f(2.0F * offset, y);
    vfloat a_direction = near, b_direction = choose(side, 2.0F * near, far);
    const vint b_ratio = choose_i(side, s->ratio + 1, s->ratio);
    /* At ratio 1 there is only one direction: the two coarse vertices are one. */
    const vmask single = ~side & equal_i(s->ratio, splat_i(0));
    a = choose(single, a + b, a);
    b = choose(single, splat(0.0F), b);
    /* Between two coarse vertices the odd one rises first. */
    const vmask swap = ~side & equal_i(to_int(near) & 1, splat_i(1));
    const vfloat low = choose(swap, b, a), low_direction = choose(swap, b_direction, a_direction);
    b = choose(swap, a, b);
    b_direction = choose(swap, a_direction, b_direction);
    a = low;
    a_direction = low_direction;

    vertex[0] = (grid_vertex){ a_direction, s->ratio, s->level };
    vertex[1] = (grid_vertex){ b_direction, b_ratio, s->level };
    vertex[2] = (grid_vertex){ 2.0F * left + 1.0F, s->ratio + 1, s->level };
    /* Rounding may leave a hair below zero. */
    weight[0] = max_f(a, splat(0.0F));
    weight[1] = max_f(b, splat(0.0F));
    weight[2] = c;
}

static inline grid_vertex grid_select(vmask m, grid_vertex a, grid_vertex b)
{
    return (grid_vertex){ choose(m, a.direction, b.direction), choose_i(m, a.ratio, b.ratio),
                          choose_i(m, a.level, b.level) };
}

/* The tetrahedron: the triangle at this level and the next, whose vertices rise one after another as the area grows. */
static inline void grid_tetrahedron(const grid_shape *s, grid_vertex vertex[GRID_COUNT], vfloat share[GRID_COUNT])
{
    grid_vertex t[3];
    vfloat w[3];
    grid_triangle(s, t, w);
    /* Area rises by 2 per unit weight of the vertices at the next ratio, which come first, then by 1. */
    const vfloat risen = min_f(max_f(0.5F * s->rise, s->rise - s->ratio_fraction), splat(1.0F));
    const vfloat c_up = min_f(w[2], risen);
    const vfloat b_up = min_f(max_f(risen - w[2], splat(0.0F)), w[1]);
    const vfloat a_up = min_f(max_f(risen - w[2] - w[1], splat(0.0F)), w[0]);
    const vmask first = less_equal(risen, w[2]), last = less(w[2] + w[1], risen);

    grid_vertex raised[3] = { t[0], t[1], t[2] };
    for (int i = 0; i < 3; i++)
        raised[i].level = raised[i].level + 1;
    vertex[0] = t[0];
    share[0] = max_f(w[0] - a_up, splat(0.0F));
    vertex[1] = grid_select(last, raised[1], t[1]);
    share[1] = choose(last, w[1], w[1] - b_up);
    vertex[2] = grid_select(first, t[2], grid_select(last, raised[0], raised[1]));
    share[2] = choose(first, w[2] - c_up, choose(last, a_up, b_up));
    vertex[3] = raised[2];
    share[3] = c_up;
}

/* What of x is above the largest integer below it, in [0, 1], and the low 32 bits of that integer; an integer is itself
 * with 0 or the one below with 1. Adding 1.5 * 2^52 leaves the nearest integer to x - 1/2 in the low bits; beyond 2^51
 * in size what comes out is no floor, but a number. */
static inline vfloat grid_fraction(vdouble x, vuint *integer)
{
    const vdouble shift = splat_d(6755399441055744.0), shifted = add_d(subtract_d(x, splat_d(0.5)), shift);
    *integer = low_word(shifted);
    return min_f(max_f(narrow(subtract_d(x, subtract_d(shifted, shift))), splat(0.0F)), splat(1.0F));
}

/* From metres to coordinates in the lattice of one grid: x = xu u + xv v + x0, y = yv v - yu u + y0. */
typedef struct grid_map {
    vfloat xu, xv, x0, yu, yv, y0;
} grid_map;

/* Skewed coordinates (x - y / sqrt 3, y * 2 / sqrt 3) of the stretched position. Every point of a grid sees the same
 * numbers, so their rounding does not matter. */
static inline grid_map grid_map_of(const grid_vertex *g, vfloat sine, vfloat cosine, vuint grid)
{
    /* 2^(-level / 2) */
    const vfloat across =
        exp2_i(-(g->level >> 1)) * choose(equal_i(g->level & 1, splat_i(1)), splat(0.70710678F), splat(1.0F));
    const vfloat along = across * exp2_i(-g->ratio);
    const vfloat skew = across * 0.577350269F, tall = across * 1.15470054F;
    /* Each grid starts somewhere else: else all would have a vertex at the origin, and the blend would be sharper
     * there. */
    const vfloat x0 = to_float((vint)(grid & 0xffffU)) * (1.0F / 65536.0F);
    const vfloat y0 = to_float((vint)(grid >> 16)) * (1.0F / 65536.0F);
    return (grid_map){ cosine * along + sine * skew, sine * along - cosine * skew, x0, sine * tall, cosine * tall, y0 };
}

/* Integer coordinates, and what is left of each in [0, 1]. Where cells have no numbers any more the weights of the
 * blend still add up to one. */
typedef struct grid_place {
    vuint x, y;
    vfloat fx, fy;
} grid_place;

static inline grid_place grid_place_of(const grid_map *m, vdouble u, vdouble v)
{
    const vdouble x = add_d(add_d(multiply_d(u, widen(m->xu)), multiply_d(v, widen(m->xv))), widen(m->x0));
    const vdouble y = add_d(subtract_d(multiply_d(v, widen(m->yv)), multiply_d(u, widen(m->yu))), widen(m->y0));
    grid_place p;
    p.fx = grid_fraction(x, &p.x);
    p.fy = grid_fraction(y, &p.y);
    return p;
}

/* The triangle around a place: three cells, not yet hashed, and barycentric weights. */
static inline void grid_surround(const grid_place *p, vuint grid, vuint cell[GRID_CELLS], vfloat weight[GRID_CELLS])
{
    const vfloat sum = p->fx + p->fy;
    const vmask upper = less_equal(splat(1.0F), sum);
    weight[0] = abs_f(1.0F - sum);
    weight[1] = choose(upper, 1.0F - p->fy, p->fx);
    weight[2] = choose(upper, 1.0F - p->fx, p->fy);
    const vuint origin = p->x * HASH_Z + p->y * HASH_Y + grid;
    cell[0] = origin + ((vuint)mask_bits(upper) & (HASH_Z + HASH_Y));
    cell[1] = origin + HASH_Z;
    cell[2] = origin + HASH_Y;
}

/* The triangles of these grids' lattices around (u, v): three cells and barycentric weights of each. grids: known to
 * the compiler, 1 or all.
 *
 * Step by step for all of them: what is computed for one is a long chain, and a compiler does not interleave chains. */
static inline __attribute__((always_inline)) void grid_cells(const grid_vertex *vertex, const int grids, vdouble u,
                                                             vdouble v, vuint seed, vuint *cell, vfloat *weight)
{
    vfloat sine[GRID_COUNT], cosine[GRID_COUNT];
    vuint grid[GRID_COUNT];
    grid_map map[GRID_COUNT];
    grid_place place[GRID_COUNT];
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++)
        sincos_pi(vertex[i].direction * exp2_i(-vertex[i].ratio), &sine[i], &cosine[i]);
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++)
        grid[i] = hash_full(seed + (vuint)to_int(vertex[i].direction) * HASH_X + (vuint)vertex[i].ratio * HASH_Y +
                            (vuint)vertex[i].level * HASH_Z);
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++)
        map[i] = grid_map_of(&vertex[i], sine[i], cosine[i], grid[i]);
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++)
        place[i] = grid_place_of(&map[i], u, v);
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++)
        grid_surround(&place[i], grid[i], cell + GRID_CELLS * i, weight + GRID_CELLS * i);
#pragma GCC unroll 12
    for (int i = 0; i < GRID_CELLS * grids; i++)
        cell[i] = hash_full(cell[i]);
}

/* (u, v) in metres; beyond 2^51 cells from the origin single cells cannot be told apart. */
static inline void grid_locate(vdouble u, vdouble v, const grid_ellipse *ellipse, vuint seed, grid_point *p)
{
    const grid_shape shape = grid_shape_of(ellipse);
    grid_vertex vertex[GRID_COUNT];
    grid_tetrahedron(&shape, vertex, p->share);
    grid_cells(vertex, GRID_COUNT, u, v, seed, p->cell, p->weight);
}

#endif
