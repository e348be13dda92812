/* The facets of one cell of a dictionary: which scales they are dealt to, and which marginals each scale takes. In
 * lanes: what sampling finds for one cell, and evaluation for many. */
#ifndef MODEL_DICTIONARY_LANES_H
#define MODEL_DICTIONARY_LANES_H

#include "math/elementary.h"
#include "math/hash.h"
#include "model/dictionary_cell.h"

#define LOG2_OF_E 1.44269504F
#define LN2 0.693147181F

/* The lattice of E: top exp(-step (j + shift)), j < LATTICE. Beyond top the integrand has 2e-6 of its weight; what is
 * below the lattice is one more scale. */
enum { LATTICE = DICTIONARY_MAX_SCALES - 1 };
#define SCALE_TOP 16.0F
#define SCALE_STEP 0.8F
#define SCALE_RATIO 0.449328964F /* exp(-step) */
#define SCALE_END 0.00241173F    /* top exp(-step LATTICE) */

/* No more facets than this are dealt to scales one by one: a float still tells one from none. */
#define MOST_DEALT 1048576.0F

/* Which random number of a cell; each scale takes two more from FIRST_SCALE on, its turn and its pick. */
enum { DRAW_COVERAGE = 1, DRAW_DENSITY, DRAW_SHIFT, DRAW_TAIL, DRAW_DEAL, FIRST_SCALE = 8 };
enum { DRAW_TURN = 1, DRAW_PICK };

static inline vuint draw_of(vuint cell, uint32_t which)
{
    return hash_full(cell + which * HASH_X);
}

/* In [0, 1): never 1, which would be the marginal after the last. */
static inline vfloat uniform_of(vuint hash)
{
    return to_float((vint)(hash >> 8)) * 0x1p-24F;
}

/* 4^x for x in [-60, 60]. */
static inline vfloat exp4(vfloat x)
{
    const vfloat whole = floor_f(2.0F * x);
    /* exp_negative takes no argument above 0. */
    return 2.0F * exp2_i(to_int(whole)) * exp_negative((2.0F * x - whole - 1.0F) * LN2);
}

/* log4 of a share of 4^log4_facets facets; 0 < share <= 1. */
static inline vfloat log4_of_share(vfloat log4_facets, vfloat share)
{
    return log4_facets + 0.5F * LOG2_OF_E * log_f(share);
}

/* The dictionary's level for 4^log4_facets facets; DICTIONARY_LEVELS and above: the target. */
static inline vint level_of(vfloat log4_facets)
{
    return to_int(max_f(log4_facets, splat(0.0F)) + 0.5F);
}

typedef struct scale_set {
    vfloat e[DICTIONARY_MAX_SCALES];
    vfloat share[DICTIONARY_MAX_SCALES]; /* sum 1 */
} scale_set;

static inline scale_set ggx_scales(vuint cell)
{
    scale_set set;
    vfloat e = SCALE_TOP * exp_negative(-SCALE_STEP * uniform_of(draw_of(cell, DRAW_SHIFT))), sum = splat(0.0F);
    for (int j = 0; j < LATTICE; j++) {
        set.e[j] = e;
        set.share[j] = SCALE_STEP * e * exp_negative(-e);
        sum = sum + set.share[j];
        e = e * SCALE_RATIO;
    }
    /* Below the lattice exp(-E) is 1 and E uniform. */
    set.e[LATTICE] = SCALE_END * (uniform_of(draw_of(cell, DRAW_TAIL)) + 0x1p-25F);
    set.share[LATTICE] = splat(SCALE_END);
    sum = sum + SCALE_END;
    for (int j = 0; j <= LATTICE; j++)
        set.share[j] = set.share[j] / sum;
    return set;
}

/* Deals the facets to scales by systematic sampling: scale j gets share_j of them in the mean, a whole number each
 * time. share: in, in the mean; out, of this cell. */
static inline void deal_to_scales(vuint cell, vfloat log4_facets, vfloat share[DICTIONARY_MAX_SCALES])
{
    const vfloat dealt = min_f(floor_f(min_f(exp4(log4_facets), splat(MOST_DEALT)) + 0.5F), splat(MOST_DEALT));
    const vfloat start = uniform_of(draw_of(cell, DRAW_DEAL));
    vfloat below = splat(0.0F), last = splat(0.0F); /* floor(start) */
    for (int j = 0; j < DICTIONARY_MAX_SCALES; j++) {
        below = below + share[j];
        const vfloat next = j + 1 < DICTIONARY_MAX_SCALES ? floor_f(dealt * below + start) : dealt;
        share[j] = (next - last) / dealt;
        last = next;
    }
}

/* One product of marginals. */
typedef struct lobe_pick {
    vfloat cosine, sine;
    vint along, across; /* marginals of a level */
} lobe_pick;

static inline lobe_pick pick_lobe(vuint hash)
{
    lobe_pick p;
    /* Half a turn will do: the product of even functions does not change in the other half. */
    sincos_pi(uniform_of(draw_of(hash, DRAW_TURN)), &p.sine, &p.cosine);
    const vuint pick = draw_of(hash, DRAW_PICK);
    p.along = (vint)((pick >> 16) * DICTIONARY_MARGINALS >> 16);
    p.across = (vint)((pick & 0xffffU) * DICTIONARY_MARGINALS >> 16);
    return p;
}

/* An IEEE half float that is not negative. */
static inline vfloat float_of_half(vuint half)
{
    return float_from_bits(half << 13) * 0x1p112F;
}

/* dictionary_density of the marginal with this number among those from `table` on. */
static inline vfloat marginal_density(const dictionary_marginal *table, vint marginal, vfloat x)
{
    const vfloat t = abs_f(x) * (1.0F / DICTIONARY_SPACING);
    const vmask inside = less(t, splat((float)DICTIONARY_SAMPLES));
    const vfloat place = choose(inside, t, splat(0.0F));
    const vint i = to_int(place);
    const vfloat f = place - to_float(i);
    /* Both samples at once; the last one as the second of two. */
    const vmask is_last = less_i(splat_i(DICTIONARY_SAMPLES - 2), i);
    const vint first = choose_i(is_last, splat_i(DICTIONARY_SAMPLES - 2), i);
    const vuint pair = gather_u(table, (marginal * DICTIONARY_SAMPLES + first) * (int32_t)sizeof(uint16_t));
    const vfloat low = float_of_half(pair & 0xffffU), high = float_of_half(pair >> 16);
    const vfloat left = choose(is_last, high, low), right = choose(is_last, splat(0.0F), high);
    return choose(inside, left + f * (right - left), splat(0.0F));
}

/* The target, at the dictionary's roughness. */
static inline vfloat gaussian_density(vfloat x)
{
    const vfloat z2 = x * x * (1.0F / (DICTIONARY_ALPHA * DICTIONARY_ALPHA));
    return choose(less(z2, splat(87.0F)), exp_negative(-z2) * (1.0F / (DICTIONARY_ALPHA * 1.77245385F)), splat(0.0F));
}

#endif
