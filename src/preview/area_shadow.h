/* What of a light as a shape reaches a point: its shape as the point sees it, and a shadow ray. */
#ifndef PREVIEW_AREA_SHADOW_H
#define PREVIEW_AREA_SHADOW_H

#include "preview/integrator.h"
#include "preview/sampler.h"

/* The light is evaluated whole, without noise; shadow rays find the share of its effect that something hides.
 * dimension: of the light, see add_direct_light. thorough: four or five rays, for what the camera sees; else one, for
 * what only bounces see. False: the light lies below the horizon, or is hidden. */
bool area_light_reaches(const world *w, const hit *h, const shade_point *p, const light *l, const light_view *view,
                        const sampler *random, uint32_t dimension, bool thorough, shade_area *area, ray_counts *counts);

#endif
