/* Pairs of uniforms for many points at once, bit for bit those of sampler_pair. */
#ifndef PREVIEW_PAIR_BATCH_H
#define PREVIEW_PAIR_BATCH_H

#include "preview/kernels.h"
#include "preview/sampler.h"

enum { PAIR_BATCH = 64 };

typedef struct pair_batch {
    uint32_t pixel[PAIR_BATCH], reversed[PAIR_BATCH]; /* of the samplers */
    double u[2][PAIR_BATCH];
} pair_batch;

static inline void pair_batch_set(pair_batch *b, int i, const sampler *s)
{
    b->pixel[i] = s->pixel;
    b->reversed[i] = s->reversed;
}

static inline void pair_batch_draw(const kernels *k, uint32_t dimension, int count, pair_batch *b)
{
    k->draw(b->pixel, b->reversed, dimension, count, b->u[0], b->u[1]);
}

#endif
