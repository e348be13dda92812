/* The checks that let models trust what they are called with. */
#include "glint_query.h"

#include <stddef.h>
#include <string.h>

#include "glint_options.h"

/* Every number of a surface into its range, as clamp_to does, but all at once: as integers, floats that are not
 * negative keep their order, negative ones are below, and NaNs above infinity. Written where they belong, without the
 * coat: a copy of the whole would wait for them. */
static void clamp_surface(glint_surface *to, const glint_surface *s)
{
    static const glint_surface least = { LEAST_ALPHA, LEAST_ALPHA, { 0 }, { 0 }, { 0 }, 0.0F, 0.0F, NULL };
    static const glint_surface most = { 1.0F, 1.0F, { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 }, 1e18F, 1.0F, NULL };
    enum { COUNT = offsetof(glint_surface, coat) / sizeof(int32_t) };
    for (size_t i = 0; i < COUNT; i++) {
        int32_t x, low, high;
        memcpy(&x, (const char *)s + i * sizeof(x), sizeof(x));
        memcpy(&low, (const char *)&least + i * sizeof(x), sizeof(x));
        memcpy(&high, (const char *)&most + i * sizeof(x), sizeof(x));
        x = x > 0x7f800000 ? low : x;
        x = x > low ? x : low;
        x = x < high ? x : high;
        memcpy((char *)to + i * sizeof(x), &x, sizeof(x));
    }
    to->coat = NULL;
}

/* False: its normal or its tangent is no direction. */
static int clamp_coat(glint_coat *c, const glint_coat *from)
{
    static const glint_footprint degenerate = { 0 };
    *c = *from;
    clamp_surface(&c->surface, &from->surface);
    c->weight = clamp_to(from->weight, 0.0F, 1.0F);
    if (from->footprint && !is_usable(from->footprint))
        c->footprint = &degenerate;
    return is_unit(vec3_from(from->normal)) && is_unit(vec3_from(from->tangent));
}

int query_fill(model_query *q, checked *c, const glint_material *material, const glint_surface *surface,
               const glint_footprint *footprint)
{
    if (!LIBRARY_SURFACES)
        surface = NULL;
    if (surface)
        clamp_surface(&c->surface, surface);
    *q = (model_query){ .material = material,
                        .surface = surface ? &c->surface : &material->options.surface,
                        .total_area = surface ? 0.0F : material->total_area,
                        .footprint = footprint && is_usable(footprint) ? footprint : NULL };
    if (query_has_horizon(material) || !surface || !surface->coat)
        return 1;
    c->surface.coat = &c->coat;
    return clamp_coat(&c->coat, surface->coat);
}

int query_begin(model_query *q, checked *c, const glint_material *material, const glint_surface *surface,
                const glint_footprint *footprint, const float wo[3])
{
    if (!material || !wo || !query_fill(q, c, material, surface, footprint))
        return 0;
    q->wo = vec3_from(wo);
    return is_unit(q->wo) && (!query_has_horizon(material) || q->wo.z > 0.0F);
}

int query_light(model_query *q, const float wi[3], float solid_angle_sr)
{
    q->wi = vec3_from(wi);
    q->solid_angle_sr = query_solid_angle(solid_angle_sr);
    return is_unit(q->wi) && (!query_has_horizon(q->material) || q->wi.z > 0.0F);
}

/* All eight numbers at once, in the manner of clamp_surface. */
void value_make_finite(glint_value *value)
{
    enum { COUNT = offsetof(glint_value, over_limit) / sizeof(int32_t) };
    const int32_t most = (int32_t)bits_of_float(3e38F);
    int32_t bits[COUNT];
    memcpy(bits, value, sizeof(bits));
    for (size_t i = 0; i < COUNT; i++) {
        int32_t x = bits[i];
        x = x > 0x7f800000 ? 0 : x;
        x = x > 0 ? x : 0;
        bits[i] = x < most ? x : most;
    }
    memcpy(value, bits, sizeof(bits));
}
