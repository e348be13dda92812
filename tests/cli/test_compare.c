/* glint compare as it is run: exit codes, the document, the report. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "run_glint.h"
#include "workplace.h"

/* counting.exr and again.exr with other sampling, smooth.exr, small.exr: a panel of sand under the sun. */
static int enter(void **state)
{
    const int result = workplace_enter(state);
    if (result != 0)
        return result;
    scene_write("plane");
    static const char *const renders[][6] = {
        { "counting.exr", "64x64", "counting", "0" },
        { "again.exr", "64x64", "counting", "1" },
        { "smooth.exr", "64x64", "smooth", "0" },
        { "small.exr", "32x64", "smooth", "0" },
    };
    for (size_t i = 0; i < sizeof renders / sizeof renders[0]; ++i) {
        outcome o = glint_run(NULL, "render", "plane.gltf", "-o", renders[i][0], "--size", renders[i][1], "--model",
                              renders[i][2], "--seed", renders[i][3], "--material", "panel=craft-glitter", "--spp", "4",
                              "--camera", "Close");
        assert_exit(&o, 0);
        outcome_free(&o);
    }
    return 0;
}

static void picture_agrees_with_itself(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "compare", "counting.exr", "counting.exr");
    assert_exit(&o, 0);
    assert_says(o.out, "agrees with");
    assert_says(o.out, "the same facets");
    assert_true(o.err[0] == '\0');
    outcome_free(&o);
}

static void picture_without_glints_does_not_agree(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "compare", "counting.exr", "smooth.exr", "--json", "-o", "report.html");
    assert_exit(&o, 1);
    json_t *d = json_loads(o.out, JSON_REJECT_DUPLICATES, NULL);
    assert_true(json_is_object(d));
    assert_string_equal(json_string_value(json_object_get(d, "verdict")), "fail");
    assert_string_equal(json_string_value(json_object_get(d, "a")), "counting.exr");
    static const char *const keys[] = { "size",       "checks",    "same_facets", "pixels",
                                        "background", "mean",      "correlation", "largest_difference",
                                        "blocks",     "quantiles", "sparks",      "histogram",
                                        "spectrum" };
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i)
        assert_non_null(json_object_get(d, keys[i]));
    json_decref(d);
    outcome_free(&o);
    size_t size;
    char *page = file_read("report.html", &size);
    assert_says(page, "<!DOCTYPE html>");
    assert_says(page, "counting.exr");
    free(page);
}

static void tolerances_decide(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "compare", "counting.exr", "smooth.exr", "--mean-tolerance", "1e6",
                          "--variance-tolerance", "1e6");
    assert_exit(&o, 0);
    outcome_free(&o);
}

static void unusable_pictures_are_named(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "compare", "counting.exr", "small.exr"), 1,
                   "small.exr has 32 x 64 pixels, expected the 64 x 64 of counting.exr");
    assert_refused(glint_run(NULL, "compare", "missing.exr", "small.exr"), 1, "missing.exr");
    file_write_text("text.exr", "not a picture");
    assert_refused(glint_run(NULL, "compare", "counting.exr", "text.exr"), 1, "text.exr");
    assert_refused(glint_run(NULL, "compare", "counting.exr"), 2, "A B");
    assert_refused(glint_run(NULL, "compare", "a", "b", "--mean-tolerance", "much"), 2, "--mean-tolerance");
}

/* Whether the report can be written is tried before the pictures are read, and a failure leaves the old one. */
static void report_that_cannot_be_written_is_an_error(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "compare", "counting.exr", "again.exr", "-o", "no/report.html"), 1,
                   "no/report.html");
    file_write_text("report.html", "old");
    outcome o = glint_run(NULL, "compare", "counting.exr", "small.exr", "-o", "report.html");
    assert_exit(&o, 1);
    assert_file_holds("report.html", "old");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_agrees_with_itself),
        cmocka_unit_test(picture_without_glints_does_not_agree),
        cmocka_unit_test(tolerances_decide),
        cmocka_unit_test(unusable_pictures_are_named),
        cmocka_unit_test(report_that_cannot_be_written_is_an_error),
    };
    return cmocka_run_group_tests(tests, enter, workplace_leave);
}
