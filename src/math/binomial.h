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
 * Draws are made several at a time because in a glint twelve share one (N, p) and so one exp and one log.
 */
#ifndef MATH_BINOMIAL_H
#define MATH_BINOMIAL_H

#include "math/elementary.h"

/* Below this mean the survival function is walked, above it a Cornish-Fisher expansion of the normal quantile is used.
 * Another one may be given before: the study of the law asks what it costs. */
#if !defined(BINOMIAL_WALK_MEAN)
#define BINOMIAL_WALK_MEAN 8.0F
#endif
#define BINOMIAL_WALK_STEPS 32

/* What depends on p alone. */
typedef struct binomial_chance {
    vmask flip;
    vfloat p;        /* min(p, 1 - p) */
    vfloat given;    /* p as it came */
    vfloat log_miss; /* log(1 - p) */
    vfloat odds;     /* p / (1 - p) */
    vfloat skew;     /* (1 - 2 p) / 6 */
} binomial_chance;

/* p in [0, 1]. */
static inline binomial_chance binomial_chance_of(vfloat p)
{
    binomial_chance c;
    c.given = p;
    c.flip = less(splat(0.5F), p);
    c.p = choose(c.flip, 1.0F - p, p);
    c.log_miss = log1m_half(c.p);
    c.odds = c.p / (1.0F - c.p);
    c.skew = (1.0F - 2.0F * c.p) * (1.0F / 6.0F);
    return c;
}

/* s in [0, 1] to the number T for which a signed uniform 32-bit u with u < T has probability s. dither, uniform in [0,
 * 1), rounds up or down at random, so that the probability is right in the mean even below 2^-31. */
static inline vint binomial_threshold(vfloat s, vfloat dither)
{
    const vfloat most = splat(2147483520.0F); /* the largest float below 2^31 */
    const vfloat t = max_f(s, splat(0.0F)) * 2147483648.0F + dither;
    /* The smaller one by its bits: GCC 12 converts both and then chooses, and 2^31 is no integer to convert. */
    const vfloat fits = float_from_bits((vuint)min_i((vint)bits_of(t), (vint)bits_of(most)));
    const vint scaled = (vint)((vuint)to_int(fits) << 1 ^ 0x80000000U);
    return choose_i(less(most, t), splat_i(INT32_MAX), scaled);
}

/* How many draws share one (N, p): groups, with a dither each, of so many. At most three of four. */
typedef struct binomial_many {
    int groups, each;
} binomial_many;

/* One step of the walk for one group: those draws whose uniform is below the threshold count one more. */
static inline __attribute__((always_inline)) vfloat binomial_count(int draws, vint threshold, const vint *u,
                                                                   const vfloat *weight, vfloat sum, vfloat *drawn)
{
    for (int i = 0; i < draws; i++) {
        const vmask more = less_i(u[i], threshold);
        sum = add_where(more, sum, weight[i]);
        if (drawn)
            drawn[i] = add_where(more, drawn[i], splat(1.0F));
    }
    return sum;
}

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

/* The sum for small means: steps through the survival function until every uniform has been met. */
static inline __attribute__((always_inline)) vfloat binomial_walk(const binomial_law *l, const binomial_chance *chance,
                                                                  const vint *u, const vfloat *weight,
                                                                  const vfloat *dither, vfloat *drawn,
                                                                  const binomial_many many)
{
    static const float inverse[BINOMIAL_WALK_STEPS] = {
        0.0F,      1.0F / 1,  1.0F / 2,  1.0F / 3,  1.0F / 4,  1.0F / 5,  1.0F / 6,  1.0F / 7,
        1.0F / 8,  1.0F / 9,  1.0F / 10, 1.0F / 11, 1.0F / 12, 1.0F / 13, 1.0F / 14, 1.0F / 15,
        1.0F / 16, 1.0F / 17, 1.0F / 18, 1.0F / 19, 1.0F / 20, 1.0F / 21, 1.0F / 22, 1.0F / 23,
        1.0F / 24, 1.0F / 25, 1.0F / 26, 1.0F / 27, 1.0F / 28, 1.0F / 29, 1.0F / 30, 1.0F / 31
    };
    vfloat em1, mass;
    exp_both(l->n * chance->log_miss, &em1, &mass);
    vint least = u[0];
    for (int i = 1; i < many.groups * many.each; i++)
        least = min_i(least, u[i]);
    least = choose_i(l->wide, splat_i(INT32_MAX), least);

    vfloat group[3] = { splat(0.0F), splat(0.0F), splat(0.0F) };
    /* A step of 0 keeps lanes that are not walked from overflowing. */
    vfloat survival = -em1, step = choose(l->wide, splat(0.0F), l->n * chance->odds);
    vint first[3];
    vmask left = mask_none();
    for (int g = 0; g < many.groups; g++) {
        first[g] = binomial_threshold(survival + l->b * mass, dither[g]);
        left = left | less_i(least, first[g]);
    }
    if (!any(left))
        return splat(0.0F);
    for (int g = 0; g < many.groups; g++) {
        const int from = many.each * g;
        group[g] = binomial_count(many.each, first[g], u + from, weight + from, group[g], drawn ? drawn + from : drawn);
    }
    for (int k = 1; k < BINOMIAL_WALK_STEPS; k++) {
        /* Denormals would cost up to four times as much. */
        mass = max_f(mass * step * inverse[k], splat(1e-30F));
        step = step - chance->odds;
        survival = survival - mass;
        const vint next = binomial_threshold(survival + l->b * mass, splat(0.0F));
        if (!any(less_i(least, next)))
            break;
        for (int g = 0; g < many.groups; g++) {
            const int from = many.each * g;
            group[g] = binomial_count(many.each, next, u + from, weight + from, group[g], drawn ? drawn + from : drawn);
        }
    }
    return group[0] + group[1] + group[2];
}

/* The sum for large means: X = floor(m + 1/2 - c + z (s + c z)), with continuity and skewness corrections (Cornish and
 * Fisher). */
static inline __attribute__((always_inline)) vfloat binomial_expand(const binomial_law *l,
                                                                    const binomial_chance *chance, const vint *u,
                                                                    const vfloat *weight, vfloat *drawn,
                                                                    const binomial_many many)
{
    const vfloat variance = l->n * chance->p * (1.0F - chance->p) + l->b * (1.0F - l->b);
    const vfloat c = chance->skew;
    const vfloat s = sqrt_f(max_f(variance - 0.083333333F - 2.0F * c * c, splat(0.0F)));
    const vfloat centre = l->mean + 0.5F - c;
    vfloat group[3] = { splat(0.0F), splat(0.0F), splat(0.0F) };
    for (int g = 0; g < many.groups; g++)
        for (int i = many.each * g; i < many.each * (g + 1); i++) {
            const vfloat z = normal_quantile(to_float(u[i]) * 4.656612e-10F);
            const vfloat x = min_f(max_f(floor_f(centre - z * (s - c * z)), splat(0.0F)), l->n + 1.0F);
            group[g] = group[g] + weight[i] * x;
            if (drawn)
                drawn[i] = choose(l->wide, x, drawn[i]);
        }
    return group[0] + group[1] + group[2];
}

/* Sum of weight[i] * X_i over draws from b(trials, chance).
 *
 * trials   >= 0, up to 1e30
 * uniform  hashes, uniform as signed 32-bit integers
 * weight   >= 0
 * drawn    NULL, or where each X_i goes
 * many     known to the compiler
 */
static inline __attribute__((always_inline)) vfloat
binomial_weighted_draws(vfloat trials, const binomial_chance *chance, const vint *uniform, const vfloat *weight,
                        const vfloat *dither, vfloat *drawn, const binomial_many many)
{
    const int all = many.groups * many.each;
    const binomial_law l = binomial_law_of(trials, chance);
    vfloat sum = splat(0.0F), total = splat(0.0F);
    vint u[12];
    for (int i = 0; i < all; i++) {
        u[i] = uniform[i] ^ mask_bits(l.flip);
        total = total + weight[i];
        if (drawn)
            drawn[i] = splat(0.0F);
    }
    if (any(~l.wide))
        sum = binomial_walk(&l, chance, u, weight, dither, drawn, many);
    if (any(l.wide))
        sum = choose(l.wide, binomial_expand(&l, chance, u, weight, drawn, many), sum);
    for (int i = 0; drawn && i < all; i++)
        drawn[i] = choose(l.flip, l.n + 1.0F - drawn[i], drawn[i]);
    return choose(l.flip, (l.n + 1.0F) * total - sum, sum);
}

/* Twelve draws, in three groups of four. */
static inline vfloat binomial_weighted_sum(vfloat trials, const binomial_chance *chance, const vint uniform[12],
                                           const vfloat weight[12], const vfloat dither[3])
{
    return binomial_weighted_draws(trials, chance, uniform, weight, dither, (vfloat *)0, (binomial_many){ 3, 4 });
}

/* One draw alone. */
static inline vfloat binomial_draw(vfloat trials, const binomial_chance *chance, vint uniform, vfloat dither)
{
    const vfloat whole = splat(1.0F);
    return binomial_weighted_draws(trials, chance, &uniform, &whole, &dither, (vfloat *)0, (binomial_many){ 1, 1 });
}

#endif
