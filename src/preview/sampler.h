/* Sample points that are well spread over a pixel and over its samples: a padded, Owen-scrambled (0, 2)-sequence. */
#ifndef PREVIEW_SAMPLER_H
#define PREVIEW_SAMPLER_H

#include <stdint.h>

typedef struct sampler {
    uint32_t pixel;    /* hash of the pixel and the render's seed */
    uint32_t sample;   /* which of the pixel's samples */
    uint32_t reversed; /* its bits */
} sampler;

sampler sampler_make(int x, int y, uint32_t sample, uint32_t seed);
/* Another sample of the same pixel. */
sampler sampler_again(uint32_t pixel, uint32_t sample);

/* Two uniforms in [0, 1). Over the first 4^k samples each cell of a 2^k x 2^k grid holds one point; pairs of different
 * dimensions are independent. B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. */
void sampler_pair(const sampler *s, uint32_t dimension, double u[2]);

/* A hash for decisions that need no spread. */
uint32_t sampler_bits(const sampler *s, uint32_t dimension);

#endif
