/* Pixel values of counting and explicit side by side: histograms and quantiles of value / smooth, for pixels of few,
 * some and many facets, with 16 samples under a box. */
#include <math.h>
#include <stdlib.h>

#include "facet_truth.h"
#include "statistics.h"
#include "study.h"

/* The mean of counts that are drawn: docs/stability.md. */
#define LAW_ERROR 2e-4

enum { MODELS = 2, BINS = 40, STRATA = 4 };

static const glint_model MODEL[MODELS] = { GLINT_MODEL_COUNTING, GLINT_MODEL_EXPLICIT };
static const double FACETS[] = { 16.0, 128.0, 1024.0 };
static const double SHARES[] = { 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999 };
enum { SHARE_COUNT = sizeof(SHARES) / sizeof(SHARES[0]) };

static const float wo[3] = { 0.0F, 0.0F, 1.0F }, wi[3] = { 0.19866933F, 0.0F, 0.98006658F };
static const glint_light light = { GLINT_LIGHT_CAP, 0.02F };

static glint_material_options options_of(glint_model model)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.surface.alpha_x = o.surface.alpha_y = 0.4F;
    return o;
}

/* The mean of value / smooth: the smooth value takes D at the middle of the light, and so does counting; explicit
 * facets see all of the light, over which D is .993 of that. */
static double mean_of(glint_model model)
{
    const glint_material_options o = options_of(model);
    return model == GLINT_MODEL_EXPLICIT ? facet_moments_of(&o, wo, wi, (double)light.solid_angle_sr).mean : 1.0;
}

/* A pixel of a millimetre, its samples in the middle of 4 x 4 strata. */
static double pixel_value(const glint_material *m, const glint_surface *surface, double u, double v)
{
    const float step = 1e-3F / STRATA;
    double sum = 0.0;
    for (int i = 0; i < STRATA * STRATA; i++) {
        const glint_footprint f = { .u = u + (i % STRATA + 0.5) * (double)step,
                                    .v = v + (i / STRATA + 0.5) * (double)step,
                                    .dudx = step,
                                    .dvdy = step };
        glint_value value;
        glint_eval_value(m, surface, &f, wo, wi, &light, &value);
        sum += (double)value.rgb[0] / (double)value.smooth[0] / (STRATA * STRATA);
    }
    return sum;
}

static int by_value(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Sorted values of count pixels, far from each other so that they are independent. */
static double *draw(glint_model model, double facets, int count, moments *all)
{
    const glint_material_options o = options_of(model);
    glint_material *m = material_or_exit(&o);
    glint_surface surface = glint_material_surface(m);
    surface.facets_per_m2 = (float)(facets * 1e6);
    double *values = malloc((size_t)count * sizeof(*values));
    if (!values)
        exit(1);
    uint64_t random = 1;
    for (int i = 0; i < count; i++) {
        values[i] =
            pixel_value(m, &surface, random_between(&random, -50.0, 50.0), random_between(&random, -50.0, 50.0));
        moments_add(all, values[i]);
    }
    qsort(values, (size_t)count, sizeof(*values), by_value);
    glint_material_destroy(m);
    return values;
}

/* The largest distance between the shares of pixels below a value. */
static double distance(const double *a, const double *b, int count)
{
    int i = 0, k = 0, most = 0;
    while (i < count && k < count) {
        const double at = fmin(a[i], b[k]);
        while (i < count && a[i] <= at)
            i++;
        while (k < count && b[k] <= at)
            k++;
        most = abs(i - k) > most ? abs(i - k) : most;
    }
    return (double)most / count;
}

/* A third of a stop each, from 2^-6 up; the first holds all that is darker. */
static void write_histogram(FILE *table, double facets, double *const values[MODELS], int count)
{
    int bins[MODELS][BINS] = { { 0 } };
    for (int k = 0; k < MODELS; k++)
        for (int i = 0; i < count; i++) {
            const double bin = values[k][i] > 0.0 ? floor(3.0 * (log2(values[k][i]) + 6.0)) : 0.0;
            bins[k][bin < 0.0 ? 0 : bin >= BINS ? BINS - 1 : (int)bin]++;
        }
    for (int i = 0; i < BINS; i++)
        fprintf(table, "%g,%.6g,%.6g,%.6g,%d\n", facets, exp2((i + 0.5) / 3.0 - 6.0), (double)bins[0][i] / count,
                (double)bins[1][i] / count, count);
    fprintf(table, "\n\n");
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    FILE *histogram = study_open(&s, "histogram.csv"), *quantiles = study_open(&s, "histogram_quantiles.csv");
    fprintf(histogram, "facets_per_pixel,value,counting,explicit,pixels\n");
    fprintf(quantiles, "facets_per_pixel,share,counting,explicit\n");
    const double expected[MODELS] = { mean_of(MODEL[0]), mean_of(MODEL[1]) };
    for (size_t n = 0; n < sizeof(FACETS) / sizeof(FACETS[0]); n++) {
        const int count = s.is_short ? (int)fmin(20000.0, 2e6 / FACETS[n]) : 100000;
        double *values[MODELS];
        moments all[MODELS] = { { 0 } };
        for (int k = 0; k < MODELS; k++)
            values[k] = draw(MODEL[k], FACETS[n], count, &all[k]);
        write_histogram(histogram, FACETS[n], values, count);
        for (int i = 0; i < SHARE_COUNT; i++)
            fprintf(quantiles, "%g,%g,%.6g,%.6g\n", FACETS[n], SHARES[i], values[0][(int)(SHARES[i] * count)],
                    values[1][(int)(SHARES[i] * count)]);
        const double apart = distance(values[0], values[1], count);
        printf("%g facets per pixel: means %.4f and %.4f, expected %.4f and %.4f, variances %.4f and %.4f, distance of "
               "the distributions %.3f\n",
               FACETS[n], all[0].mean, all[1].mean, expected[0], expected[1], moments_variance(&all[0]),
               moments_variance(&all[1]), apart);
        for (int k = 0; k < MODELS; k++)
            study_check(&s, fabs(all[k].mean - expected[k]) < 4.5 * moments_standard_error(&all[k]) + LAW_ERROR,
                        "%s at %g facets: mean %g, expected %g, sigma %g", glint_model_name(MODEL[k]), FACETS[n],
                        all[k].mean, expected[k], moments_standard_error(&all[k]));
        /* Many lit facets add up to a normal distribution in both, whatever one facet looks like. Variances that are 15
         * % apart, as the blocks may be, put two of them .02 apart; 1.95 / sqrt(n / 2) is noise at the level of 1e-3.
         */
        study_check(&s, FACETS[n] < 1000.0 || apart < 0.05 + 1.95 * sqrt(2.0 / count),
                    "at %g facets the distributions are %g apart", FACETS[n], apart);
        for (int k = 0; k < MODELS; k++)
            free(values[k]);
    }
    study_close(histogram);
    study_close(quantiles);
    return study_end(&s);
}
