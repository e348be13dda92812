/* Chooses the width of the vectors that look cells up, and fills the last. */
#include "model/dictionary_kernel.h"

dictionary_kernel *dictionary_kernel_widest(size_t most_lanes)
{
    switch (machine_lanes(most_lanes)) {
#if defined(__x86_64__)
    case 16:
        return dictionary_kernel_16;
    case 8:
        return dictionary_kernel_8;
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return dictionary_kernel_4;
#endif
    default:
        return dictionary_kernel_1;
    }
}

void dictionary_cells_density(const dictionary_surface *surface, dictionary_cells *cells, size_t count, slope at,
                              float *density)
{
    const float to_x = DICTIONARY_ALPHA / surface->target.alpha_x, to_y = DICTIONARY_ALPHA / surface->target.alpha_y;
    const size_t padded = (count + MOST_LANES - 1) / MOST_LANES * MOST_LANES;
    for (size_t i = count; i < padded; i++) {
        cells->hash[i] = 0U;
        cells->level[i] = 0;
    }
    dictionary_kernel_widest(MOST_LANES)(surface->table, cells, padded, at.x * to_x, at.y * to_y, density);
    for (size_t i = 0; i < count; i++)
        density[i] = density[i] * to_x * to_y;
}
