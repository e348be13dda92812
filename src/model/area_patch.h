/* Maps of the square to the directions of a light (area_cells.h), in lanes. */
#ifndef MODEL_AREA_PATCH_H
#define MODEL_AREA_PATCH_H

#include "model/area_cells.h"
#include "model/area_eight.h"

/* A map in each lane. */
typedef struct patch {
    int is_round;
    vfloat3 middle, u, v, w;
    vfloat size[4], turn;
} patch;

static inline vfloat3 patch_lookup(const float from[3][AREA_ROOM], vint i)
{
    return (vfloat3){ lookup_f(from[0], i), lookup_f(from[1], i), lookup_f(from[2], i) };
}

/* Each lane its own, without its area. */
static inline patch patches_at(const area_patches *from, vint i)
{
    patch p = { .is_round = from->is_round,
                .middle = patch_lookup(from->middle, i),
                .u = patch_lookup(from->u, i),
                .v = patch_lookup(from->v, i),
                .turn = splat(from->turn) };
    if (!p.is_round)
        p.w = patch_lookup(from->w, i);
    return p;
}

/* All lanes the same; is_round: as it says itself. */
static inline patch patch_at(const area_patches *from, int i, int is_round)
{
    patch p = { .is_round = is_round,
                .middle = splat_at(from->middle, i),
                .u = splat_at(from->u, i),
                .v = splat_at(from->v, i),
                .size = { splat(from->size[0][i]) },
                .turn = splat(from->turn) };
    if (!p.is_round) {
        p.w = splat_at(from->w, i);
        for (int k = 1; k < 4; k++)
            p.size[k] = splat(from->size[k][i]);
    }
    return p;
}

/* a + by_b b + by_c c */
static inline vfloat3 patch_sum(vfloat3 a, vfloat3 b, vfloat by_b, vfloat3 c, vfloat by_c)
{
    return add_3(a, add_3(scale_3(b, by_b), scale_3(c, by_c)));
}

/* Of half the angle from the top of a round light: near the top, floats know the angle, but not its cosine. */
static inline void patch_half_turn(const patch *p, vfloat x, vfloat *s, vfloat *c)
{
    vfloat minus_s;
    sincos_pi_past_quarter(p->turn * (0.5F + 0.5F * x), c, &minus_s);
    *s = 0.0F - minus_s;
}

/* Towards the point (x, y), of any length, and the map's area there. */
static inline vfloat3 patch_point(const patch *p, vfloat x, vfloat y, vfloat *area)
{
    if (p->is_round) {
        vfloat s, c;
        patch_half_turn(p, x, &s, &c);
        const vfloat s2 = s * s;
        *area = p->size[0] * (s2 * (c * c));
        return patch_sum(p->middle, p->u, 2.0F * (s * c) * y, p->v, -2.0F * s2);
    }
    const vfloat xy = x * y;
    *area = max_f((p->size[0] + p->size[3] * xy) + (p->size[1] * x + p->size[2] * y), splat(0.0F));
    return add_3(patch_sum(p->middle, p->u, x, p->v, y), scale_3(p->w, xy));
}

/* The middle of a cell, and how far it goes along both axes. */
typedef struct patch_frame {
    vfloat3 middle, along_x, along_y;
    vfloat turn; /* of a round light: half the angle along x */
} patch_frame;

static inline patch_frame patch_frame_of(const patch *p, vfloat x, vfloat y, vfloat reach_x, vfloat reach_y)
{
    const vfloat zero = splat(0.0F);
    if (p->is_round) {
        const vfloat3 none = { zero, zero, zero };
        vfloat s, c;
        patch_half_turn(p, x, &s, &c);
        const vfloat sine = 2.0F * (s * c), versine = 2.0F * (s * s), cosine = 1.0F - versine,
                     turn = MATH_PI * p->turn * reach_x;
        /* Chords are longest, and lie farthest apart, where the cell is closest to the middle of the disk. */
        const vfloat longest = min_f(sine + abs_f(cosine) * turn, splat(1.0F));
        return (patch_frame){ patch_sum(p->middle, p->u, sine * y, p->v, 0.0F - versine),
                              patch_sum(none, p->u, cosine * y * turn, p->v, 0.0F - longest * turn),
                              scale_3(p->u, longest * reach_y), turn };
    }
    return (patch_frame){ add_3(patch_sum(p->middle, p->u, x, p->v, y), scale_3(p->w, x * y)),
                          scale_3(add_3(p->u, scale_3(p->w, y)), reach_x),
                          scale_3(add_3(p->v, scale_3(p->w, x)), reach_y), zero };
}

#endif
