/* Rays of the camera, in lanes. */
#ifndef PREVIEW_CAMERA_LANES_H
#define PREVIEW_CAMERA_LANES_H

#include "preview/camera.h"
#include "preview/wide.h"

/* A ray and its differential. */
typedef struct wide_ray {
    wide3 origin, direction;
    wide near, far;
    wide3 origin_step[2], direction_step[2]; /* to the right, and downwards */
} wide_ray;

/* A step of the direction before it is made unit, to the step of the unit direction. */
static inline wide3 unit_step(wide3 direction, vec3 step, wide length)
{
    return w3_scale(w3_reject(w3_splat(step), direction), 1.0 / length);
}

/* See camera_ray. */
static inline void camera_ray_wide(const camera *c, wide x, wide y, wide_ray *r)
{
    const wide3 zero = w3_splat(v3(0.0, 0.0, 0.0));
    const wide across = (2.0 * x / (double)c->width - 1.0) * c->half_width + c->middle_x;
    const wide upwards = (1.0 - 2.0 * y / (double)c->height) * c->half_height + c->middle_y;
    const wide3 offset = w3_mad(w3_scale(w3_splat(c->right), across), w3_splat(c->up), upwards);
    const vec3 step_x = v3_scale(c->right, 2.0 * c->half_width / (double)c->width);
    const vec3 step_y = v3_scale(c->up, -2.0 * c->half_height / (double)c->height);

    if (c->projection == SCENE_ORTHOGRAPHIC) {
        *r = (wide_ray){ .origin = w3_add(w3_splat(c->origin), offset),
                         .direction = w3_splat(c->forward),
                         .near = wide_splat(c->near),
                         .far = wide_splat(c->far),
                         .origin_step = { w3_splat(step_x), w3_splat(step_y) },
                         .direction_step = { zero, zero } };
        return;
    }
    const wide3 towards = w3_add(w3_splat(c->forward), offset);
    const wide length = w3_length(towards);
    const wide3 direction = w3_scale(towards, 1.0 / length);
    *r = (wide_ray){ .origin = w3_splat(c->origin),
                     .direction = direction,
                     .near = c->near * length,
                     .far = c->far * length,
                     .origin_step = { zero, zero },
                     .direction_step = { unit_step(direction, step_x, length), unit_step(direction, step_y, length) } };
}

#endif
