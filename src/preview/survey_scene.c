/* What of a survey is known before any pixel is looked at: the materials and the lights. */
#include <stdio.h>
#include <stdlib.h>

#include "preview/survey.h"
#include "scene/surface.h"

static uint32_t count_textures(const scene_material *m, uint32_t *normal_maps)
{
    const scene_texture *list[SCENE_MATERIAL_TEXTURES];
    uint32_t count = 0;
    scene_material_textures(m, list);
    for (int i = 0; i < SCENE_MATERIAL_TEXTURES; ++i) {
        const bool is_normal = list[i] == &m->normal_texture || list[i] == &m->clearcoat_normal_texture;
        const bool is_example = list[i] == &m->glint.example_texture || list[i] == &m->coat_glint.example_texture;
        if (list[i]->image == SCENE_NONE || is_example)
            continue;
        *normal_maps += is_normal;
        count += !is_normal;
    }
    return count;
}

static void begin_materials(survey *out, const scene *s, const preview_options *o)
{
    for (int i = 0; i < s->material_count; ++i) {
        const scene_material *const from = &s->materials[i];
        glint_material_options *const base = &out->options[2 * i], *const coat = base + 1;
        *base = scene_base_options(from, materials_model(s, i, SCENE_LAYER_BASE, o->model));
        *coat = scene_coat_options(from, materials_model(s, i, SCENE_LAYER_CLEARCOAT, o->model));
        glint_plan_material *const m = &out->materials[i];
        *m = (glint_plan_material){ .name = from->name,
                                    .base = base,
                                    .coat = from->clearcoat > 0.0F ? coat : NULL,
                                    .is_cut_out = from->alpha_mode != SCENE_ALPHA_OPAQUE };
        m->texture_count = count_textures(from, &m->normal_map_count);
        m->alpha.least = m->facets_per_m2.least = m->footprint_m2.least = HUGE_VALF;
    }
}

static void begin_lights(survey *out, const world *w)
{
    const scene *const s = w->shader.scene;
    for (int i = 0; i < w->light_count; ++i) {
        char *const name = out->light_names[i].text;
        const size_t size = sizeof out->light_names[i].text;
        if (i < s->light_count && s->lights[i].name != NULL && s->lights[i].name[0] != '\0')
            snprintf(name, size, "light '%s'", s->lights[i].name);
        else
            snprintf(name, size, "light %d", i);
        out->lights[i] =
            (glint_plan_light){ .name = name,
                                .kind = light_is_area(&w->lights[i]) ? GLINT_PLAN_LIGHT_SHAPE : GLINT_PLAN_LIGHT_CAP };
    }
}

bool survey_has_surroundings(const world *w)
{
    return w->environment != NULL || w->emitters != NULL;
}

static void begin_surroundings(survey *out, const world *w)
{
    if (!survey_has_surroundings(w))
        return;
    survey_name *const name = &out->light_names[w->light_count];
    snprintf(name->text, sizeof name->text, "%s", w->environment != NULL ? "the environment" : "what glows");
    out->lights[w->light_count] =
        (glint_plan_light){ .name = name->text,
                            .kind = GLINT_PLAN_LIGHT_SURROUNDINGS,
                            .patch_count = w->environment != NULL ? (uint32_t)w->environment->patch_count
                                                                  : (uint32_t)w->emitters->count };
}

bool survey_begin(survey *out, const world *w, const preview_options *o, int light_count, size_t most_pairs, report *r)
{
    const scene *const s = w->shader.scene;
    const size_t material_count = (size_t)s->material_count + 1U, lights = (size_t)light_count + 1U;
    *out = (survey){ .summary = GLINT_PLAN_SUMMARY_INIT };
    out->options = calloc(2 * material_count, sizeof *out->options);
    out->materials = calloc(material_count, sizeof *out->materials);
    out->lights = calloc(lights, sizeof *out->lights);
    out->light_names = calloc(lights, sizeof *out->light_names);
    out->pairs = calloc(most_pairs, sizeof *out->pairs);
    out->sparks = calloc(most_pairs * GLINT_PLAN_SHAPES, sizeof *out->sparks);
    out->pair_of = calloc(material_count * lights, sizeof *out->pair_of);
    if (out->options == NULL || out->materials == NULL || out->lights == NULL || out->light_names == NULL ||
        out->pairs == NULL || out->sparks == NULL || out->pair_of == NULL) {
        survey_free(out);
        return report_error(r, "no memory to look at %zu materials under %zu lights", material_count, lights);
    }
    begin_materials(out, s, o);
    begin_lights(out, w);
    begin_surroundings(out, w);
    return true;
}

void survey_free(survey *s)
{
    free(s->options);
    free(s->materials);
    free(s->lights);
    free(s->light_names);
    free(s->pairs);
    free(s->sparks);
    free(s->pair_of);
    *s = (survey){ 0 };
}
