/* A renderer of nothing but plain surfaces under round lights, written without looking for anything else: what such a
 * scene has to cost. */
#include "bare.h"

#include "preview/film.h"
#include "preview/hash.h"
#include "preview/place.h"
#include "preview/sampler.h"
#include "preview/shade_parts.h"
#include "scene/surface.h"

/* As in src/preview/integrator.c: the same samples make the same pixels. */
enum { DIM_PIXEL = 0, DIM_LIGHTS = 5, DIM_DRAW = (1 << 20) - 3 };

static void look(const world *w, const sampler *random, vertex *v)
{
    float density_scale;
    const scene *const s = w->shader.scene;
    hit_resolve(w->geometry, &v->ray, &v->found, &v->hit);
    v->hit_step = hit_differentiate(&v->hit, &v->step, v->ray.direction);
    const int material = v->hit.mesh->material;
    const scene_texels t = scene_texels_of(&s->materials[material]);
    shade_layer *const layer = &v->point.layers[0];
    v->point.layer_count = 1;
    layer->material = w->shader.materials->layers[material].base;
    layer->counts = w->shader.materials->layers[material].base_counts;
    layer->surface = scene_base_surface(&s->materials[material], &t);
    shade_set_frame(layer, v->hit.normal, v->hit.tangent, v3_scale(v->ray.direction, -1.0));
    if (layer->counts) {
        layer->footprint = place_footprint(&s->materials[material].glint, &v->hit, &v->hit_step, 0.0F, &density_scale);
        layer->surface.facets_per_m2 *= density_scale;
        layer->footprint.draw = hash_combine(sampler_bits(random, DIM_DRAW), 0U);
    }
}

static void tile(const world *w, const double jitter[2], glint_footprint *f)
{
    const float larger = (float)w->footprint_side / (float)w->glint_side;
    double to_middle[2];
    for (int k = 0; k < 2; ++k) {
        const double at = jitter[k] * w->glint_side;
        to_middle[k] = floor(at) + 0.5 - at;
    }
    f->dudx *= larger;
    f->dudy *= larger;
    f->dvdx *= larger;
    f->dvdy *= larger;
    f->u += to_middle[0] * (double)f->dudx + to_middle[1] * (double)f->dudy;
    f->v += to_middle[0] * (double)f->dvdx + to_middle[1] * (double)f->dvdy;
}

static bool is_lit(const world *w, const vertex *v, const light *l, const light_view *view, const sampler *random,
                   uint32_t dimension)
{
    static const double u[2] = { 0.0, 0.0 };
    trace_ray ray = { .origin = hit_leave(&v->hit, v->hit.shadow_origin) };
    if (!(v->point.layers[0].wo[2] > 0.0F && v3_dot(view->wi, v->point.layers[0].z) > 0.0))
        return false;
    if (l->unshadowed)
        return true;
    light_pick(l, view, ray.origin, u, &ray.direction, &ray.far);
    return !trace_occluded(w->trace, &ray);
}

static void add_lights(const world *w, const vertex *v, const sampler *random, radiance *sum)
{
    const shade_layer *const layer = &v->point.layers[0];
    for (int i = 0; i < w->light_count; ++i) {
        light_view view;
        glint_value value;
        if (!light_see(&w->lights[i], v->hit.position, &view) ||
            !is_lit(w, v, &w->lights[i], &view, random, DIM_LIGHTS + (uint32_t)i))
            continue;
        const float wi[3] = { (float)v3_dot(view.wi, layer->x), (float)v3_dot(view.wi, layer->y),
                              (float)v3_dot(view.wi, layer->z) };
        const glint_light cap = { GLINT_LIGHT_CAP, view.solid_angle_sr };
        glint_eval_value(layer->material, &layer->surface, layer->counts ? &layer->footprint : NULL, layer->wo, wi,
                         &cap, &value);
        for (int c = 0; c < 3; ++c)
            sum->discrete[c] += view.irradiance[c] * value.rgb[c];
    }
}

static void sample_pixel(const world *w, int x, int y, uint32_t index, pixel_sample *out)
{
    double jitter[2];
    vertex v;
    const sampler random = sampler_make(x, y, index, w->seed);
    *out = (pixel_sample){ 0 };
    sampler_pair(&random, DIM_PIXEL, jitter);
    camera_ray(w->camera, x + jitter[0], y + jitter[1], &v.ray, &v.step);
    v.step = differential_scale(&v.step, 1.0 / w->footprint_side);
    if (!trace_closest(w->trace, &v.ray, TRACE_BLEND_SOLID, &v.found))
        return;
    look(w, &random, &v);
    if (v.point.layers[0].counts)
        tile(w, jitter, &v.point.layers[0].footprint);
    add_lights(w, &v, &random, &out->light);
    out->alpha = 1.0F;
}

void bare_render(const world *w, image *film)
{
    for (int y = 0; y < film->height; ++y)
        for (int x = 0; x < film->width; ++x) {
            film_pixel pixel = { 0 };
            for (int i = 0; i < w->spp; ++i) {
                pixel_sample sample;
                sample_pixel(w, x, y, (uint32_t)i, &sample);
                film_add(&pixel, &sample, false);
            }
            film_write(film, x, y, &pixel);
        }
}
