/* Blocks of k x k pixels of the counting model vary as those of the explicit one.
 *
 * Both variances are known in closed form, explicit's from the facets' shares and counting's from its grids: their
 * ratio over a sweep of footprints has no noise. That the closed form is what the library does is measured: each block
 * has a place, a direction on the surface and a seed of its own, so blocks are independent, and the error of their
 * variance is known from their own fourth moment.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch_points.h"
#include "facet_truth.h"
#include "grid_truth.h"
#include "statistics.h"
#include "study.h"

#define PI 3.14159265358979323846

enum { SIDE = 16, SIZES = 5, SPLIT = 4 };

typedef struct setting {
    glint_distribution distribution;
    double alpha_x, alpha_y;
    double tilt, facets, size; /* degrees; facets under the pixel; metres, across */
    double solid_angle;
} setting;

/* The pixel on a surface that is tilted, by a camera that is rolled; direction of the tilt on the surface. */
static void pixel_of(const setting *s, double roll, double turn, double j[4])
{
    const double ratio = 1.0 / cos(s->tilt * PI / 180.0);
    const double c = cos(turn), n = sin(turn), rc = cos(roll), rn = sin(roll), major = s->size * ratio, minor = s->size;
    j[0] = c * major * rc - n * minor * rn;
    j[1] = -c * major * rn - n * minor * rc;
    j[2] = n * major * rc + c * minor * rn;
    j[3] = -n * major * rn + c * minor * rc;
}

enum { TURNS = 8 };

/* Of the tilt on the surface and of the camera. The directions of view and light stay what they are: the pattern is
 * turned below them. */
static void pixel_of_turn(const setting *s, int i, double j[4])
{
    pixel_of(s, (i % 4 + 0.5) * PI / 4.0, (i % TURNS + 0.3) * PI / TURNS, j);
}

/* ---- one block by the library ---- */

static batch_points points;

static glint_batch batch_of(int count, const float wo[3], const float wi[3], double solid_angle)
{
    for (int i = 0; i < count; i++)
        batch_points_light(&points, i, wo, wi, (float)solid_angle);
    return batch_points_of(&points, count);
}

/* SIDE x SIDE pixels of split x split samples; a sample has its share of the pixel as footprint, as the renderer does.
 */
static void block_of(const glint_material *m, const glint_batch *b, int split, const double j[4], uint64_t *random,
                     double pixel[SIDE][SIDE])
{
    const double u = random_between(random, -100.0, 100.0), v = random_between(random, -100.0, 100.0);
    const uint32_t seed = (uint32_t)random_bits(random);
    const int side = SIDE * split;
    for (int i = 0; i < side * side; i++) {
        const double x = (i % side + 0.5) / split, y = (i / side + 0.5) / split;
        const glint_footprint f = { u + j[0] * x + j[1] * y,
                                    v + j[2] * x + j[3] * y,
                                    (float)(j[0] / split),
                                    (float)(j[1] / split),
                                    (float)(j[2] / split),
                                    (float)(j[3] / split),
                                    seed,
                                    0U };
        batch_points_place(&points, i, &f);
    }
    if (glint_eval_batch(m, b) != GLINT_OK)
        abort();
    memset(pixel, 0, sizeof(double) * SIDE * SIDE);
    for (int i = 0; i < side * side; i++)
        pixel[i / side / split][i % side / split] += (double)points.rgb[0][i] / (split * split);
}

/* Mean square of the deviation from the mean, which is known, of the k x k blocks within this one. */
static void add_squares(double pixel[SIDE][SIDE], double mean, moments square[SIZES])
{
    for (int s = 0; s < SIZES; s++) {
        const int k = 1 << s;
        double sum = 0.0;
        for (int y = 0; y < SIDE; y += k)
            for (int x = 0; x < SIDE; x += k) {
                double block = 0.0;
                for (int i = 0; i < k * k; i++)
                    block += pixel[y + i / k][x + i % k];
                const double d = block / (k * k) / mean - 1.0;
                sum += d * d;
            }
        moments_add(&square[s], sum * (k * k) / (SIDE * SIDE));
    }
}

/* ---- counting over explicit ---- */

typedef struct ratio {
    double expected, measured, sigma;
} ratio;

static void directions_of(const setting *s, float wo[3], float wi[3])
{
    const double tilt = s->tilt * PI / 180.0;
    const double other = tilt - 0.1; /* the half vector is .05 rad off the normal at every tilt */
    wo[0] = (float)sin(tilt);
    wo[1] = 0.0F;
    wo[2] = (float)cos(tilt);
    wi[0] = (float)-sin(other);
    wi[1] = 0.0F;
    wi[2] = (float)cos(other);
}

static glint_material_options options_of(const setting *s)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = s->distribution;
    o.surface.alpha_x = (float)s->alpha_x;
    o.surface.alpha_y = (float)s->alpha_y;
    o.surface.facets_per_m2 = (float)(s->facets / (s->size * s->size / cos(s->tilt * PI / 180.0)));
    return o;
}

static int split_of(facet_filter filter)
{
    return filter == FACET_BOX ? SPLIT : 1;
}

/* Mean over turns of what counting's blocks and explicit's have of (1 - p) / p. */
static void overlaps_of(const setting *s, facet_filter filter, int k, double *counting, double *truth)
{
    const double density = (double)options_of(s).surface.facets_per_m2;
    *counting = *truth = 0.0;
    for (int i = 0; i < TURNS; i++) {
        double j[4];
        pixel_of_turn(s, i, j);
        *counting += grid_overlap(k, split_of(filter), j, density) / TURNS;
        for (int c = 0; c < 4; c++)
            j[c] *= sqrt(density);
        *truth += facet_overlap(filter, k, j) / TURNS;
    }
}

/* Variance of the library's blocks over explicit's. */
static void measure(const setting *s, facet_filter filter, int blocks, uint64_t *random, ratio out[SIZES])
{
    const glint_material_options o = options_of(s);
    glint_material *m = material_or_exit(&o);
    const int split = split_of(filter);
    float wo[3], wi[3];
    directions_of(s, wo, wi);
    const glint_batch b = batch_of(SIDE * SIDE * split * split, wo, wi, s->solid_angle);
    const glint_footprint unit = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const glint_light light = { GLINT_LIGHT_CAP, (float)s->solid_angle };
    glint_value v;
    glint_eval_value(m, NULL, &unit, wo, wi, &light, &v);
    moments square[SIZES] = { { 0 } };
    for (int i = 0; i < blocks; i++) {
        double j[4], pixel[SIDE][SIDE];
        pixel_of_turn(s, i, j);
        block_of(m, &b, split, j, random, pixel);
        add_squares(pixel, (double)v.smooth[0], square);
    }
    glint_material_destroy(m);

    const facet_moments facet = facet_moments_of(&o, wo, wi, s->solid_angle);
    const double variance = facet.square - facet.mean * facet.mean, p = (double)v.lit_probability;
    for (int k = 0; k < SIZES; k++) {
        double counting, truth;
        overlaps_of(s, filter, 1 << k, &counting, &truth);
        out[k] = (ratio){ counting * (1.0 - p) / p / (truth * variance), square[k].mean / (truth * variance),
                          moments_standard_error(&square[k]) / (truth * variance) };
    }
}

static const char *name_of(facet_filter filter)
{
    return filter == FACET_BOX ? "16 samples, box" : "1 sample, tent";
}

/* 15 % for blocks of 2 x 2 pixels and more, 30 % for single ones. */
static double bound_of(int k)
{
    return k == 1 ? 0.30 : 0.15;
}

/* The closed forms, over tilts, densities and pixels between the grids' levels. */
static void sweep(study *s)
{
    static const double tilts[] = { 0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0 };
    static const double facets[] = { 0.5, 1.0, 2.0, 4.0, 8.0, 30.0, 1000.0 };
    const int sizes = s->is_short ? 3 : 8;
    FILE *table = study_open(s, "blocks_sweep.csv");
    fprintf(table, "filter,tilt,facets_per_pixel,pixel_m,k1,k2,k4,k8,k16\n");
    double least[SIZES], most[SIZES];
    for (int filter = 0; filter < 2; filter++) {
        for (int k = 0; k < SIZES; k++) {
            least[k] = HUGE_VAL;
            most[k] = 0.0;
        }
        for (int t = 0; t < 7; t += s->is_short ? 2 : 1)
            for (int n = 0; n < 7; n += s->is_short ? 2 : 1)
                for (int i = 0; i < sizes; i++) {
                    const setting at = { .tilt = tilts[t],
                                         .facets = facets[n],
                                         .size = 1e-3 * exp2((double)i / sizes) };
                    fprintf(table, "%s,%g,%g,%g", filter ? "tent" : "box", at.tilt, at.facets, at.size);
                    for (int k = 0; k < SIZES; k++) {
                        double counting, truth;
                        overlaps_of(&at, (facet_filter)filter, 1 << k, &counting, &truth);
                        const double r = counting / truth;
                        fprintf(table, ",%.4f", r);
                        least[k] = fmin(least[k], r);
                        most[k] = fmax(most[k], r);
                        study_check(s, fabs(r - 1.0) < bound_of(1 << k),
                                    "%s, tilt %g, %g facets, pixel %g m, k = %d: %.3f", name_of((facet_filter)filter),
                                    at.tilt, at.facets, at.size, 1 << k, r);
                    }
                    fprintf(table, "\n");
                }
        printf("closed form, %-15s", name_of((facet_filter)filter));
        for (int k = 0; k < SIZES; k++)
            printf("  k = %d: %.3f to %.3f", 1 << k, least[k], most[k]);
        printf("\n");
        fprintf(table, "\n\n");
    }
    study_close(table);
}

/* The light is small enough for D to fall by 2 % at most across it, and large enough for p near .01. */
static const setting SETTINGS[] = {
    { GLINT_DISTRIBUTION_GGX, 0.4, 0.4, 80.0, 0.5, 1e-3, 0.005 },
    { GLINT_DISTRIBUTION_BECKMANN, 0.4, 0.4, 0.0, 4.0, 1.2e-3, 0.02 },
    { GLINT_DISTRIBUTION_GGX, 0.4, 0.4, 80.0, 30.0, 1.41e-3, 0.005 },
    { GLINT_DISTRIBUTION_BECKMANN, 0.4, 0.1, 60.0, 1.0, 1.7e-3, 0.002 },
    { GLINT_DISTRIBUTION_GGX, 0.4, 0.4, 0.0, 0.5, 1e-3, 0.02 },
    { GLINT_DISTRIBUTION_GGX, 0.4, 0.4, 30.0, 30.0, 1.7e-3, 0.02 },
    { GLINT_DISTRIBUTION_BECKMANN, 0.4, 0.4, 60.0, 8.0, 1.41e-3, 0.01 },
    { GLINT_DISTRIBUTION_BECKMANN, 0.4, 0.4, 80.0, 2.0, 1.2e-3, 0.005 },
};

/* The library: a check against the closed form, and against the bound itself with all of its noise. */
static void simulate(study *s)
{
    FILE *table = study_open(s, "blocks.csv");
    fprintf(table, "filter,distribution,tilt,facets_per_pixel,pixel_m,k,expected,measured,sigma,blocks\n");
    uint64_t random = 1;
    for (int filter = 0; filter < 2; filter++) {
        const int settings = s->is_short ? 4 : (int)(sizeof(SETTINGS) / sizeof(SETTINGS[0]));
        const int blocks = (filter == FACET_BOX ? 3000 : 16000) * (s->is_short ? 1 : 10);
        for (int i = 0; i < settings; i++) {
            const setting *at = &SETTINGS[i];
            ratio r[SIZES];
            measure(at, (facet_filter)filter, blocks, &random, r);
            printf("%-15s  tilt %2.0f  N %4.1f:", name_of((facet_filter)filter), at->tilt, at->facets);
            for (int k = 0; k < SIZES; k++) {
                const double sigmas = (r[k].measured - r[k].expected) / r[k].sigma;
                printf("  %.3f +- %.3f (%+.1f)", r[k].measured, r[k].sigma, sigmas);
                fprintf(table, "%s,%s,%g,%g,%g,%d,%.4f,%.4f,%.4f,%d\n", filter ? "tent" : "box",
                        at->distribution ? "Beckmann" : "GGX", at->tilt, at->facets, at->size, 1 << k, r[k].expected,
                        r[k].measured, r[k].sigma, blocks);
                /* 80 means of correlated sizes; 2 % for the light, and counts of a real number of trials, whose
                 * variance is f p (1 - f p) and not f p (1 - p) in the fraction: 1 % at p = .01. */
                study_check(s, fabs(r[k].measured - r[k].expected) < 4.0 * r[k].sigma + 0.01,
                            "%s, tilt %g, %g facets, k = %d: measured %.4f, closed form %.4f, sigma %.4f",
                            name_of((facet_filter)filter), at->tilt, at->facets, 1 << k, r[k].measured, r[k].expected,
                            r[k].sigma);
            }
            printf("\n");
        }
        fprintf(table, "\n\n");
    }
    study_close(table);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    sweep(&s);
    simulate(&s);
    return study_end(&s);
}
