/* A camera ray through the layers of blended surfaces; behind each layer one path of indirect light. */
#include "preview/integrator.h"

#include <string.h>

#include "preview/direct.h"
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
    v->ray = (trace_ray){ .origin = hit_leave(&v->hit, v->hit.position),
                          .direction = next->wi,
                          .far = (double)INFINITY,
                          .random = sampler_bits(random, dimension(depth, DIM_BLEND)) };
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

/* All the light that a surface sends to the camera. */
static radiance light_of_layer(const world *w, const vertex *v, const sampler *random, direct_facets *facets,
                               ray_counts *counts)
{
    static const float all[3] = { 1.0F, 1.0F, 1.0F };
    radiance sum = { 0 };
    add_light(&sum, all, v->point.emission);
    add_direct_light(w, &v->hit, &v->point, random, dimension(0, DIM_LIGHTS), all, &sum, facets, counts);
    add_glow(w, &v->hit, &v->point, random, dimension(0, DIM_GLOW), all, &sum, facets, counts);
    add_surroundings(w, &v->hit, &v->point, random, dimension(0, DIM_SURROUNDINGS), all, &sum, facets, counts);
    add_indirect_light(w, v, random, &sum, counts);
    return sum;
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

int preview_footprint_side(int spp)
{
    int side = 1;
    while (4 * side * side <= spp)
        side *= 2;
    return side;
}

int preview_glint_side(const preview_options *o)
{
    const int side = preview_footprint_side(o->spp);
    return o->model == GLINT_MODEL_EXPLICIT || side < MOST_GLINT_SIDE ? side : MOST_GLINT_SIDE;
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

/* A ray through a point of the pixel. */
static void leave_camera(const world *w, int x, int y, const sampler *pixel, double jitter[2], vertex *v)
{
    sampler_pair(pixel, dimension(0, DIM_PIXEL), jitter);
    camera_ray(w->camera, x + jitter[0], y + jitter[1], &v->ray, &v->step);
    v->step = differential_scale(&v->step, 1.0 / w->footprint_side);
}

bool integrate_first(const world *w, int x, int y, uint32_t index, vertex *v)
{
    double jitter[2];
    const sampler pixel = sampler_make(x, y, index, w->seed);
    leave_camera(w, x, y, &pixel, jitter, v);
    if (!trace_closest(w->trace, &v->ray, TRACE_BLEND_SOLID, &v->found))
        return false;
    look(w, v, &pixel, 0);
    tile_footprints(w, jitter, &v->point);
    return true;
}

void integrate(const world *w, int x, int y, uint32_t index, pixel_sample *out, ray_counts *counts)
{
    *out = (pixel_sample){ 0 };
    double jitter[2];
    const sampler pixel = sampler_make(x, y, index, w->seed);
    vertex v;
    leave_camera(w, x, y, &pixel, jitter, &v);

    float transmittance = 1.0F;
    for (int layer = 0; layer < MOST_LAYERS && transmittance > LEAST_TRANSMITTANCE; ++layer) {
        const sampler random = sampler_of_layer(&pixel, layer);
        ++counts->camera_rays;
        if (!trace_closest(w->trace, &v.ray, TRACE_BLEND_SOLID, &v.found)) {
            add_seen_sky(w, v.ray.direction, transmittance, out);
            return;
        }
        look(w, &v, &random, 0);
        tile_footprints(w, jitter, &v.point);
        direct_facets facets = { 0 };
        const radiance seen = light_of_layer(w, &v, &random, &facets, counts);
        if (layer == 0)
            describe_first_hit(w, &v, &facets, out);
        add_layer(out, &seen, transmittance * v.point.opacity);
        transmittance *= 1.0F - v.point.opacity;
        v.ray.near = v.hit.distance * (1.0 + 0x1p-20); /* behind it, by more than the rounding of single precision */
    }
}
