/* Any number of rays, in packets of neighbours. */
#include "preview/trace.h"

void trace_closest_many(const trace_scene *t, const trace_ray *const *rays, int count, trace_blending blending,
                        trace_hit *hits, bool *met)
{
    for (int first = 0; first < count; first += TRACE_PACKET) {
        const int size = count - first < TRACE_PACKET ? count - first : TRACE_PACKET;
        const trace_ray *packet[TRACE_PACKET] = { NULL };
        trace_hit found[TRACE_PACKET] = { { 0 } };
        for (int i = 0; i < size; ++i)
            packet[i] = rays[first + i];
        const uint32_t any = trace_closest_packet(t, packet, blending, found);
        for (int i = 0; i < size; ++i) {
            met[first + i] = any >> i & 1U;
            if (met[first + i])
                hits[first + i] = found[i];
            hits[first + i].through_back = found[i].through_back;
        }
    }
}

void trace_occluded_many(const trace_scene *t, const trace_ray *rays, int count, bool *dark)
{
    for (int first = 0; first < count; first += TRACE_PACKET) {
        const int size = count - first < TRACE_PACKET ? count - first : TRACE_PACKET;
        const trace_ray *packet[TRACE_PACKET] = { NULL };
        for (int i = 0; i < size; ++i)
            packet[i] = &rays[first + i];
        const uint32_t any = trace_occluded_packet(t, packet);
        for (int i = 0; i < size; ++i)
            dark[first + i] = any >> i & 1U;
    }
}
