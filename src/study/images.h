/* The four scenes whose pictures are studied. */
#ifndef STUDY_IMAGES_H
#define STUDY_IMAGES_H

#include <stdbool.h>

#include "scene/report.h"
#include "scene/scene.h"

enum { IMAGES_SPARSE, IMAGES_DENSE, IMAGES_AREA, IMAGES_LAYERED, IMAGES_SCENES };

extern const char *const images_names[IMAGES_SCENES];

/* In memory, with a camera and lights. False: no memory; the scene is then to be freed all the same. */
bool images_make(int which, scene *s, report *r);

#endif
