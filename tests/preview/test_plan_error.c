/* What is left out of pictures stays within their error budget and is what the plan has foreseen. The long form is
 * tests/study/plan.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "plan_cases.h"
#include "planned_pictures.h"
#include "scenes.h"

/* The error is at most so many times what the plan foresees: .97 was measured here, 1.2 over the whole study. */
#define FORESEEN 1.5

/* The same samples, all and less: what is left out is within the budget, whatever the noise. */
static void what_is_left_out_stays_within_the_budget(void **state)
{
    (void)state;
    static const double budgets[] = { 0.02, 0.2 };
    static const int samples[] = { 4, 64 };
    float caps = 0.0F;
    for (int i = 0; i < plan_case_count(); ++i) {
        scene_camera camera;
        preview_options o;
        scene s = plan_case(i, &camera, &o);
        for (int k = 0; k < 2; ++k) {
            image all = planned_render(&s, o, 0.0, samples[k]);
            for (int j = 0; j < 2; ++j) {
                image less = planned_render(&s, o, budgets[j], samples[k]);
                const double error = plan_case_error(&less, &all);
                printf("%-16s %2d spp, budget %.2f: error %.4f, foreseen %.4f, noise %.4f%s\n", plan_case_name(i),
                       samples[k], budgets[j], error, (double)foreseen.error, (double)foreseen.noise,
                       foreseen.is_met ? "" : " (not met)");
                if (!(error <= budgets[j]))
                    fail_msg("%s: error %g, expected at most %g", plan_case_name(i), error, budgets[j]);
                /* What was foreseen comes from a few hundred pixels: seldom too little, and then not by much. */
                if (!(error <= FORESEEN * (double)foreseen.error + 1e-3))
                    fail_msg("%s: error %g, foreseen %g", plan_case_name(i), error, (double)foreseen.error);
                /* A lamp of .06 m at .55 m is off by no more than .02 as a cap: for the larger budget, and for no
                 * smaller part with it, its middle stands for it. */
                if (strcmp(plan_case_name(i), "lamp") == 0) {
                    assert_true(j == 0 || (foreseen.cap_error > 0.0F && foreseen.cap_error >= caps));
                    caps = foreseen.cap_error;
                }
                image_free(&less);
            }
            image_free(&all);
        }
        scene_free(&s);
    }
    assert_true(caps > 0.0F);
}

/* Flakes whose distribution is at e^-50 of its peak where they would show the sun, below a coat that shows it: their
 * light is nothing, and what the coat and they reflect together must not be taken for that of the few that are lit. */
static void light_of_a_coat_is_no_spark_of_the_flakes_below(void **state)
{
    (void)state;
    scene s = scenes_empty();
    scene_material m = scenes_flakes(0.2F, 3200.0F);
    m.glint.distribution = GLINT_DISTRIBUTION_BECKMANN;
    m.clearcoat = 1.0F;
    m.clearcoat_roughness = 0.7F;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 5.0F), NULL, 0);
    const float from[3] = { 1.0F, 1.0F, 0.0F };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F)->angular_diameter_rad = 0.4F;
    const scene_camera above = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&above);
    image all = planned_render(&s, o, 0.0, 4), less = planned_render(&s, o, 0.02, 4);
    printf("error %.3g, over the mean %.3g\n", (double)foreseen.error, (double)foreseen.error_of_mean);
    assert_true(pictures_mean(&all, "R") > 0.0);
    assert_true(plan_case_error(&less, &all) <= 0.02 && foreseen.error <= 0.02F);
    /* A fit takes the place of the sun's shape; and without sparks the mean square is the square of the mean. */
    assert_true(foreseen.error > 0.0F && foreseen.error_of_mean <= 1.01F * foreseen.error);
    image_free(&all);
    image_free(&less);
    scene_free(&s);
}

/* ---- no budget ---- */

/* Without a budget lights with a shape get the integral that the smallest budget gets, and not the fit. */
static void no_budget_is_the_limit_of_small_ones(void **state)
{
    (void)state;
    for (int i = 0; i < plan_case_count(); ++i) {
        scene_camera camera;
        preview_options o;
        scene s = plan_case(i, &camera, &o);
        image none = planned_render(&s, o, 0.0, 4), least = planned_render(&s, o, 1e-6, 4);
        const double error = plan_case_error(&least, &none);
        if (!(error <= 1e-6))
            fail_msg("%s: a budget of 1e-6 is %g from none", plan_case_name(i), error);
        o.area_lights = GLINT_AREA_LIGHT_FAST;
        image fit = planned_render(&s, o, 0.0, 4);
        if (strcmp(plan_case_name(i), "window") == 0)
            assert_true(plan_case_error(&fit, &none) > 1e-5);
        image_free(&fit);
        image_free(&least);
        image_free(&none);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_a_coat_is_no_spark_of_the_flakes_below),
        cmocka_unit_test(what_is_left_out_stays_within_the_budget),
        cmocka_unit_test(no_budget_is_the_limit_of_small_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
