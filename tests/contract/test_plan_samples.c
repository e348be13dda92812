/* How many samples the plan takes: the fewest that meet the budget, or more where that lets the rest be cheaper. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "small_plan.h"
#include "statistics.h"

/* Noise of .3 a sample, independent: with N samples .09 / N, of a budget of .0004. Facets that show or that fade cost
 * and leave nothing, so the fewest powers of two do: 225 samples make 256. */
static void fewest_samples_are_taken_whose_noise_is_within_the_budget(void **state)
{
    (void)state;
    small_scene s;
    small_plan_fill(&s, 10.0F, 16);
    s.summary.most_samples = 4096;
    s.summary.noise = 0.3F;
    glint_plan *plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 256);
    assert_true(glint_plan_result(plan).is_met);
    assert_string_equal(small_plan_find(plan, GLINT_EFFECT_SAMPLES)->choice, "256");
    glint_plan_destroy(plan);

    /* Known of 16 samples, .05, and falling as samples^-1.5: (.05 / .02)^(2 / 1.5) = 3.4 times as many. */
    s.summary.noise = 0.05F;
    s.summary.noise_samples = 16;
    s.summary.noise_fall = 1.5F;
    plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 64);
    glint_plan_destroy(plan);
    /* A faster fall is not believed of more samples than were looked at, and an uncertain one is kept clear of. */
    s.summary.noise_fall = 3.0F;
    plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 64);
    glint_plan_destroy(plan);
    s.summary.noise_spread = 0.5F;
    plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 128);
    glint_plan_destroy(plan);

    /* No number is enough: the most, and it is said. */
    s.summary.most_samples = 32;
    plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 32);
    assert_false(glint_plan_result(plan).is_met);
    assert_true(glint_plan_result(plan).enough_samples > 32);
    glint_plan_destroy(plan);

    /* Nothing varies: the fewest. */
    s.summary.most_samples = 4096;
    s.summary.noise = 0.0F;
    plan = small_plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 16);
    glint_plan_destroy(plan);
}

/* What noise leaves of the budget may be left out: with any other number of samples whose noise fits, a plan for what
 * it leaves is no cheaper. */
static void cheapest_number_of_samples_is_taken(void **state)
{
    (void)state;
    uint64_t random = 11;
    for (int k = 0; k < 2000; k++) {
        small_scene s;
        small_plan_fill(&s, (float)random_log_between(&random, 1.0, 1e6), 16);
        s.summary.error_budget = (float)random_log_between(&random, 0.01, 0.3);
        s.summary.noise = (float)random_log_between(&random, 0.01, 1.0);
        s.light.kind = (glint_plan_light_kind)(random_bits(&random) % 3);
        s.summary.most_samples = 4096;
        glint_plan *plan = small_plan_of(&s);
        const glint_plan_outcome chosen = glint_plan_result(plan);
        glint_plan_destroy(plan);
        const double budget = (double)s.summary.error_budget, one = (double)s.summary.noise;
        s.summary.most_samples = 0;
        s.summary.noise = 0.0F;
        for (uint32_t n = 16; n <= 4096; n *= 2) {
            if (!(one * one / n < budget * budget))
                continue;
            assert_true(chosen.is_met);
            s.summary.samples_per_pixel = n;
            s.summary.error_budget = (float)sqrt(budget * budget - one * one / n);
            plan = small_plan_of(&s);
            const double cost = (double)glint_plan_result(plan).ns_per_sample * n;
            glint_plan_destroy(plan);
            if (!((double)chosen.ns_per_sample * chosen.samples <= cost * 1.001))
                fail_msg("%u samples at %g ns, but %u at %g", chosen.samples, (double)chosen.ns_per_sample, n,
                         cost / n);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fewest_samples_are_taken_whose_noise_is_within_the_budget),
        cmocka_unit_test(cheapest_number_of_samples_is_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
