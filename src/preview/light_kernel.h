/* A light and many points that look at it, in lanes. */
#ifndef PREVIEW_LIGHT_KERNEL_H
#define PREVIEW_LIGHT_KERNEL_H

#include "preview/light_batch.h"
#include "preview/light_lanes.h"
#include "preview/sampler_draw.h"
#include "preview/sight_lanes.h"

static inline wide3 load_place(const double from[3][LIGHT_BATCH], int at)
{
    return (wide3){ wide_load(&from[0][at]), wide_load(&from[1][at]), wide_load(&from[2][at]) };
}

static inline void store_place(double to[3][LIGHT_BATCH], int at, wide3 a)
{
    wide_store(&to[0][at], a.x);
    wide_store(&to[1][at], a.y);
    wide_store(&to[2][at], a.z);
}

static inline wide_layer load_layer(const light_layer *l, int at)
{
    return (wide_layer){ .x = load_place(l->x, at),
                         .y = load_place(l->y, at),
                         .z = load_place(l->z, at),
                         .wo = { wide_from_floats(&l->wo[0][at]), wide_from_floats(&l->wo[1][at]),
                                 wide_from_floats(&l->wo[2][at]) },
                         .alpha_x = wide_from_floats(&l->alpha_x[at]),
                         .alpha_y = wide_from_floats(&l->alpha_y[at]) };
}

/* Returns which lanes get anything. */
static inline wide_mask irradiate(const light *l, const wide_view *v, int at, light_batch *b)
{
    const wide zero = wide_splat(0.0);
    wide_mask is_any = wide_less(zero, zero);
    for (int c = 0; c < 3; ++c) {
        const wide full = (double)l->intensity[c] * v->factor;
        const wide irradiance = wide_rounded(wide_smaller(full, wide_splat(LIGHT_MOST_IRRADIANCE)));
        wide_store_floats(&b->irradiance[c][at], irradiance);
        is_any = is_any | wide_less(zero, irradiance);
    }
    return is_any & v->is_seen;
}

static inline void see(const light *l, int at, wide_view *v, light_batch *b)
{
    const wide zero = wide_splat(0.0);
    light_see_wide(l, load_place(b->place, at), v);
    store_place(b->wi, at, v->wi);
    wide_store(&b->distance[at], v->distance);
    wide_store(&b->sine[at], v->sine);
    wide_store_floats(&b->solid_angle_sr[at], v->solid_angle_sr);
    const wide_mask reached = irradiate(l, v, at, b);
    wide_mask is_lit = wide_less(zero, zero), shape = is_lit;
    if (light_is_area(l))
        shape = wide_at_most(zero, zero);
    for (int k = 0; k < b->layers && !light_is_area(l); ++k) {
        const wide_layer layer = load_layer(&b->layer[k], at);
        layer_sees(&layer, v->wi, v->sine, &is_lit, &shape);
    }
    b->seen |= (uint64_t)wide_mask_bits(reached & (is_lit | shape)) << at;
    b->shapes |= (uint64_t)wide_mask_bits(reached & shape) << at;
}

/* The rays of a light that has no flat shape. */
static inline void aim(const light *l, int at, const wide_view *v, const double u[2][LIGHT_BATCH], light_batch *b)
{
    wide pair[2] = { wide_splat(0.0), wide_splat(0.0) };
    wide3 direction;
    wide far;
    for (int k = 0; light_is_soft(l) && k < 2; ++k)
        pair[k] = wide_load(&u[k][at]);
    light_pick_wide(l, v, load_place(b->origin, at), pair, &direction, &far);
    store_place(b->direction, at, direction);
    wide_store(&b->far[at], far);
}

/* The light as every point sees it. dimension: of the draw of its ray. */
static inline void look_at_light(const light *l, uint32_t dimension, light_batch *b)
{
    const int end = (b->count + WIDE_LANES - 1) / WIDE_LANES * WIDE_LANES;
    const bool aims = !light_is_area(l) && !l->unshadowed;
    double u[2][LIGHT_BATCH];
    b->seen = b->shapes = 0;
    if (aims && light_is_soft(l))
        draw_pairs(b->pixel, b->reversed, dimension, end, u[0], u[1]);
    for (int at = 0; at < end; at += WIDE_LANES) {
        wide_view v;
        see(l, at, &v, b);
        if (aims)
            aim(l, at, &v, u, b);
    }
    const uint64_t all = b->count < LIGHT_BATCH ? ((uint64_t)1 << b->count) - 1U : ~(uint64_t)0;
    b->seen &= all;
    b->shapes &= all;
}

#endif
