/* Colour of single facets: a tint from a small table or of a random hue, whose mean is white. */
#include "model/tint.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"

tint_palette tint_palette_of(const glint_material_options *options)
{
    tint_palette p = { options->color_variation, options->color_count, { { 0.0F } } };
    for (int c = 0; c < 3; c++) {
        float sum = 0.0F;
        for (uint32_t i = 0; i < p.count; i++)
            sum += options->colors[i][c];
        /* A channel that no colour has stays as the base colour has it. */
        for (uint32_t i = 0; i < p.count; i++)
            p.color[i][c] = sum > 1e-6F ? options->colors[i][c] * ((float)p.count / sum) : 1.0F;
    }
    return p;
}

/* 1 + variation cos(hue - a third of a turn per channel): never negative, the sum of the channels is 3 and the mean
 * over hues is white. */
static void add_hue(float variation, uint32_t hash, float rgb[3])
{
    for (int c = 0; c < 3; c++) {
        /* cos(2 pi t) = 1 - 2 sin^2(pi t), and unsigned arithmetic turns modulo one. */
        float sine, cosine;
        sincos_pi((float)((hash + 0x55555555U * (uint32_t)c) >> 8) * 0x1p-24F, &sine, &cosine);
        rgb[c] *= 1.0F + variation * (1.0F - 2.0F * fminf(sine * sine, 1.0F));
    }
}

void tint_of(const tint_palette *palette, uint32_t hash, float facets, float rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = 1.0F;
    if (palette->count > 0) {
        const uint32_t pick = (uint32_t)((uint64_t)hash_full(hash + HASH_X) * palette->count >> 32);
        for (int c = 0; c < 3; c++)
            rgb[c] = palette->color[pick][c];
    }
    if (palette->variation > 0.0F)
        add_hue(palette->variation, hash_full(hash + HASH_Y), rgb);
    /* The mean of n colours has the deviation of one over sqrt(n). */
    const float deviation = 1.0F / sqrtf(facets);
    for (int c = 0; c < 3; c++)
        rgb[c] = 1.0F + (rgb[c] - 1.0F) * deviation;
}
