/* The library's materials for every layer of a scene's materials, made once before the first ray. */
#ifndef PREVIEW_MATERIALS_H
#define PREVIEW_MATERIALS_H

#include "preview/preview.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef struct material_layers {
    glint_material *base;
    glint_material *coat;          /* NULL: the material has no clear coat */
    bool base_counts, coat_counts; /* single facets show: the layer wants a footprint */
} material_layers;

typedef struct materials {
    const scene *scene;
    preview_facets facets;
    material_layers *layers; /* scene->material_count */
} materials;

/* model: a glint_model, or PREVIEW_MODEL_AUTO: counting wherever the file asks for glints. Warns of what a material
 * asks for and no model of this version renders. */
bool materials_make(const scene *s, int model, preview_facets facets, materials *out, report *r);
void materials_free(materials *m);

#endif
