/* What every model promises, for every model: sign, reciprocity, energy, convergence. */
#include "contract.h"

#define PI 3.14159265358979323846

static void values_are_finite_and_not_negative(void **state)
{
    (void)state;
    uint64_t random = 1;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 20000; i++) {
        float wo[3], wi[3];
        random_direction(&random, wo);
        random_direction(&random, wi);
        const glint_footprint f = random_footprint(&random);
        const glint_light light = { GLINT_LIGHT_CAP, (float)random_log_between(&random, 1e-9, 6.0) };
        glint_value v;
        glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
        for (int k = 0; k < 3; k++)
            assert_true(isfinite(v.rgb[k]) && v.rgb[k] >= 0.0F && isfinite(v.smooth[k]) && v.smooth[k] >= 0.0F);
        assert_true(v.lit_probability >= 0.0F && v.lit_probability <= 1.0F && v.facet_count >= 0.0F);
    }
    contract_kept(1, "Finite and not negative", "models", NULL);
}

static void light_and_viewer_may_be_exchanged(void **state)
{
    (void)state;
    uint64_t random = 2;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        if (!is_reciprocal(row, &c))
            continue;
        for (int i = 0; i < 20000; i++) {
            float wo[3], wi[3], there[3], back[3];
            random_direction(&random, wo);
            random_direction(&random, wi);
            if (wo[2] < 1e-3F || wi[2] < 1e-3F)
                continue;
            const glint_footprint f = random_footprint(&random);
            const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
            glint_eval(m, NULL, &f, wo, wi, &light, there);
            glint_eval(m, NULL, &f, wi, wo, &light, back);
            for (int k = 0; k < 3; k++) {
                const double x = (double)(there[k] / wi[2]), y = (double)(back[k] / wo[2]);
                assert_true(fabs(x - y) <= 4e-6 * fmax(x, y));
            }
        }
    }
    contract_kept(3, "Light and viewer may be exchanged", "models",
                  (const contract_exception[]){ { GLINT_MODEL_EXPLICIT, "no (1)" },
                                                { GLINT_MODEL_LAYERED, "yes (1)" },
                                                { GLINT_MODEL_SMOOTH, NULL } });
}

static void nothing_is_seen_below_the_horizon(void **state)
{
    (void)state;
    const float up[3] = { 0.0F, 0.0F, 1.0F }, down[3] = { 0.6F, 0.0F, -0.8F }, flat[3] = { 1.0F, 0.0F, 0.0F };
    const float *const bad[] = { down, flat };
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 2; i++) {
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
        float rgb[3] = { 1.0F, 1.0F, 1.0F };
        glint_eval(m, NULL, &f, up, bad[i], &light, rgb);
        assert_true(rgb[0] == 0.0F && rgb[1] == 0.0F && rgb[2] == 0.0F);
        glint_eval(m, NULL, &f, bad[i], up, &light, rgb);
        assert_true(rgb[0] == 0.0F && rgb[1] == 0.0F && rgb[2] == 0.0F);
        assert_true(glint_pdf(m, NULL, NULL, up, bad[i]) == 0.0F && glint_pdf(m, NULL, NULL, bad[i], up) == 0.0F);
    }
    contract_kept(2, "Zero below the horizon", "models", NULL);
}

/* Albedo by the model's own sampling, by cosine sampling, and never above one. */
static void energy_is_kept_and_sampling_agrees_with_quadrature(void **state)
{
    (void)state;
    uint64_t random = 3;
    static const double theta[] = { 0.0, 0.8, 1.3, 1.5 };
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int t = 0; t < 4; t++) {
        float wo[3];
        direction(theta[t], 0.3, wo);
        moments sampled = { 0 }, quadrature = { 0 };
        for (int i = 0; i < 60000; i++) {
            const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                 (float)random_uniform(&random) };
            glint_sample s;
            moments_add(&sampled, glint_sample_direction(m, NULL, NULL, wo, u, &s) ? (double)s.weight[0] : 0.0);
            float wi[3], rgb[3];
            random_direction(&random, wi);
            glint_eval(m, NULL, NULL, wo, wi, NULL, rgb);
            moments_add(&quadrature, (double)rgb[0] * PI / fmax((double)wi[2], 1e-9));
        }
        const double sigma = hypot(moments_standard_error(&sampled), moments_standard_error(&quadrature));
        assert_true(sampled.mean <= 1.0 + 4.0 * moments_standard_error(&sampled) + 1e-5);
        if (fabs(sampled.mean - quadrature.mean) > 4.5 * sigma + 1e-5)
            fail_msg("%s, %s, view at %g: albedo %g by sampling, %g by quadrature, sigma %g",
                     glint_model_name(row->model), c.name, theta[t], sampled.mean, quadrature.mean, sigma);
    }
    contract_kept(4, "No more light than comes in; sampling agrees with quadrature", "models", NULL);
}

static void weight_times_density_is_the_value(void **state)
{
    (void)state;
    uint64_t random = 4;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 20000; i++) {
        float wo[3], rgb[3];
        random_direction(&random, wo);
        const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                             (float)random_uniform(&random) };
        glint_sample s;
        if (!glint_sample_direction(m, NULL, NULL, wo, u, &s))
            continue;
        const float pdf = glint_pdf(m, NULL, NULL, wo, s.wi);
        assert_true(fabs((double)pdf / (double)s.pdf - 1.0) < 1e-5);
        glint_eval(m, NULL, NULL, wo, s.wi, NULL, rgb);
        for (int k = 0; k < 3; k++)
            assert_true(fabs((double)(s.weight[k] * s.pdf) - (double)rgb[k]) <= 1e-5 * (double)rgb[k] + 1e-12);
    }
    contract_kept(8, "Weight times density is the value", "models", NULL);
}

/* Root mean square of value / smooth - 1 over so many footprints. */
static double roughness_of(const glint_material *m, double facets, int points, uint64_t *random)
{
    moments square = { 0 };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    glint_coat coat;
    const glint_surface s = surface_of_density(m, (float)(facets / 1e-6), &coat);
    for (int i = 0; i < points; i++) {
        float wi[3];
        direction(random_between(random, 0.0, 0.3), 1.0, wi);
        const glint_footprint f = {
            random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0), 1e-3F, 0.0F, 0.0F, 1e-3F, (uint32_t)i
        };
        const glint_light light = { GLINT_LIGHT_CAP, 1e-2F };
        glint_value v;
        glint_eval_value(m, &s, &f, wo, wi, &light, &v);
        const double d = (double)(v.rgb[0] - v.smooth[0]) / (double)v.smooth[0];
        moments_add(&square, d * d);
    }
    return sqrt(square.mean);
}

static void tends_to_smooth_as_density_grows(void **state)
{
    (void)state;
    uint64_t random = 8;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        /* By the spread of the squares, the ratio of two root mean squares is known to 5 % in every row. Where there is
         * an explicit layer, which visits every facet, a thousand points are enough for that. */
        const int points = most_facets(row, &c) > 1e12 ? 4000 : 1000;
        double last = HUGE_VAL;
        for (double n = 100.0; n < fmin(1e12, most_facets(row, &c)); n *= 10.0) {
            const double r = roughness_of(m, n, points, &random);
            /* The error falls with the square root, by .316 for ten times the facets: 9 standard errors below .5. */
            assert_true(r <= last * 0.5 + row->resolution + 1e-6);
            last = r;
        }
        if (most_facets(row, &c) > 1e12)
            assert_true(last < 1e-4);
    }
    contract_kept(6, "Tends to smooth as density grows", "models",
                  (const contract_exception[]){ { GLINT_MODEL_EXPLICIT, "yes (3)" },
                                                { GLINT_MODEL_LAYERED, "yes (3)" },
                                                { GLINT_MODEL_SMOOTH, NULL } });
}

/* Whatever the object's number, which a renderer may take from a hash: materials with seeds next to each other have
 * other facets, and so have objects with numbers next to each other. */
static void seeds_next_to_each_other_show_other_facets(void **state)
{
    (void)state;
    static const uint32_t objects[] = { 0U, 1U, 5000U, 0x00ffffffU, 0x7ffffffeU, 0x9e3779b9U, 0xfffffff0U };
    const float wo[3] = { 0.0F, 0.0F, 1.0F }, wi[3] = { 0.1F, 0.0F, 0.995F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.3F };
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        if (row->model == GLINT_MODEL_SMOOTH || row->model == GLINT_MODEL_EXAMPLE || row->model == GLINT_MODEL_LAYERED)
            continue; /* which have no facets, lay out one map, or are made of the others */
        c.options.seed++;
        glint_material *const next = create(&c.options);
        for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++) {
            int by_material = 0, by_object = 0;
            for (int k = 0; k < 64; k++) {
                glint_footprint f = { .u = 0.03 * k, .dudx = 1e-2F, .dvdy = 1e-2F, .seed = objects[i] };
                float here[3], there[3];
                glint_eval(m, NULL, &f, wo, wi, &light, here);
                glint_eval(next, NULL, &f, wo, wi, &light, there);
                by_material += memcmp(here, there, sizeof here) != 0;
                f.seed++;
                glint_eval(m, NULL, &f, wo, wi, &light, there);
                by_object += memcmp(here, there, sizeof here) != 0;
            }
            if (by_material < 32 || by_object < 32)
                fail_msg("%s, %s, object %u: of 64 places %d change with the material's seed, %d with the object's",
                         glint_model_name(row->model), c.name, objects[i], by_material, by_object);
        }
        glint_material_destroy(next);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_finite_and_not_negative),
        cmocka_unit_test(light_and_viewer_may_be_exchanged),
        cmocka_unit_test(nothing_is_seen_below_the_horizon),
        cmocka_unit_test(energy_is_kept_and_sampling_agrees_with_quadrature),
        cmocka_unit_test(weight_times_density_is_the_value),
        cmocka_unit_test(tends_to_smooth_as_density_grows),
        cmocka_unit_test(seeds_next_to_each_other_show_other_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
