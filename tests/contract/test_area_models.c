/* What each model makes of a light of real size, against sums over facets, directions or seeds. */
#include "area_cases.h"
#include "configurations.h"

#define PI AREA_PI

static glint_area_light lamp(glint_area_kind kind)
{
    return (glint_area_light){
        .kind = kind,
        .two_sided = 1U,
        .solid_angle_sr = 0.3F,
        .radius = 0.3F,
        .center = { -0.3F, 0.2F, 1.0F },
        .half_x = { 0.4F, 0.0F, 0.1F },
        .half_y = { 0.0F, 0.25F, 0.0F },
        .corner_count = 4U,
        .corners = { { -0.7F, -0.1F, 1.0F }, { 0.2F, -0.1F, 1.0F }, { 0.1F, 0.5F, 1.0F }, { -0.6F, 0.4F, 1.0F } }
    };
}

static glint_material *material_of(glint_model model, float facet_alpha)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.surface.alpha_x = o.surface.alpha_y = 0.3F;
    o.surface.facets_per_m2 = 1e8F;
    o.facet_alpha = facet_alpha;
    o.area_light_method = GLINT_AREA_LIGHT_EXACT;
    return create(&o);
}

static const float VIEW[3] = { 0.35F, 0.0F, 0.936749F };

/* Counts and facets, over many pixels: the mean is the integral of the lobe. */
static void means_are_the_brute_force(void **state)
{
    (void)state;
    const area_truth_lobe lobe = { 0, 0.3, 0.3 };
    const glint_model models[] = { GLINT_MODEL_COUNTING, GLINT_MODEL_EXPLICIT };
    for (int m = 0; m < 2; m++)
        for (int kind = GLINT_AREA_SUN; kind <= GLINT_AREA_POLYGON; kind++) {
            const glint_area_light l = lamp((glint_area_kind)kind);
            const area_truth truth = area_truth_of(&lobe, VIEW, &l, 400);
            glint_material *material = material_of(models[m], 0.0F);
            moments x = { 0 };
            for (int i = 0; i < 3000; i++) {
                /* Ten cells apart: no two pixels share a facet or a cell of a grid. */
                const glint_footprint f = { 1e-2 * i, 0.0, 1e-3F, 0.0F, 0.0F, 1e-3F, (uint32_t)i };
                glint_value v;
                glint_eval_area(material, NULL, &f, VIEW, &l, &v);
                moments_add(&x, (double)v.rgb[0]);
            }
            const double sigma = moments_standard_error(&x), error = x.mean - truth.specular;
            /* Quadrature within half a percent. */
            if (fabs(error) > 4.0 * sigma + 0.005 * truth.specular)
                fail_msg("%s, kind %d: mean %g, expected %g, %.1f sigmas", glint_model_name(models[m]), kind, x.mean,
                         truth.specular, error / sigma);
            glint_material_destroy(material);
        }
}

/* N facets of which each is lit with chance p, for whole cells: variance (1 - p) / (N p) of the mean, and what F G2
 * adds by varying over the light, which is left out here by looking at the mirror's own number. */
static void explicit_lights_the_binomial_number_of_facets(void **state)
{
    (void)state;
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_area_light l = { .kind = GLINT_AREA_SUN, .solid_angle_sr = 0.1F, .center = { 0.0F, 0.0F, 1.0F } };
    glint_material *material = material_of(GLINT_MODEL_EXPLICIT, 0.0F);
    moments x = { 0 };
    glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
    for (int i = 0; i < 10000; i++) {
        const glint_footprint f = { 1e-3 * i + 5e-4, 5e-4, 1e-3F, 0.0F, 0.0F, 1e-3F, 0U };
        glint_eval_area(material, NULL, &f, up, &l, &v);
        moments_add(&x, (double)v.rgb[0] / (double)v.smooth[0]);
    }
    const double p = (double)v.lit_probability, expected = (1.0 - p) / (100.0 * p);
    const double noise = sqrt((2.0 + 1.0 / (100.0 * p)) / x.count);
    printf("variance of explicit over (1-p)/Np: %.3f\n", moments_variance(&x) / expected);
    if (fabs(moments_variance(&x) / expected - 1.0) > 4.0 * noise + 0.02)
        fail_msg("variance %g, expected %g, noise %g", moments_variance(&x), expected, noise * expected);
    glint_material_destroy(material);
}

/* A rough facet's lobe is a density: what parts of a light take in adds up, and all directions take in all of it. */
static void rough_facets_spread_and_keep_their_light(void **state)
{
    (void)state;
    for (int distribution = 0; distribution < 2; distribution++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = GLINT_MODEL_EXPLICIT;
        o.distribution = (glint_distribution)distribution;
        o.surface.alpha_x = o.surface.alpha_y = 0.2F;
        o.facet_alpha = 0.05F;
        glint_material *m = create(&o);
        const glint_area_light whole = lamp(GLINT_AREA_RECTANGLE);
        for (int i = 0; i < 40; i++) {
            const glint_footprint f = { 1e-2 * i, 0.0, 3e-4F, 0.0F, 0.0F, 3e-4F, 3U };
            double sum = 0.0;
            glint_value v;
            for (int part = 0; part < 2; part++) {
                glint_area_light half = whole;
                for (int k = 0; k < 3; k++) {
                    half.center[k] += (part ? 0.5F : -0.5F) * whole.half_x[k];
                    half.half_x[k] *= 0.5F;
                }
                glint_eval_area(m, NULL, &f, VIEW, &half, &v);
                sum += (double)v.rgb[0];
            }
            glint_eval_area(m, NULL, &f, VIEW, &whole, &v);
            assert_true(fabs(sum - (double)v.rgb[0]) < 2e-3 * (double)v.rgb[0] + 1e-6);
        }
        glint_material_destroy(m);
    }
}

/* Points of the light and of the model estimate the integral of the model's own eval. */
static void points_estimate_the_integral_of_eval(void **state)
{
    (void)state;
    const glint_model models[] = { GLINT_MODEL_DICTIONARY, GLINT_MODEL_EXAMPLE };
    enum { SIDE = 60 };
    for (int m = 0; m < 2; m++) {
        glint_material *material = material_of(models[m], 0.0F);
        const glint_area_light l = lamp(GLINT_AREA_SUN);
        const double length = sqrt(0.09 + 0.04 + 1.0);
        const double a[3] = { -0.3 / length, 0.2 / length, 1.0 / length };
        moments error = { 0 };
        for (int i = 0; i < 60; i++) {
            const glint_footprint f = { 1e-2 * i, 0.0, 2e-3F, 0.0F, 0.0F, 2e-3F, (uint32_t)i };
            double sum = 0.0;
            for (int s = 0; s < SIDE; s++)
                for (int t = 0; t < SIDE; t++) {
                    const double versine = 0.3 / (2.0 * PI) * (s + 0.5) / SIDE, phi = 2.0 * PI * (t + 0.5) / SIDE;
                    const double sine = sqrt(versine * (2.0 - versine));
                    const double n = hypot(a[0], a[2]), x[3] = { a[2] / n, 0.0, -a[0] / n };
                    const double y[3] = { a[1] * x[2], a[2] * x[0] - a[0] * x[2], -a[1] * x[0] };
                    float wi[3], rgb[3];
                    for (int k = 0; k < 3; k++)
                        wi[k] = (float)((1.0 - versine) * a[k] + sine * (cos(phi) * x[k] + sin(phi) * y[k]));
                    const glint_light point = { GLINT_LIGHT_CAP, 0.3F / 16.0F };
                    glint_eval(material, NULL, &f, VIEW, wi, &point, rgb);
                    sum += (double)rgb[0] * 0.3 / (SIDE * SIDE);
                }
            glint_value v;
            glint_eval_area(material, NULL, &f, VIEW, &l, &v);
            moments_add(&error, (double)v.rgb[0] / sum - 1.0);
        }
        const double sigma = moments_standard_error(&error);
        printf("%s: mean error of the points %.4f, of one pixel %.3f\n", glint_model_name(models[m]), error.mean,
               sqrt(moments_variance(&error)));
        /* One percent: the solid angle of a point's share widens what the example model sees. */
        if (fabs(error.mean) > 4.0 * sigma + 0.01)
            fail_msg("%s: mean error %g, %.1f sigmas", glint_model_name(models[m]), error.mean, error.mean / sigma);
        glint_material_destroy(material);
    }
}

/* Correlation of the pixels' glints before and after a sun slides by a tenth of its width. */
static double kept_glints(glint_model model, double radius)
{
    glint_material *m = material_of(model, 0.0F);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    moments a = { 0 }, b = { 0 }, ab = { 0 };
    for (int i = 0; i < 3000; i++) {
        const glint_footprint f = { 1e-2 * i, 0.0, 4e-4F, 0.0F, 0.0F, 4e-4F, (uint32_t)i };
        double x[2];
        for (int k = 0; k < 2; k++) {
            const double at = 0.3 + 0.2 * radius * k;
            const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                           .solid_angle_sr = (float)(2.0 * PI * (1.0 - cos(radius))),
                                           .center = { (float)sin(at), 0.0F, (float)cos(at) } };
            glint_value v;
            glint_eval_area(m, NULL, &f, up, &sun, &v);
            x[k] = (double)(v.rgb[0] / v.smooth[0]);
        }
        moments_add(&a, x[0]);
        moments_add(&b, x[1]);
        moments_add(&ab, x[0] * x[1]);
    }
    glint_material_destroy(m);
    return (ab.mean - a.mean * b.mean) / sqrt(moments_variance(&a) * moments_variance(&b));
}

static void glints_stay_while_a_light_slides_a_little(void **state)
{
    (void)state;
    static const double radii[] = { 0.05, 0.3, 0.8 };
    for (int i = 0; i < 3; i++) {
        const double truth = kept_glints(GLINT_MODEL_EXPLICIT, radii[i]);
        const double counting = kept_glints(GLINT_MODEL_COUNTING, radii[i]);
        printf("radius %.2f: correlation after a tenth of the width: explicit %.3f, counting %.3f\n", radii[i], truth,
               counting);
        /* Noise of a correlation from 3000 pixels: below .02. */
        assert_true(counting > truth - 0.06);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_are_the_brute_force),
        cmocka_unit_test(explicit_lights_the_binomial_number_of_facets),
        cmocka_unit_test(rough_facets_spread_and_keep_their_light),
        cmocka_unit_test(points_estimate_the_integral_of_eval),
        cmocka_unit_test(glints_stay_while_a_light_slides_a_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
