/* The study of models against explicit, facet by facet: mean, variance of blocks of pixels, and cost, on a flat patch.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "study/statistics.h"
#include "study/study.h"

extern const unsigned char models_gnuplot[];

enum { SIDE = 48, PIXELS = SIDE * SIDE, BLOCKS = 3, MOST_SEEDS = 64 };
static const int block_of[BLOCKS] = { 1, 4, 16 };

enum { SMOOTH, COUNTING, DICTIONARY, EXAMPLE, EXPLICIT, KINDS };
static const glint_model model_of[KINDS] = { GLINT_MODEL_SMOOTH, GLINT_MODEL_COUNTING, GLINT_MODEL_DICTIONARY,
                                             GLINT_MODEL_EXAMPLE, GLINT_MODEL_EXPLICIT };

static const double facets_of[] = { 4.0, 64.0, 1024.0 };
enum { DENSITIES = sizeof facets_of / sizeof facets_of[0] };

typedef struct patch {
    moments mean;             /* of seeds */
    moments variance[BLOCKS]; /* of block means over the squared smooth value, of seeds */
    double cost_ns;
} patch;

/* f cos_i of the lobe itself: that of the example model is its map's. */
static float smooth_value(const glint_surface *s, const float wo[3], const float wi[3])
{
    glint_material *lobe = NULL;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_SMOOTH;
    o.distribution = GLINT_DISTRIBUTION_BECKMANN;
    float rgb[3] = { 1.0F, 1.0F, 1.0F };
    if (glint_material_create(&o, &lobe, NULL, 0) == GLINT_OK)
        glint_eval(lobe, s, NULL, wo, wi, NULL, rgb);
    glint_material_destroy(lobe);
    return rgb[0];
}

/* Pixels of .1 mm in a square over the smooth value, seen and lit near the mirrored direction; each seed another
 * surface under another light. */
static void shade(const glint_material *m, uint32_t seed, double facets, float *pixels)
{
    static const float wo[3] = { 0.0F, 0.28F, 0.96F };
    static const glint_light light = { GLINT_LIGHT_CAP, 1e-2F };
    uint64_t random = seed;
    const double x = random_between(&random, -0.2, 0.2), y = -0.28 + random_between(&random, -0.2, 0.2);
    const float wi[3] = { (float)x, (float)y, (float)sqrt(1.0 - x * x - y * y) };
    glint_surface s = glint_material_surface(m);
    s.facets_per_m2 = (float)(facets * 1e8);
    const float smooth = smooth_value(&s, wo, wi);
    for (int i = 0; i < PIXELS; i++) {
        const int column = i % SIDE, row = i / SIDE;
        const glint_footprint f = { .u = column * 1e-4, .v = row * 1e-4, .dudx = 1e-4F, .dvdy = 1e-4F, .seed = seed };
        float rgb[3];
        glint_eval(m, &s, &f, wo, wi, &light, rgb);
        pixels[i] = rgb[0] / smooth;
    }
}

static double block_variance(const float *pixels, int block)
{
    moments m = { 0 };
    for (int y = 0; y + block <= SIDE; y += block)
        for (int x = 0; x + block <= SIDE; x += block) {
            double sum = 0.0;
            for (int i = 0; i < block * block; i++)
                sum += (double)pixels[(y + i / block) * SIDE + x + i % block];
            moments_add(&m, sum / (block * block));
        }
    return moments_variance(&m);
}

/* One surface; what a pixel took, in ns. */
static double measure_surface(const glint_material *m, uint32_t seed, double facets, patch *out)
{
    static float pixels[PIXELS];
    const double start = study_cpu_s();
    shade(m, seed, facets, pixels);
    const double elapsed = study_cpu_s() - start;
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++)
        sum += (double)pixels[i];
    moments_add(&out->mean, sum / PIXELS);
    for (int b = 0; b < BLOCKS; b++)
        moments_add(&out->variance[b], block_variance(pixels, block_of[b]));
    return elapsed * 1e9 / PIXELS;
}

/* All models in turns, surface by surface; the time is the median of them. from: of the study, before it. */
static void measure_density(study_run *run, double from, glint_material *const m[KINDS], double facets, int seeds,
                            patch found[KINDS])
{
    static double times[KINDS][MOST_SEEDS];
    for (int seed = 0; seed < seeds; seed++)
        for (int k = 0; k < KINDS; k++) {
            if (!study_goes_on(run, from + (seed + (double)k / KINDS) / (seeds * DENSITIES)))
                return;
            times[k][seed] = measure_surface(m[k], 1000U + (uint32_t)seed, facets, &found[k]);
        }
    for (int k = 0; k < KINDS; k++)
        found[k].cost_ns = study_median(times[k], seeds);
}

static glint_material *material_of(study_run *run, int kind, double facets)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model_of[kind];
    /* Beckmann, which the dictionary is made for. */
    o.distribution = GLINT_DISTRIBUTION_BECKMANN;
    o.surface.facets_per_m2 = (float)(facets * 1e8);
    o.surface.alpha_x = o.surface.alpha_y = 0.3F;
    /* An example lies side by side: where scattered ones leave a gap the surface is flat, which is another lobe. */
    return study_material(run, &o);
}

/* Relative to the truth: how far the standard deviation of blocks of 4 x 4 pixels is off, and the mean. */
static double deviation_error(const patch *p, const patch *truth, int block)
{
    return fabs(sqrt(p->variance[block].mean / truth->variance[block].mean) - 1.0);
}

static double deviation_bar(const patch *p, const patch *truth, int block)
{
    const double a = moments_standard_error(&p->variance[block]) / fmax(p->variance[block].mean, 1e-30);
    const double b = moments_standard_error(&truth->variance[block]) / truth->variance[block].mean;
    return 0.5 * sqrt((p->variance[block].mean > 0.0 ? a * a : 0.0) + b * b);
}

static void measure_all(study_run *run, int seeds, patch found[DENSITIES][KINDS])
{
    study_table(run, "models.csv",
                "model,facets,cost_ns,mean_error,mean_bar,deviation_1,deviation_4,deviation_16,deviation_4_error,"
                "deviation_4_bar,seeds");
    for (int d = 0; d < DENSITIES && study_goes_on(run, (double)d / DENSITIES); d++) {
        glint_material *m[KINDS];
        for (int k = 0; k < KINDS; k++)
            m[k] = material_of(run, k, facets_of[d]);
        if (study_goes_on(run, (double)d / DENSITIES))
            measure_density(run, (double)d / DENSITIES, m, facets_of[d], seeds, found[d]);
        for (int k = 0; k < KINDS; k++)
            glint_material_destroy(m[k]);
        for (int k = KINDS - 1; k >= 0; k--) {
            const patch *const p = &found[d][k], *const truth = &found[d][EXPLICIT];
            const double a = moments_standard_error(&p->mean), b = moments_standard_error(&truth->mean);
            study_row(run, "%s,%g,%.5g,%.4g,%.2g,%.4g,%.4g,%.4g,%.4g,%.2g,%d", glint_model_name(model_of[k]),
                      facets_of[d], p->cost_ns, fabs(p->mean.mean / truth->mean.mean - 1.0),
                      sqrt(a * a + b * b) / truth->mean.mean, sqrt(p->variance[0].mean / truth->variance[0].mean),
                      sqrt(p->variance[1].mean / truth->variance[1].mean),
                      sqrt(p->variance[2].mean / truth->variance[2].mean), deviation_error(p, truth, 1),
                      deviation_bar(p, truth, 1), seeds);
        }
    }
    study_end_table(run);
}

static void report_front(study_run *run, patch found[DENSITIES][KINDS])
{
    study_setting settings[KINDS];
    const patch *const middle = found[DENSITIES - 1];
    for (int k = 0; k < KINDS; k++)
        settings[k] = (study_setting){ glint_model_name(model_of[k]), middle[k].cost_ns,
                                       deviation_error(&middle[k], &middle[EXPLICIT], 1),
                                       deviation_bar(&middle[k], &middle[EXPLICIT], 1), false };
    static const study_dial dial = { "models_front.csv",
                                     "Models at 1024 facets a pixel.",
                                     "ns a pixel",
                                     "cost_ns",
                                     "error of the standard deviation of 4 x 4 pixels",
                                     "Take counting; explicit where the very facets matter and there are few." };
    study_front(run, &dial, settings, KINDS);
}

static void measure(study_run *run)
{
    static patch found[DENSITIES][KINDS];
    measure_all(run, study_is_quick(run) ? 6 : MOST_SEEDS, found);
    if (!study_goes_on(run, 1.0))
        return;
    for (int d = 0; d < DENSITIES; d++) {
        const patch *const f = found[d];
        const double bar = deviation_bar(&f[COUNTING], &f[EXPLICIT], 1);
        study_check(run, deviation_error(&f[COUNTING], &f[EXPLICIT], 1) < 0.15 + 3.0 * bar,
                    "%g facets a pixel: blocks of counting deviate %.2f times as much as those of explicit",
                    facets_of[d], sqrt(f[COUNTING].variance[1].mean / f[EXPLICIT].variance[1].mean));
        const double a = moments_standard_error(&f[COUNTING].mean), b = moments_standard_error(&f[EXPLICIT].mean);
        const double mean = fabs(f[COUNTING].mean.mean / f[EXPLICIT].mean.mean - 1.0);
        const double bound = 0.005 + 4.0 * sqrt(a * a + b * b) / f[EXPLICIT].mean.mean;
        study_check(run, mean < bound,
                    "%g facets a pixel: means are %.2f %% apart, at most half a percent and what so few surfaces leave "
                    "open, %.2f %%",
                    facets_of[d], 100.0 * mean, 100.0 * bound);
    }
    const patch *const dense = found[DENSITIES - 1];
    study_note(run, "1024 facets a pixel: smooth takes %.0f ns, counting %.0f, explicit %.0f", dense[SMOOTH].cost_ns,
               dense[COUNTING].cost_ns, dense[EXPLICIT].cost_ns);
    report_front(run, found);
}

static const study_figure figures[] = {
    { "models", "Cost of a model, and how far its picture's deviation is off, for three densities.", models_gnuplot },
    { NULL, NULL, NULL },
};

extern const study models_study;

const study models_study = {
    .name = "models",
    .title = "Models against every facet",
    .truth = "explicit, which adds up every facet under the pixel",
    .choose = "counting, whose cost does not grow with the facets; explicit only where there are few.",
    .share = 0.12,
    .run = measure,
    .figures = figures,
};
