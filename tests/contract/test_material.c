/* Making a material: every bad option is named with its range, and a failed allocation leaves nothing behind. */
#include "configurations.h"

#include <stdlib.h>
#include <string.h>

static void bad_options_are_named_with_their_range(void **state)
{
    (void)state;
#define CASE(member, value, result, text)                                                                              \
    {                                                                                                                  \
        offsetof(glint_material_options, member), value, result, text                                                  \
    }
    static const struct {
        size_t offset;
        float value;
        glint_result result;
        const char *expected;
    } cases[] = {
        CASE(surface.alpha_x, 0.0F, GLINT_ERROR_RANGE, "surface.alpha_x is 0, expected 0.0001 to 1"),
        CASE(surface.alpha_y, 1.5F, GLINT_ERROR_RANGE, "surface.alpha_y is 1.5, expected 0.0001 to 1"),
        CASE(surface.alpha_x, NAN, GLINT_ERROR_RANGE, "surface.alpha_x is nan, expected 0.0001 to 1"),
        CASE(surface.facets_per_m2, -1.0F, GLINT_ERROR_RANGE, "surface.facets_per_m2 is -1, expected 0 to 1e+18"),
        CASE(surface.facets_per_m2, INFINITY, GLINT_ERROR_RANGE, "surface.facets_per_m2 is inf, expected 0 to 1e+18"),
        CASE(surface.discreteness, 2.0F, GLINT_ERROR_RANGE, "surface.discreteness is 2, expected 0 to 1"),
        CASE(surface.f0[1], -0.1F, GLINT_ERROR_RANGE, "surface.f0[1] is -0.1, expected 0 to 1"),
        CASE(surface.f90[2], 1.1F, GLINT_ERROR_RANGE, "surface.f90[2] is 1.1, expected 0 to 1"),
        CASE(surface.diffuse[0], 1.1F, GLINT_ERROR_RANGE, "surface.diffuse[0] is 1.1, expected 0 to 1"),
        CASE(facet_alpha, -1.0F, GLINT_ERROR_RANGE, "facet_alpha is -1, expected 0 to 1"),
        CASE(coverage, 1.01F, GLINT_ERROR_RANGE, "coverage is 1.01, expected 0 to 1"),
        CASE(elongation, 0.5F, GLINT_ERROR_RANGE, "elongation is 0.5, expected 1 to 10000"),
    };
#undef CASE
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        memcpy((char *)&o + cases[i].offset, &cases[i].value, sizeof(float));
        glint_material *m = (glint_material *)(void *)&o;
        char message[200];
        assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), cases[i].result);
        assert_null(m);
        assert_string_equal(message, cases[i].expected);
    }
}

static void unknown_enum_values_are_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        const int bad = 77;
        memcpy((char *)&o + (i == 0   ? offsetof(glint_material_options, model)
                             : i == 1 ? offsetof(glint_material_options, distribution)
                             : i == 2 ? offsetof(glint_material_options, fresnel)
                                      : offsetof(glint_material_options, weighting)),
               &bad, sizeof(bad));
        glint_material *m;
        assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_ERROR_RANGE);
        assert_null(m);
    }
}

static void wrong_size_is_refused_and_short_messages_are_cut(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.size -= 8;
    glint_material *m;
    char message[12];
    assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_ARGUMENT);
    assert_int_equal(strlen(message), sizeof(message) - 1);
    assert_int_equal(glint_material_create(NULL, &m, NULL, 0), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_material_create(&o, NULL, NULL, 0), GLINT_ERROR_ARGUMENT);
    glint_material_destroy(NULL);
}

typedef struct counter {
    int allocations, live, fail_at;
} counter;

static void *counted_allocate(size_t byte_count, void *user)
{
    counter *c = user;
    if (c->allocations++ == c->fail_at)
        return NULL;
    c->live++;
    return aligned_alloc(64, (byte_count + 63) / 64 * 64);
}

static void counted_release(void *memory, void *user)
{
    counter *c = user;
    c->live--;
    free(memory);
}

static void any_failed_allocation_is_reported_and_leaves_nothing(void **state)
{
    (void)state;
    for (uint32_t model = 0; model < glint_model_count(); model++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = (glint_model)model;
        counter c = { 0, 0, -1 };
        o.allocator = (glint_allocator){ counted_allocate, counted_release, &c };
        glint_material *m = create(&o);
        const int needed = c.allocations;
        assert_true(c.live > 0 && c.live <= needed); /* some may have been given back after baking */
        glint_material_destroy(m);
        assert_int_equal(c.live, 0);
        for (int n = 0; n < needed; n++) {
            char message[128];
            c = (counter){ 0, 0, n };
            assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_MEMORY);
            assert_null(m);
            assert_int_equal(c.live, 0);
            assert_non_null(strstr(message, glint_model_name((glint_model)model)));
        }
    }
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.allocator.allocate = counted_allocate;
    glint_material *m;
    assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_ERROR_ARGUMENT);
}

static void models_are_found_by_name(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < glint_model_count(); i++) {
        glint_model found = (glint_model)99;
        assert_int_equal(glint_model_find(glint_model_name((glint_model)i), &found), GLINT_OK);
        assert_int_equal(found, i);
        assert_true(glint_model_features((glint_model)i) & GLINT_FEATURE_SAMPLE);
    }
    glint_model untouched = (glint_model)99;
    assert_int_equal(glint_model_find("no such model", &untouched), GLINT_ERROR_RANGE);
    assert_int_equal(untouched, 99);
    assert_null(glint_model_name((glint_model)99));
    assert_int_equal(glint_model_features((glint_model)99), 0);
    for (int r = -1; r < 8; r++)
        assert_true(strlen(glint_result_text((glint_result)r)) > 3);
}

static void version_is_that_of_the_header(void **state)
{
    (void)state;
    char expected[32];
    snprintf(expected, sizeof(expected), "%d.%d.%d", GLINT_VERSION_MAJOR, GLINT_VERSION_MINOR, GLINT_VERSION_PATCH);
    assert_string_equal(glint_version(), expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_options_are_named_with_their_range),
        cmocka_unit_test(unknown_enum_values_are_refused),
        cmocka_unit_test(wrong_size_is_refused_and_short_messages_are_cut),
        cmocka_unit_test(any_failed_allocation_is_reported_and_leaves_nothing),
        cmocka_unit_test(models_are_found_by_name),
        cmocka_unit_test(version_is_that_of_the_header),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
