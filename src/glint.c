/* The library's front: handles, the table of models, and single evaluations. */
#include "glint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "glint_options.h"
#include "glint_query.h"
#include "math/effects.h"
#include "math/float_bits.h"
#include "ndf/ndf.h"

/* Indexed by glint_model. */
static const struct model *const models[] = {
    [GLINT_MODEL_SMOOTH] = &smooth_model,
    [GLINT_MODEL_COUNTING] = LIBRARY_COUNTING ? &counting_model : &smooth_model,
    [GLINT_MODEL_EXPLICIT] = LIBRARY_EXPLICIT ? &explicit_model : &counting_model,
    [GLINT_MODEL_DICTIONARY] = LIBRARY_DICTIONARY ? &dictionary_model : &counting_model,
    [GLINT_MODEL_EXAMPLE] = LIBRARY_EXAMPLE ? &example_model : &counting_model,
    [GLINT_MODEL_LAYERED] = &layered_model,
};
enum { MODEL_COUNT = sizeof(models) / sizeof(models[0]) };

const char *glint_version(void)
{
#define TEXT_(x) #x
#define TEXT(x) TEXT_(x)
    return TEXT(GLINT_VERSION_MAJOR) "." TEXT(GLINT_VERSION_MINOR) "." TEXT(GLINT_VERSION_PATCH);
}

const char *glint_result_text(glint_result result)
{
    switch (result) {
    case GLINT_OK:
        return "no error";
    case GLINT_ERROR_ARGUMENT:
        return "an argument is missing or has an impossible size";
    case GLINT_ERROR_RANGE:
        return "a value is outside its range";
    case GLINT_ERROR_UNSUPPORTED:
        return "the model does not support this";
    case GLINT_ERROR_MEMORY:
        return "there is not enough memory";
    }
    return "an unknown result";
}

/* ---- models ---- */

uint32_t glint_model_count(void)
{
    return MODEL_COUNT;
}

static int is_model(glint_model model)
{
    return (uint32_t)model < MODEL_COUNT;
}

const char *glint_model_name(glint_model model)
{
    return is_model(model) ? models[model]->name : NULL;
}

uint32_t glint_model_features(glint_model model)
{
    return is_model(model) ? models[model]->features : 0U;
}

glint_result glint_model_find(const char *name, glint_model *model)
{
    if (!name || !model)
        return GLINT_ERROR_ARGUMENT;
    for (uint32_t i = 0; i < MODEL_COUNT; i++)
        if (strcmp(models[i]->name, name) == 0) {
            *model = (glint_model)i;
            return GLINT_OK;
        }
    return GLINT_ERROR_RANGE;
}

/* ---- set-up ---- */

static void *allocate_default(size_t byte_count, void *user)
{
    (void)user;
    return aligned_alloc(64, (byte_count + 63) / 64 * 64);
}

static void release_default(void *memory, void *user)
{
    (void)user;
    free(memory);
}

static ndf ndf_of(glint_distribution distribution, const glint_surface *s)
{
    return (ndf){ distribution == GLINT_DISTRIBUTION_GGX ? NDF_GGX : NDF_BECKMANN, s->alpha_x, s->alpha_y };
}

/* A material whose options have been checked. NULL: there is not enough memory. */
static struct glint_material *make(const glint_material_options *o, struct glint_material *base,
                                   struct glint_material *coat)
{
    const struct model *model = models[o->model];
    struct glint_material *made = o->allocator.allocate(sizeof(*made), o->allocator.user);
    if (!made)
        return NULL;
    const ndf n = ndf_of(o->distribution, &o->surface);
    *made = (struct glint_material){ model, *o, ndf_total_area(&n), NULL, model->features, base, coat };
    if (!model->setup || model->setup(made) == GLINT_OK)
        return made;
    o->allocator.release(made, o->allocator.user);
    return NULL;
}

/* A layer takes its memory where the whole material does. */
static struct glint_material *make_layer(const glint_material_options *layer, const glint_allocator *allocator)
{
    glint_material_options o = *layer;
    o.allocator = *allocator;
    return make(&o, NULL, NULL);
}

static struct glint_material *make_layered(const glint_material_options *o)
{
    struct glint_material *base = make_layer(o->layers.base, &o->allocator);
    struct glint_material *coat = base ? make_layer(o->layers.coat, &o->allocator) : NULL;
    struct glint_material *made = coat ? make(o, base, coat) : NULL;
    if (!made) {
        glint_material_destroy(coat);
        glint_material_destroy(base);
    }
    return made;
}

glint_result glint_material_create(const glint_material_options *options, glint_material **material, char *message,
                                   size_t message_size)
{
    complaint c = { message, message_size, GLINT_OK, NULL };
    if (message && message_size > 0)
        message[0] = '\0';
    if (!material)
        return GLINT_ERROR_ARGUMENT;
    *material = NULL;
    if (!options) {
        complain(&c, GLINT_ERROR_ARGUMENT, "options is NULL");
        return c.result;
    }
    check_options(&c, options);
    if (c.result != GLINT_OK)
        return c.result;
    glint_material_options o = *options;
    if (!o.allocator.allocate)
        o.allocator = (glint_allocator){ allocate_default, release_default, NULL };
    *material = o.model == GLINT_MODEL_LAYERED ? make_layered(&o) : make(&o, NULL, NULL);
    if (!*material)
        complain(&c, GLINT_ERROR_MEMORY, "there is not enough memory for a material of model %s",
                 models[o.model]->name);
    return c.result;
}

void glint_material_destroy(glint_material *material)
{
    if (!material)
        return;
    glint_material_destroy(material->coat);
    glint_material_destroy(material->base);
    if (material->model->free)
        material->model->free(material);
    const glint_allocator a = material->options.allocator;
    a.release(material, a.user);
}

glint_model glint_material_model(const glint_material *material)
{
    return material->options.model;
}

uint32_t glint_material_features(const glint_material *material)
{
    return material->features;
}

const glint_material *glint_material_layer(const glint_material *material, glint_layer layer)
{
    return layer == GLINT_LAYER_COAT ? material->coat : material->base;
}

glint_surface glint_material_surface(const glint_material *material)
{
    return material->options.surface;
}

/* ---- evaluation ---- */

void glint_eval_value(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                      const float wo[3], const float wi[3], const glint_light *light, glint_value *value)
{
    checked c;
    model_query q;
    *value = (glint_value){ 0 };
    if (!wi || !query_begin(&q, &c, material, surface, footprint, wo) ||
        !query_light(&q, wi, light ? light->solid_angle_sr : 0.0F))
        return;
    material->model->eval(&q, value);
    value_make_finite(value);
}

void glint_eval_area(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                     const float wo[3], const glint_area_light *light, glint_value *value)
{
    checked c;
    model_query q;
    *value = (glint_value){ 0 };
    if (!light || !query_begin(&q, &c, material, surface, footprint, wo))
        return;
    q.area_light = light;
    material->model->eval(&q, value);
    value_make_finite(value);
}

void glint_eval(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                const float wo[3], const float wi[3], const glint_light *light, float rgb[3])
{
    glint_value value;
    glint_eval_value(material, surface, footprint, wo, wi, light, &value);
    memcpy(rgb, value.rgb, sizeof(value.rgb));
}

void glint_transmittance(const glint_material *material, const glint_coat *coat, const float wo[3], const float *wi,
                         float rgb[3])
{
    checked c;
    model_query q;
    rgb[0] = rgb[1] = rgb[2] = 0.0F;
    if (!material)
        return;
    glint_surface surface = material->options.surface;
    if (coat)
        surface.coat = coat;
    if (!query_begin(&q, &c, material, &surface, NULL, wo) || (wi && !query_light(&q, wi, 0.0F)))
        return;
    rgb[0] = rgb[1] = rgb[2] = 1.0F;
    if (material->model->transmittance)
        material->model->transmittance(&q, wi == NULL, rgb);
}

int glint_sample_direction(const glint_material *material, const glint_surface *surface,
                           const glint_footprint *footprint, const float wo[3], const float random[3],
                           glint_sample *sample)
{
    checked c;
    model_query q;
    *sample = (glint_sample){ { 0 }, 0, { 0 } };
    if (!random || !query_begin(&q, &c, material, surface, footprint, wo))
        return 0;
    float u[3];
    for (int i = 0; i < 3; i++)
        u[i] = clamp_to(random[i], 0.0F, 0.99999994F);
    const int lit = material->model->sample(&q, u, sample);
    /* Schlick's blend from f0 to a smaller f90 may round to a hair below zero. */
    for (int i = 0; i < 3; i++)
        sample->weight[i] = clamp_to(sample->weight[i], 0.0F, 3e38F);
    return lit;
}

float glint_pdf(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                const float wo[3], const float wi[3])
{
    checked c;
    model_query q;
    if (!wi || !query_begin(&q, &c, material, surface, footprint, wo) || !query_light(&q, wi, 0.0F))
        return 0.0F;
    return clamp_to(material->model->pdf(&q), 0.0F, 3e38F);
}
