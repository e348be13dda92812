/* Colour of single facets: a tint from a small table or of a random hue, whose mean is white. */
#include "model/tint.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/hash.h"
#include "model/tint_lanes.h"

int tint_is_asked(const glint_material_options *options)
{
    return options->color_variation > 0.0F || options->color_count > 0;
}

tint_palette tint_palette_of(const glint_material_options *options)
{
    const uint32_t count = options->color_count;
    tint_palette p = { options->color_variation, count > 0 ? (float)count : 1.0F, { { 0.0F } } };
    for (int c = 0; c < 3; c++) {
        float sum = 0.0F;
        for (uint32_t i = 0; i < count; i++)
            sum += options->colors[i][c];
        /* A channel that no colour has stays as the base colour has it. */
        for (uint32_t i = 0; i < GLINT_MAX_COLORS; i++)
            p.color[c][i] = i < count && sum > 1e-6F ? options->colors[i][c] * ((float)count / sum) : 1.0F;
    }
    return p;
}

/* The mean of n colours has the deviation of one over sqrt(n). */
static void add_deviation(const tint_palette *palette, float uniform, float deviation, float rgb[3])
{
    tint_less_white(palette, uniform, rgb);
    for (int c = 0; c < 3; c++)
        rgb[c] = fmaxf(1.0F + rgb[c] * deviation, 0.0F);
}

void tint_of(const tint_palette *palette, uint32_t hash, float facets, float rgb[3])
{
    add_deviation(palette, tint_uniform_of(hash_full(hash + HASH_Y)), 1.0F / sqrtf(facets), rgb);
}

void tint_of_uniform(const tint_palette *palette, float uniform, float rgb[3])
{
    add_deviation(palette, fminf(uniform, 0.99999994F), 1.0F, rgb);
}
