/* What every way to make a hit ready has in common. */
#ifndef PREVIEW_SHADE_PARTS_H
#define PREVIEW_SHADE_PARTS_H

#include "preview/shade.h"

/* The local frame: z the normal, x as near to `along` as can be. */
void shade_set_frame(shade_layer *layer, vec3 normal, vec3 along, vec3 wo);
/* Footprints of the layers that count. */
void shade_place_glints(const shader *s, const hit *h, const hit_step *step, float choice, vec3 wo, shade_point *out);

/* shade.c: all that glTF can ask of a surface. */
shade_preparer shade_prepare_any;
/* shade_plain.c: a surface that is the same everywhere. */
shade_preparer shade_prepare_plain;

#endif
