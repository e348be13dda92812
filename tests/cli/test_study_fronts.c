/* Every study in its quick form: its bounds hold, and the fronts have the order that docs/accuracy.md claims. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "run_glint.h"
#include "workplace.h"

static json_t *said;

static const json_t *study_named(const char *name)
{
    size_t i;
    const json_t *study;
    json_array_foreach(json_object_get(said, "studies"), i, study)
    {
        if (strcmp(json_string_value(json_object_get(study, "name")), name) == 0)
            return study;
    }
    fail_msg("there is no study %s", name);
    return NULL;
}

/* A setting of the dial with this table. */
static const json_t *setting(const char *study, const char *table, const char *name)
{
    size_t i, k;
    const json_t *front, *s;
    json_array_foreach(json_object_get(study_named(study), "fronts"), i, front)
    {
        if (strcmp(json_string_value(json_object_get(front, "table")), table) != 0)
            continue;
        json_array_foreach(json_object_get(front, "settings"), k, s)
        {
            if (strcmp(json_string_value(json_object_get(s, "name")), name) == 0)
                return s;
        }
    }
    fail_msg("%s has no setting %s in %s", study, name, table);
    return NULL;
}

static double number_of(const json_t *s, const char *member)
{
    return json_number_value(json_object_get(s, member));
}

/* The first costs less and is nearer. */
static void assert_beats(const char *study, const char *table, const char *better, const char *worse)
{
    const json_t *const a = setting(study, table, better), *const b = setting(study, table, worse);
    if (number_of(a, "cost") >= number_of(b, "cost") || number_of(a, "error") >= number_of(b, "error"))
        fail_msg("%s: %s costs %g with error %g, %s costs %g with error %g", study, better, number_of(a, "cost"),
                 number_of(a, "error"), worse, number_of(b, "cost"), number_of(b, "error"));
}

static void assert_on_front(const char *study, const char *table, const char *name)
{
    if (!json_is_true(json_object_get(setting(study, table, name), "on_front")))
        fail_msg("%s: %s is not on the front", study, name);
}

static int run_all(void **state)
{
    if (workplace_enter(state) != 0)
        return -1;
    outcome o = glint_run(NULL, "study", "--quick", "--json", "-o", "out");
    said = json_loads(o.out, 0, NULL);
    outcome_free(&o);
    return said ? 0 : -1;
}

static int forget(void **state)
{
    json_decref(said);
    return workplace_leave(state);
}

static void every_bound_holds(void **state)
{
    (void)state;
    size_t i, k;
    const json_t *study, *check;
    json_array_foreach(json_object_get(said, "studies"), i, study)
    {
        json_array_foreach(json_object_get(study, "checks"), k, check)
        {
            if (!json_is_true(json_object_get(check, "holds")))
                fail_msg("%s: %s", json_string_value(json_object_get(study, "name")),
                         json_string_value(json_object_get(check, "text")));
        }
    }
    assert_int_equal(i, 8);
}

static void fronts_have_the_order_that_the_page_claims(void **state)
{
    (void)state;
    static const char *const published[] = { "gated Gaussian as printed", "gated Gaussian cut at 0 (DB23)",
                                             "cut to [1; N] (KK24)" };
    for (int k = 0; k < 3; k++)
        assert_beats("law", "law_front.csv", "libglint (walking to 5)", published[k]);
    assert_beats("law", "law_front.csv", "libglint (walking to 5)", "exact (BTPE)");
    assert_beats("integrals", "integrals_worst_front.csv", "fast (LTC)", "64 random");
    assert_on_front("integrals", "integrals_worst_front.csv", "fast (LTC)");
    assert_on_front("integrals", "integrals_worst_front.csv", "exact");
    assert_beats("look-ups", "look_ups_front.csv", "all 36; 64 samples", "one drawn by its weight; 256 samples");
    assert_beats("models", "models_front.csv", "counting", "dictionary");
    assert_on_front("models", "models_front.csv", "smooth");
    assert_on_front("models", "models_front.csv", "counting");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bound_holds),
        cmocka_unit_test(fronts_have_the_order_that_the_page_claims),
    };
    return cmocka_run_group_tests(tests, run_all, forget);
}
