/* One table: every model with every kind of option. A new model is one row in MODELS. */
#ifndef TESTS_CONFIGURATIONS_H
#define TESTS_CONFIGURATIONS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "glint.h"
#include "statistics.h"

typedef struct model_row {
    glint_model model;
    /* f(wo, wi) = f(wi, wo), count for count. Not for explicit: it knows the true directions of a light of finite size,
     * and exchanging the two exchanges only its middle with the viewer. */
    int reciprocal;
    double most_facets; /* that a test may put under one footprint */
    /* Relative error of the value that more facets do not take away until there are so many that the model is smooth.
     * dictionary: two marginals of half floats, 2^-11 each, without the last 1.6e-4 of their tails. */
    double resolution;
} model_row;

static const model_row MODELS[] = {
    { GLINT_MODEL_SMOOTH, 1, 1e18, 0.0 },     { GLINT_MODEL_COUNTING, 1, 1e18, 0.0 },
    { GLINT_MODEL_EXPLICIT, 0, 1500.0, 0.0 }, { GLINT_MODEL_DICTIONARY, 1, 1e18, 1.3e-3 },
    { GLINT_MODEL_EXAMPLE, 1, 1e18, 0.0 },    { GLINT_MODEL_LAYERED, 1, 1e18, 1.3e-3 },
};

typedef struct configuration {
    const char *name;
    glint_material_options options;
} configuration;

enum { CONFIGURATIONS = 8 };

/* Another microstructure of the example model for each configuration: flat facets that follow the surface, and every
 * built-in map, tiled and scattered. */
static inline void set_example(glint_example *e, int i)
{
    static const glint_example_kind kinds[] = { GLINT_EXAMPLE_ISOTROPIC_NOISE, GLINT_EXAMPLE_SCRATCHES,
                                                GLINT_EXAMPLE_BRUSHED,         GLINT_EXAMPLE_LEATHER,
                                                GLINT_EXAMPLE_STRUCTURE,       GLINT_EXAMPLE_ANISOTROPIC_NOISE };
    static float normals[6][3 * 16 * 16];
    if (i < 2)
        return;
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    if (glint_example_generate(kinds[i - 2], 16, &shape, 7U, normals[i - 2]) != GLINT_OK)
        fail_msg("glint_example_generate refuses kind %d", i - 2);
    e->normals = normals[i - 2];
    e->mirror = i % 2 == 0;
    e->rotation_rad = 0.3F;
    e->sigma_r = 0.04F;
    if (i == 3 || i == 7) {
        e->placement = GLINT_EXAMPLE_SCATTERED;
        e->scale_variation = 0.2F;
        e->shear_variation = 0.1F;
        e->rotation_variation_rad = 3.0F;
    }
}

/* Configuration i of a model that is no pair of layers. */
static inline configuration single_configuration(glint_model model, int i)
{
    static const char *const names[CONFIGURATIONS] = { "GGX",
                                                       "Beckmann",
                                                       "GGX 4:1",
                                                       "Beckmann 4:1",
                                                       "GGX, equal projected area, rough facets",
                                                       "Beckmann dielectric over a diffuse base",
                                                       "GGX conductor, elongated facets, half coverage",
                                                       "GGX, half discrete, tinted" };
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    if (model == GLINT_MODEL_EXPLICIT) {
        o.surface.facets_per_m2 = 1e5F; /* it visits them all */
        o.facet_limit = 2000U;
    }
    o.distribution = i == 1 || i == 3 || i == 5 ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    if (i == 2 || i == 3) {
        o.surface.alpha_x = 0.4F;
        o.surface.alpha_y = 0.1F;
    }
    if (i == 3) {
        o.density_variation = 1.0F;
        o.max_anisotropy = 8.0F;
    }
    if (i == 4) {
        o.weighting = GLINT_WEIGHTING_EQUAL_PROJECTED_AREA;
        o.facet_alpha = 0.02F;
    }
    if (i == 5) {
        o.fresnel = GLINT_FRESNEL_DIELECTRIC;
        for (int c = 0; c < 3; c++)
            o.surface.diffuse[c] = 1.0F - 0.3F * (float)c;
    }
    if (i == 6) {
        o.fresnel = GLINT_FRESNEL_CONDUCTOR;
        o.elongation = 20.0F;
        o.coverage = 0.5F;
    }
    if (i == 7) {
        o.surface.discreteness = 0.5F;
        for (int c = 0; c < 3; c++)
            o.surface.f0[c] = 0.2F + 0.3F * (float)c;
        if (glint_model_features(model) & GLINT_FEATURE_COLOR) {
            o.color_variation = 0.5F;
            o.color_count = 2;
            o.colors[0][0] = o.colors[1][1] = o.colors[1][2] = 0.8F;
            o.colors[0][1] = o.colors[1][0] = 0.3F;
        }
    }
    if (model == GLINT_MODEL_EXAMPLE)
        set_example(&o.example, i);
    return (configuration){ names[i], o };
}

/* A coat over a base, each in another configuration. */
static inline configuration layered_configuration(int i)
{
    static const struct {
        const char *name;
        glint_model base, coat;
    } pairs[CONFIGURATIONS] = { { "smooth under smooth", GLINT_MODEL_SMOOTH, GLINT_MODEL_SMOOTH },
                                { "counting under counting", GLINT_MODEL_COUNTING, GLINT_MODEL_COUNTING },
                                { "dictionary under counting", GLINT_MODEL_DICTIONARY, GLINT_MODEL_COUNTING },
                                { "example under explicit", GLINT_MODEL_EXAMPLE, GLINT_MODEL_EXPLICIT },
                                { "counting under dictionary", GLINT_MODEL_COUNTING, GLINT_MODEL_DICTIONARY },
                                { "counting under example", GLINT_MODEL_COUNTING, GLINT_MODEL_EXAMPLE },
                                { "smooth under counting", GLINT_MODEL_SMOOTH, GLINT_MODEL_COUNTING },
                                { "dictionary under dictionary", GLINT_MODEL_DICTIONARY, GLINT_MODEL_DICTIONARY } };
    static glint_material_options layers[CONFIGURATIONS][2];
    glint_material_options *base = &layers[i][0], *coat = &layers[i][1];
    *base = single_configuration(pairs[i].base, i).options;
    *coat = single_configuration(pairs[i].coat, (i + 3) % CONFIGURATIONS).options;
    coat->seed = 1U;
    for (int c = 0; c < 3; c++)
        coat->surface.f0[c] = 0.04F + 0.1F * (float)c;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_LAYERED;
    o.layers.base = base;
    o.layers.coat = coat;
    o.layers.coat_weight = i % 2 ? 0.7F : 1.0F;
    return (configuration){ pairs[i].name, o };
}

/* Configuration i of a model. */
static inline configuration configuration_of(glint_model model, int i)
{
    return model == GLINT_MODEL_LAYERED ? layered_configuration(i) : single_configuration(model, i);
}

/* Whether the model, or one of the layers, is this one. */
static inline int has_model(const configuration *c, glint_model model)
{
    const glint_material_options *o = &c->options;
    return o->model == model ||
           (o->model == GLINT_MODEL_LAYERED && (o->layers.base->model == model || o->layers.coat->model == model));
}

static inline int is_reciprocal(const model_row *row, const configuration *c)
{
    return row->reciprocal && !has_model(c, GLINT_MODEL_EXPLICIT);
}

static inline double most_facets(const model_row *row, const configuration *c)
{
    return has_model(c, GLINT_MODEL_EXPLICIT) ? 1500.0 : row->most_facets;
}

/* The material's own surface with this density, of both layers where there are two; coat: room for the second. */
static inline glint_surface surface_of_density(const glint_material *m, float facets_per_m2, glint_coat *coat)
{
    glint_surface s = glint_material_surface(m);
    s.facets_per_m2 = facets_per_m2;
    if (s.coat) {
        *coat = *s.coat;
        coat->surface.facets_per_m2 = facets_per_m2;
        s.coat = coat;
    }
    return s;
}

static inline glint_material *create(const glint_material_options *o)
{
    glint_material *m = NULL;
    char message[256];
    if (glint_material_create(o, &m, message, sizeof(message)) != GLINT_OK)
        fail_msg("glint_material_create: %s", message);
    return m;
}

/* Calls body with m and c for every row of the table. */
#define FOR_EACH_CONFIGURATION(c, m, row)                                                                              \
    for (const model_row *row = MODELS; row < MODELS + sizeof(MODELS) / sizeof(MODELS[0]); row++)                      \
        for (int i_ = 0; i_ < CONFIGURATIONS; i_++)                                                                    \
            for (configuration c = configuration_of(row->model, i_); c.name; c.name = NULL)                            \
                for (glint_material *m = create(&c.options); m; glint_material_destroy(m), m = NULL)

static inline void direction(double theta, double phi, float v[3])
{
    v[0] = (float)(sin(theta) * cos(phi));
    v[1] = (float)(sin(theta) * sin(phi));
    v[2] = (float)cos(theta);
}

/* Uniform over the upper hemisphere, cosine-distributed. */
static inline void random_direction(uint64_t *random, float v[3])
{
    direction(asin(sqrt(random_uniform(random))), random_between(random, 0.0, 6.28318530718), v);
}

static inline glint_footprint random_footprint(uint64_t *random)
{
    const double size = random_log_between(random, 1e-5, 1e-2), turn = random_between(random, 0.0, 6.3);
    const double other = size * random_between(random, 0.05, 1.0);
    return (glint_footprint){ .u = random_between(random, -10.0, 10.0),
                              .v = random_between(random, -10.0, 10.0),
                              .dudx = (float)(size * cos(turn)),
                              .dudy = (float)(-other * sin(turn)),
                              .dvdx = (float)(size * sin(turn)),
                              .dvdy = (float)(other * cos(turn)),
                              .seed = (uint32_t)random_bits(random) };
}

#endif
