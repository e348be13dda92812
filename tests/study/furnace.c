/* The weak white furnace (Chermain et al. 2020, Eq. 17 and Figure 9): without shadowing and Fresnel every patch of the
 * dictionary reflects exactly what comes in.
 */
#include <math.h>

#include "statistics.h"
#include "study.h"

/* Integrals of Eq. 17 for the three views of Figure 9. */
enum { VIEWS = 3 };
static const double VIEW_RAD[VIEWS] = { 0.0, 0.78539816339744831, 1.56 };
static const double BOUND[VIEWS] = { 0.003, 0.003, 0.012 };

typedef struct setting {
    glint_distribution distribution;
    float alpha, facets, density_variation; /* facets under the pixel */
} setting;

/* D of the patch at h: f with F = 1, looked at and lit along h itself, where f cos = D G1^2 / (4 cos). */
static double density_of(const glint_material *m, const glint_footprint *f, const double h[3])
{
    const float v[3] = { (float)h[0], (float)h[1], (float)h[2] };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-6F };
    float rgb[3];
    glint_eval(m, NULL, f, v, v, &light, rgb);
    const double g1 = fmin(1.0, 2.0 * h[2] * h[2]);
    return (double)rgb[0] * 4.0 * h[2] / (g1 * g1);
}

/* Adds G1(wo, h) D(h) max(0, wo.h) / cos_o dh, which is G1 D / (4 cos_o) dwi. */
static void add_to_views(double weight, const double h[3], double sum[VIEWS])
{
    for (int t = 0; t < VIEWS; t++) {
        const double cosine = cos(VIEW_RAD[t]), dot = sin(VIEW_RAD[t]) * h[0] + cosine * h[2];
        if (dot > 0.0)
            sum[t] += weight * fmin(dot / cosine, 2.0 * h[2]);
    }
}

/* In slopes, on a grid whose step is a hundredth of alpha or less at the centre and grows with the slope, as the widths
 * of lobes do: slope = alpha sinh(t). dh = cos^3 d(slope)^2. */
static void furnace(const setting *s, uint64_t *random, double sum[VIEWS])
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_DICTIONARY;
    o.distribution = s->distribution;
    o.surface.alpha_x = o.surface.alpha_y = s->alpha;
    o.surface.facets_per_m2 = s->facets * 1e6F;
    o.density_variation = s->density_variation;
    glint_material *m = material_or_exit(&o);
    const glint_footprint f = {
        random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0), 1e-3F, 0.0F, 0.0F, 1e-3F, 0U
    };
    /* Beckmann ends at four of its deviations, 2.8 alpha; of GGX 1 / (1 + r^2) is longer than r alpha. */
    const double end = s->distribution == GLINT_DISTRIBUTION_BECKMANN ? asinh(6.0) : asinh(40.0);
    const double step = s->distribution == GLINT_DISTRIBUTION_BECKMANN ? 0.02 : 0.01;
    const double shift = random_uniform(random);
    for (int t = 0; t < VIEWS; t++)
        sum[t] = 0.0;
    for (double a = -end + shift * step; a < end; a += step)
        for (double b = -end + shift * step; b < end; b += step) {
            const double x = (double)s->alpha * sinh(a), y = (double)s->alpha * sinh(b);
            const double z = 1.0 / sqrt(1.0 + x * x + y * y), h[3] = { -x * z, -y * z, z };
            const double area = (double)s->alpha * (double)s->alpha * cosh(a) * cosh(b) * step * step;
            add_to_views(density_of(m, &f, h) * area * z * z * z, h, sum);
        }
    glint_material_destroy(m);
}

static void check(study *s, const setting *at, const double sum[VIEWS])
{
    for (int t = 0; t < VIEWS; t++)
        study_check(s, fabs(sum[t] - 1.0) < BOUND[t], "%s, alpha %g, %g facets, zeta %g, view at %.3g: %.5f",
                    at->distribution == GLINT_DISTRIBUTION_BECKMANN ? "Beckmann" : "GGX", (double)at->alpha,
                    (double)at->facets, (double)at->density_variation, VIEW_RAD[t], sum[t]);
}

/* What is far apart in every respect. */
static void spot_checks(study *s, uint64_t *random)
{
    static const setting settings[] = {
        { GLINT_DISTRIBUTION_BECKMANN, 0.02F, 30.0F, 0.0F },  { GLINT_DISTRIBUTION_BECKMANN, 0.1F, 1.0F, 0.01F },
        { GLINT_DISTRIBUTION_BECKMANN, 0.3F, 1e4F, 2.0F },    { GLINT_DISTRIBUTION_BECKMANN, 0.5F, 300.0F, 0.0F },
        { GLINT_DISTRIBUTION_BECKMANN, 1.0F, 1e6F, 0.0F },    { GLINT_DISTRIBUTION_BECKMANN, 1.0F, 10.0F, 2.0F },
        { GLINT_DISTRIBUTION_BECKMANN, 0.02F, 1e12F, 0.01F }, { GLINT_DISTRIBUTION_GGX, 0.1F, 3.0F, 0.0F },
    };
    for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); i++) {
        double sum[VIEWS];
        furnace(&settings[i], random, sum);
        check(s, &settings[i], sum);
    }
}

/* Figure 9: the furnace against alpha, density and its variation, one at a time. */
static void sweep(study *s, uint64_t *random)
{
    enum { POINTS = 12 };
    FILE *table = study_open(s, "furnace.csv");
    fprintf(table, "alpha,facets_per_pixel,density_variation,theta_0,theta_0.785,theta_1.56\n");
    for (int parameter = 0; parameter < 3; parameter++) {
        for (int i = 0; i < POINTS; i += s->is_short ? 11 : 1) {
            const double t = (double)i / (POINTS - 1);
            setting at = { GLINT_DISTRIBUTION_BECKMANN, 0.5F, 100.0F, 0.01F };
            if (parameter == 0)
                at.alpha = (float)(0.02 * pow(50.0, t));
            if (parameter == 1)
                at.facets = (float)pow(10.0, i);
            if (parameter == 2)
                at.density_variation = (float)(4.0 * t);
            double sum[VIEWS];
            furnace(&at, random, sum);
            check(s, &at, sum);
            fprintf(table, "%g,%g,%g,%.6f,%.6f,%.6f\n", (double)at.alpha, (double)at.facets,
                    (double)at.density_variation, sum[0], sum[1], sum[2]);
        }
        fprintf(table, "\n\n");
    }
    study_close(table);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    uint64_t random = 1;
    spot_checks(&s, &random);
    sweep(&s, &random);
    return study_end(&s);
}
