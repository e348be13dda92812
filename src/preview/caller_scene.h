/* The scene that a caller's structs describe. */
#ifndef PREVIEW_CALLER_SCENE_H
#define PREVIEW_CALLER_SCENE_H

#include "preview/glint_preview.h"
#include "preview/preview.h"

/* What of a caller's world is no part of a scene. */
typedef struct caller_world {
    preview_sky sky;
    environment_map map; /* rgb NULL: the sky is what surrounds the scene */
    preview_environment environment;
} caller_world;

/* Copies and checks everything. On failure what there is may be freed with caller_scene_free. */
bool caller_scene_make(const glint_preview_scene_options *o, scene *out, caller_world *world, report *r);
void caller_scene_free(scene *s, caller_world *world);

/* The struct begins with its size; if that is another one: an error that names it. */
bool caller_check_size(const char *name, size_t found, size_t expected, report *r);

/* place: "lights/3". No number of the array may be infinite or none. */
bool caller_check_finite(const char *place, const char *member, const float *values, int count, report *r);

#endif
