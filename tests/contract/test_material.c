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
        CASE(density_variation, 9.0F, GLINT_ERROR_RANGE, "density_variation is 9, expected 0 to 8"),
        CASE(max_anisotropy, 0.5F, GLINT_ERROR_RANGE, "max_anisotropy is 0.5, expected 1 to 16"),
        CASE(color_variation, -0.5F, GLINT_ERROR_RANGE, "color_variation is -0.5, expected 0 to 1"),
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

static void bad_colors_are_named_by_their_place(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_DICTIONARY;
    o.color_count = 9;
    glint_material *m;
    char message[200];
    assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_RANGE);
    assert_string_equal(message, "color_count is 9, expected 0 to 8");
    o.color_count = 8;
    o.colors[7][2] = 1.5F;
    assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_RANGE);
    assert_string_equal(message, "colors[7][2] is 1.5, expected 0 to 1");
    /* What is not counted is not looked at. */
    o.color_count = 7;
    assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_OK);
    glint_material_destroy(m);
}

static void bad_layers_are_named_by_their_place(void **state)
{
    (void)state;
    const glint_material_options plain = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material_options bad = plain, nested = plain, tinted = plain;
    bad.coverage = 2.0F;
    nested.model = GLINT_MODEL_LAYERED;
    nested.layers.base = nested.layers.coat = &plain;
    tinted.model = GLINT_MODEL_EXPLICIT;
    tinted.surface.f0[2] = NAN;
    const struct {
        const glint_material_options *base, *coat;
        float weight, normal_z, tangent_x;
        glint_result result;
        const char *expected;
    } cases[] = {
        { NULL, &plain, 1, 1, 1, GLINT_ERROR_ARGUMENT, "layers.base is NULL, expected the options of that layer" },
        { &plain, NULL, 1, 1, 1, GLINT_ERROR_ARGUMENT, "layers.coat is NULL, expected the options of that layer" },
        { &plain, &plain, 1.5F, 1, 1, GLINT_ERROR_RANGE, "layers.coat_weight is 1.5, expected 0 to 1" },
        { &plain, &plain, 1, 3, 1, GLINT_ERROR_RANGE,
          "layers.coat_normal is (0, 0, 3), expected a vector of length 1" },
        { &plain, &plain, 1, 1, 0, GLINT_ERROR_RANGE,
          "layers.coat_tangent is (0, 0, 0), expected a vector of length 1" },
        { &bad, &plain, 1, 1, 1, GLINT_ERROR_RANGE, "layers.base.coverage is 2, expected 0 to 1" },
        { &plain, &bad, 1, 1, 1, GLINT_ERROR_RANGE, "layers.coat.coverage is 2, expected 0 to 1" },
        { &plain, &tinted, 1, 1, 1, GLINT_ERROR_RANGE, "layers.coat.surface.f0[2] is nan, expected 0 to 1" },
        { &plain, &nested, 1, 1, 1, GLINT_ERROR_UNSUPPORTED,
          "layers.coat.model is layered, expected a model of one layer" },
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = GLINT_MODEL_LAYERED;
        o.layers = (glint_layers){ cases[i].base,
                                   cases[i].coat,
                                   cases[i].weight,
                                   { 0.0F, 0.0F, cases[i].normal_z },
                                   { cases[i].tangent_x, 0.0F, 0.0F } };
        glint_material *m;
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

static void fail_each_allocation(const configuration *of)
{
    glint_material_options o = of->options;
    counter c = { 0, 0, -1 };
    o.allocator = (glint_allocator){ counted_allocate, counted_release, &c };
    glint_material *m = create(&o);
    const int needed = c.allocations;
    /* Set-up may give back some of it at once. */
    assert_true(needed > 0 && c.live > 0 && c.live <= needed);
    glint_material_destroy(m);
    assert_int_equal(c.live, 0);
    for (int n = 0; n < needed; n++) {
        char message[128];
        c = (counter){ 0, 0, n };
        assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_MEMORY);
        assert_null(m);
        assert_int_equal(c.live, 0);
        assert_non_null(strstr(message, glint_model_name(o.model)));
    }
}

static void any_failed_allocation_is_reported_and_leaves_nothing(void **state)
{
    (void)state;
    for (uint32_t model = 0; model < glint_model_count(); model++) {
        const configuration c = configuration_of((glint_model)model, 0);
        fail_each_allocation(&c);
    }
    for (int i = 1; i < CONFIGURATIONS; i++) {
        const configuration c = configuration_of(GLINT_MODEL_LAYERED, i);
        fail_each_allocation(&c);
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
        cmocka_unit_test(bad_colors_are_named_by_their_place),
        cmocka_unit_test(bad_layers_are_named_by_their_place),
        cmocka_unit_test(unknown_enum_values_are_refused),
        cmocka_unit_test(wrong_size_is_refused_and_short_messages_are_cut),
        cmocka_unit_test(any_failed_allocation_is_reported_and_leaves_nothing),
        cmocka_unit_test(models_are_found_by_name),
        cmocka_unit_test(version_is_that_of_the_header),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
