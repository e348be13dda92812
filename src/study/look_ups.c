/* The study of look-ups: all 36 realisations of a count, one of them drawn for each sample, or always the nearest. */
#include "study/look_ups.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "study/statistics.h"
#include "study/study.h"

extern const unsigned char look_ups_gnuplot[];

enum { ALL, DRAWN, NEAREST, WAYS };
static const char *const way_names[WAYS] = { "all 36", "one drawn by its weight", "the nearest" };

enum { SIDE = 24, PIXELS = SIDE * SIDE, STEPS = 6, TRUTH_SIDE = 32, MOST = TRUTH_SIDE * TRUTH_SIDE };
static const int samples_of[STEPS] = { 1, 4, 16, 64, 256, 1024 };
static const double pixel_m = 1e-3;

/* Lit facets under a pixel: from single sparks to hardly any texture. */
static const double lit_of[] = { 1.0, 30.0 };
enum { PATCHES = sizeof lit_of / sizeof lit_of[0] };
static const float chance = 0.02F;

/* Samples that take long beside the reading of a clock; a divisor of PIXELS. */
enum { FEW = 64 };

typedef struct samples {
    double u[MOST], v[MOST];
    float step[MOST], none[MOST], density[MOST], hx[MOST], hy[MOST], cap[MOST], p[MOST], factor[MOST], facets[MOST];
    uint32_t seed[MOST], draw[MOST];
} samples;

/* From the i-th on, side * side jittered samples of one pixel, each with the footprint that 64 samples a pixel have. */
static void place(samples *s, int i, int x, int y, int side, double lit, uint64_t *random)
{
    for (int k = 0; k < side * side; k++, i++) {
        const int column = k % side, row = k / side;
        s->u[i] = (x + (column + random_uniform(random)) / side) * pixel_m;
        s->v[i] = (y + (row + random_uniform(random)) / side) * pixel_m;
        s->step[i] = (float)(pixel_m / 8.0);
        s->none[i] = 0.0F;
        s->density[i] = (float)(lit / (double)chance / (pixel_m * pixel_m));
        s->hx[i] = 0.11F;
        s->hy[i] = -0.07F;
        s->cap[i] = 1e-3F;
        s->p[i] = chance;
        s->seed[i] = 0x51ed270bU;
        s->draw[i] = (uint32_t)(random_bits(random) >> 32);
    }
}

/* How long it took, in ns. */
static double look_up(int way, samples *s, int count)
{
    const counting_points points = { s->u,       s->v,    s->step, s->none, s->none, s->step,
                                     s->density, s->seed, s->hx,   s->hy,   s->cap,  s->p };
    const double start = study_cpu_s();
    if (way == ALL)
        counting_kernel_1(&points, (size_t)count, s->factor, s->facets);
    else if (way == DRAWN)
        counting_drawn_1(&points, s->draw, (size_t)count, s->factor, s->facets);
    else
        look_up_nearest(&points, (size_t)count, s->factor, s->facets);
    return (study_cpu_s() - start) * 1e9;
}

static double mean_factor(const samples *s, int from, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += (double)s->factor[from + i];
    return sum / count;
}

/* Relative, root mean square over the pixels of a patch, and its standard error. */
typedef struct patch_error {
    double rms, bar, cost_ns; /* a pixel */
} patch_error;

/* The ways take turns at the same samples, of several pixels where those have few; the time is the median of turns. */
static void compare(int step, double lit, const double truth[PIXELS], samples *s, uint64_t *random,
                    patch_error found[WAYS][STEPS])
{
    static double times[WAYS][PIXELS];
    const int count = samples_of[step], side = (int)lround(sqrt(count)), group = count < FEW ? FEW / count : 1;
    moments square[WAYS] = { { 0 } };
    for (int first = 0; first < PIXELS; first += group) {
        for (int k = 0; k < group; k++)
            place(s, k * count, (first + k) % SIDE, (first + k) / SIDE, side, lit, random);
        for (int way = 0; way < WAYS; way++) {
            times[way][first / group] = look_up(way, s, group * count) / group;
            for (int k = 0; k < group; k++) {
                const double error = mean_factor(s, k * count, count) - truth[first + k];
                moments_add(&square[way], error * error);
            }
        }
    }
    for (int way = 0; way < WAYS; way++) {
        const double rms = sqrt(square[way].mean);
        found[way][step] = (patch_error){ rms, moments_standard_error(&square[way]) / (2.0 * rms),
                                          study_median(times[way], PIXELS / group) };
    }
}

static void measure_patch(study_run *run, int patch, samples *s, patch_error found[WAYS][STEPS])
{
    static double truth[PIXELS];
    uint64_t random = 81 + (uint64_t)patch;
    for (int i = 0; i < PIXELS && study_goes_on(run, (patch + 0.7 * i / PIXELS) / PATCHES); i++) {
        place(s, 0, i % SIDE, i / SIDE, TRUTH_SIDE, lit_of[patch], &random);
        look_up(ALL, s, MOST);
        truth[i] = mean_factor(s, 0, MOST);
    }
    for (int step = 0; step < STEPS && study_goes_on(run, (patch + 0.7 + 0.3 * step / STEPS) / PATCHES); step++)
        compare(step, lit_of[patch], truth, s, &random, found);
    for (int way = 0; way < WAYS; way++)
        for (int step = 0; step < STEPS; step++) {
            const patch_error *const e = &found[way][step];
            study_row(run, "%s,%g,%d,%.4g,%.5g,%.2g", way_names[way], lit_of[patch], samples_of[step],
                      e->cost_ns * 1e-3, e->rms, e->bar);
        }
}

/* What one drawn takes of the time of all; and how many times the samples of all it needs for the error that those
 * have with 64 samples, as its own falls with the root of their number from 1024 on. */
typedef struct drawn_price {
    double share, times;
} drawn_price;

static drawn_price price_of(const patch_error found[WAYS][STEPS])
{
    const double more = found[DRAWN][STEPS - 1].rms / found[ALL][3].rms;
    return (drawn_price){ found[DRAWN][STEPS - 1].cost_ns / found[ALL][STEPS - 1].cost_ns,
                          (double)samples_of[STEPS - 1] / samples_of[3] * more * more };
}

/* All ways and numbers of samples on one front. */
static void report_patch(study_run *run, const patch_error found[WAYS][STEPS])
{
    static char names[WAYS * STEPS][64], why[96], choose[128];
    study_setting settings[WAYS * STEPS];
    for (int i = 0; i < WAYS * STEPS; i++) {
        const patch_error *const e = &found[i / STEPS][i % STEPS];
        snprintf(names[i], sizeof names[i], "%s; %d sample%s", way_names[i / STEPS], samples_of[i % STEPS],
                 samples_of[i % STEPS] == 1 ? "" : "s");
        settings[i] = (study_setting){ names[i], e->cost_ns * 1e-3, e->rms, e->bar, false };
    }
    const drawn_price price = price_of(found);
    snprintf(why, sizeof why, "one drawn takes %.2f of their time and needs %.0f times the samples for the same error.",
             price.share, price.times);
    snprintf(choose, sizeof choose, "Take all 36: %s", why);
    study_choose(run, "all 36: %s", why);
    static const study_dial dial = { "look_ups_front.csv",
                                     "Look-ups of a pixel with thirty lit facets.",
                                     "µs a pixel (one lane)",
                                     "cost_us",
                                     "root mean square error over the mean",
                                     choose };
    study_front(run, &dial, settings, WAYS * STEPS);
}

static void measure(study_run *run)
{
    static patch_error found[PATCHES][WAYS][STEPS];
    samples *const s = calloc(1, sizeof *s);
    if (!s) {
        report_error(study_report(run), "look-ups: no memory for samples");
        return;
    }
    study_table(run, "look_ups.csv", "way,lit_facets,samples,cost_us,error,error_bar");
    for (int patch = 0; patch < PATCHES; patch++)
        measure_patch(run, patch, s, found[patch]);
    study_end_table(run);
    free(s);
    if (!study_goes_on(run, 1.0))
        return;
    for (int patch = 0; patch < PATCHES; patch++) {
        const patch_error(*const f)[STEPS] = (const patch_error(*)[STEPS])found[patch];
        study_note(run, "%g lit facet%s: one drawn takes %.2f of the time of all 36", lit_of[patch],
                   lit_of[patch] > 1.0 ? "s" : "", price_of(f).share);
        study_check(
            run, f[DRAWN][STEPS - 1].rms < f[DRAWN][2].rms / 3.0,
            "%g lit facets: drawing comes to the truth as samples are added: %.3f of it with 16, %.3f with 1024",
            lit_of[patch], f[DRAWN][2].rms, f[DRAWN][STEPS - 1].rms);
        study_check(run, f[NEAREST][STEPS - 1].rms > 1.3 * f[DRAWN][STEPS - 1].rms,
                    "%g lit facets: the nearest does not, it shows another surface: %.3f with 1024", lit_of[patch],
                    f[NEAREST][STEPS - 1].rms);
        study_check(
            run, f[ALL][3].rms < f[DRAWN][4].rms,
            "%g lit facets: all 36 in 64 samples are nearer (%.3f) than one drawn in 256 (%.3f), in %.2f of the "
            "time",
            lit_of[patch], f[ALL][3].rms, f[DRAWN][4].rms, f[ALL][3].cost_ns / f[DRAWN][4].cost_ns);
    }
    report_patch(run, (const patch_error(*)[STEPS])found[1]);
}

static const study_figure figures[] = {
    { "look_ups", "Error of a pixel against its cost, for 1 to 1024 samples a pixel.", look_ups_gnuplot },
    { NULL, NULL, NULL },
};

extern const study look_ups_study;

const study look_ups_study = {
    .name = "look-ups",
    .title = "Look-ups: all 36, one drawn, the nearest",
    .truth = "all 36 at 1024 places of each pixel",
    .choose = "all 36: one drawn saves less time than its noise costs.",
    .share = 0.01,
    .run = measure,
    .figures = figures,
};
