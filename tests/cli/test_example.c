/* glint example writes normal maps, and glint eval shows them as libglint does that was given the same normals. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "glint.h"
#include "run_glint.h"
#include "workplace.h"

static void a_map_is_written_and_described(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "example", "brushed", "-o", "map.png", "--size", "64", "--json");
    assert_exit(&o, 0);
    json_t *said = json_loads(o.out, 0, NULL);
    assert_non_null(said);
    assert_string_equal(json_string_value(json_object_get(said, "kind")), "brushed");
    assert_int_equal(json_integer_value(json_object_get(said, "size")), 64);
    /* The slope that was not asked for is .2, nearly all of it across u: alpha is sqrt(2) times it. */
    const double u = json_number_value(json_object_get(said, "slope_u"));
    const double v = json_number_value(json_object_get(said, "slope_v"));
    assert_true(fabs(hypot(u, v) - 0.2) < 1e-4 && v > 8.0 * u);
    const double alpha_u = pow(json_number_value(json_object_get(said, "roughness")), 2.0);
    const double strength = json_number_value(json_object_get(said, "anisotropy"));
    assert_true(fabs(alpha_u - sqrt(2.0 * u * u + pow(0.05, 4.0))) < 1e-6);
    assert_true(fabs(alpha_u + (1.0 - alpha_u) * strength * strength - sqrt(2.0 * v * v + pow(0.05, 4.0))) < 1e-6);
    assert_true(fabs(json_number_value(json_object_get(said, "anisotropy_rotation_rad")) - 1.5707963) < 1e-6);
    json_decref(said);
    outcome_free(&o);

    o = glint_run(NULL, "example", "brushed", "-o", "again.png", "--size", "64");
    assert_exit(&o, 0);
    assert_says(o.out, "again.png: brushed, 64 x 64 texels");
    outcome_free(&o);
    assert_same_files("map.png", "again.png");
    size_t size;
    char *png = file_read("map.png", &size);
    /* Signature, then the header: width, height, 16 bits, RGB. */
    assert_memory_equal(png, "\x89PNG\r\n\x1a\n", 8);
    assert_memory_equal(png + 16, "\0\0\0\x40\0\0\0\x40\x10\x02", 10);
    free(png);
}

static void wrong_usage_writes_nothing(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "example", "lether", "-o", "map.png"), 2,
                   "unknown kind 'lether'; did you mean 'leather'?");
    assert_refused(glint_run(NULL, "example", "leather"), 2, "-o MAP.png is missing");
    assert_refused(glint_run(NULL, "example", "leather", "-o", "map.jpg"), 2,
                   "'map.jpg': expected a name that ends in .png");
    assert_refused(glint_run(NULL, "example", "leather", "-o", "map.png", "--size", "12"), 2, "--size");
    assert_refused(glint_run(NULL, "example", "leather", "-o", "map.png", "--slope", "3"), 2, "--slope");
    assert_refused(glint_run(NULL, "example", "leather", "-o", "no/where.png"), 1, "no/where.png");
    assert_int_equal(folder_count("."), 0);
}

enum { SIZE = 16, QUERIES = 60 };

static const char material_text[] =
    "{ \"name\": \"grain\", \"pbrMetallicRoughness\": { \"baseColorFactor\": [0.75, 0.5, 0.25, 1], \"metallicFactor\": "
    "1,"
    "  \"roughnessFactor\": 0.5 }, \"extensions\": { \"GLINT_materials_glint\": { \"glintFactor\": 1,"
    "  \"glintDensity\": 1048576, \"glintFacetRoughness\": 0.25, \"glintSeed\": 5, \"glintStructure\": \"example\","
    "  \"glintExampleTexture\": { \"index\": 0 }, \"glintExamplePlacement\": \"scattered\", \"glintExampleSize\": "
    "0.0625,"
    "  \"glintExampleRotationVariation\": 0.5, \"glintExampleScaleVariation\": 0.125 } },"
    "  \"extras\": { \"textures\": [{ \"source\": 0 }], \"images\": [{ \"uri\": \"map.png\" }] } }";

/* The same material by the library alone. */
static glint_material *grain(void)
{
    static float normals[3 * SIZE * SIZE];
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_LEATHER, SIZE, &shape, 7U, normals), GLINT_OK);
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXAMPLE;
    o.facet_alpha = 0.0625F;
    o.seed = 5;
    o.surface = (glint_surface){ .alpha_x = 0.25F,
                                 .alpha_y = 0.25F,
                                 .f0 = { 0.75F, 0.5F, 0.25F },
                                 .f90 = { 1.0F, 1.0F, 1.0F },
                                 .facets_per_m2 = 1048576.0F,
                                 .discreteness = 1.0F };
    o.example.normals = normals;
    o.example.size = SIZE;
    o.example.side_m = 0.0625F;
    o.example.placement = GLINT_EXAMPLE_SCATTERED;
    o.example.rotation_variation_rad = 0.5F;
    o.example.scale_variation = 0.125F;
    o.example.jitter = 1.0F;
    o.example.sigma_r = 1e-3F;
    glint_material *material = NULL;
    char message[256];
    if (glint_material_create(&o, &material, message, sizeof message) != GLINT_OK)
        fail_msg("%s", message);
    return material;
}

static void eval_shows_the_map_as_the_library_does(void **state)
{
    (void)state;
    outcome made = glint_run(NULL, "example", "leather", "-o", "map.png", "--size", "16", "--seed", "7");
    assert_exit(&made, 0);
    outcome_free(&made);
    file_write_text("grain.json", material_text);
    glint_material *material = grain();
    char text[QUERIES * 160];
    size_t used = 0;
    float expected[QUERIES], peak = 0.0F;
    for (int i = 0; i < QUERIES; ++i) {
        const double slope[2] = { 0.2 * sin(1.7 * i), 0.2 * cos(2.3 * i) };
        const double length = sqrt(1.0 + slope[0] * slope[0] + slope[1] * slope[1]);
        const double h[3] = { slope[0] / length, slope[1] / length, 1.0 / length };
        const glint_footprint f = { 0.013 * i, 0.031 * i, 0.004F, 0.0F, 0.0F, 0.004F, 0 };
        const glint_light light = { GLINT_LIGHT_CAP, .solid_angle_sr = 1e-3F };
        const float wo[3] = { 0.0F, 0.0F, 1.0F };
        /* The mirror image of straight up. */
        const double wi[3] = { 2.0 * h[2] * h[0], 2.0 * h[2] * h[1], 2.0 * h[2] * h[2] - 1.0 };
        const float to[3] = { (float)wi[0], (float)wi[1], (float)wi[2] };
        float rgb[3];
        glint_eval(material, NULL, &f, wo, to, &light, rgb);
        expected[i] = rgb[0];
        peak = fmaxf(peak, rgb[0]);
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "%.17g %.17g 0.004 0 0 0.004 0 0 1 %.17g %.17g %.17g 1e-3 0\n", f.u, f.v, wi[0], wi[1],
                                 wi[2]);
    }
    glint_material_destroy(material);
    const run_setup setup = { .input = text };
    outcome o = glint_run(&setup, "eval", "--material", "./grain.json");
    assert_exit(&o, 0);
    assert_string_equal(o.err, "");
    const char *at = o.out;
    for (int i = 0; i < QUERIES; ++i) {
        char *end;
        const float found = strtof(at, &end);
        /* Sixteen bits of a normal are 1.5e-5 of a slope, and a facet's roughness 3000 times that. A code of the maps
         * may flip by it, 1 / 128 of a value that is as bright as its tile gets. */
        if (!(fabsf(found - expected[i]) < 0.01F * peak))
            fail_msg("query %d: found %g, expected %g", i, (double)found, (double)expected[i]);
        at = strchr(end, '\n') + 1;
    }
    assert_true(peak > 0.0F);
    outcome_free(&o);
}

static void a_map_that_cannot_be_is_an_error_of_eval(void **state)
{
    (void)state;
    file_write_text("grain.json", material_text);
    const run_setup setup = { .input = "0 0 1e-3 0 0 1e-3 0 0 1 0 0 1 1e-3 0\n" };
    assert_refused(glint_run(&setup, "eval", "--material", "./grain.json"), 1, "map.png");
    file_write_text("map.png", "no picture");
    assert_refused(glint_run(&setup, "eval", "--material", "./grain.json"), 1, "map.png");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, workplace_enter, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(a_map_is_written_and_described),
        TEST(wrong_usage_writes_nothing),
        TEST(eval_shows_the_map_as_the_library_does),
        TEST(a_map_that_cannot_be_is_an_error_of_eval),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
