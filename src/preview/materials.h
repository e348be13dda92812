/* The library's materials for every layer of a scene's materials, made once before the first ray. */
#ifndef PREVIEW_MATERIALS_H
#define PREVIEW_MATERIALS_H

#include "preview/preview.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef struct material_layers {
    glint_material *whole;         /* layered where the material has a clear coat */
    const glint_material *base;    /* of whole, or the same */
    const glint_material *coat;    /* of whole; NULL: there is no clear coat */
    bool base_counts, coat_counts; /* single facets show: the layer wants a footprint */
    bool draws;                    /* of their realisations one may be drawn for a sample */
    bool base_mapped, coat_mapped; /* a normal map shows: the layer wants a frame along u and v */
} material_layers;

typedef struct materials {
    const scene *scene;
    preview_facets facets;
    material_layers *layers; /* scene->material_count */
} materials;

/* Of the options count model, facets and area_lights; PREVIEW_MODEL_AUTO: for each material the model that shows what
 * it asks for, see scene_model_of. plan: what is left out; NULL: all is as the scene asks, and warnings say what a
 * material asks for and its model does not render. */
bool materials_make(const scene *s, const preview_options *o, const glint_plan *plan, materials *out, report *r);
void materials_free(materials *m);

/* The model that a layer of a material gets without a plan. */
glint_model materials_model(const scene *s, int index, scene_glint_layer layer, int model);

#endif
