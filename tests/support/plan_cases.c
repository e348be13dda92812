/* Scenes that a plan must keep within its budget. */
#include "plan_cases.h"

#include <math.h>
#include <string.h>

#include "scenes.h"

typedef struct plan_setting {
    const char *name;
    float roughness, facets_per_m2;
    float half_size; /* of the square that the camera sees, m: a pixel is a 12th of it */
    bool coated, tinted, stretched, blocked, from_aside;
    scene_light_kind light;
    int bounces;
    glint_model model; /* 0: as the material asks for */
    float density_variation;
    float lamp_m; /* width of a rectangle; 0: a window of .3 x .2 m */
} plan_setting;

/* Lit facets of a pixel from hundredths to a million: half_size 0.1 m makes pixels of 8 mm. */
static const plan_setting settings[] = {
    { "sparse", 0.5F, 1e5F, 0.1F, .light = SCENE_LIGHT_DIRECTIONAL },
    { "some", 0.7F, 1e8F, 0.1F, .light = SCENE_LIGHT_POINT },
    { "dense", 0.8F, 1e11F, 0.1F, .light = SCENE_LIGHT_POINT },
    { "dense and sharp", 0.2F, 1e9F, 0.1F, .light = SCENE_LIGHT_POINT },
    { "aslant", 0.7F, 1e9F, 0.1F, .from_aside = true, .light = SCENE_LIGHT_POINT },
    { "colors", 0.7F, 3e9F, 0.1F, .tinted = true, .light = SCENE_LIGHT_POINT },
    { "coat", 0.7F, 3e9F, 0.1F, .coated = true, .light = SCENE_LIGHT_POINT },
    { "brushed", 0.6F, 1e9F, 0.1F, .stretched = true, .light = SCENE_LIGHT_POINT },
    { "window", 0.6F, 1e8F, 0.1F, .light = SCENE_LIGHT_RECT },
    { "lamp", 0.6F, 1e8F, 0.1F, .light = SCENE_LIGHT_RECT, .lamp_m = 0.06F },
    { "shadow", 0.7F, 1e9F, 0.1F, .blocked = true, .light = SCENE_LIGHT_POINT },
    { "penumbra", 0.6F, 1e8F, 0.1F, .blocked = true, .light = SCENE_LIGHT_RECT },
    { "bounce", 0.7F, 1e9F, 0.1F, .blocked = true, .light = SCENE_LIGHT_POINT, .bounces = 1 },
    { "dictionary", 0.6F, 1e9F, 0.1F, .light = SCENE_LIGHT_POINT, .model = GLINT_MODEL_DICTIONARY },
    { "uneven", 0.6F, 1e10F, 0.1F, .light = SCENE_LIGHT_POINT, .density_variation = 0.5F },
};
enum { SETTING_COUNT = sizeof settings / sizeof settings[0] };

int plan_case_count(void)
{
    return SETTING_COUNT;
}

const char *plan_case_name(int index)
{
    return settings[index].name;
}

static scene_material material_of(const plan_setting *c)
{
    scene_material m = scenes_flakes(c->roughness, c->facets_per_m2);
    if (c->coated) {
        m.clearcoat = 1.0F;
        m.clearcoat_roughness = 0.3F;
    }
    if (c->tinted)
        m.glint.color_variation = 0.7F;
    if (c->stretched)
        m.anisotropy = 0.6F;
    m.glint.density_variation = c->density_variation;
    return m;
}

static bool is_dictionary(const plan_setting *c)
{
    return c->model == GLINT_MODEL_DICTIONARY || c->density_variation > 0.0F;
}

static void add_light(const plan_setting *c, scene *s)
{
    static const float from[3] = { 0.1F, 0.5F, 0.15F };
    scene_light *const l = scenes_add_light(s, c->light, from, 1.0F);
    /* A dictionary takes lights that show their shape point by point, at a price. */
    l->radius_m = is_dictionary(c) ? 0.02F : 0.05F;
    if (c->light == SCENE_LIGHT_DIRECTIONAL)
        l->angular_diameter_rad = 0.1F;
    l->width_m = c->lamp_m > 0.0F ? c->lamp_m : 0.3F;
    l->height_m = l->width_m / 1.5F;
}

scene plan_case(int index, scene_camera *camera, preview_options *options)
{
    static const preview_sky black = { { 0.0F }, { 0.0F }, { 0.0F } };
    const plan_setting *const c = &settings[index];
    const scene_material m = material_of(c), block = scenes_matte(0.5F);
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 2.0F * c->half_size), NULL, 0);
    if (c->blocked) {
        float place[16];
        scenes_translation(place, 0.03F, 0.03F, 0.0F);
        scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &block), 0.03F, 24, 12), place, 1);
    }
    add_light(c, &s);
    const float eye[3] = { 0.0F, 1.0F, c->from_aside ? 1.5F : 1e-4F }, target[3] = { 0.0F, 0.0F, 0.0F };
    *camera = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, c->half_size);
    *options = (preview_options)PREVIEW_OPTIONS_INIT;
    options->width = options->height = 24;
    options->bounces = c->bounces;
    if (c->model != GLINT_MODEL_SMOOTH)
        options->model = (int)c->model;
    options->camera = camera;
    options->sky = &black;
    return s;
}

static double level_at(const image *i, int pixel)
{
    const float *const p = &i->pixels[(size_t)pixel * (size_t)i->channel_count];
    return ((double)p[0] + (double)p[1] + (double)p[2]) / 3.0;
}

double plan_case_error(const image *a, const image *b)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < a->width * a->height; ++i) {
        const double of_a = level_at(a, i), of_b = level_at(b, i);
        if (!(of_b > 0.0))
            continue;
        sum += (of_a / of_b - 1.0) * (of_a / of_b - 1.0);
        ++count;
    }
    return count > 0 ? sqrt(sum / count) : 0.0;
}
