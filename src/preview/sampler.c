/* Sample points one at a time. */
#include "preview/sampler.h"

#include "preview/sampler_draw.h"

sampler sampler_again(uint32_t pixel, uint32_t sample)
{
    return (sampler){ pixel, sample, reverse_bits(sample) };
}

sampler sampler_make(int x, int y, uint32_t sample, uint32_t seed)
{
    return sampler_again(hash_combine(hash_combine(hash_mix(seed), (uint32_t)x), (uint32_t)y), sample);
}

void sampler_pair(const sampler *s, uint32_t dimension, double u[2])
{
    draw_pair(s->pixel, s->reversed, dimension, &u[0], &u[1]);
}

uint32_t sampler_bits(const sampler *s, uint32_t dimension)
{
    return hash_combine(hash_combine(s->pixel, dimension), s->sample);
}
