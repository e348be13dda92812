/* What statistical tests share: a random number generator, moments with their standard errors, and tail probabilities.
 */
#ifndef TESTS_STATISTICS_H
#define TESTS_STATISTICS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* splitmix64: independent of every hash in the library. */
static inline uint64_t random_bits(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
}

/* Uniform in [0, 1). */
static inline double random_uniform(uint64_t *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

static inline double random_between(uint64_t *state, double low, double high)
{
    return low + (high - low) * random_uniform(state);
}

/* exp of a uniform between the logarithms. */
static inline double random_log_between(uint64_t *state, double low, double high)
{
    return exp(random_between(state, log(low), log(high)));
}

/* Running moments (Welford). */
typedef struct moments {
    double count, mean, square;
} moments;

static inline void moments_add(moments *m, double x)
{
    m->count += 1.0;
    const double d = x - m->mean;
    m->mean += d / m->count;
    m->square += d * (x - m->mean);
}

static inline double moments_variance(const moments *m)
{
    return m->count > 1.0 ? m->square / (m->count - 1.0) : 0.0;
}

static inline double moments_standard_error(const moments *m)
{
    return sqrt(moments_variance(m) / m->count);
}

/* P(chi^2 with k degrees of freedom > x), by Wilson and Hilferty's cube root; good to a few percent for k > 30. */
static inline double chi_square_tail(double x, double k)
{
    const double z = (cbrt(x / k) - (1.0 - 2.0 / (9.0 * k))) / sqrt(2.0 / (9.0 * k));
    return 0.5 * erfc(z / sqrt(2.0));
}

#endif
