/* Turns each material of the scene into one or two handles of libglint. */
#include "preview/materials.h"

#include <stdlib.h>

#include "preview/preview.h"
#include "scene/surface.h"

static const char *name_of(const scene_material *m)
{
    return m->name != NULL ? m->name : "";
}

static void warn_of_unrendered(const scene *s, int index, glint_model model, report *r)
{
    const scene_material *const m = &s->materials[index];
    const scene_glint *const g = &m->glint;
    const char *const path = s->path != NULL ? s->path : "scene";
    if (!g->present || !(g->factor > 0.0F))
        return;
    if (g->color_variation > 0.0F && !(glint_model_features(model) & GLINT_FEATURE_COLOR))
        report_warning(r,
                       "%s: materials/%d (\"%s\"): glintColorVariation %g is not rendered by the %s model; every facet "
                       "has one colour",
                       path, index, name_of(m), (double)g->color_variation, glint_model_name(model));
    if (g->density_variation > 0.0F && model != GLINT_MODEL_DICTIONARY)
        report_warning(
            r,
            "%s: materials/%d (\"%s\"): glintDensityVariation %g is not rendered by the %s model; the density is even",
            path, index, name_of(m), (double)g->density_variation, glint_model_name(model));
    if (g->structure == SCENE_STRUCTURE_EXAMPLE)
        report_warning(r, "%s: materials/%d (\"%s\"): glintStructure \"example\" is rendered as \"flakes\"", path,
                       index, name_of(m));
}

/* Glints that are laid out by texture coordinates need some. */
static void warn_of_missing_texcoords(const scene *s, report *r)
{
    for (int i = 0; i < s->mesh_count; ++i) {
        const scene_mesh *const mesh = &s->meshes[i];
        const scene_glint *const g = &s->materials[mesh->material].glint;
        if (g->present && g->factor > 0.0F && g->space == SCENE_SPACE_UV && mesh->texcoord[g->texcoord] == NULL)
            report_warning(r,
                           "%s: %s: no TEXCOORD_%d, which the glints of material \"%s\" use; they are laid out in the "
                           "object's space instead",
                           s->path != NULL ? s->path : "scene", mesh->name != NULL ? mesh->name : "a mesh", g->texcoord,
                           name_of(&s->materials[mesh->material]));
    }
}

/* Those of another renderer: its hash of the cells of a flat grid. */
static void choose_facets(preview_facets facets, glint_material_options *o)
{
    if (facets == PREVIEW_FACETS_OWN)
        return;
    o->weighting = GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
    o->facet_hash = facets == PREVIEW_FACETS_POVRAY ? GLINT_FACET_HASH_POVRAY : GLINT_FACET_HASH_CYCLES;
}

static bool make_layer(const scene *s, int index, const char *layer, const glint_material_options *options,
                       glint_material **out, bool *counts, report *r)
{
    char message[256] = "";
    const glint_result result = glint_material_create(options, out, message, sizeof message);
    if (result != GLINT_OK)
        return report_error(r, "%s: materials/%d (\"%s\"), %s: %s", s->path != NULL ? s->path : "scene", index,
                            name_of(&s->materials[index]), layer,
                            message[0] != '\0' ? message : glint_result_text(result));
    *counts = (glint_model_features(options->model) & GLINT_FEATURE_DISCRETE) != 0;
    return true;
}

static bool make_layers(const scene *s, int index, glint_model model, preview_facets facets, material_layers *out,
                        report *r)
{
    const scene_material *const m = &s->materials[index];
    glint_material_options base = scene_base_options(m, model);
    choose_facets(facets, &base);
    if (!make_layer(s, index, "base", &base, &out->base, &out->base_counts, r))
        return false;
    if (!(m->clearcoat > 0.0F))
        return true;
    glint_material_options coat = scene_coat_options(m, model);
    choose_facets(facets, &coat);
    return make_layer(s, index, "clear coat", &coat, &out->coat, &out->coat_counts, r);
}

bool materials_make(const scene *s, int model, preview_facets facets, materials *out, report *r)
{
    *out = (materials){ .scene = s, .facets = facets };
    const size_t count = s->material_count > 0 ? (size_t)s->material_count : 1U;
    out->layers = calloc(count, sizeof *out->layers);
    if (out->layers == NULL)
        return report_error(r, "no memory for %d materials", s->material_count);

    const glint_model wanted = model == PREVIEW_MODEL_AUTO ? GLINT_MODEL_COUNTING : (glint_model)model;
    for (int i = 0; i < s->material_count; ++i) {
        warn_of_unrendered(s, i, wanted, r);
        if (!make_layers(s, i, wanted, facets, &out->layers[i], r)) {
            materials_free(out);
            return false;
        }
    }
    warn_of_missing_texcoords(s, r);
    return true;
}

void materials_free(materials *m)
{
    for (int i = 0; m->layers != NULL && i < m->scene->material_count; ++i) {
        glint_material_destroy(m->layers[i].base);
        glint_material_destroy(m->layers[i].coat);
    }
    free(m->layers);
    *m = (materials){ 0 };
}
