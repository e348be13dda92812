/* The explicit model against closed forms. */
#include "configurations.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* D of the material averaged over the light's cap, with the Jacobian 4 h.wi as the facets have it: what the mean of
 * value / reflectance must be. Fibonacci points on the cap. */
static double mean_over_cap(const glint_material *m, const float wo[3], const float wi[3], double solid_angle)
{
    enum { POINTS = 20000 };
    const double cos_rim = 1.0 - solid_angle / (2.0 * PI);
    const double z[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
    const double length = sqrt(z[0] * z[0] + z[2] * z[2]);
    const double x[3] = { z[2] / length, 0.0, -z[0] / length };
    const double y[3] = { z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0] };
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double c = 1.0 - (1.0 - cos_rim) * (i + 0.5) / POINTS, s = sqrt(1.0 - c * c), phi = 2.39996322972865 * i;
        float w[3], rgb[3];
        for (int k = 0; k < 3; k++)
            w[k] = (float)(c * z[k] + s * (cos(phi) * x[k] + sin(phi) * y[k]));
        glint_eval(m, NULL, NULL, wo, w, NULL, rgb);
        sum += (double)rgb[0];
    }
    return sum / POINTS;
}

/* Mean over pixels: the smooth value averaged over the light. A narrow light, so that F and G2, which the model takes
 * at the light's middle, do not matter. */
static void mean_of_explicit_is_smooth_over_the_light(void **state)
{
    (void)state;
    uint64_t random = 1;
    const double solid_angle = 0.01;
    for (int i = 0; i < 5; i++)
        for (int hash = 0; hash < 2; hash++)
            for (int t = 0; t < 3; t++) {
                configuration c = configuration_of(GLINT_MODEL_EXPLICIT, i);
                c.options.facet_hash = (glint_facet_hash)hash;
                c.options.facet_alpha = 0.0F;
                c.options.surface.facets_per_m2 = 1e8F; /* 100 under a pixel */
                glint_material *m = create(&c.options);
                c.options.model = GLINT_MODEL_SMOOTH;
                glint_material *smooth = create(&c.options);
                float wo[3], wi[3];
                direction(0.5 * t, 0.0, wo);
                direction(0.5 * t + 0.15, PI, wi);
                const double expected = mean_over_cap(smooth, wo, wi, solid_angle);
                moments x = { 0 };
                for (int k = 0; k < 6000; k++) {
                    const glint_footprint f = { random_between(&random, -0.5, 0.5),
                                                random_between(&random, -0.5, 0.5),
                                                1e-3F,
                                                2e-4F,
                                                -1e-4F,
                                                1e-3F,
                                                (uint32_t)k };
                    const glint_light light = { GLINT_LIGHT_CAP, (float)solid_angle };
                    glint_value v;
                    glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
                    moments_add(&x, (double)v.rgb[0]);
                }
                const double sigma = moments_standard_error(&x), error = x.mean - expected;
                /* 30 means: 4 sigmas. F and G2 vary by less than .3 % over a light of 3 degrees. */
                if (fabs(error) > 4.0 * sigma + 0.003 * expected)
                    fail_msg("%s, hash %d, view %d: mean %g, expected %g, %.1f sigmas", c.name, hash, t, x.mean,
                             expected, error / sigma);
                glint_material_destroy(m);
                glint_material_destroy(smooth);
            }
}

/* Pixels that are whole cells see N facets with shares 1/N each: the count of lit ones is binomial. */
static void variance_of_explicit_is_binomial(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXPLICIT;
    o.surface.facets_per_m2 = 1e8F;
    glint_material *m = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    moments x = { 0 };
    glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
    for (int k = 0; k < 40000; k++) {
        /* 5 x 5 cells of 1e-4 m, on their borders */
        const glint_footprint f = {
            1e-4 * (5 * (k % 200) + 2.5), 1e-4 * (5 * (k / 200) + 2.5), 5e-4F, 0.0F, 0.0F, 5e-4F, 0U
        };
        glint_eval_value(m, NULL, &f, up, up, &light, &v);
        moments_add(&x, (double)(v.rgb[0] / v.smooth[0]));
    }
    const double p = (double)v.lit_probability, variance = (1.0 - p) / (25.0 * p);
    /* Kurtosis 3 + 1/Np; D falls over the light's radius of .08, on average by 3 % in p. */
    const double noise = 4.0 * sqrt((2.0 + 1.0 / (25.0 * p)) / x.count);
    printf("variance of explicit over (1-p)/Np: %.3f\n", moments_variance(&x) / variance);
    assert_true(fabs(moments_variance(&x) / variance - 1.0) < noise + 0.04);
    assert_true(fabs((double)v.facet_count - 25.0) < 1e-3);
    glint_material_destroy(m);
}

static void more_facets_than_the_limit_give_the_smooth_value_and_their_number(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXPLICIT;
    o.facet_limit = 1000U;
    glint_material *m = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    const glint_footprint f = { .dudx = 1e-2F, .dvdy = 1e-2F };
    glint_value v;
    glint_eval_value(m, NULL, &f, up, up, &light, &v);
    assert_memory_equal(v.rgb, v.smooth, sizeof(v.rgb));
    assert_true(fabs((double)v.facet_count / 1e4 - 1.0) < 1e-5);
    glint_material_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_of_explicit_is_smooth_over_the_light),
        cmocka_unit_test(variance_of_explicit_is_binomial),
        cmocka_unit_test(more_facets_than_the_limit_give_the_smooth_value_and_their_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
