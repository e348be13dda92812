/* Turns each material of the scene into one or two handles of libglint. */
#include "preview/materials.h"

#include <stdlib.h>

#include "io/example_map.h"
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
    if (g->structure == SCENE_STRUCTURE_EXAMPLE && model != GLINT_MODEL_EXAMPLE)
        report_warning(r,
                       "%s: materials/%d (\"%s\"): glintStructure \"example\" is not rendered by the %s model; flakes "
                       "stand in for the normal map",
                       path, index, name_of(m), glint_model_name(model));
    if (g->structure != SCENE_STRUCTURE_EXAMPLE && model == GLINT_MODEL_EXAMPLE)
        report_warning(r,
                       "%s: materials/%d (\"%s\"): has no glintExampleTexture for the example model; 16 x 16 flat "
                       "facets that follow its roughness stand in",
                       path, index, name_of(m));
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

static bool make_layer(const scene *s, int index, const char *layer, glint_material_options *options,
                       glint_material **out, bool *counts, bool *mapped, report *r)
{
    char message[256] = "";
    float *normals = NULL;
    if (options->model == GLINT_MODEL_EXAMPLE && !example_map_open(s, &s->materials[index], options, &normals, r))
        return false;
    const glint_result result = glint_material_create(options, out, message, sizeof message);
    *counts = (glint_model_features(options->model) & GLINT_FEATURE_DISCRETE) != 0;
    *mapped = normals != NULL;
    free(normals);
    if (result != GLINT_OK)
        return report_error(r, "%s: materials/%d (\"%s\"), %s: %s", s->path != NULL ? s->path : "scene", index,
                            name_of(&s->materials[index]), layer,
                            message[0] != '\0' ? message : glint_result_text(result));
    return true;
}

static bool make_layers(const scene *s, int index, glint_model model, material_layers *out, report *r)
{
    const scene_material *const m = &s->materials[index];
    glint_material_options base = scene_base_options(m, model);
    if (!make_layer(s, index, "base", &base, &out->base, &out->base_counts, &out->base_mapped, r))
        return false;
    if (!(m->clearcoat > 0.0F))
        return true;
    glint_material_options coat = scene_coat_options(m, model);
    return make_layer(s, index, "clear coat", &coat, &out->coat, &out->coat_counts, &out->coat_mapped, r);
}

bool materials_make(const scene *s, int model, materials *out, report *r)
{
    *out = (materials){ .scene = s };
    const size_t count = s->material_count > 0 ? (size_t)s->material_count : 1U;
    out->layers = calloc(count, sizeof *out->layers);
    if (out->layers == NULL)
        return report_error(r, "no memory for %d materials", s->material_count);

    for (int i = 0; i < s->material_count; ++i) {
        const glint_model wanted = model == PREVIEW_MODEL_AUTO ? scene_model_of(&s->materials[i]) : (glint_model)model;
        warn_of_unrendered(s, i, wanted, r);
        if (!make_layers(s, i, wanted, &out->layers[i], r)) {
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
