/* The scene that a caller's structs describe, part by part. */
#ifndef PREVIEW_CALLER_SCENE_H
#define PREVIEW_CALLER_SCENE_H

#include "preview/caller_warnings.h"
#include "preview/glint_preview.h"
#include "preview/preview.h"

/* What of a caller's world is no part of a scene. */
typedef struct caller_world {
    preview_sky sky;
    environment_map map; /* rgb NULL: the sky is what surrounds the scene */
    preview_environment environment;
} caller_world;

typedef struct caller_scene {
    scene scene;
    caller_world world;
    caller_warnings warnings;
} caller_scene;

/* All glint_preview_parts. */
#define CALLER_LOOKS (GLINT_PREVIEW_MATERIALS | GLINT_PREVIEW_IMAGES | GLINT_PREVIEW_LIGHTS | GLINT_PREVIEW_WORLD)

/* Copies and checks everything. r must keep warnings in c. On failure what there is may be freed with
 * caller_scene_free. c may not move afterwards. */
bool caller_scene_make(const glint_preview_scene_options *o, caller_scene *c, report *r);
/* The same of some glint_preview_parts, without meshes. Materials without the images have those of the scene. */
bool caller_scene_make_parts(const glint_preview_scene_options *o, int parts, const scene *images_of, caller_scene *c,
                             report *r);
/* Exchanges those parts, warnings apart, between two scenes. */
void caller_scene_swap(caller_scene *a, caller_scene *b, int parts);
/* Whether the meshes of a scene, and what rays pass of them, would be the same with the materials of another. */
bool caller_scene_same_meshes(const scene *a, const scene *b);
void caller_scene_free(caller_scene *c);

/* The struct begins with its size; if that is another one: an error that names it. */
bool caller_check_size(const char *name, size_t found, size_t expected, report *r);

bool caller_check_array(const char *name, const void *array, size_t count, report *r);

/* place: "lights/3". No number of the array may be infinite or none. */
bool caller_check_finite(const char *place, const char *member, const float *values, int count, report *r);

#endif
