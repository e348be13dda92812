/* Owen-scrambled Sobol points in two dimensions, with a shuffled order for every pair of dimensions. */
#include "preview/sampler.h"

#include "preview/hash.h"

static uint32_t reverse_bits(uint32_t x)
{
    x = (x >> 24) | ((x >> 8) & 0x0000ff00U) | ((x << 8) & 0x00ff0000U) | (x << 24);
    x = ((x & 0xf0f0f0f0U) >> 4) | ((x & 0x0f0f0f0fU) << 4);
    x = ((x & 0xccccccccU) >> 2) | ((x & 0x33333333U) << 2);
    return ((x & 0xaaaaaaaaU) >> 1) | ((x & 0x55555555U) << 1);
}

/* Flips each bit by a hash of the bits below it: Laine and Karras 2011, with the constants of Burley 2020, Sec. 4. On
 * reversed bits this is Owen's nested uniform scramble, which flips each bit by a hash of the bits above it. */
static uint32_t permute_upwards(uint32_t x, uint32_t seed)
{
    x += seed;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return x;
}

/* The second Sobol dimension, its bits reversed: direction numbers are Pascal's triangle modulo 2, v(k+1) = v(k) xor
 * v(k) >> 1. The binomial (k, j) is odd where the bits of j are among those of k, so bit j of the result is the parity
 * of the index's bits at all such k: five butterflies. */
static uint32_t reversed_sobol_second(uint32_t index)
{
    index ^= (index >> 16) & 0x0000ffffU;
    index ^= (index >> 8) & 0x00ff00ffU;
    index ^= (index >> 4) & 0x0f0f0f0fU;
    index ^= (index >> 2) & 0x33333333U;
    index ^= (index >> 1) & 0x55555555U;
    return index;
}

sampler sampler_make(int x, int y, uint32_t sample, uint32_t seed)
{
    return (sampler){ hash_combine(hash_combine(hash_mix(seed), (uint32_t)x), (uint32_t)y), sample,
                      reverse_bits(sample) };
}

void sampler_pair(const sampler *s, uint32_t dimension, double u[2])
{
    const uint32_t seed = hash_combine(s->pixel, dimension);
    /* A shuffle that keeps blocks of 4^k together. The first Sobol dimension is the index with its bits reversed. */
    const uint32_t index = reverse_bits(permute_upwards(s->reversed, seed));
    const uint32_t first = permute_upwards(index, hash_combine(seed, 1U));
    const uint32_t second = permute_upwards(reversed_sobol_second(index), hash_combine(seed, 2U));
    u[0] = (double)reverse_bits(first) * 0x1p-32;
    u[1] = (double)reverse_bits(second) * 0x1p-32;
}

uint32_t sampler_bits(const sampler *s, uint32_t dimension)
{
    return hash_combine(hash_combine(s->pixel, dimension), s->sample);
}
