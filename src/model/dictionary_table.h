/* The dictionary: marginal distributions of slopes that sharpen from a Gaussian into single lobes, level by level.
 *
 * Chermain et al. 2020, sections 4.3 to 4.5 and 7.3. Level l of a marginal is a mixture of 2^l Gaussian lobes and their
 * mirror images; the product of two marginals has 4^(l+1) lobes. Level DICTIONARY_LEVELS is the target itself, a
 * Gaussian of roughness DICTIONARY_ALPHA, and needs no table.
 */
#ifndef MODEL_DICTIONARY_TABLE_H
#define MODEL_DICTIONARY_TABLE_H

#include <stdint.h>

/* The paper's numbers. */
enum { DICTIONARY_LEVELS = 16, DICTIONARY_MARGINALS = 192, DICTIONARY_SAMPLES = 64 };
#define DICTIONARY_ALPHA 0.5F
#define DICTIONARY_DOMAIN 1.41421356F /* four standard deviations of the target, 4 alpha / sqrt 2 */
#define DICTIONARY_SPACING (DICTIONARY_DOMAIN / DICTIONARY_SAMPLES)

/* One marginal, even in x: samples of its density at x = i / 64 of the domain as IEEE half floats, straight lines
 * between them, zero at the end of the domain and beyond. */
typedef uint16_t dictionary_marginal[DICTIONARY_SAMPLES];

/* 384 KiB. */
typedef struct dictionary {
    dictionary_marginal marginal[DICTIONARY_LEVELS][DICTIONARY_MARGINALS];
} dictionary;

/* Where lobes are while the dictionary is being built: quantiles of |slope| in units of 2^-32. */
enum { DICTIONARY_LOBES = 1 << (DICTIONARY_LEVELS - 1), DICTIONARY_JOINT_LOBES = 128 };
typedef struct dictionary_scratch {
    uint32_t joint[DICTIONARY_MARGINALS][DICTIONARY_JOINT_LOBES]; /* the first lobes of all marginals */
    uint32_t lobe[DICTIONARY_LOBES];                              /* all lobes of one marginal */
} dictionary_scratch;

/* Fills *d from the seed; every machine gives the same bits. */
void dictionary_build(dictionary *d, dictionary_scratch *scratch, uint32_t seed);

/* Density at slope x, in 1 / slope; its integral over all x is 1. */
float dictionary_density(const dictionary_marginal marginal, float x);

/* The slope below which lies the share u of the marginal, u in [0, 1). */
float dictionary_quantile(const dictionary_marginal marginal, float u);

#endif
