/* A metal floor under two lights, and what the effect needs beside it. */
#include "effects.h"

#include <string.h>

#include "scenes.h"

enum { TEXELS = 8 };

/* Texels that differ in every channel, tiled. */
static scene_texture checks(scene *s)
{
    uint8_t rgba[TEXELS * TEXELS][4];
    for (int i = 0; i < TEXELS * TEXELS; ++i) {
        const int x = i % TEXELS, y = i / TEXELS;
        rgba[i][0] = (uint8_t)(100 + 20 * ((x + 3 * y) % 7));
        rgba[i][1] = (uint8_t)(100 + 20 * ((3 * x + y) % 7));
        rgba[i][2] = (uint8_t)(200 + 10 * ((x + y) % 5));
        rgba[i][3] = 255;
    }
    scene_texture t = scenes_add_texture(s, rgba[0], TEXELS, TEXELS);
    t.scale[0] = t.scale[1] = 9.0F;
    return t;
}

/* Small enough to see what is around it. */
static void add_floor(scene *s, const scene_material *m)
{
    scenes_add_instance(s, scenes_add_square(s, scenes_add_material(s, m), 0.08F), NULL, 0);
}

static void add_wall_that_glows(scene *s)
{
    scene_material glow = scenes_matte(0.5F);
    float place[16];
    glow.emissive[0] = glow.emissive[1] = glow.emissive[2] = 3.0F;
    glow.double_sided = true;
    scenes_translation(place, 0.1F, 0.2F, -0.1F);
    scenes_add_instance(s, scenes_add_square(s, scenes_add_material(s, &glow), 0.05F), place, 1);
}

static void add_lights(scene *s, scene_light_kind kind, int count, float radius)
{
    for (int i = 0; i < count; ++i) {
        const float from[3] = { 0.2F - 0.7F * (float)(i % 2) + 0.01F * (float)i, 1.0F, 0.3F - 0.2F * (float)(i % 2) };
        scene_light *const l = scenes_add_light(s, kind, from, 1.0F);
        l->radius_m = radius;
        l->width_m = l->height_m = 0.5F;
    }
}

static void set_material(const char *effect, scene *s, scene_material *m)
{
    if (strcmp(effect, "EFFECT_TEXTURES") == 0)
        m->base_color_texture = checks(s);
    if (strcmp(effect, "EFFECT_NORMAL_MAPS") == 0)
        m->normal_texture = checks(s);
    if (strcmp(effect, "EFFECT_COATS") == 0)
        m->clearcoat = 0.7F;
    if (strcmp(effect, "EFFECT_ALPHA") == 0) {
        m->alpha_mode = SCENE_ALPHA_BLEND;
        m->base_color[3] = 0.4F;
    }
    if (strcmp(effect, "EFFECT_EMISSION") == 0)
        m->emissive[1] = 1.0F;
    if (strcmp(effect, "EFFECT_ROUND_SHAPES") == 0)
        m->roughness = 0.2F;
    if (strcmp(effect, "EFFECT_FACET_LIMIT") == 0)
        m->glint.density = 1e14F;
    if (strcmp(effect, "EFFECT_FACET_PLANES") == 0 || strcmp(effect, "EFFECT_EXAMPLES") == 0)
        m->glint.space = SCENE_SPACE_OBJECT;
    if (strcmp(effect, "EFFECT_EXAMPLES") == 0) {
        m->glint.structure = SCENE_STRUCTURE_EXAMPLE;
        m->glint.example_texture = checks(s);
        m->glint.example_size = 0.01F;
    }
}

static void set_options(const char *effect, preview_options *o)
{
    static const preview_sky sky = { { 1.0F, 1.0F, 1.0F }, { 0.5F, 0.5F, 0.5F }, { 0.1F, 0.1F, 0.1F } };
    o->aov = strcmp(effect, "EFFECT_DESCRIPTION") == 0;
    if (strcmp(effect, "EFFECT_BOUNCES") == 0 || strcmp(effect, "EFFECT_EMITTERS") == 0)
        o->bounces = 1;
    if (strcmp(effect, "EFFECT_ENVIRONMENT") == 0)
        o->sky = &sky;
    if (strcmp(effect, "EFFECT_FACET_LIMIT") == 0)
        o->model = GLINT_MODEL_EXPLICIT;
    if (strcmp(effect, "EFFECT_FACETS_OF_OTHERS") == 0)
        o->facets = PREVIEW_FACETS_CYCLES;
    if (strcmp(effect, "EFFECT_DRAWS") == 0) {
        o->accuracy = 0.2;
        o->spp = 1024;
    }
}

bool effects_use(const char *effect, scene *s, preview_options *o)
{
    if (strncmp(effect, "EFFECT_", 7) != 0)
        return false;
    const bool glows = strcmp(effect, "EFFECT_BOUNCES") == 0 || strcmp(effect, "EFFECT_EMITTERS") == 0;
    const bool is_flat = strcmp(effect, "EFFECT_FLAT_LIGHTS") == 0;
    const bool is_many = strcmp(effect, "EFFECT_MANY_LIGHTS") == 0;
    const bool is_round = strcmp(effect, "EFFECT_ROUND_SHAPES") == 0;
    const bool has_facets = strstr(effect, "FACET") != NULL || strstr(effect, "EXAMPLE") != NULL;
    const bool is_drawn = strcmp(effect, "EFFECT_DRAWS") == 0;
    scene_material m = has_facets || is_drawn ? scenes_flakes(0.6F, is_drawn ? 1e8F : 1e7F) : scenes_matte(0.5F);
    m.metallic = 1.0F;
    *s = scenes_empty();
    set_material(effect, s, &m);
    add_floor(s, &m);
    if (glows)
        add_wall_that_glows(s);
    add_lights(s, is_flat ? SCENE_LIGHT_RECT : SCENE_LIGHT_POINT, is_many ? 20 : 2, is_round ? 0.3F : 0.02F);
    set_options(effect, o);
    return true;
}
