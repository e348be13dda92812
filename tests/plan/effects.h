/* Scenes that use one effect each, so that it shows when a build has no such effect. */
#ifndef PLAN_EFFECTS_H
#define PLAN_EFFECTS_H

#include "preview/preview.h"

/* effect: by its name in preview/effects.h. Nothing is set where it is none. *s is freed by scene_free. */
bool effects_use(const char *effect, scene *s, preview_options *o);

#endif
