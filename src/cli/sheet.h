/* A preset's properties, told once and shown twice: as lines for people or as keys of a JSON object. */
#ifndef CLI_SHEET_H
#define CLI_SHEET_H

#include "cli/document.h"
#include "scene/scene.h"

/* Adds every property that the material uses, with its unit. object NULL: prints lines to standard output. */
void sheet_show(const scene_material *m, document *object);

#endif
