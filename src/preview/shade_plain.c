/* Surfaces that are the same everywhere: without textures, vertex colours and turned highlights nothing is looked up at
 * a hit, and all that it needs is known before the first ray. */
#include <stdlib.h>

#include "preview/place.h"
#include "preview/shade_parts.h"
#include "scene/surface.h"

struct shade_constant {
    shade_preparer *prepare;
    glint_surface surface, coat;
    float clearcoat;
    float emission[3], albedo[3], opacity;
    bool wants_choice; /* facets on the planes of the object's axes: one of them is chosen at random */
};

static bool has_textures(const scene_material *m)
{
    const scene_texture *list[SCENE_MATERIAL_TEXTURES];
    scene_material_textures(m, list);
    for (int i = 0; i < SCENE_MATERIAL_TEXTURES; ++i) {
        const bool is_example = list[i] == &m->glint.example_texture || list[i] == &m->coat_glint.example_texture;
        if (list[i]->image != SCENE_NONE && !is_example)
            return true;
    }
    return false;
}

static bool has_vertex_colors(const scene *s, int material)
{
    for (int i = 0; i < s->mesh_count; ++i)
        if (s->meshes[i].material == material && s->meshes[i].color != NULL)
            return true;
    return false;
}

static bool is_on_planes(const scene *s, int material, const scene_glint *g)
{
    if (g == NULL)
        return false;
    for (int i = 0; i < s->mesh_count; ++i)
        if (s->meshes[i].material == material && !place_is_in_texture_space(g, &s->meshes[i]))
            return true;
    return false;
}

static bool has_planes(const scene *s, int material)
{
    const scene_material *const m = &s->materials[material];
    return is_on_planes(s, material, scene_layer_glint(m, SCENE_LAYER_BASE)) ||
           is_on_planes(s, material, scene_layer_glint(m, SCENE_LAYER_CLEARCOAT));
}

static bool is_plain(const scene *s, int material)
{
    const scene_material *const m = &s->materials[material];
    return !m->unlit && m->anisotropy_rotation == 0.0F && !has_textures(m) && !has_vertex_colors(s, material);
}

static struct shade_constant constant_of(const scene_material *m)
{
    const scene_texels t = scene_texels_of(m);
    const bool is_coated = EFFECT_COATS && m->clearcoat > 0.0F;
    struct shade_constant c = { .prepare = is_coated ? shade_prepare_coated : shade_prepare_plain,
                                .surface = scene_base_surface(m, &t),
                                .coat = scene_coat_surface(m, &t),
                                .clearcoat = fminf(m->clearcoat, 1.0F),
                                .opacity = m->alpha_mode == SCENE_ALPHA_BLEND ? fminf(t.base_color[3], 1.0F) : 1.0F };
    for (int i = 0; i < 3; ++i) {
        c.emission[i] = m->emissive[i];
        c.albedo[i] = t.base_color[i];
    }
    return c;
}

bool shader_open(shader *s, report *r)
{
    const size_t count = (size_t)s->scene->material_count + 1U;
    struct shade_constant *const made = calloc(count, sizeof *made);
    if (made == NULL)
        return report_error(r, "no memory for %d materials", s->scene->material_count);
    for (int i = 0; i < s->scene->material_count; ++i) {
        made[i].prepare = shade_prepare_any;
        if (is_plain(s->scene, i))
            made[i] = constant_of(&s->scene->materials[i]);
        made[i].wants_choice = has_planes(s->scene, i);
    }
    s->constants = made;
    return true;
}

void shader_close(shader *s)
{
    free(s->constants);
    s->constants = NULL;
}

bool shade_wants_choice(const shader *s, const hit *h)
{
    return EFFECT_FACET_PLANES && s->constants[h->mesh->material].wants_choice;
}

void shade_prepare(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice, shade_point *out)
{
    s->constants[h->mesh->material].prepare(s, h, step, wo, choice, out);
}

void shade_prepare_plain(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice, shade_point *out)
{
    const struct shade_constant *const c = &s->constants[h->mesh->material];
    const material_layers *const handles = &s->materials->layers[h->mesh->material];
    out->layer_count = 1;
    out->counts = handles->base_counts;
    out->draws = handles->draws;
    out->whole = handles->whole;
    out->occlusion = 1.0F;
    out->opacity = c->opacity;
    for (int i = 0; i < 3; ++i) {
        out->emission[i] = c->emission[i];
        out->albedo[i] = c->albedo[i];
    }
    shade_layer *const base = &out->layers[0];
    base->material = handles->base;
    base->counts = handles->base_counts;
    base->mapped = handles->base_mapped;
    base->is_own = !handles->base_mapped;
    base->surface = c->surface;
    base->weight = 1.0F;
    shade_set_frame(base, h->normal, h->tangent, wo);
    if (EFFECT_FACETS && out->counts)
        shade_place_glints(s, h, step, choice, wo, SCENE_LAYER_BASE, base);
}

void shade_prepare_coated(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice, shade_point *out)
{
    const struct shade_constant *const c = &s->constants[h->mesh->material];
    const material_layers *const handles = &s->materials->layers[h->mesh->material];
    shade_prepare_plain(s, h, step, wo, choice, out);
    shade_layer *const coat = &out->layers[1];
    coat->material = handles->coat;
    coat->counts = handles->coat_counts;
    coat->mapped = handles->coat_mapped;
    coat->is_own = !handles->coat_mapped;
    coat->surface = c->coat;
    coat->weight = c->clearcoat;
    const shade_layer *const base = &out->layers[0];
    coat->x = base->x;
    coat->y = base->y;
    coat->z = base->z;
    for (int i = 0; i < 3; ++i)
        coat->wo[i] = base->wo[i];
    if (base->mapped) /* which has turned the frame */
        shade_set_frame(coat, h->normal, h->tangent, wo);
    shade_begin_coat(out);
    if (EFFECT_FACETS && coat->counts)
        shade_place_glints(s, h, step, choice, wo, SCENE_LAYER_CLEARCOAT, coat);
}
