/* Checks what a client asks for, and names the option, its value and its range when it cannot be had. */
#include "glint_options.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "math/float_bits.h"
#include "model/example.h"

void complain(complaint *c, glint_result result, const char *format, ...)
{
    if (c->result != GLINT_OK)
        return;
    c->result = result;
    if (c->text && c->size > 0) {
        va_list arguments;
        const size_t length = (size_t)snprintf(c->text, c->size, "%s", c->scope ? c->scope : "");
        const size_t start = length < c->size ? length : c->size - 1;
        va_start(arguments, format);
        vsnprintf(c->text + start, c->size - start, format, arguments);
        va_end(arguments);
    }
}

static void check(complaint *c, const char *name, float x, float low, float high)
{
    if (!in_range(x, low, high))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected %g to %g", name, printable(x), (double)low, (double)high);
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

static void check_colors(complaint *c, const glint_material_options *o)
{
    check(c, "color_variation", o->color_variation, 0.0F, 1.0F);
    if (o->color_count > GLINT_MAX_COLORS) {
        complain(c, GLINT_ERROR_RANGE, "color_count is %u, expected 0 to %d", (unsigned)o->color_count,
                 GLINT_MAX_COLORS);
        return;
    }
    for (uint32_t i = 0; i < 3 * o->color_count; i++) {
        char name[32];
        snprintf(name, sizeof(name), "colors[%u][%u]", (unsigned)i / 3U, (unsigned)i % 3U);
        check(c, name, o->colors[i / 3][i % 3], 0.0F, 1.0F);
    }
}

/* |x| <= most, for 0 <= most. */
static void check_signed(complaint *c, const char *name, float x, float most)
{
    if (!in_range(fabsf(x), 0.0F, most))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected %g to %g", name, printable(x), (double)-most, (double)most);
}

/* 0, or low <= x <= high. */
static void check_or_zero(complaint *c, const char *name, float x, float low, float high)
{
    if (!in_range(x, 0.0F, 0.0F) && !in_range(x, low, high))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected 0 or %g to %g", name, printable(x), (double)low,
                 (double)high);
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
                     i, i / e->size, i % e->size, printable(n[0]), printable(n[1]));
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

/* |v|^2 is 1 give or take what rounding and typed digits do. No product of numbers that are none. */
static int is_unit(const float v[3])
{
    for (int i = 0; i < 3; i++)
        if (!is_below(v[i], 1.02F))
            return 0;
    return in_range(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 0.98F, 1.02F);
}

static void check_unit(complaint *c, const char *name, const float v[3])
{
    if (!is_unit(v))
        complain(c, GLINT_ERROR_RANGE, "%s is (%g, %g, %g), expected a vector of length 1", name, printable(v[0]),
                 printable(v[1]), printable(v[2]));
}

static void check_layers(complaint *c, const glint_layers *layers)
{
    if (!layers->base || !layers->coat)
        complain(c, GLINT_ERROR_ARGUMENT, "layers.%s is NULL, expected the options of that layer",
                 layers->base ? "coat" : "base");
    check(c, "layers.coat_weight", layers->coat_weight, 0.0F, 1.0F);
    check_unit(c, "layers.coat_normal", layers->coat_normal);
    check_unit(c, "layers.coat_tangent", layers->coat_tangent);
}

/* The value of every option by itself. */
static void check_values(complaint *c, const glint_material_options *o)
{
    check_enum(c, "model", (unsigned)o->model, glint_model_count() - 1);
    check_enum(c, "distribution", (unsigned)o->distribution, GLINT_DISTRIBUTION_BECKMANN);
    check_enum(c, "fresnel", (unsigned)o->fresnel, GLINT_FRESNEL_CONDUCTOR);
    check_enum(c, "weighting", (unsigned)o->weighting, GLINT_WEIGHTING_EQUAL_PROJECTED_AREA);
    check_enum(c, "area_light_method", (unsigned)o->area_light_method, GLINT_AREA_LIGHT_EXACT);
    check_enum(c, "facet_hash", (unsigned)o->facet_hash, GLINT_FACET_HASH_POVRAY);
    if (o->facet_limit > 100000000U)
        complain(c, GLINT_ERROR_RANGE, "facet_limit is %u, expected 0 to 100000000", o->facet_limit);
    check_surface(c, &o->surface);
    check(c, "facet_alpha", o->facet_alpha, 0.0F, 1.0F);
    check(c, "coverage", o->coverage, 0.0F, 1.0F);
    check(c, "elongation", o->elongation, 1.0F, 1e4F);
    check(c, "density_variation", o->density_variation, 0.0F, 8.0F);
    check(c, "max_anisotropy", o->max_anisotropy, 1.0F, 16.0F);
    check(c, "smooth_deviation", o->smooth_deviation, 0.0F, 1e6F);
    check(c, "draw_deviation", o->draw_deviation, 0.0F, 1e6F);
    check_colors(c, o);
    if (o->fresnel == GLINT_FRESNEL_DIELECTRIC)
        check(c, "ior", o->ior, 1.0001F, 10.0F);
    if (o->fresnel == GLINT_FRESNEL_CONDUCTOR)
        for (int i = 0; i < 3; i++) {
            check(c, "eta", o->eta[i], 1e-4F, 20.0F);
            check(c, "k", o->k[i], 0.0F, 20.0F);
        }
    if (o->model == GLINT_MODEL_EXAMPLE)
        check_example(c, &o->example);
    if (o->model == GLINT_MODEL_LAYERED)
        check_layers(c, &o->layers);
    if (!o->allocator.allocate != !o->allocator.release)
        complain(c, GLINT_ERROR_ARGUMENT, "allocator has only one of allocate and release, expected both or neither");
}

/* Features that the options ask for; a model added later may lack some. */
static uint32_t wanted_features(const glint_material_options *o)
{
    return (o->distribution == GLINT_DISTRIBUTION_GGX ? GLINT_FEATURE_GGX : GLINT_FEATURE_BECKMANN) |
           (o->surface.alpha_x != o->surface.alpha_y ? GLINT_FEATURE_ANISOTROPIC : 0U) |
           (o->color_variation > 0.0F || o->color_count > 0U ? GLINT_FEATURE_COLOR : 0U) |
           (o->weighting == GLINT_WEIGHTING_EQUAL_AREA ? GLINT_FEATURE_EQUAL_AREA : GLINT_FEATURE_EQUAL_PROJECTED_AREA);
}

/* Whether a material can be made from these options, but for its layers. */
static void check_material(complaint *c, const glint_material_options *o)
{
    /* An older client knows fewer members, a newer one more; neither is cut short without a word. */
    if (o->size != sizeof(*o)) {
        complain(c, GLINT_ERROR_ARGUMENT, "size is %zu, expected %zu (set it with GLINT_MATERIAL_OPTIONS_INIT)",
                 o->size, sizeof(*o));
        return;
    }
    check_values(c, o);
    if (c->result != GLINT_OK)
        return;
    if (wanted_features(o) & ~glint_model_features(o->model))
        complain(c, GLINT_ERROR_UNSUPPORTED, "model %s lacks a feature that the options ask for (bits %#x)",
                 glint_model_name(o->model), wanted_features(o) & ~glint_model_features(o->model));
}

/* The options of both layers. */
static void check_both_layers(complaint *c, const glint_layers *layers)
{
    const glint_material_options *const both[2] = { layers->base, layers->coat };
    static const char *const names[2] = { "layers.base.", "layers.coat." };
    for (int i = 0; i < 2 && c->result == GLINT_OK; i++) {
        c->scope = names[i];
        check_material(c, both[i]);
        if (c->result == GLINT_OK && both[i]->model == GLINT_MODEL_LAYERED)
            complain(c, GLINT_ERROR_UNSUPPORTED, "model is layered, expected a model of one layer");
    }
    c->scope = NULL;
}

void check_options(complaint *c, const glint_material_options *o)
{
    check_material(c, o);
    if (c->result == GLINT_OK && o->model == GLINT_MODEL_LAYERED)
        check_both_layers(c, &o->layers);
}
