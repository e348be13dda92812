/* What a camera looks at, and how large it is: where lights that suit any scene are put. */
#ifndef PREVIEW_SUBJECT_H
#define PREVIEW_SUBJECT_H

#include "preview/vector.h"
#include "scene/scene.h"

typedef struct subject {
    vec3 middle;
    double radius; /* half the height of the picture there; > 0 */
} subject;

subject subject_of(const scene *s, const scene_camera *view);

#endif
