/* A plain polygon, in lanes: squares that are bent over the quadrilaterals between one point and three corners.
 *
 * A square's point (x, y) is at middle + x u + y v + x y w. Its area changes linearly, as that of bilinear maps does:
 * seen from the origin, 4 (u x v + x u x w + y w x v) . p, where p is any point of the plane. So a rule over the square
 * (light/cubature.h) stays one. A triangle is a square two of whose corners coincide; where more do there is no area,
 * and what it adds is exactly nothing: lanes whose polygons have few corners wait for those that have many.
 *
 * The one point is the first corner, or the middle, from where squares are half as wide and one more. area_fan.c does
 * the same at one point of the surface, with corners side by side.
 */
#ifndef MODEL_AREA_POLYGON_H
#define MODEL_AREA_POLYGON_H

#include "model/area_plain.h"

enum { PLAIN_CORNERS = GLINT_MAX_CORNERS, PLAIN_QUADS = PLAIN_CORNERS / 2 };

/* A polygon as seen from the distance of its middle, the mean of all corners. */
typedef struct plain_shape {
    vmask usable;
    vfloat3 middle;          /* unit */
    plain_extent extent;     /* of all corners */
    vfloat facing;           /* its area seen along the middle, signed */
    vfloat side2, diagonal2; /* squared: its longest side, and from its first corner to every second one */
} plain_shape;

/* A square's area at (x, y) is size + x size_x + y size_y, in the units of plain_light. */
typedef struct plain_quad {
    vfloat3 middle, u, v, w;
    vfloat size, size_x, size_y;
} plain_quad;

static inline vfloat3 plain_minus(vfloat3 a, vfloat3 b)
{
    return (vfloat3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

/* The greatest part of a vector, as an integer, which may be compared whatever it is. */
static inline vint plain_widest(vfloat3 v)
{
    const vint x = (vint)bits_of(abs_f(v.x)), y = (vint)bits_of(abs_f(v.y)), z = (vint)bits_of(abs_f(v.z));
    const vint xy = choose_i(less_i(x, y), y, x);
    return choose_i(less_i(xy, z), z, xy);
}

/* count, widest: of all corners. */
static inline vmask plain_has_numbers(vint count, vint widest)
{
    return less_i(splat_i(2), count) & less_i(widest, (vint)bits_of(splat(1e15F)));
}

/* Whether a polygon is not far wider than it is away, so that no square is too large a number. */
static inline vmask plain_is_away(vint widest, vfloat distance2)
{
    const vfloat width = float_from_bits((vuint)widest);
    return less(splat(1e-30F), distance2) & less(width * width, 9.0F * distance2);
}

/* Half of the longest side of a square: from the first corner, and from the middle. */
static inline vfloat plain_wide(const plain_shape *s)
{
    return 0.5F * sqrt_f(max_f(s->side2, s->diagonal2));
}

static inline vfloat plain_slim(const plain_shape *s)
{
    return 0.5F * sqrt_f(max_f(s->side2, s->extent.reach * s->extent.reach));
}

/* normals: the sum of what neighbouring corners span with the middle. */
static inline void plain_set_facing(plain_shape *s, vfloat3 normals)
{
    const vfloat along = dot_3(normals, s->middle), length2 = dot_3(normals, normals);
    s->facing = 0.5F * along;
    s->extent.off_plane = abs_f(along) / sqrt_f(max_f(length2, splat(1e-30F)));
}

/* As plain_light_of, whose middle, u, v and size are not set here; bends by both kinds of squares. */
static inline plain_light plain_polygon_rule(const plain_shape *s, vint count, vint two_sided, vfloat bend_of_wide,
                                             vfloat bend_of_slim, vmask *from_middle)
{
    const vfloat zero = splat(0.0F), reach2 = s->extent.reach * s->extent.reach;
    const plain_limits most = plain_limits_fast();
    *from_middle =
        less_i(splat_i(4), count) & (less_i(plain_level(bend_of_slim, &most), plain_level(bend_of_wide, &most)) |
                                     ~less(bend_of_wide, splat(PLAIN_FADES)));
    const vfloat bend = choose(*from_middle, bend_of_slim, bend_of_wide);
    vmask plain = s->usable & less(s->extent.reach, splat(2.0F)) & less(splat(1e-8F), s->extent.reach) &
                  less(1e-4F * (reach2 * reach2), s->facing * s->facing);
    const vmask is_away = equal_i(two_sided, splat_i(0)) & less(zero, s->facing);
    const vmask is_dark = plain & (is_away | less(s->middle.z + s->extent.height, splat(-1e-4F)));
    plain = plain & less(s->extent.height, s->middle.z) & less(bend, splat(PLAIN_FINEST)) & ~is_dark;
    const vint rule = choose_i(is_dark, splat_i(PLAIN_DARK), splat_i(PLAIN_LEFT));
    return (plain_light){ .rule = choose_i(plain, splat_i(PLAIN_POLYGON) + plain_level(bend, &most), rule),
                          .left = choose(plain, plain_share_left(bend, PLAIN_FADES, PLAIN_FINEST),
                                         choose(is_dark, zero, splat(1.0F))) };
}

/* From a point and three corners, given from there. sign: that of the polygon's `facing`. */
static inline plain_quad plain_quad_of(vfloat3 from, vfloat3 b, vfloat3 c, vfloat3 d, vfloat sign)
{
    const vfloat quarter = splat(0.25F), half = 0.5F * sign;
    const vfloat3 bd = add_3(b, d);
    const vfloat bc = dot_3(cross_3(b, c), from), cd = dot_3(cross_3(c, d), from), across = dot_3(cross_3(b, d), from);
    return (plain_quad){ add_3(from, scale_3(add_3(c, bd), quarter)),
                         scale_3(add_3(c, plain_minus(b, d)), quarter),
                         scale_3(add_3(c, plain_minus(d, b)), quarter),
                         scale_3(plain_minus(c, bd), quarter),
                         half * (bc + cd),
                         half * (bc - across),
                         half * (cd - across) };
}

/* As plain_terms_at. Corners that lie in a line by rounding, or not in a plane, give no area below none. */
static inline void plain_quad_terms_at(const area_lobe *l, const plain_quad *q, vfloat x, vfloat y, vfloat weight,
                                       int has_base, plain_sums *out)
{
    const vfloat3 at = add_3(add_3(q->middle, scale_3(q->u, x)), add_3(scale_3(q->v, y), scale_3(q->w, x * y)));
    const vfloat area = max_f(q->size + (q->size_x * x + q->size_y * y), splat(0.0F));
    plain_direction_terms(l, at, area * weight, has_base, out);
}

/* ---- polygons in lanes ---- */

/* count: 0 where there is no polygon. From there on the first corner is repeated, up to `most`, which is even. */
typedef struct plain_corners {
    int most;
    vint count;
    vfloat3 at[PLAIN_CORNERS];
} plain_corners;

static inline vfloat3 plain_corner(const plain_corners *c, int i)
{
    return c->at[i < c->most ? i : 0];
}

/* In the order of area_fold.h. */
static inline vfloat3 plain_sum_eight(const vfloat3 v[PLAIN_CORNERS])
{
    return add_3(add_3(add_3(v[0], v[4]), add_3(v[2], v[6])), add_3(add_3(v[1], v[5]), add_3(v[3], v[7])));
}

/* Their mean, and where there is one. */
static inline vmask plain_find_mean(const plain_corners *c, vfloat3 *mean, vfloat *distance2)
{
    const vfloat zero = splat(0.0F);
    const vfloat3 none = { zero, zero, zero };
    vint widest = splat_i(0);
    for (int i = 0; i < c->most; i++) {
        const vint own = plain_widest(c->at[i]);
        widest = choose_i(less_i(widest, own), own, widest);
    }
    const vmask known = plain_has_numbers(c->count, widest);
    vfloat3 corner[PLAIN_CORNERS];
    for (int i = 0; i < PLAIN_CORNERS; i++)
        corner[i] = i < c->most ? choose_3(known & less_i(splat_i(i), c->count), c->at[i], none) : none;
    *mean = scale_3(plain_sum_eight(corner), 1.0F / choose(known, to_float(c->count), splat(1.0F)));
    *distance2 = dot_3(*mean, *mean);
    return known & plain_is_away(choose_i(known, widest, splat_i(0)), *distance2);
}

/* Makes corners multiples of the middle's distance. */
static inline plain_shape plain_shape_of(plain_corners *c)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    const vfloat3 up = { zero, zero, one };
    vfloat3 mean, normal[PLAIN_CORNERS];
    vfloat distance2, reach2 = zero;
    plain_shape s = { .extent = { zero, zero, zero }, .side2 = zero, .diagonal2 = zero };
    s.usable = plain_find_mean(c, &mean, &distance2);
    const vfloat inverse = 1.0F / choose(s.usable, sqrt_f(distance2), one);
    s.middle = choose_3(s.usable, scale_3(mean, inverse), up);
    for (int i = 0; i < c->most; i++)
        c->at[i] = choose_3(s.usable, scale_3(choose_3(s.usable, c->at[i], up), inverse), up);
    for (int i = 0; i < PLAIN_CORNERS; i++)
        normal[i] = (vfloat3){ zero, zero, zero };
    for (int i = 0; i < c->most; i++) {
        const vfloat3 off = plain_minus(c->at[i], s.middle), next = plain_minus(plain_corner(c, i + 1), s.middle);
        const vfloat3 side = plain_minus(plain_corner(c, i + 1), c->at[i]),
                      across = plain_minus(c->at[i | 1], c->at[0]);
        reach2 = max_f(reach2, dot_3(off, off));
        s.extent.height = max_f(s.extent.height, abs_f(off.z));
        s.side2 = max_f(s.side2, dot_3(side, side));
        s.diagonal2 = max_f(s.diagonal2, dot_3(across, across));
        normal[i] = cross_3(off, next);
    }
    s.extent.reach = sqrt_f(reach2);
    plain_set_facing(&s, plain_sum_eight(normal));
    return s;
}

/* Squares of the lanes that are plain; others have no area. Returns how many there are. */
static inline int plain_quads_of(const plain_corners *c, const plain_shape *s, vmask plain, vmask from_middle,
                                 plain_quad quad[PLAIN_QUADS])
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    const vfloat3 up = { zero, zero, one };
    const vfloat sign = choose(less(s->facing, zero), splat(-1.0F), one);
    const vfloat3 from = choose_3(plain, choose_3(from_middle, s->middle, c->at[0]), up);
    vfloat3 ring[2 * PLAIN_QUADS + 1];
    const int count = any(plain & from_middle) ? c->most / 2 : c->most / 2 - 1;
    for (int i = 0; i <= 2 * count; i++)
        ring[i] =
            plain_minus(choose_3(plain, choose_3(from_middle, plain_corner(c, i), plain_corner(c, i + 1)), from), from);
    for (int k = 0; k < count; k++)
        quad[k] = plain_quad_of(from, ring[2 * k], ring[2 * k + 1], ring[2 * k + 2], sign);
    return count;
}

#endif
