/* Integer hashes: cell coordinates to uniform bits. They pass the pair tests that Wang's and Jenkins's mixers fail. */
#ifndef MATH_HASH_H
#define MATH_HASH_H

#include "math/lanes.h"

/* Odd multipliers for the coordinates of a lattice. */
#define HASH_X 0x9E3779B1U
#define HASH_Y 0xC2B2AE3DU
#define HASH_Z 0x85157AF5U

/* Full avalanche (bias of every output bit below 2^-9): C. Wellons's lowbias32 constants. */
static inline vuint hash_full(vuint x)
{
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    return x ^ (x >> 16);
}

/* Enough for the top bits when x already is a hash plus a small lattice step. times: HASH_TOP; with its negative comes
 * the negative of the hash, for nothing. */
#define HASH_TOP 0x846ca68bU

static inline vuint hash_top(vuint x, vuint times)
{
    return (x ^ x >> 15) * times;
}

#endif
