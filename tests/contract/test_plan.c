/* The plan: decisions follow from the summary's numbers, and errors add up to no more than the budget. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "small_plan.h"
#include "statistics.h"

static void bins_are_powers_of_two(void **state)
{
    (void)state;
    for (int k = -16; k < 32; k++) {
        assert_int_equal(glint_plan_bin((float)ldexp(1.0, k)), k + 16);
        assert_int_equal(glint_plan_bin((float)ldexp(1.99, k)), k + 16);
    }
    assert_int_equal(glint_plan_bin(0.0F), 0);
    assert_int_equal(glint_plan_bin(-1.0F), 0);
    assert_int_equal(glint_plan_bin((float)NAN), 0);
    assert_int_equal(glint_plan_bin(1e30F), GLINT_PLAN_BINS - 1);
}

/* 1.1 / (N p) of variance against a budget of 0.02: 2750 facets. */
static void few_facets_are_counted_and_many_are_smooth(void **state)
{
    (void)state;
    small_scene s;
    small_plan_fill(&s, 10.0F, 16);
    glint_plan *few = small_plan_of(&s);
    assert_string_equal(small_plan_find(few, GLINT_EFFECT_FACETS)->choice, "counted");
    assert_true(small_plan_find(few, GLINT_EFFECT_FACETS)->ns_per_sample > 0.0F);
    glint_material_options cut = s.options;
    glint_plan_cut(few, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_COUNTING);
    /* Of a tile, of which 16 make a pixel: at most four times the budget. */
    assert_true(cut.smooth_deviation > 0.06F && cut.smooth_deviation <= 0.08F);
    glint_plan_destroy(few);

    small_plan_fill(&s, 1e4F, 16);
    glint_plan *many = small_plan_of(&s);
    assert_string_equal(small_plan_find(many, GLINT_EFFECT_FACETS)->choice, "smooth");
    assert_false(small_plan_find(many, GLINT_EFFECT_FACETS)->is_on);
    assert_true(small_plan_find(many, GLINT_EFFECT_FACETS)->ns_per_sample == 0.0F);
    assert_non_null(strstr(small_plan_find(many, GLINT_EFFECT_FACETS)->reason, "the lamp"));
    cut = s.options;
    glint_plan_cut(many, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_SMOOTH);
    glint_plan_destroy(many);
}

/* A draw adds 9 / (N p) of a tile to a sample: with 1024 samples and 16 tiles 9 16 / (1024 N p) to a pixel, and the
 * facets themselves still show where 1.1 / (N p) is more than the budget. */
static void many_samples_allow_single_draws(void **state)
{
    (void)state;
    small_scene s;
    small_plan_fill(&s, 1500.0F, 1024);
    glint_plan *plan = small_plan_of(&s);
    assert_string_equal(small_plan_find(plan, GLINT_EFFECT_LOOKUPS)->choice, "one of 36");
    glint_material_options cut = s.options;
    glint_plan_cut(plan, 0, &cut);
    assert_true(cut.draw_deviation > 0.0F && cut.draw_deviation <= 0.02F * 32.0F);
    glint_plan_destroy(plan);

    small_plan_fill(&s, 1500.0F, 16);
    plan = small_plan_of(&s);
    assert_string_equal(small_plan_find(plan, GLINT_EFFECT_LOOKUPS)->choice, "all 36");
    glint_plan_destroy(plan);

    small_plan_fill(&s, 1500.0F, 1024);
    s.light.kind = GLINT_PLAN_LIGHT_SURROUNDINGS;
    plan = small_plan_of(&s);
    assert_string_equal(small_plan_find(plan, GLINT_EFFECT_LOOKUPS)->choice, "all 36");
    glint_plan_destroy(plan);
}

static void nothing_is_left_out_without_a_budget(void **state)
{
    (void)state;
    small_scene s;
    small_plan_fill(&s, 1e9F, 1024);
    s.summary.error_budget = 0.0F;
    s.summary.bounces = 2;
    s.light.blocked_rays = 0;
    glint_plan *plan = small_plan_of(&s);
    glint_material_options cut = s.options;
    glint_plan_cut(plan, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_COUNTING);
    assert_true(cut.smooth_deviation == 0.0F && cut.draw_deviation == 0.0F);
    assert_true(glint_plan_result(plan).error == 0.0F);
    assert_int_equal(glint_plan_result(plan).bounces, 2);
    assert_true(small_plan_find(plan, GLINT_EFFECT_SHADOWS)->is_on);
    glint_plan_destroy(plan);
}

/* Caps that are off by up to a half, of which the last are taken by some of the samples. */
static glint_plan_shape random_shape(uint64_t *random)
{
    glint_plan_shape s = { 1.0F / GLINT_PLAN_SHAPES, (float)random_between(random, 0.0, 0.2),
                           (float)random_log_between(random, 1e-9, 1e3) };
    const float share = (float)random_uniform(random);
    s.cap = s.part * (float)random_log_between(random, 1e-6, 0.25);
    s.last_cap = share * s.cap;
    s.last_sparks = share * s.sparks;
    return s;
}

/* Random summaries: the error of what is left out is within the budget, shares of time add up to one. */
static void errors_stay_within_the_budget(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int k = 0; k < 20000; k++) {
        small_scene s;
        small_plan_fill(&s, (float)random_log_between(&random, 1e-4, 1e9),
                        (uint32_t)random_log_between(&random, 1.0, 4096.0));
        s.summary.tiles_per_pixel = s.summary.samples_per_pixel < 16 ? 1 : 16;
        s.summary.error_budget = (float)random_log_between(&random, 1e-4, 1.0);
        s.summary.bounces = (uint32_t)random_between(&random, 0.0, 3.0);
        s.summary.bounced = (float)random_log_between(&random, 1e-6, 1.0);
        s.summary.noise = (float)random_log_between(&random, 1e-3, 10.0);
        s.light.kind = (glint_plan_light_kind)(random_bits(&random) % 3);
        for (int i = 0; i < GLINT_PLAN_SHAPES; i++)
            s.pair.shapes[i] = random_shape(&random);
        s.summary.contrast = (float)random_log_between(&random, 1.0, 1e4);
        s.light.blocked_rays = random_bits(&random) % 2 ? 0U : 7U;
        s.light.shadow_rays = (uint32_t)random_log_between(&random, 7.0, 1e6);
        s.options.color_variation = random_bits(&random) % 2 ? 0.0F : 0.9F;
        glint_plan *plan = small_plan_of(&s);
        const glint_plan_outcome out = glint_plan_result(plan);
        double time = 0.0, variance = 0.0;
        for (uint32_t i = 0; i < glint_plan_decision_count(plan); i++) {
            const glint_decision *d = glint_plan_decision(plan, i);
            time += (double)d->time_share;
            variance += (double)d->error * (double)d->error;
            assert_true(d->choice[0] != '\0' && d->reason[0] != '\0');
            assert_true(d->is_on || d->ns_per_sample == 0.0F);
        }
        assert_true(fabs(time - 1.0) < 1e-4);
        assert_true(fabs(sqrt(variance) - (double)out.error) < 1e-5);
        if (!((double)out.error <= (double)s.summary.error_budget * (1.0 + 1e-6)))
            fail_msg("error %g, budget %g", (double)out.error, (double)s.summary.error_budget);
        assert_true(out.error_of_mean >= out.error * (1.0F - 1e-5F));
        /* Root sum of squares, and not met where it is too much. */
        const double both = hypot((double)out.error, (double)out.noise), budget = (double)s.summary.error_budget;
        assert_true(fabs(both - budget) < 1e-5 * budget || out.is_met == (both <= budget));
        glint_plan_destroy(plan);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_are_powers_of_two),          cmocka_unit_test(few_facets_are_counted_and_many_are_smooth),
        cmocka_unit_test(many_samples_allow_single_draws), cmocka_unit_test(nothing_is_left_out_without_a_budget),
        cmocka_unit_test(errors_stay_within_the_budget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
