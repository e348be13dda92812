/* Two sequences of samples of every pixel that is looked at: by how much their means differ is how far each is from
 * what many more samples would give.
 *
 * After 1, 4, 16 and 64 samples, since samples that are well spread leave far less noise than as many independent ones:
 * how much less depends on what the pixel shows, and is seen only by taking them.
 */
#include "preview/survey_noise.h"

#include <stdlib.h>

#include "preview/hash.h"
#include "preview/survey.h"
#include "preview/threads.h"

enum { SEQUENCES = 2, MOST_LEVELS = 4 }; /* levels: of 4^k samples, up to SURVEY_MOST_SAMPLES */

/* A pixel that is darker than so much of the picture's mean is held against that: any light at all would be infinitely
 * much of a black one. Taste. */
#define DARK 0.1
/* Rates beyond those of smooth functions are chance. */
#define LEAST_FALL 1.0
#define MOST_FALL 3.0

typedef struct pixel_sums {
    double discrete[SEQUENCES], smooth[SEQUENCES];
} pixel_sums;

typedef struct level_moments {
    double mean, square; /* over pixels, of the relative variance */
} level_moments;

/* What the threads read, and where each pixel's sums are. */
typedef struct task {
    const world *world;
    const survey_place *places;
    pixel_sums *sums;
    uint32_t first, end; /* samples to be taken */
} task;

static void add_samples(void *user, int index)
{
    const task *const t = user;
    world own = *t->world;
    pixel_sums *const sums = &t->sums[index];
    for (int k = 0; k < SEQUENCES; ++k) {
        own.seed = hash_combine(t->world->seed, (uint32_t)k + 1U);
        for (uint32_t i = t->first; i < t->end; ++i) {
            pixel_sample sample;
            ray_counts unused = { 0 };
            integrate(&own, t->places[index].x, t->places[index].y, i, &sample, &unused);
            sums->discrete[k] += survey_level(sample.light.discrete);
            sums->smooth[k] += survey_level(sample.light.smooth);
        }
    }
}

static double mean_of(const pixel_sums *s)
{
    return 0.5 * (s->smooth[0] + s->smooth[1]);
}

/* Relative to the light of the pixel: to that of its facets where those flash, or a spark that is a little off would be
 * many times the smooth light off. Facets count once all tiles of a pixel are seen: before, other samples show others.
 */
static level_moments variance_of(const pixel_sums *sums, int count, bool discrete)
{
    level_moments m = { 0.0, 0.0 };
    double picture = 0.0;
    for (int i = 0; i < count; ++i)
        picture += mean_of(&sums[i]) / count;
    for (int i = 0; i < count; ++i) {
        const double *const sum = discrete ? sums[i].discrete : sums[i].smooth;
        const double flash = discrete ? 0.5 * (sum[0] + sum[1]) : 0.0;
        const double base = fmax(fmax(mean_of(&sums[i]), flash), DARK * picture);
        if (!(base > 0.0))
            continue;
        const double variance = 0.5 * (sum[0] - sum[1]) * (sum[0] - sum[1]) / (base * base);
        m.mean += variance / count;
        m.square += variance * variance / count;
    }
    return m;
}

/* The variance at the last level, how it fell since the level before, and how sure both are. */
static void conclude(const level_moments *smooth, const level_moments *discrete, int last, int tiles, int count,
                     survey_noise *out)
{
    const bool whole = 1 << (2 * last) >= tiles, was_whole = last > 0 && 1 << (2 * (last - 1)) >= tiles;
    const level_moments *const now = whole ? &discrete[last] : &smooth[last];
    *out = (survey_noise){ .deviation = sqrt(now->mean), .samples = 1U << (2 * last), .fall = LEAST_FALL };
    if (!(now->mean > 0.0))
        return;
    out->spread = sqrt(fmax(now->square / (now->mean * now->mean) - 1.0, 0.0) / count);
    if (last == 0)
        return;
    const double before = was_whole ? discrete[last - 1].mean : smooth[last - 1].mean;
    const double after = was_whole ? discrete[last].mean : smooth[last].mean;
    if (before > 0.0 && after > 0.0)
        out->fall = fmin(fmax(0.5 * log2(before / after), LEAST_FALL), MOST_FALL);
}

bool survey_noise_measure(const world *w, const survey_place *places, int count, const survey_noise_limits *limits,
                          survey_noise *out, report *r)
{
    level_moments smooth[MOST_LEVELS], discrete[MOST_LEVELS];
    const int tiles = w->glint_side * w->glint_side;
    int last = -1;
    pixel_sums *const sums = calloc((size_t)count, sizeof *sums);
    if (sums == NULL)
        return report_error(r, "no memory to look at %d pixels", count);
    for (int k = 0; k < MOST_LEVELS && 1 << (2 * k) <= limits->samples; ++k) {
        task shared = { w, places, sums, k == 0 ? 0U : 1U << (2 * (k - 1)), 1U << (2 * k) };
        threads_each(limits->threads, count, add_samples, &shared);
        smooth[k] = variance_of(sums, count, false);
        discrete[k] = variance_of(sums, count, true);
        last = k;
        if (shared.end >= (uint32_t)tiles && discrete[k].mean <= limits->enough * limits->enough)
            break;
    }
    free(sums);
    conclude(smooth, discrete, last, tiles, count, out);
    return true;
}
