/* glint plan and --accuracy: a table for people, the same as a document, the plan in the document of a render, and a
 * warning where a budget that was asked for is not met. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "printed_document.h"
#include "run_glint.h"
#include "workplace.h"

/* The keys that programs rely on, and shares of time that add up to one. */
static void assert_is_plan(const json_t *plan)
{
    const json_t *const list = json_object_get(plan, "decisions");
    double time = 0.0;
    assert_true(json_array_size(list) > 5);
    for (size_t i = 0; i < json_array_size(list); ++i) {
        const json_t *const d = json_array_get(list, i);
        time += json_number_value(json_object_get(d, "time_share"));
        assert_true(json_is_string(json_object_get(d, "effect")) && json_is_boolean(json_object_get(d, "on")));
        assert_true(strlen(json_string_value(json_object_get(d, "choice"))) > 0);
        assert_true(strlen(json_string_value(json_object_get(d, "reason"))) > 0);
        assert_true(json_is_number(json_object_get(d, "error")));
    }
    assert_true(fabs(time - 1.0) < 1e-4);
    assert_true(json_is_number(json_object_get(plan, "error")) && json_is_number(json_object_get(plan, "noise")));
    assert_true(json_is_boolean(json_object_get(plan, "met")));
    /* Rounded to so many digits. */
    assert_true(json_number_value(json_object_get(plan, "error_of_mean")) >=
                0.999 * json_number_value(json_object_get(plan, "error")));
    assert_true(json_is_number(json_object_get(plan, "error_of_mean")));
}

static void plan_is_a_table_and_a_document(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "plan", "plane.gltf", "--size", "32x32", "--material", "panel=sand");
    assert_exit(&o, 0);
    assert_says(o.out, "panel");
    assert_says(o.out, "facets");
    assert_says(o.out, "budget of 0.02");
    assert_says(o.out, "off everywhere: ");
    /* What the scene does not have has no row, but on demand. */
    assert_null(strstr(o.out, "it has no normal map"));
    outcome_free(&o);
    o = glint_run(NULL, "plan", "plane.gltf", "--size", "32x32", "--material", "panel=sand", "--all");
    assert_exit(&o, 0);
    assert_says(o.out, "it has no normal map");
    outcome_free(&o);
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--all"), 2, "unknown option '--all'");
    o = glint_run(NULL, "plan", "plane.gltf", "--size", "32x32", "--accuracy", "0.1", "--json");
    json_t *d = printed_document(&o);
    assert_true(json_number_value(json_object_get(d, "accuracy")) == 0.1);
    assert_is_plan(json_object_get(d, "plan"));
    json_decref(d);
    outcome_free(&o);
    assert_refused(glint_run(NULL, "plan", "plane.gltf", "-o", "a.exr"), 2, "unknown option '-o'");
    assert_refused(glint_run(NULL, "plan", "plane.gltf", "--accuracy", "2"), 2, "--accuracy '2'");
}

static void render_says_what_was_planned(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--size", "16x16", "--spp", "4", "--json");
    json_t *d = printed_document(&o);
    assert_true(json_number_value(json_object_get(d, "accuracy")) == 0.02);
    assert_is_plan(json_object_get(d, "plan"));
    json_decref(d);
    outcome_free(&o);
    o = glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--size", "16x16", "--spp", "4", "--accuracy", "0",
                  "--json");
    d = printed_document(&o);
    assert_null(json_object_get(d, "plan"));
    json_decref(d);
    outcome_free(&o);
}

/* Of the plane under a sky, of which each sample sees another part. */
static double chosen_samples(const char *accuracy, const char *option, const char *value)
{
    outcome o = glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--size", "32x32", "--light-set", "sun-and-sky",
                          "--accuracy", accuracy, "--json", option, value);
    json_t *d = printed_document(&o);
    const double spp = json_number_value(json_object_get(d, "spp"));
    const json_t *const plan = json_object_get(d, "plan");
    if (plan)
        assert_true(json_number_value(json_object_get(plan, "samples")) == spp);
    /* What is planned is what is spent. */
    assert_true(json_number_value(json_object_get(json_object_get(d, "rays"), "camera")) == 32.0 * 32.0 * spp);
    json_decref(d);
    outcome_free(&o);
    return spp;
}

/* Without --spp as many samples as the accuracy takes; with it those; without either, or without a budget, sixteen. */
static void accuracy_chooses_samples_that_nobody_asked_for(void **state)
{
    (void)state;
    const double rough = chosen_samples("0.2", "--seed", "1"), fine = chosen_samples("0.01", "--seed", "1");
    assert_true(rough >= 4.0 && fine > rough && fine <= 4096.0);
    assert_true(chosen_samples("0.02", "--spp", "8") == 8.0);
    assert_true(chosen_samples("0", "--seed", "1") == 16.0);
    outcome o = glint_run(NULL, "plan", "plane.gltf", "--size", "32x32", "--json");
    json_t *d = printed_document(&o);
    assert_true(json_number_value(json_object_get(d, "spp")) == 16.0);
    json_decref(d);
    outcome_free(&o);
    /* What cannot be met is said with the most samples that are taken by themselves. */
    o = glint_run(NULL, "plan", "plane.gltf", "--size", "32x32", "--light-set", "sun-and-sky", "--accuracy", "1e-5");
    assert_exit(&o, 0);
    assert_says(o.out, "4096 ");
    assert_says(o.out, "the most that is chosen");
    outcome_free(&o);
}

/* The edge of the plane alone leaves more noise than a millionth. */
static void budget_that_is_not_met_is_said_before_rendering(void **state)
{
    (void)state;
    outcome o =
        glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--size", "16x16", "--spp", "1", "--accuracy", "1e-6");
    assert_exit(&o, 0);
    assert_says(o.err, "warning: --accuracy 1e-06 is not met");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(plan_is_a_table_and_a_document, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(render_says_what_was_planned, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(accuracy_chooses_samples_that_nobody_asked_for, workplace_enter_plane,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(budget_that_is_not_met_is_said_before_rendering, workplace_enter_plane,
                                        workplace_leave),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
