/* How the layers of a prepared point scatter light: evaluation and sampling of their sum, and what a cone sees of them.
 */
#define WIDE_LANES 1
#include "preview/shade_parts.h"
#include "preview/sight_lanes.h"

/* How far above the horizon of a coat the middle of a light is taken to be at least: sin of about a degree. Taste. */
#define LOWEST 0.02

static vec3 to_world(const shade_layer *layer, const float local[3])
{
    const vec3 in_plane = v3_mad(v3_scale(layer->x, (double)local[0]), layer->y, (double)local[1]);
    return v3_normalize(v3_mad(in_plane, layer->z, (double)local[2]));
}

void shade_below_coat(const shade_point *p, const vec3 *wi, float rgb[3])
{
    const shade_layer *const layer = &p->layers[1];
    const glint_coat coat = { .surface = layer->surface,
                              .weight = layer->weight,
                              .normal = { 0.0F, 0.0F, 1.0F },
                              .tangent = { 1.0F, 0.0F, 0.0F } };
    float local[3];
    if (wi != NULL)
        shade_to_local(layer, *wi, local);
    glint_transmittance(p->whole, &coat, layer->wo, wi != NULL ? local : NULL, rgb);
}

/* How much of a layer's light from wi is seen. */
static void weigh(const shade_point *p, int i, vec3 wi, float weight[3])
{
    if (i == 0 && shade_layers(p) == 2)
        shade_below_coat(p, &wi, weight);
    else
        weight[0] = weight[1] = weight[2] = p->layers[i].weight;
}

/* A slope distribution of roughness alpha has the variance alpha^2 / 2 per axis; variances add. */
static float widened(float alpha, double slope_variance)
{
    return (float)fmin(sqrt((double)alpha * (double)alpha + 2.0 * slope_variance), 1.0);
}

/* Of the half vector, in square radians: a cone about as wide as the sun. */
#define WIDE_CONE 1e-5

void shade_widen(shade_point *p, double slope_variance)
{
    for (int i = 0; i < shade_layers(p); ++i) {
        glint_surface *const s = &p->layers[i].surface;
        /* It sees the mean of the flashes of many directions: to count facets there would add noise and nothing else.
         */
        if (slope_variance > WIDE_CONE)
            p->layers[i].counts = false;
        p->layers[i].is_own = false;
        s->alpha_x = widened(s->alpha_x, slope_variance);
        s->alpha_y = widened(s->alpha_y, slope_variance);
    }
}

bool shade_faces(const shade_point *p, vec3 wi)
{
    for (int i = 0; i < shade_layers(p); ++i) {
        if (p->layers[i].wo[2] > 0.0F && v3_dot(wi, p->layers[i].z) > 0.0)
            return true;
    }
    return false;
}

/* The facets of both layers together, as glint_value has them. */
static void add_facets(const glint_value *layer, glint_value *sum)
{
    const float both = sum->facet_count + layer->facet_count;
    const float lit = sum->facet_count * sum->lit_probability + layer->facet_count * layer->lit_probability;
    const bool is_first = !(sum->facet_count > 0.0F);
    sum->lit_probability = is_first || !(both > 0.0F) ? layer->lit_probability : fminf(lit / both, 1.0F);
    sum->facet_count = both;
    sum->over_limit = sum->over_limit || layer->over_limit;
}

void shade_add_layer(const shade_point *p, int i, vec3 wi, const glint_value *one, glint_value *sum)
{
    float weight[3];
    weigh(p, i, wi, weight);
    for (int c = 0; c < 3; ++c) {
        sum->rgb[c] += weight[c] * one->rgb[c];
        sum->smooth[c] += weight[c] * one->smooth[c];
    }
    if (p->layers[i].counts)
        add_facets(one, sum);
}

void shade_eval(const shade_point *p, vec3 wi, float solid_angle_sr, glint_value *value)
{
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle_sr };
    *value = (glint_value){ 0 };
    for (int i = 0; i < shade_layers(p); ++i) {
        const shade_layer *const layer = &p->layers[i];
        float local[3];
        glint_value one;
        shade_to_local(layer, wi, local);
        glint_eval_value(layer->material, shade_surface(layer), layer->counts ? &layer->footprint : NULL, layer->wo,
                         local, &light, &one);
        shade_add_layer(p, i, wi, &one, value);
    }
}

/* ---- lights as shapes ---- */

double shade_cap_error(const shade_point *p, vec3 wi, double sine)
{
    double most = 0.0;
    for (int i = 0; i < shade_layers(p); ++i) {
        const wide_layer layer = sight_layer_of(&p->layers[i]);
        double local[3];
        to_local(&layer, w3_splat(wi), local);
        if (fabs(local[2]) < sine)
            return (double)INFINITY;
        most = fmax(most, cap_error(&layer, local, sine));
    }
    return most;
}

void shade_area_to_local(const shade_layer *layer, const shade_area *from, glint_area_light *to)
{
    *to = (glint_area_light){ .kind = from->kind,
                              .hidden = from->hidden,
                              .radius = (float)from->radius,
                              .solid_angle_sr = from->solid_angle_sr };
    shade_to_local(layer, from->center, to->center);
    shade_to_local(layer, from->half_x, to->half_x);
    shade_to_local(layer, from->half_y, to->half_y);
}

/* A direction to the light for what the coat leaves of the base, which changes little over it: to its middle, or the
 * nearest above the coat's horizon. */
vec3 shade_towards_area(const shade_point *p, const shade_area *area)
{
    const vec3 z = p->layers[shade_layers(p) - 1].z;
    const vec3 middle = v3_normalize(area->center);
    const double height = v3_dot(middle, z);
    return height >= LOWEST ? middle : v3_normalize(v3_mad(middle, z, LOWEST - height));
}

void shade_eval_area(const shade_point *p, const shade_area *area, glint_value *value)
{
    const vec3 middle = shade_towards_area(p, area);
    *value = (glint_value){ 0 };
    for (int i = 0; i < shade_layers(p); ++i) {
        const shade_layer *const layer = &p->layers[i];
        glint_area_light light;
        glint_value one;
        shade_area_to_local(layer, area, &light);
        glint_eval_area(layer->material, shade_surface(layer), layer->counts ? &layer->footprint : NULL, layer->wo,
                        &light, &one);
        shade_add_layer(p, i, middle, &one, value);
    }
}

bool shade_faces_area(const shade_point *p, const shade_area *area)
{
    for (int i = 0; i < shade_layers(p); ++i) {
        const vec3 z = p->layers[i].z;
        const double highest =
            v3_dot(area->center, z) + fabs(v3_dot(area->half_x, z)) + fabs(v3_dot(area->half_y, z)) + area->radius;
        if (p->layers[i].wo[2] > 0.0F && highest > 0.0)
            return true;
    }
    return false;
}

float shade_level(const shade_point *p, vec3 wi)
{
    float sum = 0.0F;
    for (int i = 0; i < shade_layers(p); ++i) {
        const shade_layer *const layer = &p->layers[i];
        float local[3], rgb[3];
        shade_to_local(layer, wi, local);
        glint_eval(layer->material, &layer->surface, NULL, layer->wo, local, NULL, rgb);
        sum += layer->weight * (rgb[0] + rgb[1] + rgb[2]) / 3.0F;
    }
    return sum;
}

/* ---- sampling ---- */

/* A guess of how much a layer reflects, which only steers the choice between layers. */
static float importance(const shade_layer *layer)
{
    const glint_surface *const s = &layer->surface;
    const float away = 1.0F - fminf(fmaxf(layer->wo[2], 0.0F), 1.0F);
    const float fifth = away * away * away * away * away;
    float sum = 0.0F;
    for (int c = 0; c < 3; ++c)
        sum += s->diffuse[c] + s->f0[c] + (s->f90[c] - s->f0[c]) * fifth;
    return layer->weight * sum;
}

/* The probability that shade_sample chooses a layer. */
static float share_of(const shade_point *p, int layer)
{
    if (shade_layers(p) < 2)
        return 1.0F;
    const float base = importance(&p->layers[0]);
    const float coat = importance(&p->layers[1]);
    const float share_of_coat = base + coat > 0.0F ? coat / (base + coat) : 0.5F;
    return layer == 1 ? share_of_coat : 1.0F - share_of_coat;
}

/* glTF: occlusion darkens diffuse light from all around, nothing else. */
static glint_surface surface_in_surroundings(const shade_point *p, const shade_layer *layer)
{
    glint_surface surface = layer->surface;
    for (int c = 0; c < 3; ++c)
        surface.diffuse[c] *= p->occlusion;
    return surface;
}

float shade_pdf(const shade_point *p, vec3 wi)
{
    float sum = 0.0F;
    for (int i = 0; i < shade_layers(p); ++i) {
        const shade_layer *const layer = &p->layers[i];
        const glint_surface surface = surface_in_surroundings(p, layer);
        float local[3];
        shade_to_local(layer, wi, local);
        sum += share_of(p, i) * glint_pdf(layer->material, &surface, NULL, layer->wo, local);
    }
    return sum;
}

bool shade_sample(const shade_point *p, float choose_layer, const float random[3], shade_direction *out)
{
    if (p->layer_count == 0)
        return false;
    const int chosen = shade_layers(p) == 2 && choose_layer < share_of(p, 1) ? 1 : 0;
    const float share = share_of(p, chosen);
    const shade_layer *const layer = &p->layers[chosen];
    const glint_surface surface = surface_in_surroundings(p, layer);

    glint_sample sample;
    if (!glint_sample_direction(layer->material, &surface, NULL, layer->wo, random, &sample))
        return false;
    out->layer = chosen;
    out->wi = to_world(layer, sample.wi);
    out->pdf = sample.pdf * share;
    float weight[3];
    weigh(p, (int)(layer - p->layers), out->wi, weight);
    for (int c = 0; c < 3; ++c)
        out->weight[c] = sample.weight[c] * weight[c] / share;
    return true;
}

/* ---- light from all around, found in two ways ---- */

float shade_patch_density(const shade_point *p, int i, const shade_surroundings *s)
{
    const shade_layer *const layer = &p->layers[i];
    const glint_surface surface = surface_in_surroundings(p, layer);
    float local[3];
    shade_to_local(layer, s->wi, local);
    return s->light_pdf + share_of(p, i) * glint_pdf(layer->material, &surface, NULL, layer->wo, local);
}

void shade_patch_set(const shade_point *p, int i, const shade_surroundings *s, float density, shade_patch *to)
{
    const float expected = s->solid_angle_sr * density;
    to->grown = expected < 1.0F ? fminf(1.0F / expected, s->most_samples) : 1.0F;
    to->density = density;
    to->solid_angle_sr = fminf(s->solid_angle_sr, (float)(2.0 * PREVIEW_PI));
    to->layer = p->layers[i];
    to->layer.is_own = false;
    to->layer.surface = surface_in_surroundings(p, &p->layers[i]);
    glint_footprint *const f = &to->layer.footprint;
    const float longer = sqrtf(to->grown);
    f->dudx *= longer;
    f->dudy *= longer;
    f->dvdx *= longer;
    f->dvdy *= longer;
}

static void eval_patch(const shade_patch *patch, vec3 wi, glint_value *value)
{
    const glint_light light = { GLINT_LIGHT_CAP, patch->solid_angle_sr };
    const shade_layer *const layer = &patch->layer;
    float local[3];
    shade_to_local(layer, wi, local);
    glint_eval_value(layer->material, &layer->surface, layer->counts ? &layer->footprint : NULL, layer->wo, local,
                     &light, value);
}

void shade_add_patch(const shade_point *p, int i, vec3 wi, const shade_patch *patch, glint_value *one, glint_value *sum)
{
    float weight[3];
    weigh(p, i, wi, weight);
    for (int c = 0; c < 3; ++c) {
        sum->rgb[c] += weight[c] * one->rgb[c] / patch->density;
        sum->smooth[c] += weight[c] * one->smooth[c] / patch->density;
    }
    one->facet_count /= patch->grown;
    if (patch->layer.counts)
        add_facets(one, sum);
}

void shade_eval_surroundings(const shade_point *p, const shade_surroundings *s, glint_value *value)
{
    *value = (glint_value){ 0 };
    for (int i = 0; i < shade_layers(p); ++i) {
        const float density = shade_patch_density(p, i, s);
        shade_patch patch;
        glint_value one;
        if (!(density > 0.0F))
            continue;
        shade_patch_set(p, i, s, density, &patch);
        eval_patch(&patch, s->wi, &one);
        shade_add_patch(p, i, s->wi, &patch, &one, value);
    }
}

void shade_eval_found(const shade_point *p, const shade_surroundings *s, const shade_direction *found,
                      glint_value *value)
{
    const shade_layer *const layer = &p->layers[found->layer];
    const float density = s->light_pdf + found->pdf;
    const bool counts = layer->counts && s->solid_angle_sr > 0.0F;
    glint_value one = { 0 };
    *value = (glint_value){ 0 };
    if (counts) {
        shade_patch patch;
        shade_patch_set(p, found->layer, s, density, &patch);
        eval_patch(&patch, s->wi, &one);
        one.facet_count /= patch.grown;
        add_facets(&one, value);
    }
    for (int c = 0; c < 3; ++c) {
        /* The sample's own quotient: a sharp lobe at a rounded direction would give another. */
        value->smooth[c] = found->weight[c] * (found->pdf / density);
        value->rgb[c] = value->smooth[c];
        if (counts && one.smooth[c] > 0.0F)
            value->rgb[c] *= one.rgb[c] / one.smooth[c];
    }
}
