/* A caller's lights and what surrounds its scene. */
#ifndef PREVIEW_CALLER_LIGHT_H
#define PREVIEW_CALLER_LIGHT_H

#include "preview/caller_scene.h"

/* Into a scene that has none yet. */
bool caller_lights_copy(const glint_preview_scene_options *o, scene *s, report *r);
/* *to may not move afterwards. */
bool caller_world_copy(const glint_preview_world *from, caller_world *to, report *r);

#endif
