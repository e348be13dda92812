/* A camera ray through the layers of blended surfaces; behind each layer one path of indirect light. */
#include "preview/camera_sample.h"

#include <string.h>

#include "preview/hash.h"
#include "preview/rig.h"
#include "preview/sampler.h"
#include "preview/surroundings.h"

/* Blended layers one behind the other that a camera ray looks through, and the light that is too weak to follow. Taste.
 */
#define MOST_LAYERS 64
#define LEAST_TRANSMITTANCE 1e-4F
/* Blocks of pixels under counting vary as those under explicit facets within 15 % from 4 x 4 on (docs/truth.md). */
#define MOST_GLINT_SIDE 4
/* The largest single-precision number below 1: uniforms must not reach 1. */
#define BELOW_ONE 0x1.fffffep-1F

/* What the sampler's dimensions are for. Those of the lights follow the others, up to that of the surroundings. */
enum {
    DIM_PIXEL,
    DIM_PLACE,
    DIM_LOBE,
    DIM_DIRECTION,
    DIM_BLEND,
    DIM_LIGHTS,
    DIM_DRAW = (1 << 20) - 3,
    DIM_GLOW,
    DIM_SURROUNDINGS
};

/* Every depth of a path has dimensions of its own, with room for 2^19 lights, of which each may ask for two. */
static uint32_t dimension(int depth, uint32_t purpose)
{
    return ((uint32_t)depth << 20) + purpose;
}

static const float all[3] = { 1.0F, 1.0F, 1.0F }; /* of the light that a camera ray meets */

static float to_uniform(double u)
{
    return fminf((float)u, BELOW_ONE);
}

/* Makes what the ray has found ready for light. */
static void look(const world *w, vertex *v, const sampler *random, int depth)
{
    double choice[2] = { 0.0, 0.0 };
    hit_resolve(w->geometry, &v->ray, &v->found, &v->hit);
    v->hit_step = hit_differentiate(&v->hit, &v->step, v->ray.direction);
    if (shade_wants_choice(&w->shader, &v->hit))
        sampler_pair(random, dimension(depth, DIM_PLACE), choice);
    shade_prepare(&w->shader, &v->hit, &v->hit_step, v3_scale(v->ray.direction, -1.0), to_uniform(choice[0]),
                  &v->point);
    for (int i = 0; i < v->point.layer_count; ++i)
        if (v->point.layers[i].counts)
            v->point.layers[i].footprint.draw =
                hash_combine(sampler_bits(random, dimension(depth, DIM_DRAW)), (uint32_t)i);
}

static void add_light(radiance *sum, const float throughput[3], const float added[3])
{
    for (int c = 0; c < 3; ++c) {
        sum->discrete[c] += throughput[c] * added[c];
        sum->smooth[c] += throughput[c] * added[c];
    }
}

/* Draws the next ray of a path, with the differential of a reflection about the half vector: the facet that sends the
 * ray there turns with the surface. False: the path ends. */
static bool leave(const world *w, vertex *v, const sampler *random, int depth, shade_direction *next)
{
    double lobe[2], u[2];
    sampler_pair(random, dimension(depth, DIM_LOBE), lobe);
    sampler_pair(random, dimension(depth, DIM_DIRECTION), u);
    const float three[3] = { to_uniform(lobe[0]), to_uniform(u[0]), to_uniform(u[1]) };
    if (!shade_sample(&v->point, to_uniform(lobe[1]), three, next) || !(next->pdf > 0.0F))
        return false;
    if (v3_dot(next->wi, v->hit.geometric_normal) <= 0.0) /* into the surface, through a bent normal */
        return false;

    const vec3 half = v3_normalize(v3_sub(next->wi, v->ray.direction));
    v->step = differential_reflect(&v->step, v->ray.direction, half, &v->hit_step.position, &v->turn);
    differential_widen(&v->step, next->wi, fmin(1.0 / ((double)next->pdf * w->spp), 2.0 * PREVIEW_PI));
    v->ray =
        (trace_ray){ .origin = hit_leave(&v->hit, v->hit.position), .direction = next->wi, .far = (double)INFINITY };
    if (w->is_blended)
        v->ray.random = sampler_bits(random, dimension(depth, DIM_BLEND));
    return true;
}

/* Light that arrives at the vertex from the sky and from other surfaces. */
static void add_indirect_light(const world *w, const vertex *from, const sampler *random, radiance *sum,
                               ray_counts *counts)
{
    float throughput[3] = { 1.0F, 1.0F, 1.0F };
    if (w->bounces < 1 && !w->has_sky)
        return;
    vertex v = *from;
    v.turn = hit_turn(&v.hit, &v.hit_step);
    for (int depth = 1; depth <= w->bounces || w->has_sky; ++depth) {
        shade_direction next;
        shade_point left;
        if (w->emitters != NULL)
            left = v.point;
        if (!leave(w, &v, random, depth - 1, &next))
            return;
        ++counts->bounce_rays;
        if (!trace_closest(w->trace, &v.ray, TRACE_BLEND_RANDOM, &v.found)) {
            add_escaped_light(w, &v.point, &next, throughput, sum, counts);
            return;
        }
        if (depth > w->bounces)
            return;
        look(w, &v, random, depth);
        v.turn = hit_turn(&v.hit, &v.hit_step);
        const bool sampled = w->emitters != NULL && add_found_glow(w, &left, &next, &v.found, &v.hit, v.point.emission,
                                                                   throughput, sum, counts);
        for (int c = 0; c < 3; ++c)
            throughput[c] *= next.weight[c];
        shade_widen(&v.point, differential_half_vector_variance(&v.step, &v.turn));
        if (!sampled)
            add_light(sum, throughput, v.point.emission);
        add_direct_light(w, &v.hit, &v.point, random, dimension(depth, DIM_LIGHTS), throughput, sum, NULL, counts);
        if (depth < w->bounces)
            add_glow(w, &v.hit, &v.point, random, dimension(depth, DIM_GLOW), throughput, sum, NULL, counts);
        add_surroundings(w, &v.hit, &v.point, random, dimension(depth, DIM_SURROUNDINGS), throughput, sum, NULL,
                         counts);
    }
}

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
    if (!w->sky_seen)
        return;
    if (w->environment != NULL)
        environment_seen(w->environment, direction, sky.discrete);
    else
        sky_radiance(&w->sky, direction, sky.discrete);
    memcpy(sky.smooth, sky.discrete, sizeof sky.smooth);
    add_layer(out, &sky, share);
}

/* The samples of a layer that is seen through others are spread apart from theirs. */
static sampler sampler_of_layer(const sampler *pixel, int layer)
{
    sampler own = *pixel;
    if (layer > 0)
        own.pixel = hash_combine(pixel->pixel, (uint32_t)layer);
    return own;
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
    for (int i = 0; i < point->layer_count; ++i) {
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

/* What the ray has found, under the footprint of the sample. */
void camera_sample_look(const world *w, camera_sample *s)
{
    look(w, &s->vertex, &s->random, 0);
    tile_footprints(w, s->jitter, &s->vertex.point);
    s->facets = (direct_facets){ 0 };
    for (int c = 0; c < 3; ++c)
        s->light.discrete[c] = s->light.smooth[c] = s->vertex.point.emission[c];
}

static void add_lights(const world *w, camera_sample *s, ray_counts *counts)
{
    add_direct_light(w, &s->vertex.hit, &s->vertex.point, &s->random, dimension(0, DIM_LIGHTS), all, &s->light,
                     &s->facets, counts);
}

/* All other light that the surface sends to the camera. */
static void add_other_light(const world *w, camera_sample *s, ray_counts *counts)
{
    const vertex *const v = &s->vertex;
    add_glow(w, &v->hit, &v->point, &s->random, dimension(0, DIM_GLOW), all, &s->light, &s->facets, counts);
    add_surroundings(w, &v->hit, &v->point, &s->random, dimension(0, DIM_SURROUNDINGS), all, &s->light, &s->facets,
                     counts);
    add_indirect_light(w, v, &s->random, &s->light, counts);
}

/* Through the first surface, to those behind it. */
static void look_behind(const world *w, camera_sample *s, pixel_sample *out, ray_counts *counts)
{
    const sampler first = s->random;
    float transmittance = 1.0F;
    for (int layer = 1; layer < MOST_LAYERS; ++layer) {
        transmittance *= 1.0F - s->vertex.point.opacity;
        if (!(transmittance > LEAST_TRANSMITTANCE))
            return;
        /* Behind it, by more than the rounding of single precision. */
        s->vertex.ray.near = s->vertex.hit.distance * (1.0 + 0x1p-20);
        s->random = sampler_of_layer(&first, layer);
        ++counts->camera_rays;
        if (!trace_closest(w->trace, &s->vertex.ray, TRACE_BLEND_SOLID, &s->vertex.found)) {
            add_seen_sky(w, s->vertex.ray.direction, transmittance, out);
            return;
        }
        camera_sample_look(w, s);
        add_lights(w, s, counts);
        add_other_light(w, s, counts);
        add_layer(out, &s->light, transmittance * s->vertex.point.opacity);
    }
}

/* ---- the steps of a sample ---- */

void camera_sample_leave(const world *w, int x, int y, uint32_t index, camera_sample *s)
{
    s->random = sampler_make(x, y, index, w->seed);
    sampler_pair(&s->random, dimension(0, DIM_PIXEL), s->jitter);
    camera_ray(w->camera, x + s->jitter[0], y + s->jitter[1], &s->vertex.ray, &s->vertex.step);
    s->vertex.step = differential_scale(&s->vertex.step, 1.0 / w->footprint_side);
}

uint32_t camera_sample_lights(void)
{
    return dimension(0, DIM_LIGHTS);
}

void camera_sample_miss(const world *w, const camera_sample *s, pixel_sample *out)
{
    *out = (pixel_sample){ 0 };
    add_seen_sky(w, s->vertex.ray.direction, 1.0F, out);
}

void camera_sample_end(const world *w, camera_sample *s, bool described, pixel_sample *out, ray_counts *counts)
{
    *out = (pixel_sample){ 0 };
    add_other_light(w, s, counts);
    if (described)
        describe_first_hit(w, &s->vertex, &s->facets, out);
    add_layer(out, &s->light, s->vertex.point.opacity);
    if (s->vertex.point.opacity < 1.0F)
        look_behind(w, s, out, counts);
}

bool integrate_first(const world *w, int x, int y, uint32_t index, vertex *v)
{
    camera_sample s;
    camera_sample_leave(w, x, y, index, &s);
    if (!trace_closest(w->trace, &s.vertex.ray, TRACE_BLEND_SOLID, &s.vertex.found))
        return false;
    camera_sample_look(w, &s);
    *v = s.vertex;
    return true;
}

void integrate(const world *w, int x, int y, uint32_t index, pixel_sample *out, ray_counts *counts)
{
    camera_sample s;
    camera_sample_leave(w, x, y, index, &s);
    ++counts->camera_rays;
    if (!trace_closest(w->trace, &s.vertex.ray, TRACE_BLEND_SOLID, &s.vertex.found)) {
        camera_sample_miss(w, &s, out);
        return;
    }
    camera_sample_look(w, &s);
    add_lights(w, &s, counts);
    camera_sample_end(w, &s, true, out, counts);
}
