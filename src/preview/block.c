/* A packet is a square of pixels of the picture, always the same and always whole: of surfaces that coincide the ray
 * next door may decide which is seen, and a picture shall not depend on the tiles that it is cut into. */
#include "preview/block.h"

/* A packet has 4 x 4 pixels. */
#define PACKET_SIDE 4

void block_begin(block *b, int x, int y, const block_window *window)
{
    const int across = BLOCK_SIDE / PACKET_SIDE;
    for (int i = 0; i < BLOCK_PIXELS; ++i) {
        const int packet = i / TRACE_PACKET, entry = i % TRACE_PACKET;
        b->x[i] = x + packet % across * PACKET_SIDE + entry % PACKET_SIDE;
        b->y[i] = y + packet / across * PACKET_SIDE + entry / PACKET_SIDE;
        b->is_seen[i] =
            b->x[i] >= window->left && b->x[i] < window->right && b->y[i] >= window->top && b->y[i] < window->bottom;
    }
}

static bool is_wanted(const block *b, int first)
{
    for (int i = first; i < first + TRACE_PACKET; ++i)
        if (b->is_seen[i])
            return true;
    return false;
}

/* The rays of a packet, as far as it is in the picture. */
static void leave(const world *w, block *b, int first, uint32_t index, const trace_ray *rays[TRACE_PACKET])
{
    for (int i = 0; i < TRACE_PACKET; ++i) {
        camera_sample *const s = &b->samples[first + i];
        const int x = b->x[first + i], y = b->y[first + i];
        rays[i] = NULL;
        if (x >= w->camera->width || y >= w->camera->height)
            continue;
        camera_sample_leave(w, x, y, index, s);
        rays[i] = &s->vertex.ray;
    }
}

/* What the rays have met. Returns how many points there are then. */
static int look(const world *w, block *b, int first, uint32_t found, const trace_hit hits[TRACE_PACKET], int points,
                ray_counts *counts)
{
    for (int i = 0; i < TRACE_PACKET; ++i) {
        const int entry = first + i;
        camera_sample *const s = &b->samples[entry];
        if (!b->is_seen[entry])
            continue;
        ++counts->camera_rays;
        if (!(found >> i & 1U)) {
            camera_sample_miss(w, s, &b->seen[entry]);
            continue;
        }
        s->vertex.found = hits[i];
        camera_sample_look(w, s);
        b->points[points++] =
            (direct_point){ &s->vertex.hit, &s->vertex.point, &s->random, &s->light, &s->facets, entry };
    }
    return points;
}

void block_integrate(const world *w, block *b, uint32_t index, bool described, ray_counts *counts)
{
    int points = 0;
    for (int first = 0; first < BLOCK_PIXELS; first += TRACE_PACKET) {
        const trace_ray *rays[TRACE_PACKET];
        trace_hit hits[TRACE_PACKET];
        if (!is_wanted(b, first))
            continue;
        leave(w, b, first, index, rays);
        const uint32_t found = trace_closest_packet(w->trace, rays, TRACE_BLEND_SOLID, hits);
        points = look(w, b, first, found, hits, points, counts);
    }
    add_direct_light_to_many(w, b->points, points, camera_sample_lights(), &b->direct, counts);
    for (int i = 0; i < points; ++i) {
        const int entry = b->points[i].entry;
        camera_sample_end(w, &b->samples[entry], described, &b->seen[entry], counts);
    }
}
