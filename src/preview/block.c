/* A packet is a square of pixels of the picture, always the same, and a block is always whole: of surfaces that
 * coincide the ray next door may decide which is seen, and a picture shall not depend on the tiles that it is cut into.
 * So pixels that no one wants to see are rendered where a tile ends within a block. */
#include "preview/block.h"

/* A packet has 4 x 4 pixels. */
#define PACKET_SIDE 4

void block_begin(block *b, int x, int y, const block_window *window, uint32_t seed)
{
    const int across = BLOCK_SIDE / PACKET_SIDE;
    for (int i = 0; i < BLOCK_PIXELS; ++i) {
        const int packet = i / TRACE_PACKET, entry = i % TRACE_PACKET;
        b->x[i] = x + packet % across * PACKET_SIDE + entry % PACKET_SIDE;
        b->y[i] = y + packet / across * PACKET_SIDE + entry / PACKET_SIDE;
        b->is_seen[i] =
            b->x[i] >= window->left && b->x[i] < window->right && b->y[i] >= window->top && b->y[i] < window->bottom;
        b->camera.x[i] = b->x[i];
        b->camera.y[i] = b->y[i];
        b->camera.pixel[i] = sampler_make(b->x[i], b->y[i], 0U, seed).pixel;
    }
}

static bool is_in_picture(const world *w, const block *b, int entry)
{
    return b->x[entry] < w->camera->width && b->y[entry] < w->camera->height;
}

/* What the ray of a pixel has met; look_closer comes back to that. */
static void look(const world *w, block *b, int entry, bool met, const trace_hit *found, ray_counts *counts)
{
    camera_sample *const s = &b->samples[entry];
    ++counts->camera_rays;
    if (!met) {
        camera_sample_miss(w, s, &b->seen[entry]);
        return;
    }
    s->vertex.found = *found;
    b->scratch.tasks[b->point_count] = path_hit(&s->vertex);
    b->points[b->point_count++] =
        (direct_point){ &s->vertex, &s->random, camera_sample_throughput, &s->light, &s->facets, entry };
}

static void look_closer(const world *w, block *b)
{
    hit_resolve_many(w->geometry, w->kernels, b->scratch.tasks, b->point_count);
    for (int i = 0; i < b->point_count; ++i)
        camera_sample_look(w, &b->samples[b->points[i].entry]);
}

static void look_first(const world *w, block *b, uint32_t index, ray_counts *counts)
{
    b->point_count = 0;
    camera_sample_leave_many(w, index, &b->camera, b->samples);
    for (int first = 0; first < BLOCK_PIXELS; first += TRACE_PACKET) {
        const trace_ray *rays[TRACE_PACKET] = { NULL };
        trace_hit hits[TRACE_PACKET];
        for (int i = 0; i < TRACE_PACKET; ++i)
            if (is_in_picture(w, b, first + i))
                rays[i] = &b->samples[first + i].vertex.ray;
        const uint32_t met = trace_closest_packet(w->trace, rays, TRACE_BLEND_SOLID, hits);
        for (int i = 0; i < TRACE_PACKET; ++i)
            if (rays[i] != NULL)
                look(w, b, first + i, met >> i & 1U, &hits[i], counts);
    }
    look_closer(w, b);
}

static void add_light(const world *w, block *b, ray_counts *counts)
{
    path_scratch *const s = &b->scratch;
    add_direct_light_to_many(w, b->points, b->point_count, path_dimension(0, DIM_LIGHTS), &s->direct, counts);
    add_glow_to_many(w, b->points, b->point_count, path_dimension(0, DIM_GLOW), &s->surroundings, counts);
    add_surroundings_to_many(w, b->points, b->point_count, path_dimension(0, DIM_SURROUNDINGS), &s->surroundings,
                             counts);
    add_indirect_light_to_many(w, b->points, b->point_count, s, counts);
}

/* Through the surfaces that have been looked at. */
static void look_behind(const world *w, block *b, ray_counts *counts)
{
    path_scratch *const s = &b->scratch;
    int entries[BLOCK_PIXELS], count = 0;
    for (int i = 0; i < b->point_count; ++i) {
        const int entry = b->points[i].entry;
        if (!camera_sample_go_on(&b->samples[entry]))
            continue;
        s->rays[count] = &b->samples[entry].vertex.ray;
        entries[count++] = entry;
    }
    trace_closest_many(w->trace, s->rays, count, TRACE_BLEND_SOLID, s->hits, s->met);
    b->point_count = 0;
    for (int i = 0; i < count; ++i)
        look(w, b, entries[i], s->met[i], &s->hits[i], counts);
    look_closer(w, b);
}

void block_integrate(const world *w, block *b, uint32_t index, bool described, ray_counts *counts)
{
    look_first(w, b, index, counts);
    while (b->point_count > 0) {
        add_light(w, b, counts);
        for (int i = 0; i < b->point_count; ++i) {
            const int entry = b->points[i].entry;
            camera_sample_end(w, &b->samples[entry], described, &b->seen[entry]);
        }
        if (!EFFECT_ALPHA || !w->is_blended)
            return;
        look_behind(w, b, counts);
    }
}
