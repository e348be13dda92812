/* The mean of the counting model over seeds is the smooth value, from one facet under a pixel to 10^9 and however few
 * are lit.
 *
 * One draw has the variance 1 / (2 N p) about one, so that a standard error of a sixth of a percent takes 2e5 / (N p)
 * of them: the short form leaves out what takes more than 2e7, the middle one has wider bars where it takes more than
 * 1e8. */
#include <math.h>
#include <stdlib.h>

#include "batch_points.h"
#include "statistics.h"
#include "study.h"

#define PI 3.14159265358979323846

enum { CHUNK = 4096 };

typedef struct setting {
    const char *name;
    glint_distribution distribution;
    float alpha_x, alpha_y;
    double tilt; /* degrees */
} setting;

static const setting SETTINGS[] = {
    { "GGX", GLINT_DISTRIBUTION_GGX, 0.25F, 0.25F, 25.0 },
    { "Beckmann", GLINT_DISTRIBUTION_BECKMANN, 0.25F, 0.25F, 0.0 },
    { "GGX 4:1", GLINT_DISTRIBUTION_GGX, 0.4F, 0.1F, 50.0 },
    { "Beckmann 4:1", GLINT_DISTRIBUTION_BECKMANN, 0.4F, 0.1F, 75.0 },
};

/* Of a mean; the bound of half a percent is three of them. */
static const double MOST_SIGMA = 0.005 / 3.0;

/* Those that it takes, by the variance and a fifth more. */
static double draws_for(double lit)
{
    return fmax(200000.0, 0.6 / lit / (MOST_SIGMA * MOST_SIGMA));
}

static void direction(double theta, double phi, float v[3])
{
    v[0] = (float)(sin(theta) * cos(phi));
    v[1] = (float)(sin(theta) * sin(phi));
    v[2] = (float)cos(theta);
}

/* Footprints of 1 mm^2, stretched as a plane tilted this much shows them, in any direction and place. */
static void scatter(batch_points *q, double tilt, uint64_t *random)
{
    const double stretch = 1.0 / cos(tilt), a = 1e-3 * sqrt(stretch), c = 1e-3 / sqrt(stretch);
    for (int n = 0; n < CHUNK; n++) {
        const double turn = random_between(random, 0.0, 2.0 * PI);
        glint_footprint f = { .dudx = (float)(a * cos(turn)),
                              .dudy = (float)(-c * sin(turn)),
                              .dvdx = (float)(a * sin(turn)),
                              .dvdy = (float)(c * cos(turn)) };
        f.u = random_between(random, -100.0, 100.0);
        f.v = random_between(random, -100.0, 100.0);
        f.seed = (uint32_t)random_bits(random);
        batch_points_place(q, n, &f);
    }
}

/* Mean of counting / smooth over seeds and places; *p: the chance that a facet is lit, as the light's size makes it. */
static moments mean_over_seeds(const setting *s, double facets, double *p, double most_draws, uint64_t *random)
{
    static batch_points q;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = s->distribution;
    o.surface.alpha_x = s->alpha_x;
    o.surface.alpha_y = s->alpha_y;
    o.surface.facets_per_m2 = (float)(facets * 1e6);
    glint_material *m = material_or_exit(&o);
    const double tilt = s->tilt * PI / 180.0;
    float wo[3], wi[3];
    direction(tilt, 0.4, wo);
    direction(fmax(tilt - 0.1, 0.05), 0.4 + PI, wi);
    const glint_footprint unit = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    glint_value v;
    glint_eval_value(m, NULL, &unit, wo, wi, &light, &v);
    light.solid_angle_sr = fminf(1e-4F * (float)*p / v.lit_probability, 6.0F);
    glint_eval_value(m, NULL, &unit, wo, wi, &light, &v);
    *p = (double)v.lit_probability;

    for (int n = 0; n < CHUNK; n++)
        batch_points_light(&q, n, wo, wi, light.solid_angle_sr);
    const glint_batch b = batch_points_of(&q, CHUNK);
    /* How many is fixed before the first is drawn: to stop when a mean looks good would bias it. */
    const double draws = fmin(draws_for(facets * *p), most_draws);
    moments ratio = { 0 };
    while (ratio.count < draws) {
        scatter(&q, tilt, random);
        if (glint_eval_batch(m, &b) != GLINT_OK)
            abort();
        for (int n = 0; n < CHUNK; n++)
            moments_add(&ratio, (double)(q.rgb[0][n] / v.smooth[0]));
    }
    glint_material_destroy(m);
    return ratio;
}

/* The rarest that are lit for two of the materials, and every second density. */
static int is_quick(int setting_index, int facets_index, double lit)
{
    return lit > 0.09 ? facets_index % 2 == 0 : lit > 0.009 && setting_index % 3 == 0;
}

int main(int argc, char **argv)
{
    static const double facets[] = { 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e9 },
                        chances[] = { 1e-4, 1e-2, 0.1, 0.5 };
    study s = study_start(argc, argv);
    FILE *table = study_open(&s, "mean.csv");
    fprintf(table, "material,tilt,lit_probability,facets_per_pixel,mean,sigma,draws\n");
    const double most_draws = s.is_middle ? 1e8 : (double)INFINITY;
    uint64_t random = 2;
    double worst = 0.0;
    for (int c = 0; c < 4; c++) {
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 9; k++) {
                double p = chances[c];
                if (s.is_short && !is_quick(i, k, facets[k] * p))
                    continue;
                const moments r = mean_over_seeds(&SETTINGS[i], facets[k], &p, most_draws, &random);
                const double error = r.mean - 1.0, sigma = moments_standard_error(&r);
                /* Fewer draws than it takes: so much wider. */
                const double most_sigma = MOST_SIGMA * fmax(1.0, sqrt(draws_for(facets[k] * p) / r.count));
                fprintf(table, "%s,%g,%.3g,%g,%.6f,%.6f,%.0f\n", SETTINGS[i].name, SETTINGS[i].tilt, p, facets[k],
                        r.mean, sigma, r.count);
                if (most_sigma <= MOST_SIGMA)
                    worst = fmax(worst, fabs(error));
                /* 144 means: 4.2 sigmas is a significance of .004 in all. 1e-4 is the law's own,
                 * tests/unit/test_binomial. */
                study_check(&s,
                            fabs(error) < 4.2 * sigma + 1e-4 && fabs(error) < 3.0 * most_sigma && sigma < most_sigma,
                            "%s, p = %g, N = %g: mean %.5f, sigma %.5f (%+.1f)", SETTINGS[i].name, p, facets[k], r.mean,
                            sigma, error / sigma);
            }
        fprintf(table, "\n\n");
    }
    study_close(table);
    printf("largest deviation of the mean from smooth, of those with a sigma of a sixth of a percent: %.2f %% (bound "
           "0.5 %%)\n",
           100.0 * worst);
    return study_end(&s);
}
