/* The glTF 2.0 material model (appendix B and the KHR extensions) in the parameters of libglint. */
#include "scene/surface.h"

#include <math.h>
#include <string.h>

/* The least roughness that libglint takes. */
#define ALPHA_MIN 1e-4F
/* KHR_materials_clearcoat: a coat of index 1.5 reflects ((1.5 - 1) / (1.5 + 1))^2 head-on. */
#define COAT_F0 0.04F

static float clampf(float x, float low, float high)
{
    return fminf(fmaxf(x, low), high);
}

static float mixf(float a, float b, float t)
{
    return a + (b - a) * t;
}

static float alpha_of(float roughness)
{
    const float r = clampf(roughness, 0.0F, 1.0F);
    return fmaxf(r * r, ALPHA_MIN);
}

static bool has_glints(const scene_material *m, scene_glint_layer layer)
{
    const scene_glint *const g = scene_layer_glint(m, layer);
    return g != NULL && g->factor > 0.0F;
}

scene_texels scene_texels_of(const scene_material *m)
{
    scene_texels t = { .metallic = m->metallic,
                       .roughness = m->roughness,
                       .specular = m->specular,
                       .anisotropy = m->anisotropy,
                       .clearcoat = m->clearcoat,
                       .clearcoat_roughness = m->clearcoat_roughness,
                       .glint_factor = m->glint.present ? m->glint.factor : 0.0F,
                       .glint_density = m->glint.density,
                       .coat_glint_factor = m->coat_glint.present ? m->coat_glint.factor : 0.0F,
                       .coat_glint_density = m->coat_glint.density };
    for (int i = 0; i < 4; ++i)
        t.base_color[i] = m->base_color[i];
    for (int i = 0; i < 3; ++i) {
        t.specular_color[i] = m->specular_color[i];
        t.glint_color[i] = m->glint.color[i];
        t.coat_glint_color[i] = m->coat_glint.color[i];
    }
    return t;
}

/* Density, discreteness and tint; a layer without glints keeps its colour. */
static void add_glints(const scene_material *m, const scene_texels *t, scene_glint_layer layer, glint_surface *s)
{
    if (!has_glints(m, layer))
        return;
    const bool is_coats = scene_layer_glint(m, layer) == &m->coat_glint;
    const float *const color = is_coats ? t->coat_glint_color : t->glint_color;
    s->facets_per_m2 = fmaxf(is_coats ? t->coat_glint_density : t->glint_density, 0.0F);
    s->discreteness = clampf(is_coats ? t->coat_glint_factor : t->glint_factor, 0.0F, 1.0F);
    for (int i = 0; i < 3; ++i) {
        /* glintColorFactor tints the share of the light that is counted. */
        const float tint = mixf(1.0F, clampf(color[i], 0.0F, 1.0F), s->discreteness);
        s->f0[i] *= tint;
        s->f90[i] *= tint;
    }
}

glint_surface scene_base_surface(const scene_material *m, const scene_texels *t)
{
    const float metallic = clampf(t->metallic, 0.0F, 1.0F);
    const float specular = clampf(t->specular, 0.0F, 1.0F);
    /* KHR_materials_ior: ((1 - ior) / (1 + ior))^2; ior 0 gives 1, a Fresnel term that is 1 everywhere. */
    const float ratio = (1.0F - m->ior) / (1.0F + m->ior);
    const float head_on = ratio * ratio;
    const float alpha = alpha_of(t->roughness);
    const float strength = clampf(t->anisotropy, 0.0F, 1.0F);

    glint_surface s = { .alpha_x = mixf(alpha, 1.0F, strength * strength), .alpha_y = alpha };
    for (int i = 0; i < 3; ++i) {
        const float color = clampf(t->base_color[i], 0.0F, 1.0F);
        const float dielectric = fminf(head_on * t->specular_color[i], 1.0F) * specular;
        s.diffuse[i] = color * (1.0F - metallic);
        s.f0[i] = clampf(mixf(dielectric, color, metallic), 0.0F, 1.0F);
        s.f90[i] = mixf(specular, 1.0F, metallic);
    }
    add_glints(m, t, SCENE_LAYER_BASE, &s);
    return s;
}

glint_surface scene_coat_surface(const scene_material *m, const scene_texels *t)
{
    const float alpha = alpha_of(t->clearcoat_roughness);
    glint_surface s = { .alpha_x = alpha, .alpha_y = alpha };
    for (int i = 0; i < 3; ++i) {
        s.f0[i] = COAT_F0;
        s.f90[i] = 1.0F;
    }
    add_glints(m, t, SCENE_LAYER_CLEARCOAT, &s);
    return s;
}

glint_model scene_model_of(const scene_glint *g)
{
    if (g->structure == SCENE_STRUCTURE_EXAMPLE)
        return GLINT_MODEL_EXAMPLE;
    return g->density_variation > 0.0F ? GLINT_MODEL_DICTIONARY : GLINT_MODEL_COUNTING;
}

void scene_forget_directions(glint_surface *s)
{
    s->alpha_x = s->alpha_y;
}

static glint_material_options layer_options(const scene_material *m, glint_model model, scene_glint_layer layer)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.fresnel = GLINT_FRESNEL_SCHLICK;
    o.model = GLINT_MODEL_SMOOTH;
    if (has_glints(m, layer)) {
        const scene_glint *const g = scene_layer_glint(m, layer);
        o.model = model;
        o.distribution = g->distribution;
        o.facet_alpha = g->facet_roughness * g->facet_roughness;
        o.coverage = g->coverage;
        o.elongation = g->elongation;
        o.density_variation = fminf(g->density_variation, 8.0F); /* glTF sets no upper bound */
        o.color_variation = g->color_variation;
        o.color_count = g->color_count;
        memcpy(o.colors, g->colors, sizeof o.colors);
        /* A bit that no seed of a file has, so that equal seeds are not equal facets. */
        o.seed = layer == SCENE_LAYER_CLEARCOAT && has_glints(m, SCENE_LAYER_BASE) ? g->seed | 0x80000000U : g->seed;
    }
    const scene_texels t = scene_texels_of(m);
    o.surface = layer == SCENE_LAYER_BASE ? scene_base_surface(m, &t) : scene_coat_surface(m, &t);
    if (o.model == GLINT_MODEL_EXAMPLE && scene_layer_glint(m, layer)->structure == SCENE_STRUCTURE_EXAMPLE)
        scene_forget_directions(&o.surface);
    return o;
}

glint_material_options scene_base_options(const scene_material *m, glint_model model)
{
    return layer_options(m, model, SCENE_LAYER_BASE);
}

glint_material_options scene_coat_options(const scene_material *m, glint_model model)
{
    return layer_options(m, model, SCENE_LAYER_CLEARCOAT);
}
