/* The binomial law for one uniform per draw and any real number of trials, in lanes.
 *
 * The count of N trials, n = floor(N) whole ones and a fraction f:
 *
 *     X = Binomial(n, p) + Bernoulli(f p),    E X = N p,    Var X = n p (1 - p) + f p (1 - f p)
 *
 * It is found by inversion: X > k where u < P(X > k). So for a fixed u it does not fall when N or p grows, and steps by
 * one; only where the walk below hands over to the expansion may it lose one count. Small u means a large X: the
 * survival function keeps its relative precision in the tail that matters. Above one half p is replaced by 1 - p, u by
 * 1 - u, and the count is taken from the other end.
 *
 * Draws are made several at a time because in a glint nine share one (N, p) and so one exp and one log.
 */
#ifndef MATH_BINOMIAL_H
#define MATH_BINOMIAL_H

#include "math/elementary.h"

/* Below this mean the survival function is walked, above it a Cornish-Fisher expansion of the normal quantile is used:
 * its mean is right to 8e-5 there, its variance to 6e-4, its distribution to 5e-4. Another one may be given before: the
 * study of the law asks what it costs. */
#if !defined(BINOMIAL_WALK_MEAN)
#define BINOMIAL_WALK_MEAN 5.0F
#endif
#define BINOMIAL_WALK_STEPS 32

/* What depends on p alone. */
typedef struct binomial_chance {
    vmask flip;
    vfloat p;        /* min(p, 1 - p) */
    vfloat given;    /* p as it came */
    vfloat log_miss; /* log2(1 - p) */
    vfloat odds;     /* p / (1 - p) */
} binomial_chance;

/* p in [0, 1]. */
static inline binomial_chance binomial_chance_of(vfloat p)
{
    binomial_chance c;
    c.given = p;
    c.flip = less(splat(0.5F), p);
    c.p = choose(c.flip, 1.0F - p, p);
    c.log_miss = log2_of_miss(c.p);
    c.odds = c.p / (1.0F - c.p);
    return c;
}

/* Chances are kept times 2^31. */
#define BINOMIAL_SCALE_LOG2 31

/* A chance times 2^31, below 2^31, to the number T for which a signed uniform 32-bit u with u < T has that chance. A
 * number in [0, 1) added at random makes the chance right in the mean even below 2^-31. */
static inline vint binomial_threshold(vfloat scaled)
{
    return (vint)((vuint)to_int(scaled) << 1 ^ 0x80000000U);
}

/* The same for any chance up to one. One is missed once in 2^24. */
static inline vint binomial_first_threshold(vfloat scaled)
{
    /* The smaller one by its bits: GCC 12 converts both and then chooses, and 2^31 is no integer to convert. */
    const vint most = (vint)bits_of(splat(2147483520.0F)), bits = (vint)bits_of(scaled);
    return binomial_threshold(float_from_bits((vuint)min_i(bits, most)));
}

/* How many draws share one (N, p), at most twelve, and what their weights add up to. */
typedef struct binomial_many {
    int draws;
    float total;
} binomial_many;

/* What the draws of one (N, p) share. */
typedef struct binomial_law {
    vfloat n, b;      /* whole trials, and the chance of what is left of one */
    vfloat mean;      /* n p + b */
    vmask flip, wide; /* counted from the other end; to be expanded, not walked */
} binomial_law;

static inline binomial_law binomial_law_of(vfloat trials, const binomial_chance *chance)
{
    binomial_law l;
    l.n = floor_f(trials);
    const vfloat hit = (trials - l.n) * chance->given;
    /* With a fraction of one trial there is nothing to take from the other end, and 1 - hit would round a small chance
     * off. */
    l.flip = chance->flip & less_equal(splat(1.0F), l.n);
    l.b = choose(l.flip, 1.0F - hit, hit);
    l.mean = l.n * chance->p + l.b;
    l.wide = less_equal(splat(BINOMIAL_WALK_MEAN), l.mean);
    return l;
}

/* The uniform to draw with: where counts are taken from the other end, so is the uniform. */
static inline vint binomial_turned(const binomial_law *l, vint uniform)
{
    return choose_i(l->flip, (vint)(0U - (vuint)uniform), uniform);
}

/* Sums are kept in three parts, whose chains of additions are three times as short. */
enum { BINOMIAL_PARTS = 3 };

/* One step of the walk: those draws whose uniform is below the threshold count one more. */
static inline __attribute__((always_inline)) void binomial_count(const int draws, vint threshold, const vint *u,
                                                                 const vfloat *weight, vfloat sum[BINOMIAL_PARTS],
                                                                 vfloat *drawn)
{
#pragma GCC unroll 12
    for (int i = 0; i < draws; i++) {
        const vmask more = less_i(u[i], threshold);
        sum[i % BINOMIAL_PARTS] = add_where(more, sum[i % BINOMIAL_PARTS], weight[i]);
        if (drawn)
            drawn[i] = add_where(more, drawn[i], splat(1.0F));
    }
}

/* Where the walk through the survival function begins. Chances are times 2^31. */
typedef struct binomial_start {
    vfloat survival, mass; /* P(X > 0) without what is left of a trial, and P(X = 0) */
    vfloat step;           /* of the mass, times k at step k */
    vint first;            /* threshold for a count of one */
    vint least;            /* uniform of all draws */
} binomial_start;

/* Has no branch: made for several laws at once, before their walks, it keeps a processor from waiting for each. */
static inline __attribute__((always_inline)) binomial_start
binomial_start_of(const binomial_law *l, const binomial_chance *chance, const vint *u, vfloat dither, const int draws)
{
    /* Lanes that are not walked have no trials: their chances stay numbers, and no uniform is as small as theirs. */
    const vfloat n = choose(l->wide, splat(0.0F), l->n);
    binomial_start s;
    exp2_both(n * chance->log_miss, BINOMIAL_SCALE_LOG2, &s.survival, &s.mass);
    s.step = n * chance->odds;
    s.least = u[0];
    for (int i = 1; i < draws; i++)
        s.least = min_i(s.least, u[i]);
    s.least = choose_i(l->wide, splat_i(INT32_MAX), s.least);
    s.first = binomial_first_threshold(s.survival + l->b * s.mass + dither);
    return s;
}

/* The sum for small means: steps through the survival function until every uniform has been met. */
static inline __attribute__((always_inline)) vfloat binomial_walk(const binomial_law *l, const binomial_chance *chance,
                                                                  const binomial_start *s, const vint *u,
                                                                  const vfloat *weight, vfloat *drawn, const int draws)
{
    static const float inverse[BINOMIAL_WALK_STEPS] = {
        0.0F,      1.0F / 1,  1.0F / 2,  1.0F / 3,  1.0F / 4,  1.0F / 5,  1.0F / 6,  1.0F / 7,
        1.0F / 8,  1.0F / 9,  1.0F / 10, 1.0F / 11, 1.0F / 12, 1.0F / 13, 1.0F / 14, 1.0F / 15,
        1.0F / 16, 1.0F / 17, 1.0F / 18, 1.0F / 19, 1.0F / 20, 1.0F / 21, 1.0F / 22, 1.0F / 23,
        1.0F / 24, 1.0F / 25, 1.0F / 26, 1.0F / 27, 1.0F / 28, 1.0F / 29, 1.0F / 30, 1.0F / 31
    };
    vfloat sum[BINOMIAL_PARTS] = { splat(0.0F), splat(0.0F), splat(0.0F) };
    vfloat survival = s->survival, mass = s->mass, step = s->step;
    vint next = s->first;
    for (int k = 1; any(less_i(s->least, next)); k++) {
#if GLINT_LANES > 1 && GLINT_LANES < 16
        /* Hides from GCC that these stay the same: it would copy all of them to the stack before the loop. Sixteen
         * lanes come with 32 registers, and have room for them. */
        __asm__("" : "+r"(u), "+r"(weight));
#endif
        binomial_count(draws, next, u, weight, sum, drawn);
        if (k == BINOMIAL_WALK_STEPS)
            break;
        /* Denormals would cost up to four times as much. */
        mass = max_f(mass * step * inverse[k], splat(1e-30F));
        step = step - chance->odds;
        survival = survival - mass;
        next = binomial_threshold(max_f(survival + l->b * mass, splat(0.0F)));
    }
    return sum[0] + sum[1] + sum[2];
}

/* X = floor(centre - z (slope - z (bend - z twist))), for the normal quantile z. */
typedef struct binomial_expansion {
    vfloat centre, slope, bend, twist;
} binomial_expansion;

/* Cornish and Fisher's expansion to the third order of a smooth variable that rounds to the count: rounding adds 1/12
 * to its variance and takes 1/120 from its fourth cumulant. */
static inline binomial_expansion binomial_expansion_of(const binomial_law *l, const binomial_chance *chance)
{
    const vfloat q = 1.0F - chance->p, pq = chance->p * q, whole = l->n * pq;
    const vfloat bq = l->b * (1.0F - l->b);
    /* Of lanes to be expanded it is above 1.9. */
    const vfloat variance = max_f(whole + bq - 0.083333333F, splat(1.0F));
    const vfloat third = whole * (q - chance->p) + bq * (1.0F - 2.0F * l->b);
    const vfloat fourth = whole * (1.0F - 6.0F * pq) + bq * (1.0F - 6.0F * bq) + 0.0083333333F;
    const vfloat s = sqrt_f(variance), inverse = 1.0F / variance, r = s * inverse;
    const vfloat c = third * inverse * (1.0F / 6.0F), e = fourth * inverse * (1.0F / 24.0F), c2 = c * c;
    return (binomial_expansion){ l->mean + 0.5F - c, s + (5.0F * c2 - 3.0F * e) * r, c, (e - 2.0F * c2) * r };
}

/* The sum for large means. */
static inline __attribute__((always_inline)) vfloat binomial_expand(const binomial_law *l,
                                                                    const binomial_chance *chance, const vint *u,
                                                                    const vfloat *weight, vfloat *drawn,
                                                                    const int draws)
{
    const binomial_expansion e = binomial_expansion_of(l, chance);
    vfloat sum[BINOMIAL_PARTS] = { splat(0.0F), splat(0.0F), splat(0.0F) };
#pragma GCC unroll 12
    for (int i = 0; i < draws; i++) {
        const vfloat z = normal_quantile_i(u[i]);
        const vfloat count = floor_f(max_f(e.centre - z * (e.slope - z * (e.bend - z * e.twist)), splat(0.0F)));
        sum[i % BINOMIAL_PARTS] = sum[i % BINOMIAL_PARTS] + weight[i] * count;
        if (drawn)
            drawn[i] = choose(l->wide, count, drawn[i]);
    }
    return sum[0] + sum[1] + sum[2];
}

/* A sum of counts that were taken from the end that the law says, with weights that add up to total. The expansion may
 * go beyond the last trial. */
static inline vfloat binomial_from_start(const binomial_law *l, vfloat sum, float total)
{
    const vfloat most = (l->n + 1.0F) * total;
    sum = min_f(sum, most);
    return choose(l->flip, most - sum, sum);
}

/* Sum of weight[i] * X_i over draws of one law.
 *
 * u        uniform as signed 32-bit integers, turned
 * weight   >= 0
 * drawn    NULL, or where each X_i goes
 * many     known to the compiler
 */
static inline __attribute__((always_inline)) vfloat
binomial_weighted_draws(const binomial_law *l, const binomial_chance *chance, const binomial_start *start,
                        const vint *u, const vfloat *weight, vfloat *drawn, const binomial_many many)
{
    vfloat sum = splat(0.0F);
    for (int i = 0; drawn && i < many.draws; i++)
        drawn[i] = splat(0.0F);
    if (any(less_i(start->least, start->first)))
        sum = binomial_walk(l, chance, start, u, weight, drawn, many.draws);
    if (any(l->wide))
        sum = choose(l->wide, binomial_expand(l, chance, u, weight, drawn, many.draws), sum);
    for (int i = 0; drawn && i < many.draws; i++)
        drawn[i] = binomial_from_start(l, drawn[i], 1.0F);
    return binomial_from_start(l, sum, many.total);
}

/* The same where all lanes are to be expanded. */
static inline __attribute__((always_inline)) vfloat binomial_expanded_draws(const binomial_law *l,
                                                                            const binomial_chance *chance,
                                                                            const vint *u, const vfloat *weight,
                                                                            const binomial_many many)
{
    return binomial_from_start(l, binomial_expand(l, chance, u, weight, (vfloat *)0, many.draws), many.total);
}

/* The same for uniforms as they come. trials: >= 0, up to 1e30. */
static inline __attribute__((always_inline)) vfloat binomial_weighted_sum(vfloat trials, const binomial_chance *chance,
                                                                          const vint *uniform, const vfloat *weight,
                                                                          vfloat dither, vfloat *drawn,
                                                                          const binomial_many many)
{
    const binomial_law l = binomial_law_of(trials, chance);
    vint u[12];
    for (int i = 0; i < many.draws; i++)
        u[i] = binomial_turned(&l, uniform[i]);
    const binomial_start start = binomial_start_of(&l, chance, u, dither, many.draws);
    return binomial_weighted_draws(&l, chance, &start, u, weight, drawn, many);
}

/* One draw alone. */
static inline vfloat binomial_draw(vfloat trials, const binomial_chance *chance, vint uniform, vfloat dither)
{
    const vfloat whole = splat(1.0F);
    return binomial_weighted_sum(trials, chance, &uniform, &whole, dither, (vfloat *)0, (binomial_many){ 1, 1.0F });
}

#endif
