/* Where the samples of a block lie in their pixels, and the rays that go there, in lanes. */
#ifndef PREVIEW_CAMERA_KERNEL_H
#define PREVIEW_CAMERA_KERNEL_H

#include "preview/camera_batch.h"
#include "preview/camera_lanes.h"
#include "preview/sampler_draw.h"

static inline void store_scaled(double to[3][CAMERA_BATCH], int at, wide3 a, double s)
{
    wide_store(&to[0][at], a.x * s);
    wide_store(&to[1][at], a.y * s);
    wide_store(&to[2][at], a.z * s);
}

static inline void leave_camera(const camera *c, camera_batch *b)
{
    draw_pairs(b->pixel, b->reversed, b->dimension, CAMERA_BATCH, b->jitter[0], b->jitter[1]);
    for (int at = 0; at < CAMERA_BATCH; at += WIDE_LANES) {
        wide_ray r;
        const wide x = wide_load(&b->x[at]) + wide_load(&b->jitter[0][at]);
        const wide y = wide_load(&b->y[at]) + wide_load(&b->jitter[1][at]);
        camera_ray_wide(c, x, y, &r);
        store_scaled(b->origin, at, r.origin, 1.0);
        store_scaled(b->direction, at, r.direction, 1.0);
        wide_store(&b->near[at], r.near);
        wide_store(&b->far[at], r.far);
        for (int k = 0; k < 2; ++k) {
            store_scaled(b->origin_step[k], at, r.origin_step[k], b->scale);
            store_scaled(b->direction_step[k], at, r.direction_step[k], b->scale);
        }
    }
}

#endif
