/* The library's materials for every layer of a scene's materials, made once before the first ray. */
#ifndef PREVIEW_MATERIALS_H
#define PREVIEW_MATERIALS_H

#include "scene/report.h"
#include "scene/scene.h"

typedef struct material_layers {
    glint_material *whole;         /* layered where the material has a clear coat */
    const glint_material *base;    /* of whole, or the same */
    const glint_material *coat;    /* of whole; NULL: there is no clear coat */
    bool base_counts, coat_counts; /* single facets show: the layer wants a footprint */
} material_layers;

typedef struct materials {
    const scene *scene;
    material_layers *layers; /* scene->material_count */
} materials;

/* model: a glint_model, or PREVIEW_MODEL_AUTO: counting wherever the file asks for glints. Warns of what a material
 * asks for and no model of this version renders. */
bool materials_make(const scene *s, int model, materials *out, report *r);
void materials_free(materials *m);

#endif
