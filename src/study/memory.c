/* The study of memory: what each model's material holds, how a marginal of the dictionary is best written down, and
 * what a map of normals of each size costs and shows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/statistics.h"
#include "study/study.h"

extern const unsigned char memory_gnuplot[];

/* ---- encodings of a marginal ---- */

enum { LOBES = 256, MARGINALS = 24 };
#define DOMAIN_END 1.41421356 /* 4 / sqrt 2 times the dictionary's roughness of .5 */
#define LOBE_SIGMA 0.02

typedef enum encoding { BYTE, HALF, SINGLE, ENCODINGS } encoding;
static const char *const encoding_names[ENCODINGS] = { "8 bits", "half", "float" };
static const int encoding_bytes[ENCODINGS] = { 1, 2, 4 };

static double density_at(const double lobe[LOBES], double x)
{
    double sum = 0.0;
    for (int i = 0; i < LOBES; i++)
        for (int side = -1; side <= 1; side += 2) {
            const double d = (x + side * lobe[i]) / LOBE_SIGMA;
            sum += fabs(d) < 8.0 ? exp(-0.5 * d * d) : 0.0;
        }
    return sum / (LOBES * LOBE_SIGMA * 2.50662827463);
}

/* What is left of a value: 11 bits of mantissa, or 256 steps of the largest. */
static double encode(double value, double largest, encoding e)
{
    if (e == BYTE)
        return floor(value / largest * 255.0 + 0.5) / 255.0 * largest;
    if (e == HALF && value > 0.0) {
        const double unit = ldexp(1.0, ilogb(value) - 10);
        return floor(value / unit + 0.5) * unit;
    }
    return (double)(float)value;
}

/* Root mean square error of straight lines between `samples` values, over the mean. */
static double marginal_error(const double lobe[LOBES], int samples, encoding e)
{
    double values[257], largest = 0.0, square = 0.0, mean = 0.0;
    enum { FINE = 2000 };
    for (int i = 0; i <= samples; i++) {
        values[i] = density_at(lobe, DOMAIN_END * i / samples);
        largest = fmax(largest, values[i]);
    }
    for (int i = 0; i <= samples; i++)
        values[i] = encode(values[i], largest, e);
    for (int k = 0; k < FINE; k++) {
        const double at = (k + 0.5) / FINE * samples, truth = density_at(lobe, DOMAIN_END * (k + 0.5) / FINE);
        const int i = (int)at;
        const double error = values[i] + (at - i) * (values[i + 1] - values[i]) - truth;
        square += error * error / FINE;
        mean += truth / FINE;
    }
    return sqrt(square) / mean;
}

/* Stratified would be the dictionary's own; a sum of twelve uniforms is a normal one, of its sigma of .5 / sqrt 2. */
static void random_lobes(uint64_t *random, double lobe[LOBES])
{
    for (int i = 0; i < LOBES; i++) {
        double normal = -6.0;
        for (int n = 0; n < 12; n++)
            normal += random_uniform(random);
        lobe[i] = 0.353553391 * normal;
    }
}

static void measure_encodings(study_run *run)
{
    static const int sizes[] = { 16, 32, 64, 128, 256 };
    enum { SIZES = sizeof sizes / sizeof sizes[0] };
    static char names[SIZES * ENCODINGS][32];
    study_setting settings[SIZES * ENCODINGS];
    int count = 0;
    for (int s = 0; s < SIZES; s++)
        for (int e = 0; e < ENCODINGS && study_goes_on(run, 0.5 * s / SIZES); e++) {
            moments m = { 0 };
            uint64_t random = 101;
            for (int k = 0; k < MARGINALS; k++) {
                double lobe[LOBES];
                random_lobes(&random, lobe);
                moments_add(&m, marginal_error(lobe, sizes[s], (encoding)e));
            }
            snprintf(names[count], sizeof names[count], "%d x %s", sizes[s], encoding_names[e]);
            settings[count] = (study_setting){ names[count], (double)(sizes[s] * encoding_bytes[e]), m.mean,
                                               moments_standard_error(&m), false };
            count++;
        }
    if (!study_goes_on(run, 0.5))
        return;
    static const study_dial dial = {
        "memory_encodings.csv",
        "One marginal of the dictionary, 256 lobes.",
        "bytes",
        "bytes",
        "root mean square error over the mean",
        "In as many bytes 128 samples of 8 bits are nearer than the 64 of half that libglint has from the paper."
    };
    study_front(run, &dial, settings, count);
    double half_64 = 0.0, float_64 = 0.0;
    for (int i = 0; i < count; i++) {
        half_64 = strcmp(settings[i].name, "64 x half") == 0 ? settings[i].error : half_64;
        float_64 = strcmp(settings[i].name, "64 x float") == 0 ? settings[i].error : float_64;
    }
    study_check(run, half_64 < 1.01 * float_64, "half is as near as float: %.4f and %.4f with 64 samples", half_64,
                float_64);
}

/* ---- what materials hold ---- */

static void *count_bytes(size_t byte_count, void *user)
{
    *(size_t *)user += byte_count;
    return aligned_alloc(64, (byte_count + 63) / 64 * 64);
}

static void release(void *memory, void *user)
{
    (void)user;
    free(memory);
}

/* What is allocated while it is made, the scratch memory of its set-up included. */
static size_t bytes_of(study_run *run, glint_material_options o, glint_material **out)
{
    static size_t bytes;
    bytes = 0;
    o.allocator = (glint_allocator){ count_bytes, release, &bytes };
    *out = study_material(run, &o);
    return bytes;
}

/* Mean of the patch of many maps over the smooth lobe, at random directions: how far the map is from its distribution.
 */
static double map_error(const glint_material *m, const glint_material *lobe, int queries)
{
    uint64_t random = 102;
    double square = 0.0;
    for (int i = 0; i < queries; i++) {
        const double r = 0.4 * sqrt(random_uniform(&random)), phi = random_between(&random, 0.0, 6.2831853);
        const float wo[3] = { 0.0F, 0.0F, 1.0F };
        const double slope = r / sqrt(1.0 + r * r), z = 1.0 / sqrt(1.0 + r * r);
        const float wi[3] = { (float)(2.0 * z * slope * cos(phi)), (float)(2.0 * z * slope * sin(phi)),
                              (float)(2.0 * z * z - 1.0) };
        const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
        const glint_footprint f = { .u = 0.1, .v = 0.2, .dudx = 1.0F, .dvdy = 1.0F };
        float map[3], smooth[3];
        glint_eval(m, NULL, &f, wo, wi, &light, map);
        glint_eval(lobe, NULL, NULL, wo, wi, NULL, smooth);
        const double error = (double)map[0] / (double)smooth[0] - 1.0;
        square += error * error / queries;
    }
    return sqrt(square);
}

static void measure_materials(study_run *run)
{
    static const glint_model single[] = { GLINT_MODEL_SMOOTH, GLINT_MODEL_COUNTING, GLINT_MODEL_EXPLICIT,
                                          GLINT_MODEL_DICTIONARY };
    size_t counting = 0, dictionary = 0;
    study_table(run, "memory_materials.csv", "material,bytes");
    for (int i = 0; i < 4; i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        glint_material *m = NULL;
        o.model = single[i];
        const size_t bytes = bytes_of(run, o, &m);
        counting = single[i] == GLINT_MODEL_COUNTING ? bytes : counting;
        dictionary = single[i] == GLINT_MODEL_DICTIONARY ? bytes : dictionary;
        glint_material_destroy(m);
        study_row(run, "%s,%zu", glint_model_name(single[i]), bytes);
    }
    study_end_table(run);
    study_check(run, counting < 4096, "a counting material holds %zu bytes, at most 4096: no tables", counting);
    study_note(run, "A dictionary takes %.0f KiB while it is made, of which 384 KiB stay", (double)dictionary / 1024.0);
}

static void measure_maps(study_run *run)
{
    enum { SIZES = 6 };
    static char names[SIZES][32];
    study_setting settings[SIZES];
    const int queries = study_is_quick(run) ? 300 : 5000;
    for (int i = 0; i < SIZES && study_goes_on(run, 0.6 + 0.4 * i / SIZES); i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        glint_material *m = NULL;
        o.model = GLINT_MODEL_EXAMPLE;
        o.distribution = GLINT_DISTRIBUTION_BECKMANN;
        o.surface.alpha_x = o.surface.alpha_y = 0.3F;
        o.example.size = 8U << i;
        o.example.side_m = 1e-3F;
        const size_t bytes = bytes_of(run, o, &m);
        o.model = GLINT_MODEL_SMOOTH;
        glint_material *const lobe = study_material(run, &o);
        const double error = m && lobe ? map_error(m, lobe, queries) : 0.0;
        glint_material_destroy(lobe);
        glint_material_destroy(m);
        snprintf(names[i], sizeof names[i], "%u x %u texels", o.example.size, o.example.size);
        settings[i] = (study_setting){ names[i], (double)bytes, error, error / sqrt(2.0 * queries), false };
    }
    if (!study_goes_on(run, 1.0))
        return;
    static const study_dial dial = { "memory_maps.csv",
                                     "Maps of normals that follow a distribution, seen from far away.",
                                     "bytes",
                                     "bytes",
                                     "root mean square error of the lobe",
                                     "Take 16 x 16 texels: more show more facets, not a better lobe." };
    study_front(run, &dial, settings, SIZES);
    study_check(run, settings[SIZES - 1].error < settings[0].error,
                "256 texels show the lobe within %.3f, 8 within %.3f", settings[SIZES - 1].error, settings[0].error);
}

static void measure(study_run *run)
{
    measure_encodings(run);
    if (!study_goes_on(run, 0.5))
        return;
    measure_materials(run);
    measure_maps(run);
}

static const study_figure figures[] = {
    { "memory", "Bytes and errors: encodings of a marginal of the dictionary; maps of normals of each size.",
      memory_gnuplot },
    { NULL, NULL, NULL },
};

extern const study memory_study;

const study memory_study = {
    .name = "memory",
    .title = "Memory: tables, maps and encodings",
    .truth = "the sum of lobes in double; the smooth lobe",
    .choose = "counting, which has no tables; of maps that follow a distribution those of 16 x 16 texels.",
    .share = 0.02,
    .run = measure,
    .figures = figures,
};
