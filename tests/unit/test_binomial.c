/* The binomial law against the exact one, found from the sampler itself by bisection over its uniform. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#define GLINT_LANES 1
#include "math/binomial.h"
#include "statistics.h"

static double draw(double trials, double p, int64_t u, float dither)
{
    vint uniform[12];
    vfloat weight[12] = { 1.0F };
    for (int i = 0; i < 12; i++)
        uniform[i] = i == 0 ? (vint)u : INT32_MAX;
    const binomial_chance c = binomial_chance_of((float)p);
    return (double)binomial_weighted_sum((float)trials, &c, uniform, weight, dither, NULL, (binomial_many){ 12, 1.0F });
}

/* P(X > k) as the sampler has it: the share of uniforms that give more than k, in the mean over dithers. X falls with
 * u. */
static double sampled_survival(double trials, double p, double k)
{
    enum { DITHERS = 8 };
    double sum = 0.0;
    for (int d = 0; d < DITHERS; d++) {
        int64_t low = INT32_MIN, high = (int64_t)INT32_MAX + 1;
        while (low < high) {
            const int64_t middle = low + (high - low) / 2;
            if (draw(trials, p, middle, ((float)d + 0.5F) / DITHERS) > k)
                low = middle + 1;
            else
                high = middle;
        }
        sum += ((double)low - INT32_MIN) / 4294967296.0;
    }
    return sum / DITHERS;
}

/* P(Binomial(n, p) <= k) in double: the sum of the terms, from logarithms of factorials. */
static double binomial_cdf(double n, double p, double k)
{
    if (k < 0.0)
        return 0.0;
    if (k >= n)
        return 1.0;
    double sum = 0.0;
    const double sd = sqrt(n * p * (1.0 - p));
    const double from = fmax(0.0, floor(fmin(k, n * p) - 12.0 * sd - 40.0));
    for (double j = from; j <= k; j += 1.0)
        sum += exp(lgamma(n + 1.0) - lgamma(j + 1.0) - lgamma(n - j + 1.0) + j * log(p) + (n - j) * log1p(-p));
    return fmin(sum, 1.0);
}

/* The law of a real number of trials: X = Binomial(n, p) + Bernoulli(f p). */
static double exact_survival(double trials, double p, double k)
{
    const double n = floor(trials), hit = (trials - n) * p;
    return 1.0 - (hit * binomial_cdf(n, p, k - 1.0) + (1.0 - hit) * binomial_cdf(n, p, k));
}

static double exact_variance(double trials, double p)
{
    const double n = floor(trials), hit = (trials - n) * p;
    return n * p * (1.0 - p) + hit * (1.0 - hit);
}

typedef struct law_error {
    double mean, variance, ks;
} law_error;

/* Every k that matters, one by one. */
static law_error error_by_survival(double trials, double p)
{
    const double m = trials * p, sd = sqrt(exact_variance(trials, p));
    const double from = fmax(0.0, floor(m - 7.0 * sd - 3.0)), to = ceil(fmin(floor(trials) + 1.0, m + 8.0 * sd + 12.0));
    double mean = from, square = 0.0, ks = 0.0;
    for (double k = from; k <= to; k += 1.0) {
        const double s = sampled_survival(trials, p, k);
        mean += s;
        square += s * (2.0 * (k - from) + 1.0);
        ks = fmax(ks, fabs(s - exact_survival(trials, p, k)));
    }
    const double variance = square - (mean - from) * (mean - from);
    return (law_error){ fabs(mean / m - 1.0), fabs(variance / exact_variance(trials, p) - 1.0), ks };
}

static void law_is_exact_for_counts_that_can_be_listed(void **state)
{
    (void)state;
    static const double n[] = { 1e-6, 0.1,  0.5,   1.0,   1.5, 2.0, 3.7, 5.0, 10.0,
                                17.3, 30.0, 100.0, 333.3, 1e3, 1e4, 1e6, 1e9 };
    static const double p[] = { 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 0.6, 0.8, 0.9, 0.95, 0.99, 0.999 };
    law_error worst = { 0 };
    for (size_t i = 0; i < sizeof(n) / sizeof(n[0]); i++)
        for (size_t j = 0; j < sizeof(p) / sizeof(p[0]); j++) {
            /* The truth takes the float that the sampler gets. */
            const double trials = (double)(float)n[i], chance = (double)(float)p[j];
            if (trials * chance * (1.0 - chance) > 400.0 || trials * chance < 1e-7)
                continue;
            const law_error e = error_by_survival(trials, chance);
            if (e.mean > 5e-5 || e.variance > 5e-4 || e.ks > 4e-4)
                printf("N %g p %g: mean %.1e variance %.1e KS %.1e\n", trials, chance, e.mean, e.variance, e.ks);
            worst.mean = fmax(worst.mean, e.mean);
            worst.variance = fmax(worst.variance, e.variance);
            worst.ks = fmax(worst.ks, e.ks);
        }
    printf("worst of the listed counts: mean %.1e (bound 1e-4), variance %.1e (1e-3), Kolmogorov-Smirnov %.1e (1e-3)\n",
           worst.mean, worst.variance, worst.ks);
    assert_true(worst.mean < 1e-4);
    assert_true(worst.variance < 1e-3);
    assert_true(worst.ks < 1e-3);
}

static void law_is_exact_for_large_counts(void **state)
{
    (void)state;
    static const double n[] = { 1e4, 1e5, 1e7, 1e9, 1e12 };
    static const double p[] = { 1e-4, 1e-2, 0.1, 0.3, 0.5, 0.7, 0.99, 0.9999 };
    enum { STEPS = 400000 };
    for (size_t i = 0; i < sizeof(n) / sizeof(n[0]); i++)
        for (size_t j = 0; j < sizeof(p) / sizeof(p[0]); j++) {
            const double trials = (double)(float)n[i], chance = (double)(float)p[j];
            const double variance = exact_variance(trials, chance), m = trials * chance;
            if (variance < 400.0)
                continue;
            moments x = { 0 };
            double ks = 0.0;
            for (int k = 0; k < STEPS; k++) {
                const double u = (k + 0.5) / STEPS;
                const double d =
                    (draw(trials, chance, (int64_t)(u * 4294967296.0) + INT32_MIN, 0.5F) - m) / sqrt(variance);
                moments_add(&x, d);
                /* A count of float precision is a little spread; the law itself is normal to 1 / sqrt(variance). */
                const double normal = 0.5 * erfc(d / sqrt(2.0));
                ks = fmax(ks, fabs(normal - u));
            }
            /* A count above 2^24 is a float: its rounding, half an ulp of N, is allowed for. */
            const double rounding = trials * 6e-8 / sqrt(variance);
            const double mean_error = fabs(x.mean) * sqrt(variance) / m;
            if (mean_error > 1e-5 || fabs(moments_variance(&x) - 1.0) > 1e-3)
                printf("N %g p %g: mean %.1e variance %.1e\n", trials, chance, mean_error, moments_variance(&x) - 1.0);
            assert_true(mean_error < 1e-4);
            assert_true(fabs(moments_variance(&x) - 1.0) < 1e-3 + 2.0 * rounding * rounding);
            assert_true(ks < 1e-3 + 0.5 / sqrt(variance) + rounding);
        }
}

/* Whether the mean is small enough for the walk: of the misses where the count is taken from the other end. */
static int is_walked(double trials, double p)
{
    const double n = floor(trials);
    const double mean = p > 0.5 && n >= 1.0 ? n * (1.0 - p) + 1.0 - (trials - n) * p : trials * p;
    return mean < (double)BINOMIAL_WALK_MEAN;
}

/* Only the step that hands over from the walk to the expansion may lose a count: the two differ by their own errors
 * there. */
static void check_rise(double n0, double p0, double n1, double p1, int64_t u)
{
    const double before = draw(n0, p0, u, 0.5F), after = draw(n1, p1, u, 0.5F);
    const double allowed = is_walked(n0, p0) != is_walked(n1, p1) ? 1.0 : 0.0;
    if (after < before - allowed)
        fail_msg("N %g p %g: %g, N %g p %g: %g", n0, p0, before, n1, p1, after);
}

static void count_never_falls_as_trials_or_chance_grow(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int k = 0; k < 20000; k++) {
        const int64_t u = (int64_t)(random_bits(&random) & 0xffffffffU) + INT32_MIN;
        const double n = random_log_between(&random, 0.1, 1e4), p = random_log_between(&random, 1e-4, 0.9);
        for (int i = 0; i < 60; i++) {
            const double here = 1.0 + 0.02 * i, next = 1.0 + 0.02 * (i + 1);
            check_rise(n * here, p, n * next, p, u);
            check_rise(n, fmin(p * here, 1.0), n, fmin(p * next, 1.0), u);
        }
    }
}

/* A thousandth more in the mean changes the count by at most one. */
static void count_does_not_jump(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int k = 0; k < 200000; k++) {
        const int64_t u = (int64_t)(random_bits(&random) & 0xffffffffU) + INT32_MIN;
        const double n = random_log_between(&random, 0.1, 1e4), p = random_log_between(&random, 1e-4, 0.9);
        const double step = 1.0 + 1e-3 / fmax(n * p, 1e-3), x = draw(n, p, u, 0.5F);
        assert_true(fabs(draw(n * step, p, u, 0.5F) - x) <= 1.0);
        assert_true(fabs(draw(n, fmin(p * step, 1.0), u, 0.5F) - x) <= 1.0);
    }
}

static void certain_and_impossible_are_what_they_say(void **state)
{
    (void)state;
    /* The outermost 256 of 2^32 uniforms are left out: a threshold is twice a float below 2^31, so a certain facet is
     * missed there. */
    for (int64_t u = INT32_MIN + 257; u < INT32_MAX - 256; u += 65537)
        for (double n = 0.0; n < 1e12; n = 3.0 * n + 1.0) {
            assert_true(draw(n, 0.0, u, 0.999F) == 0.0);
            /* Above 2^24 a float steps by two and more: (n + 1) - 1 may be the next one. */
            assert_true(fabs(draw(n, 1.0, u, 0.999F) - (double)(float)n) <= (n > 16777215.0 ? 1.2e-7 * n : 0.0));
        }
    /* One trial over again: the fraction is present with its own chance. */
    assert_true(fabs(sampled_survival(0.25, 1.0, 0.0) - 0.25) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(law_is_exact_for_counts_that_can_be_listed), cmocka_unit_test(law_is_exact_for_large_counts),
        cmocka_unit_test(count_never_falls_as_trials_or_chance_grow), cmocka_unit_test(count_does_not_jump),
        cmocka_unit_test(certain_and_impossible_are_what_they_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
