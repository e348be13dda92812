/* A camera ray through the layers of blended surfaces; behind each layer one path of indirect light. */
#include "preview/camera_sample.h"

#include <string.h>

#include "preview/hash.h"
#include "preview/rig.h"

/* Blended layers one behind the other that a camera ray looks through, and the light that is too weak to follow. Taste.
 */
#define MOST_LAYERS 64
#define LEAST_TRANSMITTANCE 1e-4F
/* Blocks of pixels under counting vary as those under explicit facets within 15 % from 4 x 4 on (docs/truth.md). */
#define MOST_GLINT_SIDE 4

/* ---- what the camera sees ---- */

static void describe_first_hit(const world *w, const vertex *v, const direct_facets *facets, pixel_sample *out)
{
    const vec3 n = v->point.layer_count > 0 ? v->point.layers[0].z : v->hit.normal;
    out->normal[0] = (float)n.x;
    out->normal[1] = (float)n.y;
    out->normal[2] = (float)n.z;
    memcpy(out->albedo, v->point.albedo, sizeof out->albedo);
    out->depth = (float)camera_depth(w->camera, v->hit.position);
    out->facet_count = facets->count * (float)(w->glint_side * w->glint_side);
    out->lit_probability = facets->lit_probability;
}

static void add_layer(pixel_sample *out, const radiance *from, float share)
{
    for (int c = 0; c < 3; ++c) {
        out->light.discrete[c] += share * from->discrete[c];
        out->light.smooth[c] += share * from->smooth[c];
    }
    out->alpha += share;
}

static void add_seen_sky(const world *w, vec3 direction, float share, pixel_sample *out)
{
    radiance sky = { 0 };
    if (!EFFECT_ENVIRONMENT || !w->sky_seen)
        return;
    if (w->environment != NULL)
        environment_seen(w->environment, direction, sky.discrete);
    else
        sky_radiance(&w->sky, direction, sky.discrete);
    memcpy(sky.smooth, sky.discrete, sizeof sky.smooth);
    add_layer(out, &sky, share);
}

void world_take_samples(world *w, int spp, int model)
{
    int side = 1;
    while (4 * side * side <= spp)
        side *= 2;
    w->spp = spp;
    w->footprint_side = side;
    w->glint_side = model == GLINT_MODEL_EXPLICIT || side < MOST_GLINT_SIDE ? side : MOST_GLINT_SIDE;
}

/* The ray goes through any point of its stratum, the footprint is the stratum itself, or the tile that it lies in.
 * Around the ray's own point the footprints of a pixel's samples would overlap here and leave gaps there, and pixels
 * would vary by up to 40 % more than the facets under them. */
static void tile_footprints(const world *w, const double jitter[2], shade_point *point)
{
    double to_middle[2];
    const float larger = (float)w->footprint_side / (float)w->glint_side;
    for (int k = 0; k < 2; ++k) {
        const double at = jitter[k] * w->glint_side;
        to_middle[k] = floor(at) + 0.5 - at;
    }
    for (int i = 0; i < shade_layers(point); ++i) {
        glint_footprint *const f = &point->layers[i].footprint;
        if (!point->layers[i].counts)
            continue;
        f->dudx *= larger;
        f->dudy *= larger;
        f->dvdx *= larger;
        f->dvdy *= larger;
        f->u += to_middle[0] * (double)f->dudx + to_middle[1] * (double)f->dudy;
        f->v += to_middle[0] * (double)f->dvdx + to_middle[1] * (double)f->dvdy;
    }
}

/* ---- the steps of a sample ---- */

void camera_sample_leave(const world *w, int x, int y, uint32_t index, camera_sample *s)
{
    s->first = s->random = sampler_make(x, y, index, w->seed);
    s->layer = 0;
    s->transmittance = 1.0F;
    sampler_pair(&s->random, path_dimension(0, DIM_PIXEL), s->jitter);
    camera_ray(w->camera, x + s->jitter[0], y + s->jitter[1], &s->vertex.ray, &s->vertex.step);
    s->vertex.step = differential_scale(&s->vertex.step, 1.0 / w->footprint_side);
}

void camera_sample_leave_many(const world *w, uint32_t index, camera_batch *b, camera_sample samples[CAMERA_BATCH])
{
    const sampler any = sampler_again(0U, index);
    b->dimension = path_dimension(0, DIM_PIXEL);
    b->scale = 1.0 / w->footprint_side;
    for (int i = 0; i < CAMERA_BATCH; ++i)
        b->reversed[i] = any.reversed;
    w->kernels->camera(w->camera, b);
    for (int i = 0; i < CAMERA_BATCH; ++i) {
        camera_sample *const s = &samples[i];
        s->first = s->random = (sampler){ b->pixel[i], index, any.reversed };
        s->layer = 0;
        s->transmittance = 1.0F;
        s->jitter[0] = b->jitter[0][i];
        s->jitter[1] = b->jitter[1][i];
        camera_batch_take(b, i, &s->vertex.ray, &s->vertex.step);
    }
}

void camera_sample_look(const world *w, camera_sample *s)
{
    path_look(w, &s->vertex, &s->random, 0);
    if (EFFECT_FACETS && s->vertex.point.counts)
        tile_footprints(w, s->jitter, &s->vertex.point);
    s->facets = (direct_facets){ 0 };
    for (int c = 0; c < 3; ++c)
        s->light.discrete[c] = s->light.smooth[c] = EFFECT_EMISSION ? s->vertex.point.emission[c] : 0.0F;
}

void camera_sample_miss(const world *w, const camera_sample *s, pixel_sample *out)
{
    if (s->layer == 0)
        *out = (pixel_sample){ 0 };
    add_seen_sky(w, s->vertex.ray.direction, s->transmittance, out);
}

void camera_sample_end(const world *w, const camera_sample *s, bool described, pixel_sample *out)
{
    if (s->layer == 0) {
        *out = (pixel_sample){ 0 };
        if (EFFECT_DESCRIPTION && described)
            describe_first_hit(w, &s->vertex, &s->facets, out);
    }
    add_layer(out, &s->light, EFFECT_ALPHA ? s->transmittance * s->vertex.point.opacity : 1.0F);
}

/* The samples of a layer that is seen through others are spread apart from theirs. */
bool camera_sample_go_on(camera_sample *s)
{
    s->transmittance *= 1.0F - s->vertex.point.opacity;
    if (!(s->transmittance > LEAST_TRANSMITTANCE) || ++s->layer == MOST_LAYERS)
        return false;
    /* Behind it, by more than the rounding of single precision. */
    s->vertex.ray.near = s->vertex.hit.distance * (1.0 + 0x1p-20);
    s->random.pixel = hash_combine(s->first.pixel, (uint32_t)s->layer);
    return true;
}

const float camera_sample_throughput[3] = { 1.0F, 1.0F, 1.0F };

/* ---- a sample by itself ---- */

/* All light that the surface sends to the camera. */
static void add_light(const world *w, camera_sample *s, ray_counts *counts)
{
    const vertex *const v = &s->vertex;
    const float *const all = camera_sample_throughput;
    const direct_point point = { v, &s->random, all, &s->light, &s->facets, 0 };
    add_direct_light(w, &point, path_dimension(0, DIM_LIGHTS), counts);
    add_glow(w, &v->hit, &v->point, &s->random, path_dimension(0, DIM_GLOW), all, &s->light, &s->facets, counts);
    add_surroundings(w, &v->hit, &v->point, &s->random, path_dimension(0, DIM_SURROUNDINGS), all, &s->light, &s->facets,
                     counts);
    add_indirect_light(w, v, &s->random, &s->light, counts);
}

bool integrate_first(const world *w, int x, int y, uint32_t index, vertex *v)
{
    camera_sample s;
    camera_sample_leave(w, x, y, index, &s);
    const hit_task task = path_hit(&s.vertex);
    if (!trace_closest(w->trace, &s.vertex.ray, TRACE_BLEND_SOLID, &s.vertex.found))
        return false;
    hit_resolve(w->geometry, &task);
    camera_sample_look(w, &s);
    *v = s.vertex;
    return true;
}

void integrate(const world *w, int x, int y, uint32_t index, pixel_sample *out, ray_counts *counts)
{
    camera_sample s;
    const hit_task task = path_hit(&s.vertex);
    camera_sample_leave(w, x, y, index, &s);
    do {
        ++counts->camera_rays;
        if (!trace_closest(w->trace, &s.vertex.ray, TRACE_BLEND_SOLID, &s.vertex.found)) {
            camera_sample_miss(w, &s, out);
            return;
        }
        hit_resolve(w->geometry, &task);
        camera_sample_look(w, &s);
        add_light(w, &s, counts);
        camera_sample_end(w, &s, true, out);
    } while (camera_sample_go_on(&s));
}
