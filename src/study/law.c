/* The study of the binomial law: how far samplers are from it, over trials and chances, and what a draw costs. */
#include "study/law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/statistics.h"
#include "study/study.h"

extern const unsigned char law_gnuplot[], law_front_gnuplot[];

typedef struct sampler {
    const char *name;
    law_draw *draw;
} sampler;

enum { PUBLISHED, GATED, CLAMPED, OURS_2, OURS_5, OURS_8, OURS_16, EXACT, SAMPLERS };

static const sampler samplers[SAMPLERS] = {
    [PUBLISHED] = { "gated Gaussian as printed", law_as_published },
    [GATED] = { "gated Gaussian cut at 0 (DB23)", law_gated },
    [CLAMPED] = { "cut to [1; N] (KK24)", law_clamped },
    [OURS_2] = { "libglint walking to 2", law_ours_2 },
    [OURS_5] = { "libglint (walking to 5)", law_ours_5 },
    [OURS_8] = { "libglint walking to 8", law_ours_8 },
    [OURS_16] = { "libglint walking to 16", law_ours_16 },
    [EXACT] = { "exact (BTPE)", law_exact },
};

static const float trials_of[] = { 0.3F, 1.5F, 2.0F, 5.0F, 10.0F, 30.0F, 100.0F, 1000.0F, 10000.0F };
static const float chances[] = { 1e-3F, 0.01F, 0.1F, 0.3F, 0.6F, 0.95F };
enum { TRIALS = sizeof trials_of / sizeof trials_of[0], CHANCES = sizeof chances / sizeof chances[0] };

/* Over all (N, p). */
typedef struct law_error {
    double worst_mean, worst_ks, bar; /* standard deviation of the mean where it is worst */
    double ks_bar;
    double square;
    int cases;
} law_error;

static double cdf_at(const double *cumulative, double from, double k)
{
    return k < from ? 0.0 : cumulative[(int)(k - from)];
}

/* P(X <= k) of Binomial(floor N, p) + Bernoulli(fraction p) for k from `from` on; the number of them. */
static int exact_cdf(double trials, double p, double *from, double **cumulative)
{
    const double n = floor(trials), hit = (trials - n) * p, sd = sqrt(n * p * (1.0 - p)) + 1.0;
    *from = fmax(0.0, floor(n * p - 10.0 * sd - 4.0));
    const int count = (int)(fmin(n + 1.0, ceil(n * p + 10.0 * sd + 12.0)) - *from) + 1;
    *cumulative = malloc((size_t)count * sizeof(double));
    double sum = 0.0, before = 0.0;
    for (int i = 0; *cumulative && i < count; i++) {
        const double k = *from + i;
        const double mass =
            k > n ? 0.0
                  : exp(lgamma(n + 1.0) - lgamma(k + 1.0) - lgamma(n - k + 1.0) + k * log(p) + (n - k) * log1p(-p));
        sum += mass;
        (*cumulative)[i] = (1.0 - hit) * sum + hit * before;
        before = sum;
    }
    return count;
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The largest distance between the distribution of sorted draws and the law. */
static double kolmogorov(const float *draws, int count, double trials, double p)
{
    double from, *cumulative, worst = 0.0;
    const int ks = exact_cdf(trials, p, &from, &cumulative);
    if (!cumulative)
        return (double)NAN;
    int below = 0;
    for (int i = 0; i < ks; i++) {
        while (below < count && (double)draws[below] <= from + i)
            below++;
        worst = fmax(worst, fabs((double)below / count - cdf_at(cumulative, from, from + i)));
    }
    free(cumulative);
    return worst;
}

/* Base 2, backwards: with i / count a set of pairs that is even in both. */
static uint32_t reversed(uint32_t i)
{
    uint32_t r = 0;
    for (int k = 0; k < 32; k++)
        r |= (i >> k & 1U) << (31 - k);
    return r;
}

static void draw_all(const sampler *s, float trials, float p, int groups, float *draws)
{
    const uint32_t step = (uint32_t)(4294967296.0 / (groups * LAW_DRAWS));
    uint64_t state = 61;
    for (int g = 0; g < groups; g++) {
        law_source source = { .state = &state };
        for (int i = 0; i < LAW_DRAWS; i++) {
            const uint32_t k = (uint32_t)(g * LAW_DRAWS + i);
            source.uniform[0][i] = k * step + step / 2U;
            source.uniform[1][i] = reversed(k);
        }
        s->draw(trials, p, &source, draws + (size_t)g * LAW_DRAWS);
    }
}

static void measure_case(study_run *run, int which, float trials, float p, int groups, float *draws, law_error *worst)
{
    const double mean = (double)trials * (double)p;
    const int count = groups * LAW_DRAWS;
    moments m = { 0 };
    draw_all(&samplers[which], trials, p, groups, draws);
    for (int i = 0; i < count; i++)
        moments_add(&m, (double)draws[i]);
    qsort(draws, (size_t)count, sizeof *draws, compare_floats);
    const double n = floor((double)trials), hit = ((double)trials - n) * (double)p;
    const double variance = n * (double)p * (1.0 - (double)p) + hit * (1.0 - hit);
    const double error = fabs(m.mean / mean - 1.0), ks = kolmogorov(draws, count, (double)trials, (double)p);
    /* Even uniforms give the mean to the range over their number; random ones to a standard error. */
    const double bar = which == EXACT ? sqrt(variance / count) / mean : 6.0 * sqrt(variance) / count / mean;
    study_row(run, "%s,%g,%g,%.6g,%.6g,%.3g,%.4g,%d", samplers[which].name, (double)trials, (double)p, m.mean / mean,
              moments_variance(&m) / variance, bar, ks, count);
    worst->square += error * error;
    worst->cases++;
    worst->worst_ks = fmax(worst->worst_ks, ks);
    worst->ks_bar = which == EXACT ? 0.5 / sqrt(count) : 6.0 / count;
    if (error > worst->worst_mean) {
        worst->worst_mean = error;
        worst->bar = bar;
    }
}

/* Mean and distribution of every sampler at every (N, p) of which a tenth of a facet or more is lit. */
static void measure_errors(study_run *run, law_error worst[SAMPLERS])
{
    const int groups = study_is_quick(run) ? 4096 : 65536;
    float *const draws = malloc((size_t)groups * LAW_DRAWS * sizeof *draws);
    if (!draws) {
        report_error(study_report(run), "law: no memory for %d draws", groups * LAW_DRAWS);
        return;
    }
    study_table(run, "law.csv", "sampler,trials,p,mean,variance,mean_bar,ks,draws");
    for (int k = 0; k < SAMPLERS; k++)
        for (int i = 0; i < TRIALS && study_goes_on(run, 0.7 * (k + (double)i / TRIALS) / SAMPLERS); i++)
            for (int j = 0; j < CHANCES; j++)
                if (trials_of[i] * chances[j] >= 0.1F)
                    measure_case(run, k, trials_of[i], chances[j], groups, draws, &worst[k]);
    study_end_table(run);
    free(draws);
}

enum { ROUNDS = 25, GROUPS = 256 };

/* Nanoseconds a draw, over the same cases, with uniforms that lie ready. */
static double cost_of(const sampler *s, const law_source sources[GROUPS])
{
    static float draws[LAW_DRAWS];
    int cases = 0;
    const double start = study_cpu_s();
    for (int i = 0; i < TRIALS; i++)
        for (int j = 0; j < CHANCES; j++) {
            if (trials_of[i] * chances[j] < 0.1F)
                continue;
            for (int g = 0; g < GROUPS; g++)
                s->draw(trials_of[i], chances[j], &sources[g], draws);
            cases++;
        }
    return (study_cpu_s() - start) * 1e9 / (cases * GROUPS * LAW_DRAWS);
}

/* The median of rounds in which all take turns. */
static void measure_costs(study_run *run, double cost[SAMPLERS])
{
    static double times[SAMPLERS][ROUNDS];
    static law_source sources[GROUPS];
    uint64_t random = 63, state = 62;
    for (int g = 0; g < GROUPS; g++) {
        for (int i = 0; i < 2 * LAW_DRAWS; i++)
            sources[g].uniform[i / LAW_DRAWS][i % LAW_DRAWS] = (uint32_t)(random_bits(&random) >> 32);
        sources[g].state = &state;
    }
    for (int round = 0; round < ROUNDS && study_goes_on(run, 0.7 + 0.3 * round / ROUNDS); round++)
        for (int k = 0; k < SAMPLERS; k++)
            times[k][round] = cost_of(&samplers[k], sources);
    for (int k = 0; k < SAMPLERS; k++)
        cost[k] = study_median(times[k], ROUNDS);
}

static void measure(study_run *run)
{
    law_error worst[SAMPLERS] = { 0 };
    double cost[SAMPLERS];
    measure_errors(run, worst);
    measure_costs(run, cost);
    if (!study_goes_on(run, 1.0))
        return;
    study_setting mean[SAMPLERS], whole[SAMPLERS];
    for (int k = 0; k < SAMPLERS; k++) {
        mean[k] = (study_setting){ samplers[k].name, cost[k], worst[k].worst_mean, worst[k].bar, false };
        whole[k] = (study_setting){ samplers[k].name, cost[k], worst[k].worst_ks, worst[k].ks_bar, false };
    }
    static const study_dial means = { "law_front.csv",
                                      "The mean of a count; twelve draws share (N, p), one lane.",
                                      "ns a draw",
                                      "cost_ns",
                                      "worst error of the mean, over its value",
                                      "Take the walk to 5: the mean is as near as with three times the walk." };
    static const study_dial laws = {
        "law_ks_front.csv",
        "The whole law of a count.",
        "ns a draw",
        "cost_ns",
        "worst Kolmogorov distance",
        "Exact draws refuse and try again, so they cannot keep a glint in its place: take the walk to 5."
    };
    study_front(run, &means, mean, SAMPLERS);
    study_front(run, &laws, whole, SAMPLERS);
    study_check(run, worst[OURS_5].worst_mean < 1e-4 + worst[OURS_5].bar,
                "libglint's mean is within %.1e of N p, at most 1e-4 and what even uniforms leave",
                worst[OURS_5].worst_mean);
    study_check(run, worst[OURS_5].worst_ks < 1e-3 + 1e-3, "its distribution is within %.1e of the law, at most 2e-3",
                worst[OURS_5].worst_ks);
    for (int k = PUBLISHED; k <= CLAMPED; k++)
        study_check(run, worst[k].worst_mean > 50.0 * worst[OURS_5].worst_mean,
                    "%s: the mean is up to %.0f %% off, libglint's %.1e times less", samplers[k].name,
                    100.0 * worst[k].worst_mean, worst[k].worst_mean / worst[OURS_5].worst_mean);
    study_note(run, "libglint's draw takes %.0f ns, a published one %.0f ns, an exact one %.0f ns", cost[OURS_5],
               cost[CLAMPED], cost[EXACT]);
    study_check(run, worst[OURS_2].worst_ks > worst[OURS_5].worst_ks,
                "walking to 2 only: the distribution is %.1e off, to 5: %.1e", worst[OURS_2].worst_ks,
                worst[OURS_5].worst_ks);
}

static const study_figure figures[] = {
    { "law_front", "What a draw costs and how far its mean is off at worst. Lower left is better.", law_front_gnuplot },
    { "law", "The mean of each sampler over N p: one point for each of 41 pairs (N, p).", law_gnuplot },
    { NULL, NULL, NULL },
};

extern const study law_study;

const study law_study = {
    .name = "law",
    .title = "The binomial law",
    .truth = "the law itself, term by term in double",
    .choose = "libglint's own draw, which walks to a mean of 5: cheaper than the published ones, and right.",
    .share = 0.04,
    .run = measure,
    .figures = figures,
};
