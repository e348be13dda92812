/* The library's front: handles, the table of models, and the checks that let models trust what they are called with. */
#include "glint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "glint_options.h"
#include "math/float_bits.h"
#include "model/model.h"
#include "ndf/ndf.h"

/* Indexed by glint_model. */
static const struct model *const models[] = {
    [GLINT_MODEL_SMOOTH] = &smooth_model,     [GLINT_MODEL_COUNTING] = &counting_model,
    [GLINT_MODEL_EXPLICIT] = &explicit_model, [GLINT_MODEL_DICTIONARY] = &dictionary_model,
    [GLINT_MODEL_EXAMPLE] = &example_model,   [GLINT_MODEL_LAYERED] = &layered_model,
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

/* Everything that a query points to once it has been checked. */
typedef struct checked {
    model_query query;
    glint_surface surface;
    glint_coat coat;
} checked;

static int is_unit(vec3 v)
{
    /* Interpolated directions are a little off; anything further off is a mistake and gives zero. */
    return is_below(v.x, 1.01F) && is_below(v.y, 1.01F) && is_below(v.z, 1.01F) &&
           is_below(vec3_dot(v, v) - 1.0F, 0.02F);
}

static int is_usable(const glint_footprint *f)
{
    return is_below(f->dudx, 1e6F) && is_below(f->dudy, 1e6F) && is_below(f->dvdx, 1e6F) && is_below(f->dvdy, 1e6F) &&
           is_below_d(f->u, 1e12) && is_below_d(f->v, 1e12);
}

/* Every number of a surface into its range, as clamp_to does, but all at once: as integers, floats that are not
 * negative keep their order, negative ones are below, and NaNs above infinity. */
static glint_surface clamp_surface(const glint_surface *s)
{
    static const glint_surface least = { LEAST_ALPHA, LEAST_ALPHA, { 0 }, { 0 }, { 0 }, 0.0F, 0.0F, NULL };
    static const glint_surface most = { 1.0F, 1.0F, { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 }, 1e18F, 1.0F, NULL };
    enum { COUNT = offsetof(glint_surface, coat) / sizeof(int32_t) };
    int32_t number[COUNT], low[COUNT], high[COUNT];
    memcpy(number, s, sizeof(number));
    memcpy(low, &least, sizeof(low));
    memcpy(high, &most, sizeof(high));
    for (int i = 0; i < COUNT; i++) {
        const int32_t x = number[i] > 0x7f800000 ? low[i] : number[i], up = x > low[i] ? x : low[i];
        number[i] = up < high[i] ? up : high[i];
    }
    glint_surface r = { .coat = NULL };
    memcpy(&r, number, sizeof(number));
    return r;
}

/* False: its normal or its tangent is no direction. */
static int clamp_coat(glint_coat *c, const glint_coat *from)
{
    static const glint_footprint degenerate = { 0 };
    *c = *from;
    c->surface = clamp_surface(&from->surface);
    c->weight = clamp_to(from->weight, 0.0F, 1.0F);
    if (from->footprint && !is_usable(from->footprint))
        c->footprint = &degenerate;
    return is_unit(vec3_from(from->normal)) && is_unit(vec3_from(from->tangent));
}

/* Fills all of *c but wi. False: there is nothing to see from wo. */
static int begin(checked *c, const glint_material *material, const glint_surface *surface,
                 const glint_footprint *footprint, const float wo[3])
{
    if (!material || !wo)
        return 0;
    if (surface)
        c->surface = clamp_surface(surface);
    c->query = (model_query){ .material = material,
                              .surface = surface ? &c->surface : &material->options.surface,
                              .total_area = surface ? 0.0F : material->total_area,
                              .footprint = footprint && is_usable(footprint) ? footprint : NULL,
                              .wo = vec3_from(wo) };
    if (!is_unit(c->query.wo))
        return 0;
    if (!material->base)
        return c->query.wo.z > 0.0F;
    if (!surface || !surface->coat)
        return 1;
    c->surface.coat = &c->coat;
    return clamp_coat(&c->coat, surface->coat);
}

/* The light's side. False: wi is not lit. */
static int light_up(checked *c, const float wi[3], float solid_angle_sr)
{
    c->query.wi = vec3_from(wi);
    c->query.solid_angle_sr = clamp_to(solid_angle_sr, 0.0F, 6.28318531F);
    return is_unit(c->query.wi) && (c->query.material->base || c->query.wi.z > 0.0F);
}

static void make_finite(glint_value *value)
{
    for (int i = 0; i < 3; i++) {
        value->rgb[i] = clamp_to(value->rgb[i], 0.0F, 3e38F);
        value->smooth[i] = clamp_to(value->smooth[i], 0.0F, 3e38F);
    }
}

void glint_eval_value(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                      const float wo[3], const float wi[3], const glint_light *light, glint_value *value)
{
    checked c;
    *value = (glint_value){ 0 };
    if (!wi || !begin(&c, material, surface, footprint, wo) || !light_up(&c, wi, light ? light->solid_angle_sr : 0.0F))
        return;
    material->model->eval(&c.query, value);
    make_finite(value);
}

void glint_eval_area(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                     const float wo[3], const glint_area_light *light, glint_value *value)
{
    checked c;
    *value = (glint_value){ 0 };
    if (!light || !begin(&c, material, surface, footprint, wo))
        return;
    c.query.area_light = light;
    material->model->eval(&c.query, value);
    make_finite(value);
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
    rgb[0] = rgb[1] = rgb[2] = 0.0F;
    if (!material)
        return;
    glint_surface surface = material->options.surface;
    if (coat)
        surface.coat = coat;
    if (!begin(&c, material, &surface, NULL, wo) || (wi && !light_up(&c, wi, 0.0F)))
        return;
    rgb[0] = rgb[1] = rgb[2] = 1.0F;
    if (material->model->transmittance)
        material->model->transmittance(&c.query, wi == NULL, rgb);
}

int glint_sample_direction(const glint_material *material, const glint_surface *surface,
                           const glint_footprint *footprint, const float wo[3], const float random[3],
                           glint_sample *sample)
{
    checked c;
    *sample = (glint_sample){ { 0 }, 0, { 0 } };
    if (!random || !begin(&c, material, surface, footprint, wo))
        return 0;
    float u[3];
    for (int i = 0; i < 3; i++)
        u[i] = clamp_to(random[i], 0.0F, 0.99999994F);
    const int lit = material->model->sample(&c.query, u, sample);
    /* Schlick's blend from f0 to a smaller f90 may round to a hair below zero. */
    for (int i = 0; i < 3; i++)
        sample->weight[i] = clamp_to(sample->weight[i], 0.0F, 3e38F);
    return lit;
}

float glint_pdf(const glint_material *material, const glint_surface *surface, const glint_footprint *footprint,
                const float wo[3], const float wi[3])
{
    checked c;
    if (!wi || !begin(&c, material, surface, footprint, wo) || !light_up(&c, wi, 0.0F))
        return 0.0F;
    return clamp_to(material->model->pdf(&c.query), 0.0F, 3e38F);
}

/* ---- batches ---- */

static int has_all(const glint_batch *b)
{
    const void *const arrays[] = { b->u, b->v, b->dudx, b->dudy, b->dvdx, b->dvdy, b->wo[0], b->wo[1], b->wo[2] };
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); i++)
        if (!arrays[i])
            return 0;
    if (!b->values && !(b->rgb[0] && b->rgb[1] && b->rgb[2]))
        return 0;
    return b->area_lights || (b->wi[0] && b->wi[1] && b->wi[2] && b->solid_angle_sr);
}

/* The light of entry i. False: it lights nothing. */
static int light_entry(checked *c, const glint_batch *b, size_t i)
{
    if (b->area_lights) {
        c->query.area_light = &b->area_lights[i];
        return 1;
    }
    const float wi[3] = { b->wi[0][i], b->wi[1][i], b->wi[2][i] };
    return light_up(c, wi, b->solid_angle_sr[i]);
}

static void put_entry(const glint_batch *b, size_t i, const glint_value *value)
{
    if (b->values)
        b->values[i] = *value;
    for (int k = 0; k < 3; k++)
        if (b->rgb[k])
            b->rgb[k][i] = value->rgb[k];
}

glint_result glint_eval_batch(const glint_material *material, const glint_batch *batch)
{
    if (!material || !batch || batch->size != sizeof(*batch) || (batch->count > 0 && !has_all(batch)))
        return GLINT_ERROR_ARGUMENT;
    enum { CHUNK = 64 };
    checked c[CHUNK];
    glint_footprint footprint[CHUNK];
    model_query query[CHUNK];
    glint_value value[CHUNK];
    size_t index[CHUNK];
    for (size_t start = 0; start < batch->count; start += CHUNK) {
        const size_t left = batch->count - start, count = left < CHUNK ? left : CHUNK;
        size_t lit = 0;
        for (size_t j = 0; j < count; j++) {
            const size_t i = start + j;
            const float wo[3] = { batch->wo[0][i], batch->wo[1][i], batch->wo[2][i] };
            footprint[j] = (glint_footprint){ batch->u[i],
                                              batch->v[i],
                                              batch->dudx[i],
                                              batch->dudy[i],
                                              batch->dvdx[i],
                                              batch->dvdy[i],
                                              batch->seed ? batch->seed[i] : 0U,
                                              batch->draw ? batch->draw[i] : 0U };
            if (!begin(&c[j], material, batch->surfaces ? &batch->surfaces[i] : NULL, &footprint[j], wo) ||
                !light_entry(&c[j], batch, i)) {
                put_entry(batch, i, &(glint_value){ 0 });
                continue;
            }
            query[lit] = c[j].query;
            index[lit++] = i;
        }
        if (lit == 0)
            continue;
        material->model->eval_many(query, lit, value);
        for (size_t j = 0; j < lit; j++) {
            make_finite(&value[j]);
            put_entry(batch, index[j], &value[j]);
        }
    }
    return GLINT_OK;
}
