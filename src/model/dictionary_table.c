/* Builds the dictionary, and looks up and inverts its marginals: Chermain et al. 2020, section 4.4.
 *
 * The paper draws the place of every lobe at random. Here they are stratified: the 2^l lobes of a marginal lie one in
 * each of the 2^l strata of equal probability, and where a stratum gets its new lobes in several marginals, those are
 * stratified among each other. Each lobe alone is as random as before, and two things get better. The error of level l
 * falls as 2^(-3 l / 2), so that of a cell with n facets faster than 1 / sqrt(n), the law of facets that are counted;
 * with independent lobes a cell, being a product of two marginals with sqrt(n) lobes each, needs n^(1/4). And the mean
 * of the 192 marginals is the target already at level 0.
 */
#include "model/dictionary_table.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"
#include "model/dictionary_lanes.h"

#define LOBE_SIGMA 0.02F

/* Standard deviation of the places of lobes. With the lobes' own variance and that of linear interpolation, h^2 / 6,
 * the mixture has the target's alpha^2 / 2: .125 - .0004 - .0000814. */
#define PLACE_SIGMA 0.352872F

/* Lobes are put at whole fractions of a sample's spacing, so that a lobe is a row of a small table; all PLACES of them
 * are so far from the domain's end that every lobe lies within it whole, four LOBE_SIGMA to each side. */
enum { PHASES = 32, TAPS = 8, BEFORE = 3, PADDING = 8, PLACES = 1932, GUIDE_BITS = 12 };

typedef struct lobe_table {
    float tap[PHASES][TAPS];         /* the lobe at samples -BEFORE .. TAPS - 1 - BEFORE from that before its centre */
    uint32_t last[PLACES];           /* the last quantile that belongs to a place, in units of 2^-32 */
    uint16_t guide[1 << GUIDE_BITS]; /* the place of the least quantile with these leading bits */
} lobe_table;

/* Sum of lobes at the samples, mirror images left out; entry 0 is slope -PADDING * DICTIONARY_SPACING. */
typedef struct lobe_sum {
    float at[PADDING + DICTIONARY_SAMPLES + PADDING];
} lobe_sum;

/* The normal law on the places, and its inverse as a table: a polynomial for the quantile would put its own error, a
 * thousandth, into every marginal. */
static void make_places(lobe_table *t)
{
    const float unit = DICTIONARY_SPACING / PHASES / PLACE_SIGMA;
    double share[PLACES], sum = 0.0;
    for (int i = 0; i < PLACES; i++) {
        const float z = (float)i * unit;
        /* Place 0 is its own mirror image. */
        sum += (double)exp_negative(-0.5F * z * z) * (i > 0 ? 1.0 : 0.5);
        share[i] = sum;
    }
    for (int i = 0; i < PLACES; i++)
        t->last[i] = (uint32_t)(share[i] / sum * 4294967295.0);
    uint16_t place = 0;
    for (uint32_t bits = 0; bits < 1U << GUIDE_BITS; bits++) {
        while (t->last[place] < bits << (32 - GUIDE_BITS))
            place++;
        t->guide[bits] = place;
    }
}

static void make_lobes(lobe_table *t)
{
    for (int p = 0; p < PHASES; p++)
        for (int k = 0; k < TAPS; k++) {
            const float z = ((float)(k - BEFORE) - (float)p / PHASES) * (DICTIONARY_SPACING / LOBE_SIGMA);
            t->tap[p][k] = exp_negative(-0.5F * z * z);
        }
    make_places(t);
}

/* ---- half floats ---- */

/* Samples below the least normal half are kept as zero: there are no denormals to convert. */
#define LEAST_HALF 6.10351562e-5F

/* Nearest half of a float that is 0 or in [LEAST_HALF, 65504). */
static uint16_t half_of(float x)
{
    if (x < LEAST_HALF)
        return 0;
    const uint32_t u = bits_of(x) - (112U << 23);
    return (uint16_t)((u + 0xfffU + (u >> 13 & 1U)) >> 13);
}

/* ---- places of lobes ---- */

/* A stream of hashes. */
typedef struct stream {
    uint32_t seed, count;
} stream;

static uint32_t next(stream *s)
{
    return hash_full(s->seed + HASH_X * s->count++);
}

static int has_lobe_in(const uint32_t *lobe, uint32_t count, int level, uint32_t stratum)
{
    for (uint32_t k = 0; k < count; k++)
        if ((uint64_t)lobe[k] >> (32 - level) == stratum)
            return 1;
    return 0;
}

/* In one of the 2^level strata, a lobe for each marginal that has none there yet: one in each of as many parts of the
 * stratum, dealt out at random. */
static void place_in_stratum(dictionary_scratch *scratch, stream *random, int level, uint32_t stratum,
                             uint32_t count[DICTIONARY_MARGINALS])
{
    const uint32_t before = level > 0 ? 1U << (level - 1) : 0U;
    uint32_t wanting[DICTIONARY_MARGINALS], parts = 0;
    for (uint32_t i = 0; i < DICTIONARY_MARGINALS; i++)
        if (!has_lobe_in(scratch->joint[i], before, level, stratum))
            wanting[parts++] = i;
    for (uint32_t part = 0; part < parts; part++) {
        const uint32_t pick = part + (uint32_t)((uint64_t)next(random) * (parts - part) >> 32);
        const uint32_t i = wanting[pick];
        wanting[pick] = wanting[part];
        const uint64_t within = (((uint64_t)part << 32) + next(random)) / parts;
        scratch->joint[i][count[i]++] = (uint32_t)((((uint64_t)stratum << 32) + within) >> level);
    }
}

static void place_joint(dictionary_scratch *scratch, stream *random)
{
    uint32_t count[DICTIONARY_MARGINALS] = { 0 };
    for (int level = 0; 1 << level <= DICTIONARY_JOINT_LOBES; level++)
        for (uint32_t stratum = 0; stratum < 1U << level; stratum++)
            place_in_stratum(scratch, random, level, stratum, count);
}

/* Lobe k + 2^(level - 1) lies in the half that lobe k left empty of the stratum it had for itself. */
static void place_all(dictionary_scratch *scratch, stream *random, uint32_t marginal)
{
    for (uint32_t k = 0; k < DICTIONARY_JOINT_LOBES; k++)
        scratch->lobe[k] = scratch->joint[marginal][k];
    for (int level = 8; 1 << (level - 1) < DICTIONARY_LOBES; level++)
        for (uint32_t k = 0; k < 1U << (level - 1); k++) {
            const uint32_t empty = scratch->lobe[k] >> (32 - level) ^ 1U;
            scratch->lobe[k + (1U << (level - 1))] = empty << (32 - level) | next(random) >> level;
        }
}

/* ---- marginals ---- */

static void add_lobe(lobe_sum *sum, const lobe_table *lobes, uint32_t quantile)
{
    uint32_t place = lobes->guide[quantile >> (32 - GUIDE_BITS)];
    while (lobes->last[place] < quantile)
        place++;
    const float *tap = lobes->tap[place % PHASES];
    float *at = sum->at + PADDING - BEFORE + place / PHASES;
    for (int k = 0; k < TAPS; k++)
        at[k] += tap[k];
}

/* The sum with its mirror image, made to integrate to 1 as the straight lines between samples do. What rounding to half
 * takes from one sample the next one gets: the integral stays. */
static void fold_and_normalize(const lobe_sum *sum, dictionary_marginal marginal)
{
    float folded[DICTIONARY_SAMPLES], area = 0.0F;
    for (int i = 0; i < DICTIONARY_SAMPLES; i++) {
        folded[i] = sum->at[PADDING + i] + (i <= PADDING ? sum->at[PADDING - i] : 0.0F);
        area += i > 0 ? folded[i] : 0.5F * folded[i];
    }
    const float scale = 0.5F / (area * DICTIONARY_SPACING);
    float carried = 0.0F;
    for (int i = 0; i < DICTIONARY_SAMPLES; i++) {
        const float wanted = folded[i] * scale + carried;
        marginal[i] = half_of(wanted);
        /* Half of sample 0 counts, as its other half is that of the mirror image. */
        carried = (wanted - float_of_half(marginal[i])) * (i > 0 ? 1.0F : 0.5F);
    }
}

void dictionary_build(dictionary *d, dictionary_scratch *scratch, uint32_t seed)
{
    lobe_table lobes;
    make_lobes(&lobes);
    stream random = { hash_full(seed + HASH_Z), 0 };
    place_joint(scratch, &random);
    for (uint32_t i = 0; i < DICTIONARY_MARGINALS; i++) {
        place_all(scratch, &random, i);
        lobe_sum sum = { { 0.0F } };
        uint32_t k = 0;
        for (int level = 0; level < DICTIONARY_LEVELS; level++) {
            for (; k < 1U << level; k++)
                add_lobe(&sum, &lobes, scratch->lobe[k]);
            fold_and_normalize(&sum, d->marginal[level][i]);
        }
    }
}

float dictionary_density(const dictionary_marginal marginal, float x)
{
    return marginal_density((const dictionary_marginal *)marginal, 0, x);
}

float dictionary_quantile(const dictionary_marginal marginal, float u)
{
    /* Twice the distance from the median is the share of |x| below the one that is sought. */
    const float signed_share = 2.0F * u - 1.0F;
    float left = float_of_half(marginal[0]);
    float rest = fabsf(signed_share) * (0.5F / DICTIONARY_SPACING);
    for (int i = 0; i < DICTIONARY_SAMPLES; i++) {
        const float right = i + 1 < DICTIONARY_SAMPLES ? float_of_half(marginal[i + 1]) : 0.0F;
        const float segment = 0.5F * (left + right);
        if (rest < segment) {
            /* rest = left t + (right - left) t^2 / 2, without the difference of nearly equal numbers. */
            const float root = sqrtf(fmaxf(left * left + 2.0F * (right - left) * rest, 0.0F));
            const float divisor = left + root; /* 0: nothing is left to go, and there is no density yet */
            const float t = divisor > 0.0F ? fminf(2.0F * rest / divisor, 1.0F) : 0.0F;
            return (signed_share < 0.0F ? -DICTIONARY_SPACING : DICTIONARY_SPACING) * ((float)i + t);
        }
        rest -= segment;
        left = right;
    }
    /* Rounding left a hair beyond the last lobe: no density there, so no light. */
    return DICTIONARY_DOMAIN;
}
