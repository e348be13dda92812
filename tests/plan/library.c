/* A few points of one material, and what the effect needs. */
#include <string.h>

#include "glint.h"
#include "library.h"

enum { COUNT = 32 };

/* The points and their light. */
typedef struct points {
    double u[COUNT], v[COUNT];
    float side[COUNT], none[COUNT], wo[3][COUNT], wi[3][COUNT], solid_angle_sr[COUNT];
    uint32_t draw[COUNT];
    glint_surface surfaces[COUNT];
    glint_area_light lights[COUNT];
    glint_value values[COUNT];
} points;

uint32_t library_hash(const void *bytes, size_t size, uint32_t hash)
{
    for (size_t i = 0; i < size; ++i)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 16777619U;
    return hash;
}

/* The part of the name behind LIBRARY_. */
static int is(const char *effect, const char *name)
{
    return strcmp(effect + strlen("LIBRARY_"), name) == 0;
}

static void set_model(const char *effect, glint_material_options *o)
{
    if (is(effect, "EXPLICIT"))
        o->model = GLINT_MODEL_EXPLICIT;
    if (is(effect, "DICTIONARY"))
        o->model = GLINT_MODEL_DICTIONARY;
    if (is(effect, "EXAMPLE"))
        o->model = GLINT_MODEL_EXAMPLE;
    if (is(effect, "LAYERS"))
        o->model = GLINT_MODEL_LAYERED;
}

static void set_options(const char *effect, glint_material_options *o)
{
    set_model(effect, o);
    if (is(effect, "BECKMANN"))
        o->distribution = GLINT_DISTRIBUTION_BECKMANN;
    if (is(effect, "ANISOTROPY"))
        o->surface.alpha_y = 0.5F;
    if (is(effect, "FRESNEL_TERMS"))
        o->fresnel = GLINT_FRESNEL_CONDUCTOR;
    if (is(effect, "WEIGHTINGS"))
        o->weighting = GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
    if (is(effect, "ROUGH_FACETS"))
        o->facet_alpha = 0.05F;
    if (is(effect, "ELONGATION"))
        o->elongation = 3.0F;
    if (is(effect, "DISCRETENESS"))
        o->surface.discreteness = 0.5F;
    if (is(effect, "TINTS"))
        o->color_variation = 0.7F;
    if (is(effect, "FADING"))
        o->smooth_deviation = 1.0F;
    if (is(effect, "DRAWS"))
        o->draw_deviation = 10.0F;
}

/* Half a hundred lit facets under each footprint, looked at from aside. */
static void place(points *p, const glint_surface *own)
{
    for (int i = 0; i < COUNT; ++i) {
        p->u[i] = 0.01 * i;
        p->v[i] = 0.02 * i;
        p->side[i] = 0.01F;
        p->wo[0][i] = 0.6F;
        p->wo[2][i] = 0.8F;
        p->wi[0][i] = -0.28F;
        p->wi[2][i] = 0.96F;
        p->solid_angle_sr[i] = 0.01F;
        p->draw[i] = (uint32_t)i * 2654435761U;
        p->surfaces[i] = *own;
        p->surfaces[i].alpha_x = 0.3F + 0.01F * (float)i;
        p->lights[i] = (glint_area_light){ .kind = GLINT_AREA_SPHERE, .radius = 0.5F, .center = { -0.6F, 0.0F, 2.0F } };
    }
}

static void look_from_below(points *p)
{
    for (int i = 0; i < COUNT; ++i) {
        p->wo[0][i] = -0.995F;
        p->wo[2][i] = -0.0999F;
    }
}

static uint32_t evaluate(const char *effect, const glint_material *m)
{
    static points p; /* zero but for what is set */
    const glint_surface own = glint_material_surface(m);
    place(&p, &own);
    if (is(effect, "LAYERS"))
        look_from_below(&p);
    const glint_batch batch = { .size = sizeof batch,
                                .count = COUNT,
                                .u = p.u,
                                .v = p.v,
                                .dudx = p.side,
                                .dudy = p.none,
                                .dvdx = p.none,
                                .dvdy = p.side,
                                .wo = { p.wo[0], p.wo[1], p.wo[2] },
                                .wi = { p.wi[0], p.wi[1], p.wi[2] },
                                .solid_angle_sr = p.solid_angle_sr,
                                .draw = p.draw,
                                .surfaces = is(effect, "SURFACES") ? p.surfaces : NULL,
                                .area_lights = is(effect, "AREA_LIGHTS") ? p.lights : NULL,
                                .values = p.values };
    const glint_result result = glint_eval_batch(m, &batch);
    const uint32_t hash = library_hash(&result, sizeof result, LIBRARY_FIRST_HASH);
    return library_hash(p.values, sizeof p.values, hash);
}

uint32_t library_use(const char *effect)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material_options layers[2] = { GLINT_MATERIAL_OPTIONS_INIT, GLINT_MATERIAL_OPTIONS_INIT };
    glint_material *m;
    if (strncmp(effect, "LIBRARY_", strlen("LIBRARY_")) != 0)
        return 0U;
    layers[1].seed = 1U;
    o.layers.base = &layers[0];
    o.layers.coat = &layers[1];
    /* The coat leans, so that it is seen from below the horizon of the base. */
    o.layers.coat_normal[0] = -0.6F;
    o.layers.coat_normal[2] = 0.8F;
    set_options(effect, &o);
    if (glint_material_create(&o, &m, NULL, 0) != GLINT_OK)
        return 0U;
    const uint32_t hash = evaluate(effect, m);
    glint_material_destroy(m);
    return hash;
}
