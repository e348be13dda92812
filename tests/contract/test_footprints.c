/* What every model promises under a footprint: its mean over seeds, its samples and their density. */
#include "contract.h"
#include "sampling.h"

#include <string.h>

#define PI 3.14159265358979323846

/* Small enough for D to be flat across it. */
static const glint_light LIGHT = { GLINT_LIGHT_CAP, 1e-3F };

static int samples_know_the_footprint(const glint_material *m)
{
    return (glint_material_features(m) & GLINT_FEATURE_SAMPLE_FOOTPRINT) != 0;
}

/* Stretched by the tilt at which wo sees it. */
static glint_footprint tilted_footprint(double size, double tilt, uint64_t *random)
{
    const double turn = random_between(random, 0.0, 2.0 * PI), major = size / cos(tilt);
    return (glint_footprint){ .u = random_between(random, -1.0, 1.0),
                              .v = random_between(random, -1.0, 1.0),
                              .dudx = (float)(major * cos(turn)),
                              .dudy = (float)(-size * sin(turn)),
                              .dvdx = (float)(major * sin(turn)),
                              .dvdy = (float)(size * cos(turn)),
                              .seed = (uint32_t)random_bits(random) };
}

/* 3 % is what the example model claims for scattered maps, the widest claim; counting's is that of its binomial law. */
static double claimed_error(glint_model model)
{
    return model == GLINT_MODEL_SMOOTH ? 1e-6 : model == GLINT_MODEL_COUNTING ? 2e-4 : 0.03;
}

static void mean_over_seeds_is_smooth(void **state)
{
    (void)state;
    uint64_t random = 1;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        /* The lobes of rough facets widen D where each is drawn, and only there. */
        if (row->model == GLINT_MODEL_EXPLICIT && c.options.facet_alpha > 0.0F)
            continue;
        const double side = sqrt(1000.0 / (double)c.options.surface.facets_per_m2);
        moments value = { 0 }, smooth = { 0 };
        for (int i = 0; i < 2500; i++) {
            const double tilt = random_between(&random, 0.0, 0.6);
            float wo[3], wi[3];
            direction(tilt, 0.4, wo);
            direction(tilt, 0.4 + PI + random_between(&random, -0.2, 0.2), wi);
            const glint_footprint f = tilted_footprint(side * sqrt(cos(tilt)), tilt, &random);
            glint_value v;
            glint_eval_value(m, NULL, &f, wo, wi, &LIGHT, &v);
            moments_add(&value, (double)v.rgb[0]);
            moments_add(&smooth, (double)v.smooth[0]);
        }
        const double sigma = hypot(moments_standard_error(&value), moments_standard_error(&smooth));
        const double error = value.mean - smooth.mean;
        if (fabs(error) > 4.5 * sigma + claimed_error(row->model) * smooth.mean)
            fail_msg("%s, %s: mean %g, smooth %g, %.1f sigmas", glint_model_name(row->model), c.name, value.mean,
                     smooth.mean, error / sigma);
    }
    contract_kept(5, "The mean over seeds is the smooth value", "footprints",
                  (const contract_exception[]){ { GLINT_MODEL_EXPLICIT, "yes (4)" }, { GLINT_MODEL_SMOOTH, NULL } });
}

static void weight_times_density_is_the_value_under_the_footprint(void **state)
{
    (void)state;
    uint64_t random = 2;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        const int knows = samples_know_the_footprint(m);
        int drawn = 0;
        for (int i = 0; i < 2000; i++) {
            float wo[3], rgb[3];
            random_direction(&random, wo);
            const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                 (float)random_uniform(&random) };
            const glint_footprint f = random_footprint(&random);
            glint_sample s, plain;
            const int found = glint_sample_direction(m, NULL, &f, wo, u, &s);
            if (!knows) {
                /* The smooth ones, bit for bit. */
                assert_int_equal(found, glint_sample_direction(m, NULL, NULL, wo, u, &plain));
                assert_memory_equal(&s, &plain, sizeof(s));
            }
            if (!found)
                continue;
            drawn++;
            assert_true(fabs((double)glint_pdf(m, NULL, &f, wo, s.wi) / (double)s.pdf - 1.0) < 1e-5);
            glint_eval(m, NULL, knows ? &f : NULL, wo, s.wi, &LIGHT, rgb);
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)(s.weight[k] * s.pdf) - (double)rgb[k]) <= 1e-5 * (double)rgb[k] + 1e-12);
        }
        assert_true(drawn > 800);
    }
    contract_kept(9, "Weight times density is the value under the footprint", "footprints",
                  (const contract_exception[]){ { GLINT_MODEL_SMOOTH, "(2)" },
                                                { GLINT_MODEL_COUNTING, "(2)" },
                                                { GLINT_MODEL_EXPLICIT, "(2)" },
                                                { GLINT_MODEL_EXAMPLE, "(2)" },
                                                { GLINT_MODEL_LAYERED, "yes (5)" },
                                                { GLINT_MODEL_SMOOTH, NULL } });
}

/* A long footprint on an anisotropic material, and a grazing one; where sampling knows no footprint the smooth density
 * has been tested, and tests/contract/test_dictionary.c tests a round one on everything else. */
static void samples_have_the_density_of_the_footprint(void **state)
{
    (void)state;
    static sampling_counts counts;
    uint64_t random = 3;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        if (!samples_know_the_footprint(m) || (i_ != 2 && i_ != 5))
            continue;
        const double tilt = i_ == 2 ? 0.9 : 1.4;
        float wo[3];
        direction(tilt, 0.5, wo);
        const glint_footprint f = tilted_footprint(1e-3, tilt, &random);
        sampling_expect(&counts, m, &f, wo, 3);
        sampling_draw(&counts, m, &f, wo, &random);
        double cells;
        const double chi2 = sampling_chi_square(&counts, &cells), tail = chi_square_tail(chi2, cells);
        printf("%s, %s, view at %g: chi^2 %.1f on %.0f cells, significance %.2g\n", glint_model_name(row->model),
               c.name, tilt, chi2, cells, tail);
        assert_true(tail > 0.001 / 2.0);
    }
    contract_kept(11, "Samples have their density under a footprint (round, long, grazing)", "footprints",
                  (const contract_exception[]){ { GLINT_MODEL_SMOOTH, "(2)" },
                                                { GLINT_MODEL_COUNTING, "(2)" },
                                                { GLINT_MODEL_EXPLICIT, "(2)" },
                                                { GLINT_MODEL_EXAMPLE, "(2)" },
                                                { GLINT_MODEL_LAYERED, "untested" },
                                                { GLINT_MODEL_SMOOTH, NULL } });
}

/* A facet of length over width 16 covers four widths of a square one along the tangent and a quarter across: what a
 * pixel sees of them is what it would see of square ones on a surface that is shrunk so, bit for bit, as a factor of
 * four rounds nothing. */
static void elongated_facets_are_long_along_the_tangent(void **state)
{
    (void)state;
    static const glint_model models[] = { GLINT_MODEL_COUNTING, GLINT_MODEL_EXPLICIT, GLINT_MODEL_DICTIONARY,
                                          GLINT_MODEL_EXAMPLE };
    for (size_t k = 0; k < sizeof(models) / sizeof(models[0]); k++) {
        glint_material_options o = single_configuration(models[k], 0).options;
        o.facet_alpha = 0.05F;
        glint_material *const square = create(&o);
        o.elongation = 16.0F;
        glint_material *const elongated = create(&o);
        uint64_t random = 4;
        int lit = 0;
        for (int i = 0; i < 2000; i++) {
            float wo[3], wi[3], rgb[3], expected[3];
            direction(0.3, 0.4, wo);
            direction(0.3 + random_between(&random, -0.3, 0.3), 0.4 + PI, wi);
            const double side = random_log_between(&random, 0.3, 10.0) / sqrt((double)o.surface.facets_per_m2);
            const glint_footprint f = tilted_footprint(side, 0.3, &random);
            glint_footprint shrunk = f;
            shrunk.u /= 4.0, shrunk.dudx /= 4.0F, shrunk.dudy /= 4.0F;
            shrunk.v *= 4.0, shrunk.dvdx *= 4.0F, shrunk.dvdy *= 4.0F;
            glint_eval(elongated, NULL, &f, wo, wi, &LIGHT, rgb);
            glint_eval(square, NULL, &shrunk, wo, wi, &LIGHT, expected);
            if (memcmp(rgb, expected, sizeof(rgb)) != 0)
                fail_msg("%s: %.9g under a pixel of %g m, expected %.9g", glint_model_name(models[k]), (double)rgb[0],
                         side, (double)expected[0]);
            lit += rgb[0] > 0.0F;
        }
        assert_true(lit > 500);
        glint_material_destroy(square);
        glint_material_destroy(elongated);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elongated_facets_are_long_along_the_tangent),
        cmocka_unit_test(mean_over_seeds_is_smooth),
        cmocka_unit_test(weight_times_density_is_the_value_under_the_footprint),
        cmocka_unit_test(samples_have_the_density_of_the_footprint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
