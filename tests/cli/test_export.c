/* glint export gltf and glint validate as a user runs them: exit codes, what goes where, no file after a failure. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "run_glint.h"
#include "workplace.h"

static json_t *parsed(const outcome *o)
{
    json_error_t error;
    json_t *document = json_loads(o->out, JSON_REJECT_DUPLICATES, &error);
    if (!document)
        fail_msg("standard output is not one JSON document: %s", error.text);
    return document;
}

static void assert_file_says(const char *path, const char *wanted)
{
    size_t size;
    char *text = file_read(path, &size);
    assert_says(text, wanted);
    free(text);
}

static void export_writes_a_file_and_says_nothing(void **state)
{
    (void)state;
    scene_write("plane");
    outcome o = glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "out.gltf", "--material", "panel=snow");
    assert_exit(&o, 0);
    assert_string_equal(o.out, "");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    assert_file_says("out.gltf", "GLINT_materials_glint");
    o = glint_run(NULL, "export", "gltf", "out.gltf", "-o", "out.gltf", "--strip");
    assert_exit(&o, 0);
    outcome_free(&o);
    assert_same_files("out.gltf", "plane.gltf");
}

static void a_dry_run_writes_nothing_and_tells_all(void **state)
{
    (void)state;
    scene_write("plane");
    const int before = folder_count(".");
    outcome o = glint_run(NULL, "export", "gltf", "plane.gltf", "--material", "panel=snow", "--set",
                          "/glintDensity=1e6", "--dry-run", "--json", "--bake-fallback");
    assert_exit(&o, 0);
    json_t *d = parsed(&o);
    assert_true(json_is_null(json_object_get(d, "output")));
    assert_true(json_is_true(json_object_get(d, "changed")));
    const json_t *material = json_array_get(json_object_get(d, "materials"), 0);
    assert_string_equal(json_string_value(json_object_get(material, "name")), "panel");
    assert_string_equal(json_string_value(json_object_get(material, "preset")), "snow");
    assert_int_equal(json_array_size(json_object_get(json_object_get(d, "fallback"), "materials")), 1);
    json_decref(d);
    outcome_free(&o);
    assert_int_equal(folder_count("."), before);
}

static void wrong_usage_ends_with_2_and_wrong_input_with_1(void **state)
{
    (void)state;
    scene_write("plane");
    assert_refused(glint_run(NULL, "export"), 2, "usage: glint export");
    assert_refused(glint_run(NULL, "export", "glft", "plane.gltf"), 2, "did you mean 'gltf'");
    assert_refused(glint_run(NULL, "export", "gltf", "plane.gltf"), 2, "-o OUT is missing");
    assert_refused(glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "x.glb"), 2, "end as the input does");
    assert_refused(glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "x.gltf", "--set", "/a"), 2, "POINTER=VALUE");
    assert_refused(glint_run(NULL, "export", "gltf", "none.gltf", "-o", "x.gltf"), 1, "none.gltf: cannot be opened");
    assert_refused(glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "x.gltf", "--material", "pane=snow"), 1,
                   "no material called \"pane\"; did you mean panel?");
    assert_refused(glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "/nonexistent/x.gltf"), 1,
                   "cannot be written");
    assert_int_equal(access("x.gltf", F_OK), -1);
    outcome o = glint_run(NULL, "export", "gltf", "none.gltf", "--dry-run", "--json");
    assert_exit(&o, 1);
    json_t *d = parsed(&o);
    assert_says(json_string_value(json_object_get(d, "error")), "none.gltf");
    json_decref(d);
    outcome_free(&o);
}

static void a_fallback_is_a_file_of_its_own_without_the_extension(void **state)
{
    (void)state;
    scene_write("plane");
    outcome o = glint_run(NULL, "export", "gltf", "plane.gltf", "-o", "out.gltf", "--material", "panel=snow",
                          "--bake-fallback");
    assert_exit(&o, 0);
    outcome_free(&o);
    assert_file_says("out.fallback.gltf", "\"normalTexture\"");
    o = glint_run(NULL, "inspect", "out.fallback.gltf", "--json");
    assert_exit(&o, 0);
    assert_null(strstr(o.out, "glint_density"));
    outcome_free(&o);
}

static void validate_counts_and_ends_with_1_when_any_file_is_wrong(void **state)
{
    (void)state;
    scene_write("plane");
    outcome o = glint_run(NULL, "validate", "plane.gltf");
    assert_exit(&o, 0);
    assert_string_equal(o.out, "1 file: 0 errors, 0 warnings, 0 infos\n");
    outcome_free(&o);
    file_write_text("bad.json", "{\"extensions\":{\"GLINT_materials_glint\":{\"glintFactor\":2}}}");
    o = glint_run(NULL, "validate", "plane.gltf", "bad.json", "none.glb");
    assert_exit(&o, 1);
    assert_says(o.out,
                "bad.json: error RANGE: /extensions/GLINT_materials_glint/glintFactor: found 2, expected a number "
                "from 0 to 1\n");
    assert_says(o.out, "none.glb: error FILE: ");
    assert_says(o.out, "3 files: 2 errors, 0 warnings, 0 infos\n");
    outcome_free(&o);
    o = glint_run(NULL, "validate", "bad.json", "plane.gltf", "--json");
    assert_exit(&o, 1);
    json_t *d = parsed(&o);
    assert_int_equal(json_integer_value(json_object_get(d, "errors")), 1);
    const json_t *file = json_array_get(json_object_get(d, "files"), 0);
    const json_t *issue = json_array_get(json_object_get(file, "issues"), 0);
    assert_string_equal(json_string_value(json_object_get(issue, "code")), "RANGE");
    assert_string_equal(json_string_value(json_object_get(issue, "pointer")),
                        "/extensions/GLINT_materials_glint/glintFactor");
    json_decref(d);
    outcome_free(&o);
    assert_refused(glint_run(NULL, "validate"), 2, "FILE... is missing");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, workplace_enter, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(export_writes_a_file_and_says_nothing),
        TEST(a_dry_run_writes_nothing_and_tells_all),
        TEST(wrong_usage_ends_with_2_and_wrong_input_with_1),
        TEST(a_fallback_is_a_file_of_its_own_without_the_extension),
        TEST(validate_counts_and_ends_with_1_when_any_file_is_wrong),
    };
    return cmocka_run_group_tests_name("command_export", tests, NULL, NULL);
}
