/* Turns each material of the scene into a handle of libglint, layered where there is a clear coat. */
#include "preview/materials.h"

#include <stdlib.h>

#include "io/example_map.h"
#include "preview/preview.h"
#include "scene/surface.h"

static const char *name_of(const scene_material *m)
{
    return m->name != NULL ? m->name : "";
}

static void warn_of_unrendered(const scene *s, int index, const scene_glint *g, glint_model model, report *r)
{
    const scene_material *const m = &s->materials[index];
    const char *const path = s->path != NULL ? s->path : "scene";
    if (g == NULL || !(g->factor > 0.0F))
        return;
    if ((g->color_variation > 0.0F || g->color_count > 0) && !(glint_model_features(model) & GLINT_FEATURE_COLOR))
        report_warning(r, "%s: materials/%d (\"%s\"): %s is not rendered by the %s model; every facet has one colour",
                       path, index, name_of(m), g->color_count > 0 ? "glintColors" : "glintColorVariation",
                       glint_model_name(model));
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
static void warn_of_missing_texcoords(const scene *s, scene_glint_layer layer, report *r)
{
    for (int i = 0; i < s->mesh_count; ++i) {
        const scene_mesh *const mesh = &s->meshes[i];
        const scene_material *const m = &s->materials[mesh->material];
        const scene_glint *const g = scene_layer_glint(m, layer);
        if (g != NULL && g->factor > 0.0F && g->space == SCENE_SPACE_UV && mesh->texcoord[g->texcoord] == NULL)
            report_warning(r,
                           "%s: %s: no TEXCOORD_%d, which the glints of material \"%s\" use; they are laid out in the "
                           "object's space instead",
                           s->path != NULL ? s->path : "scene", mesh->name != NULL ? mesh->name : "a mesh", g->texcoord,
                           name_of(m));
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

/* One layer before its material is made. The normals are what options.example.normals points to. */
typedef struct layer_plan {
    glint_material_options options;
    float *normals;
} layer_plan;

glint_model materials_model(const scene *s, int index, scene_glint_layer layer, int model)
{
    const scene_glint *const g = scene_layer_glint(&s->materials[index], layer);
    if (model != PREVIEW_MODEL_AUTO)
        return (glint_model)model;
    return g != NULL ? scene_model_of(g) : GLINT_MODEL_SMOOTH;
}

static bool plan_layer(const scene *s, int index, scene_glint_layer layer, const preview_options *o,
                       const glint_plan *plan, layer_plan *out, report *r)
{
    const scene_material *const m = &s->materials[index];
    const scene_glint *const g = scene_layer_glint(m, layer);
    const glint_model wanted = materials_model(s, index, layer, o->model);
    if (plan == NULL)
        warn_of_unrendered(s, index, g, wanted, r);
    out->options = layer == SCENE_LAYER_BASE ? scene_base_options(m, wanted) : scene_coat_options(m, wanted);
    choose_facets(o->facets, &out->options);
    /* A survey looks with the fit: that is near enough for a plan. */
    out->options.area_light_method = o->accuracy > 0.0 ? GLINT_AREA_LIGHT_FAST : o->area_lights;
    if (plan != NULL)
        glint_plan_cut(plan, (uint32_t)index, &out->options);
    return out->options.model != GLINT_MODEL_EXAMPLE || example_map_open(s, g, &out->options, &out->normals, r);
}

static bool shows_facets(const glint_material *layer)
{
    return (glint_material_features(layer) & GLINT_FEATURE_DISCRETE) != 0;
}

static bool make(const scene *s, int index, const glint_material_options *options, material_layers *out, report *r)
{
    char message[256] = "";
    const glint_result result = glint_material_create(options, &out->whole, message, sizeof message);
    if (result != GLINT_OK)
        return report_error(r, "%s: materials/%d (\"%s\"): %s", s->path != NULL ? s->path : "scene", index,
                            name_of(&s->materials[index]), message[0] != '\0' ? message : glint_result_text(result));
    out->coat = glint_material_layer(out->whole, GLINT_LAYER_COAT);
    out->base = out->coat != NULL ? glint_material_layer(out->whole, GLINT_LAYER_BASE) : out->whole;
    out->base_counts = shows_facets(out->base);
    out->coat_counts = out->coat != NULL && shows_facets(out->coat);
    return true;
}

static bool make_layers(const scene *s, int index, const preview_options *o, const glint_plan *plan,
                        material_layers *out, report *r)
{
    const bool is_coated = s->materials[index].clearcoat > 0.0F;
    layer_plan base = { 0 }, coat = { 0 };
    bool done = plan_layer(s, index, SCENE_LAYER_BASE, o, plan, &base, r) &&
                (!is_coated || plan_layer(s, index, SCENE_LAYER_CLEARCOAT, o, plan, &coat, r));
    if (done && is_coated) {
        glint_material_options whole = GLINT_MATERIAL_OPTIONS_INIT;
        whole.model = GLINT_MODEL_LAYERED;
        whole.layers.base = &base.options;
        whole.layers.coat = &coat.options;
        done = make(s, index, &whole, out, r);
    } else if (done) {
        done = make(s, index, &base.options, out, r);
    }
    out->draws = base.options.draw_deviation > 0.0F || coat.options.draw_deviation > 0.0F;
    out->base_mapped = base.normals != NULL;
    out->coat_mapped = coat.normals != NULL;
    free(base.normals);
    free(coat.normals);
    return done;
}

bool materials_make(const scene *s, const preview_options *o, const glint_plan *plan, materials *out, report *r)
{
    *out = (materials){ .scene = s, .facets = o->facets };
    const size_t count = s->material_count > 0 ? (size_t)s->material_count : 1U;
    out->layers = calloc(count, sizeof *out->layers);
    if (out->layers == NULL)
        return report_error(r, "no memory for %d materials", s->material_count);

    for (int i = 0; i < s->material_count; ++i) {
        if (!make_layers(s, i, o, plan, &out->layers[i], r)) {
            materials_free(out);
            return false;
        }
    }
    if (plan == NULL) {
        warn_of_missing_texcoords(s, SCENE_LAYER_BASE, r);
        warn_of_missing_texcoords(s, SCENE_LAYER_CLEARCOAT, r);
    }
    return true;
}

void materials_free(materials *m)
{
    for (int i = 0; m->layers != NULL && i < m->scene->material_count; ++i)
        glint_material_destroy(m->layers[i].whole);
    free(m->layers);
    *m = (materials){ 0 };
}
