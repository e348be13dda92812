/* Energy of the layered model: no coat over no base gives back more light than came in, with normals of any tilt; and
 * its mean over seeds is the smooth sum. */
#include "configurations.h"

#define PI 3.14159265358979323846

static const double VIEW_RAD[] = { 0.0, 0.8, 1.3, 1.5 };

static glint_material *create_layered(const glint_material_options *base, const glint_material_options *coat)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_LAYERED;
    o.layers.base = base;
    o.layers.coat = coat;
    return create(&o);
}

/* A base that reflects all light, whatever its direction: what a coat adds to it is too much. */
static glint_material_options white_base(void)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_SMOOTH;
    for (int c = 0; c < 3; c++) {
        o.surface.diffuse[c] = 1.0F;
        o.surface.f0[c] = o.surface.f90[c] = 0.0F;
    }
    return o;
}

static void random_reflectance(glint_material_options *o, int i, uint64_t *random)
{
    o->fresnel = (glint_fresnel)(i % 3);
    o->ior = (float)random_between(random, 1.05, 3.0);
    for (int c = 0; c < 3; c++) {
        o->eta[c] = (float)random_between(random, 0.1, 3.0);
        o->k[c] = (float)random_between(random, 0.0, 5.0);
        o->surface.f0[c] = (float)(random_uniform(random) * (i % 2 ? 1.0 : 0.1));
        o->surface.f90[c] = i % 4 ? 1.0F : (float)random_uniform(random);
        o->surface.diffuse[c] = i % 5 == 0 ? (float)random_uniform(random) : 0.0F;
    }
}

/* Mean weight of stratified samples: the albedo, within a few 1e-4 where there is a diffuse part, else far better. */
static double sampled_albedo(const glint_material *m, const glint_surface *s, const float wo[3], int side,
                             uint64_t *random)
{
    double sum = 0.0;
    for (int i = 0; i < side * side; i++) {
        const float u[3] = { (float)random_uniform(random), ((float)(i / side) + 0.5F) / (float)side,
                             ((float)(i % side) + 0.5F) / (float)side };
        glint_sample sample;
        if (glint_sample_direction(m, s, NULL, wo, u, &sample))
            sum += (double)sample.weight[0];
    }
    return sum / (side * side);
}

/* The reason why Eq. 10 keeps energy: what the coat reflects and what it lets through are not more than came in. */
static void a_coat_reflects_no_more_than_it_keeps_from_the_base(void **state)
{
    (void)state;
    static const glint_model models[] = { GLINT_MODEL_SMOOTH, GLINT_MODEL_DICTIONARY, GLINT_MODEL_EXAMPLE };
    enum { SIDE = 32 };
    const glint_material_options base = white_base();
    uint64_t random = 1;
    double worst = -1.0;
    for (int i = 0; i < 120; i++) {
        glint_material_options o = configuration_of(models[i % 3], i / 3 % CONFIGURATIONS).options;
        o.color_count = 0;
        o.color_variation = 0.0F;
        o.coverage = i % 7 ? 1.0F : 0.5F;
        o.surface.alpha_x = (float)random_log_between(&random, 1e-3, 1.0);
        o.surface.alpha_y = i % 2 ? o.surface.alpha_x : (float)random_log_between(&random, 1e-3, 1.0);
        random_reflectance(&o, i, &random);
        glint_material *coat = create(&o), *both = create_layered(&base, &o);
        for (int k = 0; k < 3; k++) {
            float wo[3], through[3];
            direction(k == 0 ? 0.0 : random_between(&random, 0.0, 1.56), random_between(&random, 0.0, 2.0 * PI), wo);
            glint_transmittance(both, NULL, wo, NULL, through);
            const double albedo = sampled_albedo(coat, NULL, wo, SIDE, &random), sum = albedo + (double)through[0];
            /* With a diffuse part samples choose between two lobes: weights of up to 2 / .1, 1024 of them. The midpoint
             * rule for the facets alone is off by 7e-5 of what they reflect. */
            const double bound = o.surface.diffuse[0] > 0.0F ? 5.0 * 0.7 / SIDE : 7e-5;
            worst = fmax(worst, o.surface.diffuse[0] > 0.0F ? -1.0 : sum - 1.0);
            if (sum > 1.0 + bound)
                fail_msg("%s, Fresnel %d, alpha %g %g, view %g: reflects %.6f, lets through %.6f, bound 1 + %g",
                         glint_model_name(o.model), (int)o.fresnel, (double)o.surface.alpha_x,
                         (double)o.surface.alpha_y, acos((double)wo[2]), albedo, (double)through[0], bound);
        }
        glint_material_destroy(coat);
        glint_material_destroy(both);
    }
    printf("most light of a coat over a perfectly white base: 1 + %.1e\n", worst);
}

/* The integral of the value over all directions, above and below, by random ones: 4 pi times the mean. */
static moments sphere_albedo(const glint_material *m, const glint_surface *s, const float wo[3], uint64_t *random)
{
    moments sum = { 0 };
    for (int i = 0; i < 20000; i++) {
        float wi[3], rgb[3];
        direction(acos(random_between(random, -1.0, 1.0)), random_between(random, 0.0, 2.0 * PI), wi);
        glint_eval(m, s, NULL, wo, wi, NULL, rgb);
        moments_add(&sum, 4.0 * PI * (double)rgb[0]);
    }
    return sum;
}

/* Every pair of the table over every tilt of the coat; the viewer sees both layers, or one of them alone. */
static void no_more_light_leaves_than_came_in_with_bent_normals(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        const configuration c = configuration_of(GLINT_MODEL_LAYERED, i);
        glint_material *m = create(&c.options);
        for (int t = 0; t < 4; t++) {
            float wo[3];
            glint_surface s = glint_material_surface(m);
            glint_coat coat = *s.coat;
            s.coat = &coat;
            direction(VIEW_RAD[t], 0.3, wo);
            direction(i % 2 ? 0.3 : 0.9, 0.3 + 0.8 * (i + t), coat.normal);
            moments sampled = { 0 };
            for (int n = 0; n < 10000; n++) {
                const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                     (float)random_uniform(&random) };
                glint_sample sample;
                const int lit = glint_sample_direction(m, &s, NULL, wo, u, &sample);
                moments_add(&sampled, lit ? (double)sample.weight[0] : 0.0);
            }
            const moments quadrature = sphere_albedo(m, &s, wo, &random);
            const double error = moments_standard_error(&sampled);
            const double sigma = hypot(error, moments_standard_error(&quadrature));
            if (sampled.mean > 1.0 + 4.5 * error + 1e-5)
                fail_msg("%s, view %d: albedo %g, sigma %g", c.name, t, sampled.mean, error);
            /* 32 comparisons: 4.5 sigmas is a significance of 2e-4 in all. */
            if (fabs(sampled.mean - quadrature.mean) > 4.5 * sigma + 1e-5)
                fail_msg("%s, view %d: albedo %g by sampling, %g by quadrature, %.1f sigmas", c.name, t, sampled.mean,
                         quadrature.mean, fabs(sampled.mean - quadrature.mean) / sigma);
        }
        glint_material_destroy(m);
    }
}

static void mean_over_seeds_is_the_smooth_sum(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        const configuration c = configuration_of(GLINT_MODEL_LAYERED, i);
        glint_material *m = create(&c.options);
        const int is_example = has_model(&c, GLINT_MODEL_EXAMPLE);
        glint_coat coat;
        const glint_surface s = surface_of_density(m, 3e8F, &coat);
        float wo[3], wi[3];
        direction(0.4, 0.4, wo);
        direction(0.3, 0.4 + PI, wi);
        moments ratio = { 0 };
        for (int n = 0; n < 6000; n++) {
            const glint_footprint f = { random_between(&random, -100.0, 100.0),
                                        random_between(&random, -100.0, 100.0),
                                        1e-3F,
                                        0.0F,
                                        0.0F,
                                        1e-3F,
                                        (uint32_t)random_bits(&random) };
            const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
            glint_value v;
            glint_eval_value(m, &s, &f, wo, wi, &light, &v);
            moments_add(&ratio, (double)v.rgb[1] / (double)v.smooth[1]);
        }
        const double error = moments_standard_error(&ratio);
        /* docs/models.md gives the bias of scattered examples; a light of 1e-3 sr is not flat for explicit facets: D
         * changes by (half its radius of .018 / alpha)^2 across it. */
        const double bias = is_example ? 0.03 : 0.0;
        printf("%-28s mean over seeds / smooth - 1: %+.1e, standard error %.1e\n", c.name, ratio.mean - 1.0, error);
        if (!(fabs(ratio.mean - 1.0) <= 4.2 * error + bias + 2e-6))
            fail_msg("%s: mean %.5f, expected 1, %.1f sigmas", c.name, ratio.mean, fabs(ratio.mean - 1.0) / error);
        glint_material_destroy(m);
    }
}

/* Two dictionaries know the facets under a footprint, and so does the pair of them: their albedo there by its samples
 * and by cosine-distributed directions, and each sample's own value. */
static void samples_under_a_footprint_have_their_density_and_value(void **state)
{
    (void)state;
    uint64_t random = 4;
    const configuration c = configuration_of(GLINT_MODEL_LAYERED, 7);
    glint_material *m = create(&c.options);
    assert_true(glint_material_features(m) & GLINT_FEATURE_SAMPLE_FOOTPRINT);
    const glint_footprint f = { 0.3, 0.2, 1e-3F, 0.0F, 0.0F, 1e-3F, 0U };
    const glint_light any_light = { GLINT_LIGHT_CAP, 1e-3F };
    float wo[3];
    direction(0.4, 0.5, wo);
    moments sampled = { 0 }, quadrature = { 0 };
    for (int i = 0; i < 60000; i++) {
        const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                             (float)random_uniform(&random) };
        glint_sample s;
        moments_add(&sampled, glint_sample_direction(m, NULL, &f, wo, u, &s) ? (double)s.weight[1] : 0.0);
        float wi[3], rgb[3];
        random_direction(&random, wi);
        glint_eval(m, NULL, &f, wo, wi, &any_light, rgb);
        moments_add(&quadrature, (double)rgb[1] * PI / fmax((double)wi[2], 1e-9));
    }
    const double sigma = hypot(moments_standard_error(&sampled), moments_standard_error(&quadrature));
    if (!(fabs(sampled.mean - quadrature.mean) <= 4.5 * sigma && sigma < 0.05 * sampled.mean))
        fail_msg("albedo %g by sampling, %g by quadrature, %.1f sigmas of %g", sampled.mean, quadrature.mean,
                 fabs(sampled.mean - quadrature.mean) / sigma, sigma);
    for (int i = 0; i < 5000; i++) {
        const glint_footprint any = random_footprint(&random);
        const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                             (float)random_uniform(&random) };
        glint_sample s;
        float rgb[3];
        random_direction(&random, wo);
        if (!glint_sample_direction(m, NULL, &any, wo, u, &s))
            continue;
        assert_true(fabs((double)(glint_pdf(m, NULL, &any, wo, s.wi) / s.pdf) - 1.0) < 1e-5);
        glint_eval(m, NULL, &any, wo, s.wi, &any_light, rgb);
        for (int k = 0; k < 3; k++)
            assert_true(fabs((double)(s.weight[k] * s.pdf) - (double)rgb[k]) <= 1e-5 * (double)rgb[k] + 1e-12);
    }
    glint_material_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_coat_reflects_no_more_than_it_keeps_from_the_base),
        cmocka_unit_test(no_more_light_leaves_than_came_in_with_bent_normals),
        cmocka_unit_test(mean_over_seeds_is_the_smooth_sum),
        cmocka_unit_test(samples_under_a_footprint_have_their_density_and_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
