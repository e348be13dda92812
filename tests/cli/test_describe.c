/* glint inspect and glint materials: lines for people, and the same as one JSON document. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "printed_document.h"
#include "run_glint.h"
#include "workplace.h"

static void inspect_names_what_is_in_the_file(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "inspect", "plane.gltf");
    assert_exit(&o, 0);
    assert_says(o.out, "panel");
    assert_says(o.out, "Close");
    assert_says(o.out, "night");
    outcome_free(&o);
    o = glint_run(NULL, "inspect", "--json", "plane.gltf");
    json_t *d = printed_document(&o);
    assert_true(json_is_object(d));
    assert_says(o.out, "panel");
    json_decref(d);
    outcome_free(&o);
}

/* The eight presets of the house, each with a title and a source for its numbers. */
static void materials_lists_every_preset(void **state)
{
    (void)state;
    static const char *const names[] = {
        "brushed-steel", "craft-glitter", "frosted-plastic", "gold-leaf", "metallic-car-paint", "nail-polish",
        "sand",          "snow"
    };
    outcome lines = glint_run(NULL, "materials"), json = glint_run(NULL, "materials", "--json");
    assert_exit(&lines, 0);
    json_t *all = printed_document(&json);
    assert_true(json_array_size(all) >= sizeof names / sizeof names[0]);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        assert_says(lines.out, names[i]);
        bool found = false;
        for (size_t k = 0; k < json_array_size(all); ++k)
            found = found || strcmp(json_string_value(json_object_get(json_array_get(all, k), "name")), names[i]) == 0;
        assert_true(found);
    }
    for (size_t k = 0; k < json_array_size(all); ++k) {
        assert_true(json_string_length(json_object_get(json_array_get(all, k), "title")) > 0);
        assert_true(json_string_length(json_object_get(json_array_get(all, k), "note")) > 0);
    }
    json_decref(all);
    outcome_free(&lines);
    outcome_free(&json);
}

/* 1e8 facets per m^2 are 1e4 per cm^2, one every 0.1 mm; roughness .5 is alpha .25. */
static void material_is_shown_in_words_and_units(void **state)
{
    (void)state;
    file_write_text("mine.json", "{ \"pbrMetallicRoughness\": { \"roughnessFactor\": 0.5 }, \"extensions\": {"
                                 " \"GLINT_materials_glint\": { \"glintFactor\": 1, \"glintDensity\": 1e8 } } }");
    outcome o = glint_run(NULL, "materials", "mine.json");
    assert_exit(&o, 0);
    assert_says(o.out, "1e+08 (1e+04 per cm^2, one every 0.1 mm)");
    assert_says(o.out, "0.5 (alpha 0.25)");
    outcome_free(&o);
    o = glint_run(NULL, "materials", "mine.json", "--json");
    json_t *d = printed_document(&o);
    assert_true(json_number_value(json_object_get(d, "glint_density_per_m2")) == 1e8);
    assert_true(json_number_value(json_object_get(d, "roughness")) == 0.5);
    json_decref(d);
    outcome_free(&o);
}

static void glints_of_both_layers_are_shown(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "materials", "two-layer-car-paint");
    outcome json = glint_run(NULL, "materials", "two-layer-car-paint", "--json");
    assert_exit(&o, 0);
    assert_says(o.out, "in the clear coat as well:");
    assert_says(o.out, "7e+08");
    assert_says(o.out, "1.4e+06");
    json_t *d = printed_document(&json);
    assert_true(json_number_value(json_object_get(d, "glint_density_per_m2")) == 7e8);
    assert_true(json_number_value(json_object_get(json_object_get(d, "coat"), "glint_density_per_m2")) == 1.4e6);
    json_decref(d);
    outcome_free(&o);
    outcome_free(&json);
}

static void preset_is_shown_with_its_title_and_source(void **state)
{
    (void)state;
    outcome list = glint_run(NULL, "materials", "--json"), o = glint_run(NULL, "materials", "snow");
    outcome json = glint_run(NULL, "materials", "snow", "--json");
    json_t *all = printed_document(&list), *d = printed_document(&json);
    assert_exit(&o, 0);
    assert_says(o.out, json_string_value(json_object_get(d, "title")));
    for (size_t k = 0; k < json_array_size(all); ++k)
        if (strcmp(json_string_value(json_object_get(json_array_get(all, k), "name")), "snow") == 0)
            assert_string_equal(json_string_value(json_object_get(json_array_get(all, k), "note")),
                                json_string_value(json_object_get(d, "note")));
    json_decref(all);
    json_decref(d);
    outcome_free(&list);
    outcome_free(&o);
    outcome_free(&json);
}

static void unknown_preset_lists_the_near_names(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "materials", "gold-laef"), 1, "gold-leaf");
    outcome o = glint_run(NULL, "materials", "gold-laef", "--json");
    assert_exit(&o, 1);
    json_t *d = json_loads(o.out, 0, NULL);
    assert_says(json_string_value(json_object_get(d, "error")), "gold-leaf");
    json_decref(d);
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(inspect_names_what_is_in_the_file, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(materials_lists_every_preset, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(material_is_shown_in_words_and_units, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(glints_of_both_layers_are_shown, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(preset_is_shown_with_its_title_and_source, workplace_enter_plane,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(unknown_preset_lists_the_near_names, workplace_enter_plane, workplace_leave),
    };
    return cmocka_run_group_tests_name("describe", tests, NULL, NULL);
}
