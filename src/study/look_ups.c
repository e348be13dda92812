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

typedef struct samples {
    double u[MOST], v[MOST];
    float step[MOST], none[MOST], density[MOST], hx[MOST], hy[MOST], cap[MOST], p[MOST];
    uint32_t seed[MOST], draw[MOST];
} samples;

/* side * side jittered samples of one pixel, each with the footprint that 64 samples a pixel have. */
static void place(samples *s, int x, int y, int side, double lit, uint64_t *random)
{
    for (int i = 0; i < side * side; i++) {
        const int column = i % side, row = i / side;
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

static double mean_factor(int way, const samples *s, int count)
{
    static float factor[MOST], facets[MOST];
    const counting_points points = { s->u,       s->v,    s->step, s->none, s->none, s->step,
                                     s->density, s->seed, s->hx,   s->hy,   s->cap,  s->p };
    if (way == ALL)
        counting_kernel_1(&points, (size_t)count, factor, facets);
    else if (way == DRAWN)
        counting_drawn_1(&points, s->draw, (size_t)count, factor, facets);
    else
        look_up_nearest(&points, (size_t)count, factor, facets);
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += (double)factor[i];
    return sum / count;
}

/* Relative, root mean square over the pixels of a patch, and its standard error. */
typedef struct patch_error {
    double rms, bar, cost_ns; /* a pixel */
} patch_error;

static patch_error compare(int way, int step, double lit, const double truth[PIXELS], samples *s, uint64_t *random)
{
    const int side = (int)lround(sqrt(samples_of[step]));
    moments square = { 0 };
    double elapsed = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        place(s, i % SIDE, i / SIDE, side, lit, random);
        const double start = study_cpu_s(), mean = mean_factor(way, s, samples_of[step]);
        elapsed += study_cpu_s() - start;
        moments_add(&square, (mean - truth[i]) * (mean - truth[i]));
    }
    const double rms = sqrt(square.mean);
    return (patch_error){ rms, moments_standard_error(&square) / (2.0 * rms), elapsed * 1e9 / PIXELS };
}

static void measure_patch(study_run *run, int patch, samples *s, patch_error found[WAYS][STEPS])
{
    static double truth[PIXELS];
    uint64_t random = 81 + (uint64_t)patch;
    for (int i = 0; i < PIXELS && study_goes_on(run, (patch + 0.7 * i / PIXELS) / PATCHES); i++) {
        place(s, i % SIDE, i / SIDE, TRUTH_SIDE, lit_of[patch], &random);
        truth[i] = mean_factor(ALL, s, MOST);
    }
    for (int way = 0; way < WAYS; way++)
        for (int step = 0; step < STEPS && study_goes_on(run, (patch + 0.7 + 0.1 * way) / PATCHES); step++) {
            const patch_error e = compare(way, step, lit_of[patch], truth, s, &random);
            found[way][step] = e;
            study_row(run, "%s,%g,%d,%.4g,%.5g,%.2g", way_names[way], lit_of[patch], samples_of[step], e.cost_ns * 1e-3,
                      e.rms, e.bar);
        }
}

/* All ways and numbers of samples on one front. */
static void report_patch(study_run *run, const patch_error found[WAYS][STEPS])
{
    static char names[WAYS * STEPS][64];
    study_setting settings[WAYS * STEPS];
    for (int i = 0; i < WAYS * STEPS; i++) {
        const patch_error *const e = &found[i / STEPS][i % STEPS];
        snprintf(names[i], sizeof names[i], "%s; %d sample%s", way_names[i / STEPS], samples_of[i % STEPS],
                 samples_of[i % STEPS] == 1 ? "" : "s");
        settings[i] = (study_setting){ names[i], e->cost_ns * 1e-3, e->rms, e->bar, false };
    }
    static const study_dial dial = {
        "look_ups_front.csv",
        "Look-ups of a pixel with thirty lit facets.",
        "µs a pixel (one lane)",
        "cost_us",
        "root mean square error over the mean",
        "Take all 36: one drawn costs six tenths of it and needs sixteen times the samples."
    };
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
        study_check(run, f[DRAWN][STEPS - 1].cost_ns < 0.7 * f[ALL][STEPS - 1].cost_ns,
                    "%g lit facets: one drawn takes %.2f of the time of all 36", lit_of[patch],
                    f[DRAWN][STEPS - 1].cost_ns / f[ALL][STEPS - 1].cost_ns);
        study_check(
            run, f[DRAWN][STEPS - 1].rms < f[DRAWN][2].rms / 3.0,
            "%g lit facets: drawing comes to the truth as samples are added: %.3f of it with 16, %.3f with 1024",
            lit_of[patch], f[DRAWN][2].rms, f[DRAWN][STEPS - 1].rms);
        study_check(run, f[NEAREST][STEPS - 1].rms > 1.3 * f[DRAWN][STEPS - 1].rms,
                    "%g lit facets: the nearest does not, it shows another surface: %.3f with 1024", lit_of[patch],
                    f[NEAREST][STEPS - 1].rms);
        study_check(run, f[ALL][3].cost_ns < f[DRAWN][4].cost_ns && f[ALL][3].rms < f[DRAWN][4].rms,
                    "%g lit facets: all 36 in 64 samples are nearer (%.3f) than one drawn in 256 (%.3f), and cheaper",
                    lit_of[patch], f[ALL][3].rms, f[DRAWN][4].rms);
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
    .choose = "all 36: one drawn costs six tenths and needs sixteen times the samples for the same error.",
    .share = 0.01,
    .run = measure,
    .figures = figures,
};
