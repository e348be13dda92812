/* How points see a light, and where their shadow rays go, in lanes. */
#ifndef PREVIEW_LIGHT_LANES_H
#define PREVIEW_LIGHT_LANES_H

#include "preview/light.h"
#include "preview/turn.h"

/* See light_view. */
typedef struct wide_view {
    wide_mask is_seen; /* from its front, and not from its middle; it may be black all the same */
    wide3 wi;
    wide distance, sine, solid_angle_sr;
    wide factor; /* of the intensity: what irradiance or radiance it makes */
} wide_view;

/* What a light that is seen as a shape may be: neither a point nor half of all directions. */
static inline wide shape_sine(wide sine)
{
    const wide_mask is_shape = wide_less(wide_splat(LIGHT_SMALLEST_ANGLE), sine) & wide_less(sine, wide_splat(1.0));
    return wide_choose(is_shape, sine, wide_splat(0.0));
}

static inline wide clamp_cap(wide solid_angle)
{
    return wide_smaller(wide_larger(solid_angle, wide_splat(LIGHT_SMALLEST_CAP)), wide_splat(LIGHT_LARGEST_CAP));
}

/* The same as light_cap_sr(asin(sine)): 1 - sqrt(1 - s^2) = s^2 / (1 + sqrt(1 - s^2)). */
static inline wide cap_of_sine(wide sine)
{
    const wide square = sine * sine;
    return 2.0 * PREVIEW_PI * square / (1.0 + wide_sqrt(1.0 - square));
}

static inline wide spot_factor(const light *l, wide3 wi)
{
    const wide t = w3_dot(w3_splat(l->axis), wi) * l->cone_scale + l->cone_offset;
    const wide within = wide_smaller(wide_larger(t, wide_splat(0.0)), wide_splat(1.0));
    return within * within;
}

/* max(min(1 - (d / range)^4, 1), 0): KHR_lights_punctual, "Range Property". */
static inline wide range_factor(wide distance, double range)
{
    const wide ratio = distance / range;
    const wide square = ratio * ratio;
    return wide_larger(1.0 - square * square, wide_splat(0.0));
}

static inline void see_sun(const light *l, wide_view *v)
{
    const wide zero = wide_splat(0.0);
    v->is_seen = wide_at_most(zero, zero);
    v->wi = w3_splat(l->axis);
    v->distance = wide_splat((double)INFINITY);
    v->sine = wide_splat(l->sine);
    v->solid_angle_sr = wide_splat((double)l->solid_angle_sr);
    v->factor = wide_splat(1.0);
}

static inline void light_see_wide(const light *l, wide3 position, wide_view *v)
{
    if (l->kind == SCENE_LIGHT_DIRECTIONAL) {
        see_sun(l, v);
        return;
    }
    const wide zero = wide_splat(0.0), one = wide_splat(1.0);
    const wide3 towards = w3_sub(w3_splat(l->position), position);
    const wide length = w3_length(towards);
    v->is_seen = wide_less(zero, length);
    v->distance = wide_choose(v->is_seen, length, one); /* in the light itself nothing is divided by nothing */
    v->wi = w3_scale(towards, 1.0 / v->distance);
    if (light_is_area(l)) {
        v->is_seen = v->is_seen & wide_less(zero, w3_dot(towards, w3_splat(l->axis)));
        v->solid_angle_sr = v->sine = zero;
        v->factor = one;
        return;
    }
    /* A sphere of radius r: sin of its angular radius is r / d. Inside it, the cap is held below a hemisphere. */
    const wide sine = wide_smaller(l->radius / v->distance, one);
    v->sine = shape_sine(sine);
    v->solid_angle_sr = clamp_cap(cap_of_sine(sine));
    const wide cone = l->kind == SCENE_LIGHT_SPOT ? spot_factor(l, v->wi) : one;
    v->factor = cone * range_factor(v->distance, l->range) / (v->distance * v->distance);
}

/* See light_pick. */
static inline void light_pick_wide(const light *l, const wide_view *v, wide3 position, const wide u[2],
                                   wide3 *direction, wide *distance)
{
    const bool is_far = l->kind == SCENE_LIGHT_DIRECTIONAL, is_soft = light_is_soft(l);
    wide3 middle = w3_splat(is_far ? l->axis : l->position);
    if (is_soft) {
        const wide3 tangent = w3_any_tangent(v->wi), bitangent = w3_cross(v->wi, tangent);
        const wide zero = wide_splat(0.0);
        wide sine, cosine;
        turn_sine_cosine(u[1], &sine, &cosine);
        if (is_far) {
            const wide height = 1.0 - u[0] * (1.0 - l->cosine); /* even over the cap */
            const wide r = wide_sqrt(wide_larger(1.0 - height * height, zero));
            const wide3 side = w3_mad(w3_scale(tangent, cosine * r), bitangent, sine * r);
            middle = w3_normalize(w3_mad(side, v->wi, height));
        } else {
            /* Even over the disc that faces the point; from within the sphere, its centre. */
            const wide_mask is_outside = wide_less(wide_splat(l->radius), v->distance);
            const wide r = wide_choose(is_outside, l->radius * wide_sqrt(u[0]), zero);
            middle = w3_add(middle, w3_mad(w3_scale(tangent, cosine * r), bitangent, sine * r));
        }
    }
    if (is_far) {
        *direction = middle;
        *distance = wide_splat((double)INFINITY);
        return;
    }
    const wide3 towards = w3_sub(middle, position);
    *distance = w3_length(towards);
    *direction = w3_scale(towards, 1.0 / *distance);
}

#endif
