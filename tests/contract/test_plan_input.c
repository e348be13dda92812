/* A summary that cannot be is refused by name, and so is a plan without memory. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "small_plan.h"

static void impossible_summaries_are_refused_by_name(void **state)
{
    (void)state;
    small_scene s;
    glint_plan *plan;
    char message[256];
    small_plan_fill(&s, 1.0F, 16);
    s.summary.error_budget = (float)NAN;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_null(plan);
    assert_non_null(strstr(message, "error_budget"));
    small_plan_fill(&s, 1.0F, 16);
    s.pair.light = 1;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_string_equal(message, "pairs[0].light is 1, expected less than 1");
    small_plan_fill(&s, 1.0F, 16);
    s.summary.size = 4;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_non_null(strstr(message, "GLINT_PLAN_SUMMARY_INIT"));
    small_plan_fill(&s, 1.0F, 16);
    s.summary.most_samples = 8;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_non_null(strstr(message, "most_samples is 8"));
    small_plan_fill(&s, 1.0F, 16);
    s.summary.noise_fall = 0.5F;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_non_null(strstr(message, "noise_fall"));
    small_plan_fill(&s, 1.0F, 16);
    s.material.base = NULL;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_plan_create(NULL, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_plan_create(&s.summary, NULL, NULL, 0), GLINT_ERROR_ARGUMENT);
}

static void *refuse(size_t byte_count, void *user)
{
    (void)byte_count;
    (void)user;
    return NULL;
}

static void release(void *memory, void *user)
{
    (void)user;
    free(memory);
}

static void no_memory_is_said(void **state)
{
    (void)state;
    small_scene s;
    glint_plan *plan;
    char message[256];
    small_plan_fill(&s, 1.0F, 16);
    s.summary.allocator = (glint_allocator){ refuse, release, NULL };
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_MEMORY);
    assert_null(plan);
    glint_plan_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impossible_summaries_are_refused_by_name),
        cmocka_unit_test(no_memory_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
