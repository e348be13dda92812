/* glint study leaves tables, figures and a page that shows them, and says what did not hold. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "run_glint.h"
#include "workplace.h"

static bool is_there(const char *folder, const char *name, const char *ending)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s%s", folder, name, ending);
    return access(path, R_OK) == 0;
}

/* Runs the quick study of lights with --json; the caller frees the document. */
static json_t *study_lights(const char *folder)
{
    outcome o = glint_run(NULL, "study", "--lights", "--quick", "--json", "-o", folder);
    assert_exit(&o, 0);
    json_t *const said = json_loads(o.out, 0, NULL);
    assert_non_null(said);
    outcome_free(&o);
    return said;
}

static void tables_figures_and_the_page_are_there(void **state)
{
    (void)state;
    json_t *const said = study_lights("out");
    assert_true(json_is_true(json_object_get(said, "holds")));
    assert_int_equal(json_array_size(json_object_get(said, "studies")), 1);
    const json_t *const study = json_array_get(json_object_get(said, "studies"), 0);
    assert_string_equal(json_string_value(json_object_get(study, "name")), "lights");
    assert_true(json_array_size(json_object_get(study, "checks")) > 0);
    size_t size, i;
    char *const page = file_read("out/report.html", &size);
    const json_t *name;
    json_array_foreach(json_object_get(study, "tables"), i, name)
    {
        assert_true(is_there("out", json_string_value(name), ""));
        assert_says(page, json_string_value(name));
    }
    json_array_foreach(json_object_get(study, "figures"), i, name)
    {
        assert_true(is_there("out", json_string_value(name), ".svg"));
        assert_true(is_there("out", json_string_value(name), ".png"));
        assert_says(page, json_string_value(name));
    }
    /* Nothing else: no part of a file. */
    const size_t tables = json_array_size(json_object_get(study, "tables")),
                 figures = json_array_size(json_object_get(study, "figures"));
    assert_true(tables > 0 && figures > 0);
    assert_int_equal(folder_count("out"), tables + 2 * figures + 1);
    free(page);
    json_decref(said);
}

static void the_same_study_gives_the_same_tables(void **state)
{
    (void)state;
    json_t *const first = study_lights("one"), *const second = study_lights("two");
    size_t i;
    const json_t *name;
    json_array_foreach(json_object_get(json_array_get(json_object_get(first, "studies"), 0), "tables"), i, name)
    {
        char a[512], b[512];
        snprintf(a, sizeof a, "one/%s", json_string_value(name));
        snprintf(b, sizeof b, "two/%s", json_string_value(name));
        assert_same_files(a, b);
    }
    json_decref(first);
    json_decref(second);
}

static void without_gnuplot_there_are_tables(void **state)
{
    (void)state;
    const char *const search = getenv("PATH");
    char *const path = strdup(search ? search : "");
    assert_non_null(path);
    assert_int_equal(setenv("PATH", "/nowhere", 1), 0);
    outcome o = glint_run(NULL, "study", "--lights", "--quick", "-o", "out");
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(path);
    assert_exit(&o, 0);
    assert_says(o.err, "gnuplot was not found");
    outcome_free(&o);
    assert_true(is_there("out", "lights_error", ".csv"));
    assert_false(is_there("out", "lights_error", ".svg"));
    assert_true(is_there("out", "report", ".html"));
}

/* A limit that the tables keep and a figure of some 30 kB does not. */
static void disk_that_fills_up_leaves_no_half_a_figure(void **state)
{
    (void)state;
    const run_setup small_disk = { .file_size_limit = 8192 };
    outcome o = glint_run(&small_disk, "study", "--memory", "--quick", "-o", "out");
    assert_exit(&o, 1);
    assert_says(o.err, "out/memory.png: gnuplot could not write all of it");
    outcome_free(&o);
    assert_true(is_there("out", "memory_maps", ".csv"));
    assert_false(is_there("out", "memory", ".png") || is_there("out", "memory", ".png.part"));
}

static void wrong_usage_and_a_file_for_a_folder_are_refused(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "study", "--light"), 2, "did you mean '--lights'");
    assert_refused(glint_run(NULL, "study", "lights"), 2, "'lights'");
    file_write_text("taken", "a file");
    assert_refused(glint_run(NULL, "study", "--lights", "--quick", "-o", "taken"), 1, "taken cannot be a folder");
    assert_file_holds("taken", "a file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(tables_figures_and_the_page_are_there, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(the_same_study_gives_the_same_tables, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(without_gnuplot_there_are_tables, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(disk_that_fills_up_leaves_no_half_a_figure, workplace_enter, workplace_leave),
        cmocka_unit_test_setup_teardown(wrong_usage_and_a_file_for_a_folder_are_refused, workplace_enter,
                                        workplace_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
