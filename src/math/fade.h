/* How something that varies little fades out to its mean, so that what is left out never varies by more than a limit.
 *
 * Below one limit nothing shows, from two limits on all of it, between them a smooth step w = 3 t^2 - 2 t^3. What is
 * left out varies by (1 - w) r limits, r = 1 + t, which is 1.0811 at most, at r = 1.167: by so much the step begins
 * earlier.
 */
#ifndef MATH_FADE_H
#define MATH_FADE_H

#include <math.h>

#define FADE_PEAK 1.0811F

/* The share that shows of what has this standard deviation. A limit of 0: all. */
static inline float fade_share(float deviation, float limit)
{
    if (!(limit > 0.0F))
        return 1.0F;
    const float t = deviation * (FADE_PEAK / limit) - 1.0F;
    if (!(t > 0.0F))
        return 0.0F;
    return t < 1.0F ? t * t * (3.0F - 2.0F * t) : 1.0F;
}

/* Of the sum of so many lit facets, N p, relative. Of less light than a float holds nothing is seen. */
static inline float fade_deviation(float lit)
{
    return lit > 1e-30F ? 1.0F / sqrtf(lit) : 1e15F;
}

#endif
