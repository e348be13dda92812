/* The library's front: handles, the table of models, and the checks that let models trust what they are called with. */
#include "glint.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/example.h"
#include "model/model.h"
#include "ndf/ndf.h"

/* Indexed by glint_model. */
static const struct model *const models[] = {
    [GLINT_MODEL_SMOOTH] = &smooth_model,
    [GLINT_MODEL_COUNTING] = &counting_model,
    [GLINT_MODEL_EXAMPLE] = &example_model,
};
enum { MODEL_COUNT = sizeof(models) / sizeof(models[0]) };

/* Rougher than this float can resolve near the pole. */
#define LEAST_ALPHA 1e-4F

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

/* ---- numbers from outside ---- */

/* All by bits: comparing a NaN raises a floating-point exception, and a compiler may compare before the branch that
 * should have kept it from doing so. Floats that are not negative are ordered as their bits. */
static uint32_t bits_of_float(float x)
{
    uint32_t u;
    memcpy(&u, &x, sizeof(u));
    return u;
}

/* |x| < limit; false for a NaN. */
static int is_below(float x, float limit)
{
    return (bits_of_float(x) & 0x7fffffffU) < bits_of_float(limit);
}

static int is_below_d(double x, double limit)
{
    uint64_t u, most;
    memcpy(&u, &x, sizeof(u));
    memcpy(&most, &limit, sizeof(most));
    return (u & 0x7fffffffffffffffU) < most;
}

/* low <= x <= high, for 0 <= low. */
static int in_range(float x, float low, float high)
{
    const uint32_t u = bits_of_float(x) == 0x80000000U ? 0U : bits_of_float(x);
    return u >= bits_of_float(low) && u <= bits_of_float(high);
}

/* x in [low, high] for 0 <= low; low for a NaN. */
static float clamp_to(float x, float low, float high)
{
    const uint32_t u = bits_of_float(x);
    if (u > 0x7f800000U) /* negative, or a NaN */
        return low;
    return u < bits_of_float(low) ? low : u > bits_of_float(high) ? high : x;
}

/* ---- set-up ---- */

/* Where a failed check writes what it found. */
typedef struct complaint {
    char *text;
    size_t size;
    glint_result result;
} complaint;

static void __attribute__((format(printf, 3, 4))) complain(complaint *c, glint_result result, const char *format, ...)
{
    if (c->result != GLINT_OK)
        return;
    c->result = result;
    if (c->text && c->size > 0) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(c->text, c->size, format, arguments);
        va_end(arguments);
    }
}

static void check(complaint *c, const char *name, float x, float low, float high)
{
    if (!in_range(x, low, high))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected %g to %g", name, (double)x, (double)low, (double)high);
}

static void check_enum(complaint *c, const char *name, unsigned value, unsigned last)
{
    if (value > last)
        complain(c, GLINT_ERROR_RANGE, "%s is %u, expected 0 to %u", name, value, last);
}

static void check_surface(complaint *c, const glint_surface *s)
{
    check(c, "surface.alpha_x", s->alpha_x, LEAST_ALPHA, 1.0F);
    check(c, "surface.alpha_y", s->alpha_y, LEAST_ALPHA, 1.0F);
    check(c, "surface.facets_per_m2", s->facets_per_m2, 0.0F, 1e18F);
    check(c, "surface.discreteness", s->discreteness, 0.0F, 1.0F);
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof(name), "surface.diffuse[%d]", i);
        check(c, name, s->diffuse[i], 0.0F, 1.0F);
        snprintf(name, sizeof(name), "surface.f0[%d]", i);
        check(c, name, s->f0[i], 0.0F, 1.0F);
        snprintf(name, sizeof(name), "surface.f90[%d]", i);
        check(c, name, s->f90[i], 0.0F, 1.0F);
    }
}

/* |x| <= most, for 0 <= most. */
static void check_signed(complaint *c, const char *name, float x, float most)
{
    if (!in_range(fabsf(x), 0.0F, most))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected %g to %g", name, (double)x, (double)-most, (double)most);
}

/* 0, or low <= x <= high. */
static void check_or_zero(complaint *c, const char *name, float x, float low, float high)
{
    if (!in_range(x, 0.0F, 0.0F) && !in_range(x, low, high))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected 0 or %g to %g", name, (double)x, (double)low, (double)high);
}

static void check_example_normals(complaint *c, const glint_example *e)
{
    for (uint32_t i = 0; i < e->size * e->size; i++) {
        float slope[2];
        const float *n = e->normals + (size_t)i * e->components;
        if (!example_normal_slope(e, i, slope)) {
            complain(c, GLINT_ERROR_RANGE,
                     "example.normals[%u] (row %u, column %u) begins with %g, %g, expected a normal with z > 0 and a "
                     "slope of at most 8",
                     i, i / e->size, i % e->size, (double)n[0], (double)n[1]);
            return;
        }
    }
}

/* No map may shrink to nothing, and no scattered one reach further than evaluation looks. */
static void check_example_extent(complaint *c, const glint_example *e)
{
    const int scattered = e->placement == GLINT_EXAMPLE_SCATTERED;
    const float grow = scattered ? e->scale_variation : 0.0F, lean = scattered ? e->shear_variation : 0.0F;
    const float shear_x = fabsf(e->shear[0]) + lean, shear_y = fabsf(e->shear[1]) + lean;
    const float area = e->scale[0] * e->scale[1] * (1.0F - grow) * (1.0F - grow) - shear_x * shear_y;
    if (area < 0.05F)
        complain(c, GLINT_ERROR_RANGE,
                 "example.scale with example.shear leaves %g of a map's area at worst, expected at least 0.05",
                 (double)area);
    const float x = e->scale[0] * (1.0F + grow) + shear_x, y = e->scale[1] * (1.0F + grow) + shear_y;
    const float radius = 0.5F * sqrtf(x * x + y * y);
    if (scattered && radius > EXAMPLE_MOST_RADIUS)
        complain(c, GLINT_ERROR_RANGE,
                 "example.scale, shear and their variations make half a scattered map's diagonal %g squares, expected "
                 "at most %g",
                 (double)radius, (double)EXAMPLE_MOST_RADIUS);
}

static void check_example(complaint *c, const glint_example *e)
{
    check_enum(c, "example.placement", (unsigned)e->placement, GLINT_EXAMPLE_SCATTERED);
    check_enum(c, "example.flat", e->flat, 1);
    check_enum(c, "example.mirror", e->mirror, 1);
    if (e->components != 2 && e->components != 3)
        complain(c, GLINT_ERROR_RANGE, "example.components is %u, expected 2 or 3", e->components);
    if (e->size < EXAMPLE_LEAST_SIZE || e->size > EXAMPLE_MOST_SIZE || (e->size & (e->size - 1)) != 0)
        complain(c, GLINT_ERROR_RANGE, "example.size is %u, expected 8, 16, 32, 64, 128 or 256", e->size);
    check_or_zero(c, "example.side_m", e->side_m, 1e-7F, 1e3F);
    for (int i = 0; i < 2; i++) {
        check(c, i ? "example.scale[1]" : "example.scale[0]", e->scale[i], 0.25F, 4.0F);
        check_signed(c, i ? "example.shear[1]" : "example.shear[0]", e->shear[i], 1.0F);
    }
    check_signed(c, "example.rotation_rad", e->rotation_rad, 3.1415927F);
    check(c, "example.scale_variation", e->scale_variation, 0.0F, 0.5F);
    check(c, "example.shear_variation", e->shear_variation, 0.0F, 0.5F);
    check(c, "example.rotation_variation_rad", e->rotation_variation_rad, 0.0F, 3.1415927F);
    check(c, "example.jitter", e->jitter, 0.0F, 1.0F);
    check(c, "example.sigma_h", e->sigma_h, 0.3F, 1.0F);
    check_or_zero(c, "example.sigma_r", e->sigma_r, 1e-3F, 0.5F);
    if (c->result == GLINT_OK)
        check_example_extent(c, e);
    if (c->result == GLINT_OK && e->normals)
        check_example_normals(c, e);
}

static void check_options(complaint *c, const glint_material_options *o)
{
    check_enum(c, "model", (unsigned)o->model, MODEL_COUNT - 1);
    check_enum(c, "distribution", (unsigned)o->distribution, GLINT_DISTRIBUTION_BECKMANN);
    check_enum(c, "fresnel", (unsigned)o->fresnel, GLINT_FRESNEL_CONDUCTOR);
    check_enum(c, "weighting", (unsigned)o->weighting, GLINT_WEIGHTING_EQUAL_PROJECTED_AREA);
    check_surface(c, &o->surface);
    check(c, "facet_alpha", o->facet_alpha, 0.0F, 1.0F);
    check(c, "coverage", o->coverage, 0.0F, 1.0F);
    check(c, "elongation", o->elongation, 1.0F, 1e4F);
    if (o->fresnel == GLINT_FRESNEL_DIELECTRIC)
        check(c, "ior", o->ior, 1.0001F, 10.0F);
    if (o->fresnel == GLINT_FRESNEL_CONDUCTOR)
        for (int i = 0; i < 3; i++) {
            check(c, "eta", o->eta[i], 1e-4F, 20.0F);
            check(c, "k", o->k[i], 0.0F, 20.0F);
        }
    if (o->model == GLINT_MODEL_EXAMPLE)
        check_example(c, &o->example);
    if (!o->allocator.allocate != !o->allocator.release)
        complain(c, GLINT_ERROR_ARGUMENT, "allocator has only one of allocate and release, expected both or neither");
}

/* Features that the options ask for; a model added later may lack some. */
static uint32_t wanted_features(const glint_material_options *o)
{
    return (o->distribution == GLINT_DISTRIBUTION_GGX ? GLINT_FEATURE_GGX : GLINT_FEATURE_BECKMANN) |
           (o->surface.alpha_x != o->surface.alpha_y ? GLINT_FEATURE_ANISOTROPIC : 0U) |
           (o->weighting == GLINT_WEIGHTING_EQUAL_AREA ? GLINT_FEATURE_EQUAL_AREA : GLINT_FEATURE_EQUAL_PROJECTED_AREA);
}

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

glint_result glint_material_create(const glint_material_options *options, glint_material **material, char *message,
                                   size_t message_size)
{
    complaint c = { message, message_size, GLINT_OK };
    if (message && message_size > 0)
        message[0] = '\0';
    if (!material)
        return GLINT_ERROR_ARGUMENT;
    *material = NULL;
    if (!options) {
        complain(&c, GLINT_ERROR_ARGUMENT, "options is NULL");
        return c.result;
    }
    /* An older client knows fewer members, a newer one more; neither is cut short without a word. */
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    if (options->size != sizeof(o)) {
        complain(&c, GLINT_ERROR_ARGUMENT,
                 "options.size is %zu, expected %zu (set it with GLINT_MATERIAL_OPTIONS_INIT)", options->size,
                 sizeof(o));
        return c.result;
    }
    o = *options;
    check_options(&c, &o);
    if (c.result != GLINT_OK)
        return c.result;
    const struct model *model = models[o.model];
    if (wanted_features(&o) & ~model->features) {
        complain(&c, GLINT_ERROR_UNSUPPORTED, "model %s lacks a feature that the options ask for (bits %#x)",
                 model->name, wanted_features(&o) & ~model->features);
        return c.result;
    }
    if (!o.allocator.allocate)
        o.allocator = (glint_allocator){ allocate_default, release_default, NULL };

    struct glint_material *made = o.allocator.allocate(sizeof(*made), o.allocator.user);
    if (made) {
        const ndf n = ndf_of(o.distribution, &o.surface);
        *made = (struct glint_material){ model, o, ndf_total_area(&n), NULL };
        c.result = model->setup ? model->setup(made) : GLINT_OK;
        if (c.result == GLINT_OK) {
            *material = made;
            return GLINT_OK;
        }
        o.allocator.release(made, o.allocator.user);
        c.result = GLINT_OK;
    }
    complain(&c, GLINT_ERROR_MEMORY, "there is not enough memory for a material of model %s", model->name);
    return c.result;
}

void glint_material_destroy(glint_material *material)
{
    if (!material)
        return;
    if (material->model->free)
        material->model->free(material);
    const glint_allocator a = material->options.allocator;
    a.release(material, a.user);
}

glint_model glint_material_model(const glint_material *material)
{
    return material->options.model;
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

static glint_surface clamp_surface(const glint_surface *s)
{
    glint_surface r;
    r.alpha_x = clamp_to(s->alpha_x, LEAST_ALPHA, 1.0F);
    r.alpha_y = clamp_to(s->alpha_y, LEAST_ALPHA, 1.0F);
    for (int i = 0; i < 3; i++) {
        r.diffuse[i] = clamp_to(s->diffuse[i], 0.0F, 1.0F);
        r.f0[i] = clamp_to(s->f0[i], 0.0F, 1.0F);
        r.f90[i] = clamp_to(s->f90[i], 0.0F, 1.0F);
    }
    r.facets_per_m2 = clamp_to(s->facets_per_m2, 0.0F, 1e18F);
    r.discreteness = clamp_to(s->discreteness, 0.0F, 1.0F);
    return r;
}

/* Fills all of *c but wi. False: there is nothing to see from wo. */
static int begin(checked *c, const glint_material *material, const glint_surface *surface, const float wo[3])
{
    if (!material || !wo)
        return 0;
    if (surface)
        c->surface = clamp_surface(surface);
    c->query = (model_query){ .material = material,
                              .surface = surface ? &c->surface : &material->options.surface,
                              .total_area = surface ? 0.0F : material->total_area,
                              .wo = vec3_from(wo) };
    return is_unit(c->query.wo) && c->query.wo.z > 0.0F;
}

/* The light's side. False: wi is not lit. */
static int light_up(checked *c, const glint_footprint *footprint, const float wi[3], float solid_angle_sr)
{
    c->query.wi = vec3_from(wi);
    c->query.footprint = footprint && is_usable(footprint) ? footprint : NULL;
    c->query.solid_angle_sr = clamp_to(solid_angle_sr, 0.0F, 6.28318531F);
    return is_unit(c->query.wi) && c->query.wi.z > 0.0F;
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
    if (!wi || !begin(&c, material, surface, wo) || !light_up(&c, footprint, wi, light ? light->solid_angle_sr : 0.0F))
        return;
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

int glint_sample_direction(const glint_material *material, const glint_surface *surface, const float wo[3],
                           const float random[3], glint_sample *sample)
{
    checked c;
    *sample = (glint_sample){ { 0 }, 0, { 0 } };
    if (!random || !begin(&c, material, surface, wo))
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

float glint_pdf(const glint_material *material, const glint_surface *surface, const float wo[3], const float wi[3])
{
    checked c;
    if (!wi || !begin(&c, material, surface, wo) || !light_up(&c, NULL, wi, 0.0F))
        return 0.0F;
    return clamp_to(material->model->pdf(&c.query), 0.0F, 3e38F);
}

/* ---- batches ---- */

static int has_all(const glint_batch *b)
{
    const void *const arrays[] = { b->u,      b->v,     b->dudx,  b->dudy,  b->dvdx,  b->dvdy,           b->wo[0],
                                   b->wo[1],  b->wo[2], b->wi[0], b->wi[1], b->wi[2], b->solid_angle_sr, b->rgb[0],
                                   b->rgb[1], b->rgb[2] };
    for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); i++)
        if (!arrays[i])
            return 0;
    return 1;
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
            const float wi[3] = { batch->wi[0][i], batch->wi[1][i], batch->wi[2][i] };
            footprint[j] = (glint_footprint){ batch->u[i],
                                              batch->v[i],
                                              batch->dudx[i],
                                              batch->dudy[i],
                                              batch->dvdx[i],
                                              batch->dvdy[i],
                                              batch->seed ? batch->seed[i] : 0U };
            batch->rgb[0][i] = batch->rgb[1][i] = batch->rgb[2][i] = 0.0F;
            if (!begin(&c[j], material, batch->surfaces ? &batch->surfaces[i] : NULL, wo) ||
                !light_up(&c[j], &footprint[j], wi, batch->solid_angle_sr[i]))
                continue;
            query[lit] = c[j].query;
            index[lit++] = i;
        }
        if (lit == 0)
            continue;
        material->model->eval_many(query, lit, value);
        for (size_t j = 0; j < lit; j++) {
            make_finite(&value[j]);
            for (int k = 0; k < 3; k++)
                batch->rgb[k][index[j]] = value[j].rgb[k];
        }
    }
    return GLINT_OK;
}
