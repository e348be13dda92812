/* Hits in lanes: where exactly a ray meets the triangle that Embree has found, what the mesh says about that point, and
 * how both change from pixel to pixel. In double precision: places on a surface are metres that must resolve facets. */
#ifndef PREVIEW_HIT_KERNEL_H
#define PREVIEW_HIT_KERNEL_H

#include "preview/hit_batch.h"
#include "preview/wide.h"

/* ---- matrices ---- */

/* An affine matrix in every lane: three rows of four. */
typedef struct wide_matrix {
    wide row[3][4];
} wide_matrix;

static inline wide3 matrix_vector(const wide_matrix *m, wide3 d)
{
    return (wide3){ m->row[0][0] * d.x + m->row[0][1] * d.y + m->row[0][2] * d.z,
                    m->row[1][0] * d.x + m->row[1][1] * d.y + m->row[1][2] * d.z,
                    m->row[2][0] * d.x + m->row[2][1] * d.y + m->row[2][2] * d.z };
}

static inline wide3 matrix_point(const wide_matrix *m, wide3 p)
{
    return (wide3){ m->row[0][0] * p.x + m->row[0][1] * p.y + m->row[0][2] * p.z + m->row[0][3],
                    m->row[1][0] * p.x + m->row[1][1] * p.y + m->row[1][2] * p.z + m->row[1][3],
                    m->row[2][0] * p.x + m->row[2][1] * p.y + m->row[2][2] * p.z + m->row[2][3] };
}

/* See m4_transposed_vector. */
static inline wide3 matrix_transposed(const wide_matrix *m, wide3 d)
{
    return (wide3){ m->row[0][0] * d.x + m->row[1][0] * d.y + m->row[2][0] * d.z,
                    m->row[0][1] * d.x + m->row[1][1] * d.y + m->row[2][1] * d.z,
                    m->row[0][2] * d.x + m->row[1][2] * d.y + m->row[2][2] * d.z };
}

/* One number of each lane's matrix. */
static inline wide gather_number(const double *const m[WIDE_LANES], int at)
{
    double numbers[WIDE_LANES];
    for (int lane = 0; lane < WIDE_LANES; ++lane)
        numbers[lane] = m[lane][at];
    return wide_load(numbers);
}

/* Most often the lanes have one matrix. */
static inline wide_matrix gather_matrix(const double *const m[WIDE_LANES])
{
    wide_matrix out;
    bool is_one = true;
    for (int lane = 1; lane < WIDE_LANES; ++lane)
        is_one = is_one && m[lane] == m[0];
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const int at = 4 * column + row;
            out.row[row][column] = is_one ? wide_splat(m[0][at]) : gather_number(m, at);
        }
    return out;
}

/* ---- a group of hits, the first of them number `at` of the batch ---- */

typedef struct hit_group {
    wide_matrix to_world, to_object;
    wide3 corner[3], edge[2]; /* object space; edges from corner 0 */
    wide3 origin, direction;
    wide weights[2], distance;
    wide3 place, place_object, world_edge[2];
    wide3 flat, smooth, along, across;
    wide side; /* see hit_batch */
} hit_group;

static inline wide3 load_vector(const double from[3][HIT_BATCH], int at)
{
    return (wide3){ wide_load(&from[0][at]), wide_load(&from[1][at]), wide_load(&from[2][at]) };
}

static inline wide3 load_corner(const float from[3][HIT_BATCH], int at)
{
    return (wide3){ wide_from_floats(&from[0][at]), wide_from_floats(&from[1][at]), wide_from_floats(&from[2][at]) };
}

static inline void store_vector(double to[3][HIT_BATCH], int at, wide3 a)
{
    wide_store(&to[0][at], a.x);
    wide_store(&to[1][at], a.y);
    wide_store(&to[2][at], a.z);
}

static inline void load_group(const hit_batch *b, int at, hit_group *g)
{
    const double *to_world[WIDE_LANES], *to_object[WIDE_LANES];
    for (int lane = 0; lane < WIDE_LANES; ++lane) {
        to_world[lane] = b->placed[at + lane]->to_world;
        to_object[lane] = b->placed[at + lane]->to_object;
    }
    g->to_world = gather_matrix(to_world);
    g->to_object = gather_matrix(to_object);
    for (int k = 0; k < 3; ++k)
        g->corner[k] = load_corner(b->position[k], at);
    for (int k = 0; k < 2; ++k)
        g->edge[k] = w3_sub(g->corner[k + 1], g->corner[0]);
    g->origin = load_vector(b->origin, at);
    g->direction = load_vector(b->direction, at);
    g->weights[0] = wide_load(&b->weights[0][at]);
    g->weights[1] = wide_load(&b->weights[1][at]);
    g->distance = wide_load(&b->distance[at]);
}

/* See geometry_meet. */
static inline void meet(hit_group *g)
{
    const wide zero = wide_splat(0.0), one = wide_splat(1.0);
    const wide3 o = matrix_point(&g->to_object, g->origin);
    const wide3 d = matrix_vector(&g->to_object, g->direction);
    const wide3 n = w3_cross(g->edge[0], g->edge[1]);
    const wide3 to_corner = w3_sub(g->corner[0], o);
    const wide determinant = w3_dot(n, d);
    const wide t = w3_dot(n, to_corner) / determinant;
    const wide3 q = w3_cross(to_corner, d);
    const wide b1 = w3_dot(g->edge[1], q) / determinant;
    const wide b2 = -w3_dot(g->edge[0], q) / determinant;
    const wide_mask is_met = wide_is_finite(t) & wide_is_finite(b1) & wide_is_finite(b2);
    const wide first = wide_smaller(wide_larger(b1, zero), one);
    const wide second = wide_smaller(wide_larger(b2, zero), 1.0 - first);
    g->weights[0] = wide_choose(is_met, first, g->weights[0]);
    g->weights[1] = wide_choose(is_met, second, g->weights[1]);
    g->distance = wide_choose(is_met, t, g->distance);
}

static inline void find_place(hit_group *g)
{
    g->place_object = w3_mad(w3_mad(g->corner[0], g->edge[0], g->weights[0]), g->edge[1], g->weights[1]);
    g->place = matrix_point(&g->to_world, g->place_object);
    g->world_edge[0] = matrix_vector(&g->to_world, g->edge[0]);
    g->world_edge[1] = matrix_vector(&g->to_world, g->edge[1]);
}

/* What the mesh has at the corners, interpolated. */
static inline wide3 interpolate(const hit_group *g, const float values[3][3][HIT_BATCH], int at)
{
    const wide3 a = load_corner(values[0], at), b = load_corner(values[1], at), c = load_corner(values[2], at);
    return w3_mad(w3_mad(a, w3_sub(b, a), g->weights[0]), w3_sub(c, a), g->weights[1]);
}

/* As they are on the front; which side is seen, they do not say yet. */
static inline void find_normals(const hit_batch *b, int at, hit_group *g)
{
    const wide one = wide_splat(1.0), zero = wide_splat(0.0);
    g->flat = w3_normalize(matrix_transposed(&g->to_object, w3_cross(g->edge[0], g->edge[1])));
    g->smooth = w3_normalize(matrix_transposed(&g->to_object, interpolate(g, b->normal, at)));
    const wide square = w3_dot(g->smooth, g->smooth);
    g->smooth = w3_choose(wide_at_most(square, zero) & wide_at_most(zero, square), g->flat, g->smooth);
    g->side = wide_choose(wide_at_most(w3_dot(g->flat, g->direction), zero), one, -one);
}

/* Perpendicular to the normal, as the glTF text wants it; any one where the mesh has none. */
static inline void find_tangent(const hit_batch *b, int at, hit_group *g)
{
    const wide zero = wide_splat(0.0);
    wide_mask is_known = wide_less(zero, zero);
    g->along = (wide3){ zero, zero, zero };
    if (b->has_tangents) {
        const wide3 mean = interpolate(g, b->tangent, at);
        const wide3 flat = w3_reject(matrix_vector(&g->to_world, mean), g->smooth);
        is_known = wide_less(zero, w3_dot(flat, flat));
        g->along = w3_normalize(flat);
    }
    if (!wide_all(is_known))
        g->along = w3_choose(is_known, g->along, w3_any_tangent(g->smooth));
    /* The bitangent follows the texture on the mesh. */
    g->across = w3_scale(w3_cross(g->smooth, g->along), wide_load(&b->handedness[at]));
}

/* The mean of the projections of the point onto the tangent planes of the corners, where those lie outside: keeps the
 * facets of a coarse mesh out of its own shadow. J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II
 * (2021). */
static inline wide3 lifted(const hit_batch *b, int at, const hit_group *g)
{
    const wide zero = wide_splat(0.0);
    const wide weights[3] = { 1.0 - g->weights[0] - g->weights[1], g->weights[0], g->weights[1] };
    wide3 lift = { zero, zero, zero };
    for (int k = 0; k < 3; ++k) {
        const wide3 corner = matrix_point(&g->to_world, g->corner[k]);
        const wide3 n =
            w3_scale(w3_normalize(matrix_transposed(&g->to_object, load_corner(b->normal[k], at))), g->side);
        const wide below = wide_smaller(w3_dot(w3_sub(g->place, corner), n), zero);
        lift = w3_mad(lift, n, -below * weights[k]);
    }
    return w3_add(g->place, lift);
}

/* Embree sees the vertices, the transform and the ray in float: a few units in the last place of the largest number
 * that takes part, 2^-23 each. 32 of them cover the chain of products and sums, and are 4 micrometres at 1 m. */
static inline wide clearance(const hit_group *g)
{
    const wide edges = wide_larger(w3_max_abs(g->world_edge[0]), w3_max_abs(g->world_edge[1]));
    const wide object = w3_max_abs(matrix_vector(&g->to_world, g->place_object));
    return wide_larger(w3_max_abs(g->place), wide_larger(object, edges)) * 32.0 * 0x1p-23;
}

/* ---- from pixel to pixel ---- */

/* Below this cosine the plane is edge-on at any pixel size; it keeps steps finite. Taste. */
#define SMALLEST_COSINE 1e-6

/* How the point where the ray meets the plane of the triangle moves, metres per pixel; it stays in the plane. H. Igehy,
 * "Tracing Ray Differentials", SIGGRAPH 1999, Eqs. 10 and 11. A plane seen edge-on gives long but finite steps. */
static inline wide3 transfer(const hit_group *g, wide3 origin_step, wide3 direction_step)
{
    const wide3 step = w3_mad(origin_step, direction_step, g->distance);
    const wide3 flat = w3_scale(g->flat, g->side);
    const wide cosine = w3_dot(g->direction, flat);
    const wide safe = wide_sign(cosine) * wide_larger(wide_abs(cosine), wide_splat(SMALLEST_COSINE));
    return w3_mad(step, g->direction, -w3_dot(step, flat) / safe);
}

/* The weights w with w0 e0 + w1 e1 = step, by the normal equations. */
static inline void weights_of_step(const hit_group *g, wide3 step, wide w[2])
{
    const wide3 *const e = g->world_edge;
    const wide aa = w3_dot(e[0], e[0]), ab = w3_dot(e[0], e[1]), bb = w3_dot(e[1], e[1]);
    const wide sa = w3_dot(e[0], step), sb = w3_dot(e[1], step);
    const wide determinant = aa * bb - ab * ab, zero = wide_splat(0.0);
    const wide_mask is_any = wide_less(zero, determinant);
    w[0] = wide_choose(is_any, (sa * bb - sb * ab) / determinant, zero);
    w[1] = wide_choose(is_any, (sb * aa - sa * ab) / determinant, zero);
}

static inline void differentiate(const hit_group *g, int at, hit_batch *b)
{
    for (int k = 0; k < 2; ++k) {
        wide weights[2];
        const wide3 step = transfer(g, load_vector(b->step[k], at), load_vector(b->step[2 + k], at));
        weights_of_step(g, step, weights);
        store_vector(b->place_step[k], at, step);
        wide_store(&b->weights_step[k][0][at], weights[0]);
        wide_store(&b->weights_step[k][1][at], weights[1]);
    }
}

static inline void resolve(hit_batch *b, int at)
{
    hit_group g;
    load_group(b, at, &g);
    meet(&g);
    find_place(&g);
    find_normals(b, at, &g);
    find_tangent(b, at, &g);
    differentiate(&g, at, b);
    store_vector(b->shadow_origin, at, lifted(b, at, &g));
    wide_store(&b->clearance[at], clearance(&g));
    wide_store(&b->weights[0][at], g.weights[0]);
    wide_store(&b->weights[1][at], g.weights[1]);
    wide_store(&b->distance[at], g.distance);
    wide_store(&b->side[at], g.side);
    store_vector(b->place, at, g.place);
    store_vector(b->place_object, at, g.place_object);
    store_vector(b->flat, at, w3_scale(g.flat, g.side));
    store_vector(b->smooth, at, w3_scale(g.smooth, g.side));
    store_vector(b->along, at, g.along);
    store_vector(b->across, at, g.across);
}

static inline void resolve_hits(hit_batch *b, int count)
{
    for (int at = 0; at < count; at += WIDE_LANES)
        resolve(b, at);
}

#endif
