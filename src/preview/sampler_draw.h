/* Owen-scrambled Sobol points in two dimensions, with a shuffled order for every pair of dimensions. In integers alone,
 * so that compilers make vectors of a loop of them. */
#ifndef PREVIEW_SAMPLER_DRAW_H
#define PREVIEW_SAMPLER_DRAW_H

#include "preview/hash.h"

static inline uint32_t reverse_bits(uint32_t x)
{
    x = (x >> 24) | ((x >> 8) & 0x0000ff00U) | ((x << 8) & 0x00ff0000U) | (x << 24);
    x = ((x & 0xf0f0f0f0U) >> 4) | ((x & 0x0f0f0f0fU) << 4);
    x = ((x & 0xccccccccU) >> 2) | ((x & 0x33333333U) << 2);
    return ((x & 0xaaaaaaaaU) >> 1) | ((x & 0x55555555U) << 1);
}

/* Flips each bit by a hash of the bits below it: Laine and Karras 2011, with the constants of Burley 2020, Sec. 4. On
 * reversed bits this is Owen's nested uniform scramble, which flips each bit by a hash of the bits above it. */
static inline uint32_t permute_upwards(uint32_t x, uint32_t seed)
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
static inline uint32_t reversed_sobol_second(uint32_t index)
{
    index ^= (index >> 16) & 0x0000ffffU;
    index ^= (index >> 8) & 0x00ff00ffU;
    index ^= (index >> 4) & 0x0f0f0f0fU;
    index ^= (index >> 2) & 0x33333333U;
    index ^= (index >> 1) & 0x55555555U;
    return index;
}

/* bits / 2^32: exact, and by a conversion of signed numbers, which vectors have. */
static inline double unit_of(uint32_t bits)
{
    return ((double)(int32_t)(bits ^ 0x80000000U) + 0x1p31) * 0x1p-32;
}

/* Of a sampler. */
static inline void draw_pair(uint32_t pixel, uint32_t reversed, uint32_t dimension, double *u, double *v)
{
    const uint32_t seed = hash_combine(pixel, dimension);
    /* A shuffle that keeps blocks of 4^k together. The first Sobol dimension is the index with its bits reversed. */
    const uint32_t index = reverse_bits(permute_upwards(reversed, seed));
    const uint32_t first = permute_upwards(index, hash_combine(seed, 1U));
    const uint32_t second = permute_upwards(reversed_sobol_second(index), hash_combine(seed, 2U));
    *u = unit_of(reverse_bits(first));
    *v = unit_of(reverse_bits(second));
}

static inline void draw_pairs(const uint32_t *pixel, const uint32_t *reversed, uint32_t dimension, int count,
                              double *restrict u, double *restrict v)
{
    for (int i = 0; i < count; ++i)
        draw_pair(pixel[i], reversed[i], dimension, &u[i], &v[i]);
}

#endif
