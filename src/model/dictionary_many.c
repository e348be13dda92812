/* Chooses the width of the vectors that look cells up, and fills the last. */
#include "model/dictionary_kernel.h"

dictionary_width dictionary_widest(size_t most_lanes)
{
    switch (machine_lanes(most_lanes)) {
#if defined(__x86_64__)
    case 16:
        return (dictionary_width){ dictionary_weigh_16, dictionary_look_16 };
    case 8:
        return (dictionary_width){ dictionary_weigh_8, dictionary_look_8 };
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return (dictionary_width){ dictionary_weigh_4, dictionary_look_4 };
#endif
    default:
        return (dictionary_width){ dictionary_weigh_1, dictionary_look_1 };
    }
}

static size_t padded(size_t count)
{
    return (count + MOST_LANES - 1) / MOST_LANES * MOST_LANES;
}

void dictionary_corners_weigh(dictionary_corners *c, size_t count, uint32_t *hash, float *weight)
{
    for (size_t i = count; i < padded(count); i++) {
        c->row[i] = c->low[i] = c->high[i] = 0U;
        c->r2[i] = 0.0F;
    }
    dictionary_widest(MOST_LANES).weigh(c, padded(count), hash, weight);
}

void dictionary_cells_density(const dictionary_surface *surface, dictionary_cells *cells, size_t count, slope at,
                              float *density)
{
    const float to_x = DICTIONARY_ALPHA / surface->target.alpha_x, to_y = DICTIONARY_ALPHA / surface->target.alpha_y;
    for (size_t i = count; i < padded(count); i++) {
        cells->hash[i] = 0U;
        cells->log4_facets[i] = 0.0F;
    }
    dictionary_widest(MOST_LANES)
        .look(surface->table, surface->target.kind, cells, padded(count), at.x * to_x, at.y * to_y, density);
    for (size_t i = 0; i < count; i++)
        density[i] = density[i] * to_x * to_y;
}
