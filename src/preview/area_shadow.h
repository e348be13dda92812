/* What of a light as a shape reaches a point: its shape as the point sees it, and what hides a part of it. */
#ifndef PREVIEW_AREA_SHADOW_H
#define PREVIEW_AREA_SHADOW_H

#include "preview/integrator.h"
#include "preview/sampler.h"

/* Even over the light, on a grid of 2 x 2; and by a surface that is not rough, whose lobe may fall between them. */
#define AREA_SPREAD 4
#define AREA_REFLECTED 3
enum { AREA_MOST_RAYS = AREA_SPREAD + AREA_REFLECTED };

/* A light as a point sees it, and the shadow rays that it waits for. */
typedef struct area_shadow {
    const light *light;
    light_view view;
    bool is_clear; /* nothing can hide it */
    int ray_count;
    bool is_shared; /* the rays stand for a share of the light each; else one for all */
    bool is_sharp;  /* some of them were reflected */
} area_shadow;

/* The light is evaluated whole, without noise; shadow rays find the share of its effect that something hides. light and
 * view of *s are set. dimension: of the light, see add_direct_light. thorough: four to seven rays, for what the camera
 * sees; else one, for what only bounces see. rays: room for AREA_MOST_RAYS; they begin where the first does, which
 * leads to a place of the light where that is round. False: the light lies below the horizon. */
bool area_shadow_begin(const hit *h, const shade_point *p, const sampler *random, uint32_t dimension, bool thorough,
                       area_shadow *s, trace_ray *rays, shade_area *area);

/* dark: which of the rays met something. False: all of it is hidden. */
bool area_shadow_end(const area_shadow *s, const shade_point *p, const trace_ray *rays, const bool *dark,
                     shade_area *area);

#endif
