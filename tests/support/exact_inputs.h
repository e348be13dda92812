/* Random directions, footprints and lights by operations that IEEE 754 fixes: the same bits on every machine and from
 * every compiler, which sin, exp and log of a libm do not promise. */
#ifndef TESTS_EXACT_INPUTS_H
#define TESTS_EXACT_INPUTS_H

#include "glint.h"
#include "statistics.h"

static inline void exact_direction(uint64_t *random, float v[3])
{
    double w[3], length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        w[k] = k < 2 ? random_between(random, -0.8, 0.8) : random_between(random, 0.3, 1.0);
        length2 += w[k] * w[k];
    }
    for (int k = 0; k < 3; k++)
        v[k] = (float)(w[k] / sqrt(length2));
}

/* One random number a statement: the order in which arguments are evaluated is the compiler's choice. */
static inline glint_footprint exact_footprint(uint64_t *random)
{
    glint_footprint f;
    const int exponent = -(int)(random_bits(random) % 9) - 7;
    const double size = ldexp(random_between(random, 1.0, 2.0), exponent);
    const double other = size * random_between(random, 0.1, 1.0);
    const double skew = random_between(random, -0.5, 0.5);
    f.u = random_between(random, -10.0, 10.0);
    f.v = random_between(random, -10.0, 10.0);
    f.dudx = (float)size;
    f.dudy = (float)(-other * skew);
    f.dvdx = (float)(size * skew);
    f.dvdy = (float)other;
    f.seed = (uint32_t)random_bits(random);
    return f;
}

static inline float exact_solid_angle(uint64_t *random)
{
    return ldexpf(1.0F, -(int)(random_bits(random) % 16));
}

/* FNV-1a, word by word. */
static inline uint64_t hash_floats(uint64_t hash, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof(bits));
        hash = (hash ^ bits) * 0x100000001b3U;
    }
    return hash;
}

#define HASH_START 0xcbf29ce484222325U

#endif
