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

/* The same at any level. */
typedef struct grid_corner {
    vfloat direction;
    vint ratio;
} grid_corner;

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

/* The triangle of (direction, ratio) around the shape: corners in the order in which they rise to the next level,
 * which must be the same on both sides of every edge. */
static inline void grid_triangle(const grid_shape *s, grid_corner corner[3], vfloat weight[3])
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

    corner[0] = (grid_corner){ a_direction, s->ratio };
    corner[1] = (grid_corner){ b_direction, b_ratio };
    corner[2] = (grid_corner){ 2.0F * left + 1.0F, s->ratio + 1 };
    /* Rounding may leave a hair below zero. */
    weight[0] = max_f(a, splat(0.0F));
    weight[1] = max_f(b, splat(0.0F));
    weight[2] = c;
}

/* The tetrahedron: the triangle at this level and the next, whose vertices rise one after another as the area grows.
 * Grid 0 stands on corner 0 below, grid 3 on corner 2 above. Grid 1 stands on corner 1, above where `last` is set, and
 * grid 2 on corner 2 below where `first` is set; else above, on corner 0 where `last` is set and on corner 1 elsewhere.
 */
typedef struct grid_simplex {
    grid_corner corner[3];
    vint level;
    vmask first, last; /* the vertex that is rising */
    vfloat share[GRID_COUNT];
} grid_simplex;

static inline void grid_simplex_of(const grid_shape *s, grid_simplex *t)
{
    vfloat w[3];
    grid_triangle(s, t->corner, w);
    t->level = s->level;
    /* Area rises by 2 per unit weight of the vertices at the next ratio, which come first, then by 1. */
    const vfloat risen = min_f(max_f(0.5F * s->rise, s->rise - s->ratio_fraction), splat(1.0F));
    const vfloat c_up = min_f(w[2], risen);
    const vfloat b_up = min_f(max_f(risen - w[2], splat(0.0F)), w[1]);
    const vfloat a_up = min_f(max_f(risen - w[2] - w[1], splat(0.0F)), w[0]);
    t->first = less_equal(risen, w[2]);
    t->last = less(w[2] + w[1], risen);
    t->share[0] = max_f(w[0] - a_up, splat(0.0F));
    t->share[1] = choose(t->last, w[1], w[1] - b_up);
    t->share[2] = choose(t->first, w[2] - c_up, choose(t->last, a_up, b_up));
    t->share[3] = c_up;
}

static inline grid_vertex grid_select(vmask m, grid_vertex a, grid_vertex b)
{
    return (grid_vertex){ choose(m, a.direction, b.direction), choose_i(m, a.ratio, b.ratio),
                          choose_i(m, a.level, b.level) };
}

static inline void grid_tetrahedron(const grid_shape *s, grid_vertex vertex[GRID_COUNT], vfloat share[GRID_COUNT])
{
    grid_simplex t;
    grid_vertex low[3], high[3];
    grid_simplex_of(s, &t);
    for (int i = 0; i < 3; i++) {
        low[i] = (grid_vertex){ t.corner[i].direction, t.corner[i].ratio, t.level };
        high[i] = (grid_vertex){ t.corner[i].direction, t.corner[i].ratio, t.level + 1 };
    }
    vertex[0] = low[0];
    vertex[1] = grid_select(t.last, high[1], low[1]);
    vertex[2] = grid_select(t.first, low[2], grid_select(t.last, high[0], high[1]));
    vertex[3] = high[2];
    for (int i = 0; i < GRID_COUNT; i++)
        share[i] = t.share[i];
}

/* What of x is above the largest integer that is no larger, in [0, 1], and the low 32 bits of that integer: adding
 * 1.5 * 2^52 leaves it in the low bits. Beyond 2^51 in size they are just bits. */
static inline vfloat grid_fraction(vdouble x, vuint *integer)
{
    const vdouble whole = floor_d(x);
    *integer = low_word(add_d(whole, splat_d(6755399441055744.0)));
    return narrow(subtract_d(x, whole));
}

/* What a grid is made of: its direction and ratio, which grids of two levels share, and its level. */
typedef struct grid_way {
    vfloat sine, cosine;
    vfloat squeeze; /* 1 / aspect ratio */
    vuint number;
} grid_way;

typedef struct grid_size {
    vfloat across; /* 1 / minor axis: 2^(-level / 2) */
    vuint number;
} grid_size;

static inline grid_way grid_way_of(vfloat direction, vint ratio)
{
    grid_way w;
    w.squeeze = exp2_i(-ratio);
    sincos_pi(direction * w.squeeze, &w.sine, &w.cosine);
    w.number = (vuint)to_int(direction) * HASH_X + (vuint)ratio * HASH_Y;
    return w;
}

static inline grid_size grid_size_of(vint level, vuint seed)
{
    const vfloat half = choose(equal_i(level & 1, splat_i(1)), splat(0.70710678F), splat(1.0F));
    return (grid_size){ exp2_i(-(level >> 1)) * half, seed + (vuint)level * HASH_Z };
}

static inline grid_way grid_select_way(vmask m, const grid_way *a, const grid_way *b)
{
    return (grid_way){ choose(m, a->sine, b->sine), choose(m, a->cosine, b->cosine), choose(m, a->squeeze, b->squeeze),
                       choose_u(m, a->number, b->number) };
}

static inline grid_size grid_select_size(vmask m, const grid_size *a, const grid_size *b)
{
    return (grid_size){ choose(m, a->across, b->across), choose_u(m, a->number, b->number) };
}

/* From metres to coordinates in the lattice of one grid: x = xu u + xv v + start, y = yv v - yu u + start. */
typedef struct grid_map {
    vfloat xu, xv, yu, yv, start;
} grid_map;

/* Skewed coordinates (x - y / sqrt 3, y * 2 / sqrt 3) of the stretched position. Every point of a grid sees the same
 * numbers, so their rounding does not matter. */
static inline grid_map grid_map_of(const grid_way *way, vfloat across, vuint grid)
{
    const vfloat along = across * way->squeeze, skew = across * 0.577350269F, tall = across * 1.15470054F;
    /* Each grid starts somewhere else, in [1, 2) along its diagonal: else all would have a vertex at the origin, and
     * the blend would be sharper there. */
    const vfloat start = float_from_bits(grid >> 9 | 0x3f800000U);
    return (grid_map){ way->cosine * along + way->sine * skew, way->sine * along - way->cosine * skew, way->sine * tall,
                       way->cosine * tall, start };
}

/* Integer coordinates, and what is left of each in [0, 1]. Where cells have no numbers any more the weights of the
 * blend still add up to one. */
typedef struct grid_place {
    vuint x, y;
    vfloat fx, fy;
} grid_place;

static inline grid_place grid_place_of(const grid_map *m, vdouble u, vdouble v)
{
    const vdouble start = widen(m->start);
    const vdouble x = add_d(add_d(multiply_d(u, widen(m->xu)), multiply_d(v, widen(m->xv))), start);
    const vdouble y = add_d(subtract_d(multiply_d(v, widen(m->yv)), multiply_d(u, widen(m->yu))), start);
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

/* The triangles of these grids' lattices around (u, v): three cells, not yet hashed, and barycentric weights of each.
 * grids: known to the compiler, 1 or all. */
static inline __attribute__((always_inline)) void grid_lay(const grid_way *way, const grid_size *size, const int grids,
                                                           vdouble u, vdouble v, vuint *cell, vfloat *weight)
{
    const vuint hash = (vuint)splat_i((int32_t)HASH_TOP);
#pragma GCC unroll 4
    for (int i = 0; i < grids; i++) {
        const vuint grid = hash_top(size[i].number + way[i].number, hash);
        const grid_map map = grid_map_of(&way[i], size[i].across, grid);
        const grid_place place = grid_place_of(&map, u, v);
        grid_surround(&place, grid, cell + GRID_CELLS * i, weight + GRID_CELLS * i);
    }
}

/* Those of one grid. */
static inline void grid_around(const grid_vertex *vertex, vdouble u, vdouble v, vuint seed, vuint cell[GRID_CELLS],
                               vfloat weight[GRID_CELLS])
{
    const grid_way way = grid_way_of(vertex->direction, vertex->ratio);
    const grid_size size = grid_size_of(vertex->level, seed);
    grid_lay(&way, &size, 1, u, v, cell, weight);
}

/* The same, hashed. */
static inline void grid_cells(const grid_vertex *vertex, vdouble u, vdouble v, vuint seed, vuint cell[GRID_CELLS],
                              vfloat weight[GRID_CELLS])
{
    grid_around(vertex, u, v, seed, cell, weight);
    for (int i = 0; i < GRID_CELLS; i++)
        cell[i] = hash_full(cell[i]);
}

/* Those of all four, which have three directions and two sizes among them. */
static inline void grid_point_of(const grid_simplex *t, vdouble u, vdouble v, vuint seed, grid_point *p)
{
    grid_way corner[3];
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++)
        corner[i] = grid_way_of(t->corner[i].direction, t->corner[i].ratio);
    const grid_size low = grid_size_of(t->level, seed), high = grid_size_of(t->level + 1, seed);
    const grid_way raised = grid_select_way(t->last, &corner[0], &corner[1]);
    const grid_way way[GRID_COUNT] = { corner[0], corner[1], grid_select_way(t->first, &corner[2], &raised),
                                       corner[2] };
    const grid_size size[GRID_COUNT] = { low, grid_select_size(t->last, &high, &low),
                                         grid_select_size(t->first, &low, &high), high };
    grid_lay(way, size, GRID_COUNT, u, v, p->cell, p->weight);
#pragma GCC unroll 12
    for (int i = 0; i < GRID_COUNT * GRID_CELLS; i++)
        p->cell[i] = hash_full(p->cell[i]);
    for (int i = 0; i < GRID_COUNT; i++)
        p->share[i] = t->share[i];
}

/* (u, v) in metres; beyond 2^51 cells from the origin single cells cannot be told apart. */
static inline void grid_locate(vdouble u, vdouble v, const grid_ellipse *ellipse, vuint seed, grid_point *p)
{
    const grid_shape shape = grid_shape_of(ellipse);
    grid_simplex simplex;
    grid_simplex_of(&shape, &simplex);
    grid_point_of(&simplex, u, v, seed, p);
}

#endif
