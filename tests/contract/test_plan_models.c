/* Models obey the plan: what they leave out varies by no more than they may, and leaves no seam. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "glint.h"
#include "statistics.h"

enum { SEEDS = 4000 };

/* Values over seeds at a footprint of N facets, of which p are lit. */
static void evaluate(const glint_material *m, double n, int i, uint32_t draw, glint_value *value)
{
    static const float wo[3] = { 0.0F, 0.0F, 1.0F }, wi[3] = { 0.0995037F, 0.0F, 0.995037F };
    const float side = (float)sqrt(n / 1e8);
    const glint_footprint f = { .u = 0.01 * i, .v = 0.37 * i, .dudx = side, .dvdy = side, .draw = draw };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    glint_eval_value(m, NULL, &f, wo, wi, &light, value);
}

static glint_material *material_with(glint_model model, float smooth_deviation, float draw_deviation)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material *m;
    o.model = model;
    o.smooth_deviation = smooth_deviation;
    o.draw_deviation = draw_deviation;
    assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_OK);
    return m;
}

/* A model, the facets of a footprint that are tried, and how much its values vary over 1 / (N p) at most. */
typedef struct fading {
    glint_model model;
    int seeds;
    double first, last, step, variance;
    double bias; /* of the smooth value, at most */
} fading;

/* How far a value is off without what is left out, and the share of the count that shows. */
static double compare_at(const fading *c, double n, const glint_material *all, const glint_material *less, moments *off)
{
    double shown = 0.0;
    for (int i = 0; i < c->seeds; i++) {
        glint_value a, b;
        evaluate(all, n, i, 0U, &a);
        evaluate(less, n, i, 0U, &b);
        moments_add(off, ((double)b.rgb[0] - (double)a.rgb[0]) / (double)a.smooth[0]);
        const double counted = (double)a.rgb[0] - (double)a.smooth[0];
        if (fabs(counted) > 1e-3 * (double)a.smooth[0])
            shown = ((double)b.rgb[0] - (double)b.smooth[0]) / counted;
        assert_true(a.facet_count == b.facet_count && a.lit_probability == b.lit_probability);
    }
    return shown;
}

/* What is left out has the mean zero and never varies by more than the limit, from counting all to counting nothing. */
static void fade_out(const fading *c)
{
    const float limit = 0.1F;
    glint_material *all = material_with(c->model, 0.0F, 0.0F), *less = material_with(c->model, limit, 0.0F);
    double before = 1.0;
    assert_true(c->seeds >= 200);
    for (double n = c->first; n < c->last; n *= c->step) {
        moments off = { 0 };
        const double shown = compare_at(c, n, all, less, &off), deviation = sqrt(moments_variance(&off));
        /* So many samples know a deviation to 1 / sqrt(2 seeds). */
        const double most = (double)limit * sqrt(c->variance) * (1.0 + 4.5 / sqrt(2.0 * c->seeds));
        printf("%s, N %6.0f: %3.0f %% of the count shows; what is left out varies by %.4f, mean %.5f\n",
               glint_model_name(c->model), n, 100.0 * fabs(shown), deviation, off.mean);
        if (!(deviation <= most))
            fail_msg("it varies by %g, expected at most %g", deviation, most);
        if (!(fabs(off.mean) < 4.5 * moments_standard_error(&off) + c->bias + 1e-6))
            fail_msg("its mean is %g, %g sigmas from 0", off.mean, off.mean / moments_standard_error(&off));
        /* No seam: a quarter more facets never take more than a third of the count away. */
        assert_true(shown <= before + 1e-4 && shown >= before - 0.34 * log(c->step) / log(1.25));
        before = shown;
    }
    assert_true(fabs(before) < 1e-4);
    glint_material_destroy(all);
    glint_material_destroy(less);
}

/* Counting varies by half of 1 / (N p) in a footprint by itself; explicit by all of it, and knows all of the light, of
 * which the smooth value takes the middle: a cap of .02 sr turns half vectors by up to .04, and GGX falls by
 * (.04 / alpha)^2 in the mean over a disc around its top. */
static void what_fades_never_varies_by_more_than_its_limit(void **state)
{
    (void)state;
    static const fading cases[] = {
        { GLINT_MODEL_COUNTING, SEEDS, 100.0, 3e4, 1.25, 0.5, 0.0 },
        { GLINT_MODEL_DICTIONARY, 1000, 300.0, 1e5, 1.25, 1.0, 0.0 },
        { GLINT_MODEL_EXPLICIT, 300, 500.0, 15000.0, 1.5, 1.0, 0.0255 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        fade_out(&cases[i]);
}

/* The explicit model visits no facet where none shows, however many there are. */
static void facets_that_do_not_show_are_not_visited(void **state)
{
    (void)state;
    glint_material *all = material_with(GLINT_MODEL_EXPLICIT, 0.0F, 0.0F),
                   *less = material_with(GLINT_MODEL_EXPLICIT, 0.1F, 0.0F);
    glint_value a, b;
    evaluate(all, 1e8, 0, 0U, &a);
    evaluate(less, 1e8, 0, 0U, &b);
    assert_true(a.over_limit && !b.over_limit);
    assert_true(b.rgb[0] == b.smooth[0] && b.smooth[0] == a.smooth[0]);
    glint_material_destroy(all);
    glint_material_destroy(less);
}

/* Draws of single realisations have the mean of the whole value, and no more noise than was allowed. */
static void draws_vary_by_no_more_than_they_may(void **state)
{
    (void)state;
    const float limit = 1.0F;
    glint_material *all = material_with(GLINT_MODEL_COUNTING, 0.0F, 0.0F),
                   *drawn = material_with(GLINT_MODEL_COUNTING, 0.0F, limit);
    uint64_t random = 9;
    int differ = 0;
    for (double n = 10.0; n < 3e4; n *= 2.0) {
        moments off = { 0 };
        for (int i = 0; i < SEEDS; i++) {
            glint_value a, b;
            evaluate(all, n, i, 0U, &a);
            evaluate(drawn, n, i, (uint32_t)random_bits(&random), &b);
            moments_add(&off, ((double)b.rgb[0] - (double)a.rgb[0]) / (double)a.smooth[0]);
        }
        const double deviation = sqrt(moments_variance(&off));
        printf("N %8.0f: draws vary by %.4f\n", n, deviation);
        differ += deviation > 0.0;
        assert_true(deviation <= (double)limit * 1.05);
        assert_true(fabs(off.mean) < 4.5 * moments_standard_error(&off) + 1e-6);
    }
    assert_true(differ > 5);
    glint_material_destroy(all);
    glint_material_destroy(drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fades_never_varies_by_more_than_its_limit),
        cmocka_unit_test(facets_that_do_not_show_are_not_visited),
        cmocka_unit_test(draws_vary_by_no_more_than_they_may),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
