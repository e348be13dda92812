/* The explicit model against closed forms: what independent facets on a grid show in the mean, and how much it varies.
 */
#include "configurations.h"
#include "facet_truth.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* A pixel that is stretched, turned and sheared, with this many facets under it. */
static glint_footprint pixel_of(double facets, double density, uint64_t *random)
{
    const double side = sqrt(facets / density);
    return (glint_footprint){ random_between(random, -0.5, 0.5),
                              random_between(random, -0.5, 0.5),
                              (float)(1.6 * side),
                              (float)(0.3 * side),
                              (float)(-0.4 * side),
                              (float)(0.55 * side),
                              (uint32_t)random_bits(random) };
}

typedef struct setting {
    int configuration, hash, view;
    double facets; /* under the pixel */
} setting;

/* Value over the smooth one, in the mean and around the mean that it must have. */
static void sample(const setting *t, const glint_material_options *o, double expected, int count, uint64_t *random,
                   moments *x, moments *square)
{
    glint_material *m = create(o);
    float wo[3], wi[3];
    direction(0.5 * t->view, 0.3, wo);
    direction(0.5 * t->view + 0.15, 0.3 + PI, wi);
    const glint_light light = { GLINT_LIGHT_CAP, 0.01F };
    for (int k = 0; k < count; k++) {
        const glint_footprint f = pixel_of(t->facets, (double)o->surface.facets_per_m2, random);
        glint_value v;
        glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
        const double value = (double)(v.rgb[0] / v.smooth[0]), d = value - expected;
        moments_add(x, value);
        moments_add(square, d * d);
    }
    glint_material_destroy(m);
}

static void mean_and_variance_are_those_of_independent_facets(void **state)
{
    (void)state;
    uint64_t random = 1;
    double worst_mean = 0.0, worst_variance = 0.0;
    for (int i = 0; i < 40; i++) {
        const setting t = { i % 5, i / 5 % 2, i % 3, i % 4 == 0 ? 0.3 : i % 4 == 1 ? 3.0 : 25.0 };
        configuration c = configuration_of(GLINT_MODEL_EXPLICIT, t.configuration);
        c.options.facet_hash = (glint_facet_hash)t.hash;
        c.options.facet_alpha = 0.0F;
        c.options.surface.facets_per_m2 = 1e8F;
        float wo[3], wi[3];
        direction(0.5 * t.view, 0.3, wo);
        direction(0.5 * t.view + 0.15, 0.3 + PI, wi);
        const facet_moments facet = facet_moments_of(&c.options, wo, wi, 0.01);
        const glint_footprint f = pixel_of(t.facets, 1e8, &random);
        const double j[4] = { (double)f.dudx * 1e4, (double)f.dudy * 1e4, (double)f.dvdx * 1e4, (double)f.dvdy * 1e4 };
        const double variance = (facet.square - facet.mean * facet.mean) * facet_overlap(FACET_BOX, 1, j);
        moments x = { 0 }, square = { 0 };
        sample(&t, &c.options, facet.mean, 15000, &random, &x, &square);
        const double off = (x.mean - facet.mean) / sqrt(variance / x.count);
        const double spread = (square.mean - variance) / moments_standard_error(&square);
        worst_mean = fmax(worst_mean, fabs(off));
        worst_variance = fmax(worst_variance, fabs(spread));
        /* 80 numbers: 4.2 sigmas is a significance of .002 in all. The quadrature of facet_overlap is good to 1e-4. */
        if (fabs(off) > 4.2 || fabs(square.mean - variance) > 4.2 * moments_standard_error(&square) + 1e-4 * variance)
            fail_msg("%s, hash %d, view %d, %g facets: mean %g, expected %g (%+.1f sigmas), variance %g, expected %g "
                     "(%+.1f)",
                     c.name, t.hash, t.view, t.facets, x.mean, facet.mean, off, square.mean, variance, spread);
    }
    printf("largest deviation in sigmas: mean %.1f, variance %.1f\n", worst_mean, worst_variance);
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
        cmocka_unit_test(mean_and_variance_are_those_of_independent_facets),
        cmocka_unit_test(more_facets_than_the_limit_give_the_smooth_value_and_their_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
