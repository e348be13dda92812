/* More facets under a pixel: every discrete model comes to Cook-Torrance (Chermain et al. 2020, Figure 2), and how
 * fast. */
#include <math.h>

#include "statistics.h"
#include "study.h"

#define PI 3.14159265358979323846

typedef struct curve {
    const char *name;
    glint_model model;
    glint_distribution distribution;
    double most_facets; /* explicit visits them all */
    /* What is left grows by no more than this for ten times the facets: counted ones give sqrt(1/10); of 4000 squares
     * of a binomial count the root is off by 4 % or less where N p > 1, so .4 is five sigmas. */
    double fall;
    double resolution; /* see model_row of tests/contract/configurations.h */
} curve;

static const curve CURVES[] = {
    { "counting GGX", GLINT_MODEL_COUNTING, GLINT_DISTRIBUTION_GGX, 1e12, 0.4, 1e-6 },
    { "counting Beckmann", GLINT_MODEL_COUNTING, GLINT_DISTRIBUTION_BECKMANN, 1e12, 0.4, 1e-6 },
    { "explicit GGX", GLINT_MODEL_EXPLICIT, GLINT_DISTRIBUTION_GGX, 1e4, 0.4, 1e-6 },
    { "dictionary GGX", GLINT_MODEL_DICTIONARY, GLINT_DISTRIBUTION_GGX, 1e12, 0.5, 1.3e-3 },
    { "dictionary Beckmann", GLINT_MODEL_DICTIONARY, GLINT_DISTRIBUTION_BECKMANN, 1e12, 0.5, 1.3e-3 },
};

static void random_tilt(uint64_t *random, float v[3])
{
    const double theta = random_between(random, 0.0, 0.3), phi = random_between(random, 0.0, 2.0 * PI);
    v[0] = (float)(sin(theta) * cos(phi));
    v[1] = (float)(sin(theta) * sin(phi));
    v[2] = (float)cos(theta);
}

/* Root mean square of value / smooth - 1 over views, lights and places, and its standard error. */
static double distance(const glint_material *m, double facets, int points, uint64_t *random, double *bar)
{
    moments square = { 0 };
    glint_surface s = glint_material_surface(m);
    s.facets_per_m2 = (float)(facets * 1e6);
    for (int i = 0; i < points; i++) {
        float wo[3], wi[3];
        random_tilt(random, wo);
        random_tilt(random, wi);
        const glint_footprint f = {
            random_between(random, -10.0, 10.0), random_between(random, -10.0, 10.0), 1e-3F, 0.0F, 0.0F, 1e-3F, 0U
        };
        const glint_light light = { GLINT_LIGHT_CAP, 1e-2F };
        glint_value v;
        glint_eval_value(m, &s, &f, wo, wi, &light, &v);
        const double d = (double)v.rgb[0] / (double)v.smooth[0] - 1.0;
        moments_add(&square, d * d);
    }
    const double root = sqrt(square.mean);
    *bar = root > 0.0 ? moments_standard_error(&square) / (2.0 * root) : 0.0;
    return root;
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    FILE *table = study_open(&s, "convergence.csv");
    fprintf(table, "model,facets_per_pixel,root_mean_square,bar,points\n");
    uint64_t random = 1;
    for (size_t i = 0; i < sizeof(CURVES) / sizeof(CURVES[0]); i++) {
        const curve *c = &CURVES[i];
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = c->model;
        o.distribution = c->distribution;
        o.surface.alpha_x = o.surface.alpha_y = 0.4F;
        glint_material *m = material_or_exit(&o);
        double last = HUGE_VAL;
        for (double n = 1.0; n <= c->most_facets; n *= 10.0) {
            /* Four million facets are enough of the explicit ones for a short look. */
            const int points = c->model == GLINT_MODEL_EXPLICIT && s.is_short ? (int)fmin(4000.0, 4e6 / n) : 4000;
            double bar;
            const double r = distance(m, n, points, &random, &bar);
            fprintf(table, "%s,%g,%.6g,%.2g,%d\n", c->name, n, r, bar, points);
            study_check(&s, n < 50.0 || r <= c->fall * last + c->resolution, "%s: %g at %g facets, %g at a tenth",
                        c->name, r, n, last);
            last = r;
        }
        fprintf(table, "\n\n"); /* gnuplot's next index */
        glint_material_destroy(m);
    }
    study_close(table);
    return study_end(&s);
}
