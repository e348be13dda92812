/* Values against independent truths: Cook-Torrance in double precision, and the mean of the counting model over seeds.
 */
#include "configurations.h"

#include <stdlib.h>

#define PI 3.14159265358979323846

typedef struct double3 {
    double x, y, z;
} double3;

/* F D G2 / (4 cos_o) as the textbooks have it, from the floats that the library gets. */
static double cook_torrance(int beckmann, double ax, double ay, double3 o, double3 i)
{
    double3 h = { o.x + i.x, o.y + i.y, o.z + i.z };
    const double length = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    h = (double3){ h.x / length, h.y / length, h.z / length };
    const double tan2 = (h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay)) / (h.z * h.z);
    const double cos4 = h.z * h.z * h.z * h.z;
    const double d =
        beckmann ? exp(-tan2) / (PI * ax * ay * cos4) : 1.0 / (PI * ax * ay * cos4 * (1.0 + tan2) * (1.0 + tan2));
    double lambda[2];
    for (int k = 0; k < 2; k++) {
        const double3 v = k ? i : o;
        const double a = v.z / sqrt(ax * ax * v.x * v.x + ay * ay * v.y * v.y);
        lambda[k] = beckmann ? 0.5 * (exp(-a * a) / (a * sqrt(PI)) - erfc(a)) : 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    }
    return d / (4.0 * o.z * (1.0 + lambda[0] + lambda[1]));
}

static void smooth_agrees_with_double_precision(void **state)
{
    (void)state;
    uint64_t random = 1;
    double worst[2] = { 0.0, 0.0 };
    for (int k = 0; k < 300000; k++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = GLINT_MODEL_SMOOTH;
        o.distribution = k & 1 ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
        o.surface.alpha_x = (float)random_log_between(&random, 1e-3, 1.0);
        o.surface.alpha_y = k & 2 ? o.surface.alpha_x : (float)random_log_between(&random, 1e-3, 1.0);
        glint_material *m = create(&o);
        float wo[3], wi[3], rgb[3];
        random_direction(&random, wo);
        /* Near the mirror direction, where there is something to compare: the half vector within a few alpha of the
         * normal. */
        const double slope_x = (double)o.surface.alpha_x * random_between(&random, -2.0, 2.0);
        const double slope_y = (double)o.surface.alpha_y * random_between(&random, -2.0, 2.0);
        const double norm = sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
        const double hx = slope_x / norm, hy = slope_y / norm, hz = 1.0 / norm;
        const double dot = 2.0 * (hx * (double)wo[0] + hy * (double)wo[1] + hz * (double)wo[2]);
        wi[0] = (float)(dot * hx - (double)wo[0]);
        wi[1] = (float)(dot * hy - (double)wo[1]);
        wi[2] = (float)(dot * hz - (double)wo[2]);
        glint_eval(m, NULL, NULL, wo, wi, NULL, rgb);
        glint_material_destroy(m);
        if (wi[2] < 1e-3F || wo[2] < 1e-3F)
            continue;
        const double exact = cook_torrance(k & 1, (double)o.surface.alpha_x, (double)o.surface.alpha_y,
                                           (double3){ (double)wo[0], (double)wo[1], (double)wo[2] },
                                           (double3){ (double)wi[0], (double)wi[1], (double)wi[2] });
        worst[k & 1] = fmax(worst[k & 1], fabs((double)rgb[0] / exact - 1.0));
    }
    printf("largest relative error: GGX %.1e, Beckmann %.1e (bound 1e-5)\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-5 && worst[1] < 1e-5);
}

enum { CHUNK = 4096 };

/* Ratio of counting to smooth over seeds and places, until its standard error is below a quarter of half a percent. */
static moments ratio_over_seeds(const glint_material *m, double facets, double tilt, uint64_t *random)
{
    static double u[CHUNK], v[CHUNK];
    static float jacobian[4][CHUNK], wo[3][CHUNK], wi[3][CHUNK], solid_angle[CHUNK], rgb[3][CHUNK];
    static uint32_t seed[CHUNK];
    static glint_surface surface[CHUNK];
    float o[3], i[3], smooth[3];
    direction(tilt, 0.4, o);
    direction(fmax(tilt - 0.1, 0.05), 0.4 + PI, i);
    glint_eval(m, NULL, NULL, o, i, NULL, smooth);
    glint_surface s = glint_material_surface(m);
    s.facets_per_m2 = (float)(facets / 1e-6);

    /* The light's size that makes a tenth of the facets lit: at one facet a pixel a smaller one would take 10^9
     * samples. */
    const glint_footprint unit = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const glint_light probe = { GLINT_LIGHT_CAP, 1e-4F };
    glint_value value;
    glint_eval_value(m, &s, &unit, o, i, &probe, &value);
    const float angle = fminf(1e-4F * 0.1F / value.lit_probability, 6.0F);

    glint_batch b = GLINT_BATCH_INIT;
    b.count = CHUNK;
    b.u = u;
    b.v = v;
    b.dudx = jacobian[0];
    b.dudy = jacobian[1];
    b.dvdx = jacobian[2];
    b.dvdy = jacobian[3];
    b.seed = seed;
    b.solid_angle_sr = solid_angle;
    b.surfaces = surface;
    for (int k = 0; k < 3; k++) {
        b.wo[k] = wo[k];
        b.wi[k] = wi[k];
        b.rgb[k] = rgb[k];
        for (int n = 0; n < CHUNK; n++) {
            wo[k][n] = o[k];
            wi[k][n] = i[k];
        }
    }
    moments ratio = { 0 };
    do {
        for (int n = 0; n < CHUNK; n++) {
            /* A footprint of 1 mm^2, stretched as a plane tilted this much shows it, in any direction. */
            const double stretch = 1.0 / cos(tilt), turn = random_between(random, 0.0, 2.0 * PI);
            const double a = 1e-3 * sqrt(stretch), c = 1e-3 / sqrt(stretch);
            jacobian[0][n] = (float)(a * cos(turn));
            jacobian[1][n] = (float)(-c * sin(turn));
            jacobian[2][n] = (float)(a * sin(turn));
            jacobian[3][n] = (float)(c * cos(turn));
            u[n] = random_between(random, -100.0, 100.0);
            v[n] = random_between(random, -100.0, 100.0);
            seed[n] = (uint32_t)random_bits(random);
            solid_angle[n] = angle;
            surface[n] = s;
        }
        assert_int_equal(glint_eval_batch(m, &b), GLINT_OK);
        for (int n = 0; n < CHUNK; n++)
            moments_add(&ratio, (double)(rgb[0][n] / smooth[0]));
    } while (ratio.count < 20000.0 || moments_standard_error(&ratio) > 0.00125);
    return ratio;
}

static void mean_over_seeds_is_smooth(void **state)
{
    (void)state;
    static const double facets[] = { 1.0, 10.0, 100.0, 1e3, 1e5, 1e7 }, tilts[] = { 0.0, 25.0, 50.0, 75.0 };
    uint64_t random = 2;
    double worst = 0.0;
    printf("mean of counting / smooth over seeds, in sigmas of its own standard error (at most .00125)\n");
    printf("%-14s %5s", "", "tilt");
    for (int k = 0; k < 6; k++)
        printf("  N = %-7g", facets[k]);
    for (int i = 0; i < 4; i++) {
        configuration c = configuration_of(GLINT_MODEL_COUNTING, i);
        glint_material *m = create(&c.options);
        for (int t = 0; t < 4; t++) {
            printf("\n%-14s %5.0f", c.name, tilts[t]);
            for (int k = 0; k < 6; k++) {
                const moments r = ratio_over_seeds(m, facets[k], tilts[t] * PI / 180.0, &random);
                const double error = r.mean - 1.0, sigmas = error / moments_standard_error(&r);
                printf("  %.4f %+.1f", r.mean, sigmas);
                worst = fmax(worst, fabs(error));
                /* 96 means: 4.2 sigmas is a significance of .003 in all; the float ratio itself is off by a few 1e-7.
                 */
                assert_true(fabs(error) < 4.2 * moments_standard_error(&r) + 1e-6);
            }
        }
        glint_material_destroy(m);
    }
    printf("\nlargest deviation %.2f %% (bound 0.5 %%)\n", 100.0 * worst);
    assert_true(worst < 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_agrees_with_double_precision),
        cmocka_unit_test(mean_over_seeds_is_smooth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
