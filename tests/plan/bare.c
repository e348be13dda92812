/* A renderer of nothing but plain surfaces of one material under round lights, written without looking for
 * anything else: what such a scene has to cost. Its rays run in packets, and the library gets batches, as in the
 * previewer. */
#include "bare.h"

#include "preview/camera_batch.h"
#include "preview/film.h"
#include "preview/light_batch.h"
#include "preview/place.h"
#include "preview/sampler.h"
#include "preview/shade_parts.h"

/* As in src/preview/integrator.c: the same samples make the same pixels. */
enum { DIM_PIXEL = 0, DIM_LIGHTS = 5 };

enum { SIDE = 8, PACKET = 4, COUNT = SIDE * SIDE };

static void look(const world *w, vertex *v)
{
    float density_scale;
    const scene *const s = w->shader.scene;
    const int material = v->hit.mesh->material;
    shade_layer *const layer = &v->point.layers[0];
    v->point.layer_count = 1;
    layer->material = w->shader.materials->layers[material].base;
    layer->counts = w->shader.materials->layers[material].base_counts;
    shade_set_frame(layer, v->hit.normal, v->hit.tangent, v3_scale(v->ray.direction, -1.0));
    if (layer->counts) {
        layer->footprint = place_footprint(&s->materials[material].glint, &v->hit, &v->hit_step, 0.0F, &density_scale);
    }
}

static void tile(const world *w, const double jitter[2][COUNT], int pixel, glint_footprint *f)
{
    const float larger = (float)w->footprint_side / (float)w->glint_side;
    double to_middle[2];
    for (int k = 0; k < 2; ++k) {
        const double at = jitter[k][pixel] * w->glint_side;
        to_middle[k] = floor(at) + 0.5 - at;
    }
    f->dudx *= larger;
    f->dudy *= larger;
    f->dvdx *= larger;
    f->dvdy *= larger;
    f->u += to_middle[0] * (double)f->dudx + to_middle[1] * (double)f->dudy;
    f->v += to_middle[0] * (double)f->dvdx + to_middle[1] * (double)f->dvdy;
}

/* ---- a block of pixels ---- */

typedef struct bare_block {
    int x[COUNT], y[COUNT];
    sampler random[COUNT];
    camera_batch camera;
    vertex v[COUNT];
    int hit[COUNT], hits; /* which of them are */
    light_batch lights;   /* of those */
    pixel_sample out[COUNT];
} bare_block;

/* What the points of one light ask the library, of the one material that there is. */
typedef struct bare_batch {
    const vertex *v[COUNT];
    pixel_sample *out[COUNT];
    float irradiance[COUNT][3];
    double at[2][COUNT];
    float step[4][COUNT], wo[3][COUNT], wi[3][COUNT], solid_angle_sr[COUNT], rgb[3][COUNT];
    uint32_t seed[COUNT];
    size_t count;
} bare_batch;

static void add_point(bare_batch *b, const vertex *v, const light_batch *seen, int point, pixel_sample *out)
{
    const shade_layer *const layer = &v->point.layers[0];
    const size_t i = b->count++;
    const vec3 wi = v3(seen->wi[0][point], seen->wi[1][point], seen->wi[2][point]);
    const vec3 axes[3] = { layer->x, layer->y, layer->z };
    for (int c = 0; c < 3; ++c) {
        b->wo[c][i] = layer->wo[c];
        b->wi[c][i] = (float)v3_dot(wi, axes[c]);
        b->irradiance[i][c] = seen->irradiance[c][point];
    }
    b->at[0][i] = layer->footprint.u;
    b->at[1][i] = layer->footprint.v;
    b->step[0][i] = layer->footprint.dudx;
    b->step[1][i] = layer->footprint.dudy;
    b->step[2][i] = layer->footprint.dvdx;
    b->step[3][i] = layer->footprint.dvdy;
    b->seed[i] = layer->footprint.seed;
    b->solid_angle_sr[i] = seen->solid_angle_sr[point];
    b->v[i] = v;
    b->out[i] = out;
}

static void add_batch(bare_batch *b)
{
    if (b->count == 0)
        return;
    const glint_batch batch = { .size = sizeof batch,
                                .count = b->count,
                                .u = b->at[0],
                                .v = b->at[1],
                                .dudx = b->step[0],
                                .dudy = b->step[1],
                                .dvdx = b->step[2],
                                .dvdy = b->step[3],
                                .seed = b->seed,
                                .wo = { b->wo[0], b->wo[1], b->wo[2] },
                                .wi = { b->wi[0], b->wi[1], b->wi[2] },
                                .solid_angle_sr = b->solid_angle_sr,
                                .rgb = { b->rgb[0], b->rgb[1], b->rgb[2] } };
    glint_eval_batch(b->v[0]->point.layers[0].material, &batch);
    for (size_t i = 0; i < b->count; ++i)
        for (int c = 0; c < 3; ++c)
            b->out[i]->light.discrete[c] += b->irradiance[i][c] * b->rgb[c][i];
}

static void look_at_lights(const world *w, bare_block *b)
{
    b->lights.count = b->hits;
    b->lights.layers = 1;
    for (int i = 0; i < b->hits || i % w->kernels->lanes != 0; ++i) {
        const int at = b->hit[i < b->hits ? i : b->hits - 1];
        light_batch_set(&b->lights, i, &b->v[at].hit, &b->v[at].point, &b->random[at]);
    }
}

static void add_light(const world *w, int index, bare_block *b)
{
    const light *const l = &w->lights[index];
    light_batch *const seen = &b->lights;
    trace_ray shadow[COUNT];
    bool dark[COUNT];
    int count = 0;
    bare_batch batch;
    batch.count = 0;
    w->kernels->light(l, DIM_LIGHTS + (uint32_t)index, seen);
    for (int i = 0; i < b->hits; ++i)
        if (seen->seen >> i & 1U)
            shadow[count++] =
                (trace_ray){ .origin = v3(seen->origin[0][i], seen->origin[1][i], seen->origin[2][i]),
                             .direction = v3(seen->direction[0][i], seen->direction[1][i], seen->direction[2][i]),
                             .far = seen->far[i] };
    trace_occluded_many(w->trace, shadow, count, dark);
    count = 0;
    for (int i = 0; i < b->hits; ++i)
        if ((seen->seen >> i & 1U) && !dark[count++])
            add_point(&batch, &b->v[b->hit[i]], seen, i, &b->out[b->hit[i]]);
    add_batch(&batch);
}

static void leave(const world *w, uint32_t index, bare_block *b)
{
    b->camera.dimension = DIM_PIXEL;
    b->camera.scale = 1.0 / w->footprint_side;
    for (int i = 0; i < COUNT; ++i) {
        b->random[i] = sampler_again(b->camera.pixel[i], index);
        b->camera.reversed[i] = b->random[i].reversed;
    }
    w->kernels->camera(w->camera, &b->camera);
    for (int i = 0; i < COUNT; ++i)
        camera_batch_take(&b->camera, i, &b->v[i].ray, &b->v[i].step);
}

static void look_at_packet(const world *w, int first, bare_block *b)
{
    const trace_ray *rays[TRACE_PACKET];
    trace_hit found[TRACE_PACKET];
    for (int i = 0; i < TRACE_PACKET; ++i)
        rays[i] = &b->v[first + i].ray;
    const uint32_t met = trace_closest_packet(w->trace, rays, TRACE_BLEND_SOLID, found);
    hit_task tasks[TRACE_PACKET];
    int count = 0;
    for (int i = 0; i < TRACE_PACKET; ++i) {
        vertex *const v = &b->v[first + i];
        b->out[first + i] = (pixel_sample){ .alpha = (float)(met >> i & 1U) };
        if (!(met >> i & 1U))
            continue;
        b->hit[b->hits + count] = first + i;
        v->found = found[i];
        tasks[count++] = (hit_task){ &v->ray, &v->step, &v->found, &v->hit, &v->hit_step };
    }
    hit_resolve_many(w->geometry, w->kernels, tasks, count);
    for (int end = b->hits + count; b->hits < end; ++b->hits) {
        const int at = b->hit[b->hits];
        vertex *const v = &b->v[at];
        look(w, v);
        if (v->point.layers[0].counts)
            tile(w, b->camera.jitter, at, &v->point.layers[0].footprint);
    }
}

static void render_block(const world *w, int x, int y, bare_block *b, image *film)
{
    film_pixel pixels[COUNT] = { 0 };
    for (int i = 0; i < COUNT; ++i) {
        const int packet = i / TRACE_PACKET, entry = i % TRACE_PACKET;
        b->x[i] = x + packet % (SIDE / PACKET) * PACKET + entry % PACKET;
        b->y[i] = y + packet / (SIDE / PACKET) * PACKET + entry / PACKET;
        b->camera.x[i] = b->x[i];
        b->camera.y[i] = b->y[i];
        b->camera.pixel[i] = sampler_make(b->x[i], b->y[i], 0U, w->seed).pixel;
    }
    for (int index = 0; index < w->spp; ++index) {
        b->hits = 0;
        leave(w, (uint32_t)index, b);
        for (int first = 0; first < COUNT; first += TRACE_PACKET)
            look_at_packet(w, first, b);
        look_at_lights(w, b);
        for (int i = 0; i < w->light_count; ++i)
            add_light(w, i, b);
        for (int i = 0; i < COUNT; ++i)
            film_add(&pixels[i], &b->out[i], false);
    }
    for (int i = 0; i < COUNT; ++i)
        film_write(film, b->x[i], b->y[i], &pixels[i]);
}

void bare_render(const world *w, image *film)
{
    static bare_block b;
    for (int y = 0; y < film->height; y += SIDE)
        for (int x = 0; x < film->width; x += SIDE)
            render_block(w, x, y, &b, film);
}
