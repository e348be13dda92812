/* What every way to make a hit ready has in common. */
#ifndef PREVIEW_SHADE_PARTS_H
#define PREVIEW_SHADE_PARTS_H

#include "preview/shade.h"

/* The local frame: z the normal, x as near to `along` as can be. */
void shade_set_frame(shade_layer *layer, vec3 normal, vec3 along, vec3 wo);
/* The second layer of a point is there: what it leaves of the first. */
void shade_begin_coat(shade_point *p);
/* The footprint of a layer, where it counts. */
void shade_place_glints(const shader *s, const hit *h, const hit_step *step, float choice, vec3 wo,
                        scene_glint_layer which, shade_layer *layer);

/* What the library evaluates: NULL is the material's own surface, about which it knows more. */
static inline const glint_surface *shade_surface(const shade_layer *layer)
{
    return layer->is_own ? NULL : &layer->surface;
}

static inline void shade_to_local(const shade_layer *layer, vec3 direction, float local[3])
{
    local[0] = (float)v3_dot(direction, layer->x);
    local[1] = (float)v3_dot(direction, layer->y);
    local[2] = (float)v3_dot(direction, layer->z);
}

/* ---- scatter.c ---- */

void shade_area_to_local(const shade_layer *layer, const shade_area *from, glint_area_light *to);
/* A direction to the light for what the coat leaves of the base, which changes little over it: to its middle, or the
 * nearest above the coat's horizon. */
vec3 shade_towards_area(const shade_point *p, const shade_area *area);
/* Adds to *sum what is seen of *one: of the light from wi that layer i scatters. */
void shade_add_layer(const shade_point *p, int i, vec3 wi, const glint_value *one, glint_value *sum);

/* A layer under a patch of even light: where occlusion is, and with the footprint that a sample stands for. */
typedef struct shade_patch {
    shade_layer layer;
    float density; /* with which the direction is drawn, in both ways together */
    float solid_angle_sr, grown;
} shade_patch;

/* The density of a direction that the light's own distribution gave, see shade_eval_surroundings; 0: it counts for
 * nothing. */
float shade_patch_density(const shade_point *p, int i, const shade_surroundings *s);
void shade_patch_set(const shade_point *p, int i, const shade_surroundings *s, float density, shade_patch *to);
/* Adds to *sum what the patch shows; *one is spent. */
void shade_add_patch(const shade_point *p, int i, vec3 wi, const shade_patch *patch, glint_value *one,
                     glint_value *sum);

/* ---- ways to make a hit ready ---- */

/* shade.c: all that glTF can ask of a surface. */
shade_preparer shade_prepare_any;
/* shade_plain.c: a surface that is the same everywhere, without a coat and with one. */
shade_preparer shade_prepare_plain, shade_prepare_coated;

#endif
