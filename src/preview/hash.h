/* Hashes of integers: the only source of randomness, so that a picture repeats to the bit. */
#ifndef PREVIEW_HASH_H
#define PREVIEW_HASH_H

#include <stdint.h>

/* A permutation of 32 bits whose every output bit depends on every input bit: the two-round mixer of Wellons,
 * "Prospecting for Hash Functions" (2018), with the constants of its best 16-15-16 search result. */
static inline uint32_t hash_mix(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    x ^= x >> 16;
    return x;
}

static inline uint32_t hash_combine(uint32_t seed, uint32_t value)
{
    return hash_mix(seed ^ (hash_mix(value) + 0x9e3779b9U));
}

/* In [0, 1): the top 24 bits, so that rounding never reaches 1. */
static inline float hash_uniform(uint32_t x)
{
    return (float)(x >> 8) * 0x1p-24F;
}

#endif
