/* The weak white furnace (Chermain et al. 2020, Eq. 17): without shadowing and Fresnel every patch reflects exactly
 * what comes in.
 *
 * test_dictionary_furnace FILE.csv also writes the sweep of the paper's Figure 9.
 */
#include "configurations.h"

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
    glint_material *m = create(&o);
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

static void report(const setting *s, const double sum[VIEWS])
{
    printf("%-8s alpha %.2f, %8g facets, zeta %g: %.5f %.5f %.5f\n",
           s->distribution == GLINT_DISTRIBUTION_BECKMANN ? "Beckmann" : "GGX", (double)s->alpha, (double)s->facets,
           (double)s->density_variation, sum[0], sum[1], sum[2]);
}

static int holds(const double sum[VIEWS])
{
    for (int t = 0; t < VIEWS; t++)
        if (fabs(sum[t] - 1.0) >= BOUND[t])
            return 0;
    return 1;
}

static void every_patch_passes_the_weak_white_furnace(void **state)
{
    (void)state;
    static const setting settings[] = {
        { GLINT_DISTRIBUTION_BECKMANN, 0.02F, 30.0F, 0.0F },  { GLINT_DISTRIBUTION_BECKMANN, 0.1F, 1.0F, 0.01F },
        { GLINT_DISTRIBUTION_BECKMANN, 0.3F, 1e4F, 2.0F },    { GLINT_DISTRIBUTION_BECKMANN, 0.5F, 300.0F, 0.0F },
        { GLINT_DISTRIBUTION_BECKMANN, 1.0F, 1e6F, 0.0F },    { GLINT_DISTRIBUTION_BECKMANN, 1.0F, 10.0F, 2.0F },
        { GLINT_DISTRIBUTION_BECKMANN, 0.02F, 1e12F, 0.01F }, { GLINT_DISTRIBUTION_GGX, 0.1F, 3.0F, 0.0F },
    };
    uint64_t random = 1;
    int failed = 0;
    for (size_t i = 0; i < sizeof(settings) / sizeof(settings[0]); i++) {
        double sum[VIEWS];
        furnace(&settings[i], &random, sum);
        report(&settings[i], sum);
        failed += !holds(sum);
    }
    assert_int_equal(failed, 0);
}

/* Figure 9: the furnace against alpha, density and its variation, one at a time. */
static int write_sweep(const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        return 1;
    }
    fprintf(file, "distribution,alpha,facets_per_pixel,density_variation,theta_0,theta_0.785,theta_1.56\n");
    uint64_t random = 2;
    int failed = 0;
    for (int parameter = 0; parameter < 3; parameter++)
        for (int i = 0; i < 12; i++) {
            setting s = { GLINT_DISTRIBUTION_BECKMANN, 0.5F, 100.0F, 0.01F };
            if (parameter == 0)
                s.alpha = 0.02F * powf(50.0F, (float)i / 11.0F);
            if (parameter == 1)
                s.facets = powf(10.0F, (float)i);
            if (parameter == 2)
                s.density_variation = 4.0F * (float)i / 11.0F;
            double sum[VIEWS];
            furnace(&s, &random, sum);
            failed += !holds(sum);
            fprintf(file, "Beckmann,%g,%g,%g,%.6f,%.6f,%.6f\n", (double)s.alpha, (double)s.facets,
                    (double)s.density_variation, sum[0], sum[1], sum[2]);
        }
    failed += fclose(file) != 0;
    printf("%s: 36 settings, %d beyond the paper's bounds\n", path, failed);
    return failed != 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_patch_passes_the_weak_white_furnace) };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return failed ? failed : argc > 1 ? write_sweep(argv[1]) : 0;
}
