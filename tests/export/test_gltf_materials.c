/* Presets and single values on glTF files: the material that comes out, and the geometry that it needs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "export_case.h"

/* The renderer's own way to put a preset on a material, and the exported file: the same material but for the order of
 * images. */
static void presets_come_out_as_the_renderer_applies_them(void **state)
{
    static const char *const presets[] = {
        "brushed-steel", "craft-glitter", "frosted-plastic", "gold-leaf", "metallic-car-paint", "nail-polish",
        "sand",          "snow"
    };
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof presets / sizeof presets[0]; i++) {
        /* ClearCoatTest has textures, coats and transforms that must go. */
        exported(MODELS "ClearCoat-glTF/ClearCoatTest.gltf", in_folder(c, "out.gltf"),
                 &(request){ .material = "*", .preset = presets[i] });
        snprintf(c->path, sizeof c->path, "%s", in_folder(c, "out.gltf"));
        gltf_case_accepted(c);
        scene s = { 0 };
        scene_material wanted;
        report r = { 0 };
        assert_true(preset_read(presets[i], &s, &wanted, &r));
        assert_true(c->scene.material_count > 10);
        for (int m = 0; m < c->scene.material_count; m++) {
            scene_material found = c->scene.materials[m];
            assert_string_not_equal(found.name, wanted.name);
            found.name = wanted.name;
            assert_memory_equal(&found, &wanted, sizeof found);
        }
        free(wanted.name);
        scene_free(&s);
        scene_free(&c->scene);
    }
}

static void only_the_named_material_changes(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'materials': [{'name': 'a'}, {'name': 'b', 'alphaCutoff': 0.25}, {}], 'extensionsUsed': ['X']");
    char *const in = in_folder(c, "scene.gltf"), *const out = in_folder(c, "out.gltf");
    exported(in, out, &(request){ .material = "materials/2", .preset = "snow" });
    const scene *s = read_output(c, out);
    assert_false(s->materials[0].glint.present || s->materials[1].glint.present);
    assert_true(s->materials[2].glint.present && s->materials[2].glint.density == 4e6F);
    assert_true(s->materials[1].alpha_cutoff == 0.25F);
    refused(in, out, &(request){ .material = "c", .preset = "snow" }, "no material called \"c\"");
    refused(in, out, &(request){ .material = "a", .preset = "snwo" }, "snow");
}

#define TRIANGLE                                                                                                       \
    "'bufferViews': [{'buffer': 0, 'byteLength': 36}, {'buffer': 0, 'byteOffset': 36, 'byteLength': 36}],"             \
    "'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], 'max': [1, " \
    "1, 0]}, {'bufferView': 1, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}],"                                   \
    "'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'NORMAL': 1}%s}]}],"                                    \
    "'nodes': [{'mesh': 0}], 'scenes': [{'nodes': [0]}]"

static const float triangle[18] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1 };

static void primitives_without_a_material_get_one(void **state)
{
    gltf_case *c = *state;
    gltf_case_json_with_buffer(c, triangle, sizeof triangle, TRIANGLE, "");
    char *const in = in_folder(c, "scene.gltf"), *const out = in_folder(c, "out.gltf");
    exported(in, out, &(request){ .material = "default", .preset = "snow" });
    const scene *s = read_output(c, out);
    assert_int_equal(s->material_count, 1);
    assert_int_equal(s->meshes[0].material, 0);
    assert_true(s->materials[0].glint.density == 4e6F);
    exported(out, in_folder(c, "back.gltf"), &(request){ .strip = 1 });
    assert_same_files(in, in_folder(c, "back.gltf"));
}

/* Without texture coordinates facets lie on planes along the axes; on a surface that faces z, u is x. */
static void tangents_without_texture_coordinates_follow_the_planes_of_the_object(void **state)
{
    gltf_case *c = *state;
    gltf_case_json_with_buffer(c, triangle, sizeof triangle, TRIANGLE ", 'materials': [{'name': 'm'}]",
                               ", 'material': 0");
    char *const out = in_folder(c, "out.gltf");
    exported(in_folder(c, "scene.gltf"), out, &(request){ .material = "m", .preset = "brushed-steel" });
    const scene *s = read_output(c, out);
    assert_non_null(s->meshes[0].tangent);
    for (int i = 0; i < 3; i++) {
        const float wanted[4] = { 1.0F, 0.0F, 0.0F, 1.0F };
        assert_memory_equal(&s->meshes[0].tangent[4 * i], wanted, sizeof wanted);
    }
}

/* The reader computes MikkTSpace tangents where a file has none. Reading normalises what was stored: two roundings of
 * single precision. */
static void tangents_are_those_that_the_reader_computes(void **state)
{
    gltf_case *c = *state;
    const char *file = MODELS "BoxTextured-glTF-Binary/BoxTextured.glb";
    exported(file, in_folder(c, "out.glb"), &(request){ .material = "*", .preset = "brushed-steel" });
    const scene *s = read_output(c, in_folder(c, "out.glb"));
    scene before = { 0 };
    report r = { 0 };
    assert_true(scene_file_read(file, NULL, &before, &r));
    const scene_mesh *a = &before.meshes[0], *b = &s->meshes[0];
    assert_int_equal(a->vertex_count, b->vertex_count);
    for (uint32_t i = 0; i < 3 * a->triangle_count; i++)
        for (uint32_t k = 0; k < 4; k++)
            if (fabsf(a->tangent[4 * a->index[i] + k] - b->tangent[4 * b->index[i] + k]) > 2.4e-7F)
                fail_msg("corner %u: component %u differs", i, k);
    scene_free(&before);
}

static void values_are_set_where_the_pointer_says(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'materials': [{'extensions': {'GLINT_materials_glint': {'glintDensity': 1e7}}}, {}],"
                      "'extensionsUsed': ['GLINT_materials_glint']");
    char *const in = in_folder(c, "scene.gltf"), *const out = in_folder(c, "out.gltf");
    exported(in, out, &(request){ .pointer = "/glintSpace", .value = "object" });
    assert_int_equal(read_output(c, out)->materials[0].glint.space, SCENE_SPACE_OBJECT);
    assert_false(c->scene.materials[1].glint.present);
    exported(in, out,
             &(request){ .pointer = "/materials/1/extensions/GLINT_materials_glint/glintColorFactor",
                         .value = "[1,0.5,0]" });
    const scene *s = read_output(c, out);
    assert_true(s->materials[1].glint.present && s->materials[1].glint.color[1] == 0.5F);
    assert_true(s->materials[0].glint.color[1] == 1.0F);
}

static void wrong_values_are_refused_and_write_nothing(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'materials': [{'extensions': {'GLINT_materials_glint': {}}}],"
                      "'extensionsUsed': ['GLINT_materials_glint']");
    char *const in = in_folder(c, "scene.gltf"), *const out = in_folder(c, "out.gltf");
    static const struct {
        const char *pointer, *value, *reason;
    } bad[] = {
        { "/glintDensity", "-1", "/materials/0/extensions/GLINT_materials_glint/glintDensity: found -1" },
        { "/glintDensity", "much", "found \"much\", expected a number" },
        { "/glintSeed", "2147483648", "found 2147483648, expected an integer from 0 to 2147483647" },
        { "/glintSpace", "world", "found \"world\", expected one of uv|object" },
        { "/glintDensty", "1", "glintDensity" },
        { "/glintTexture/index", "0", "of which there are 0" },
        { "glintDensity", "1", "starts with a slash" },
        { "/materials/7/extensions/GLINT_materials_glint/glintDensity", "1", "of which there are 1" },
        { "/materials/0/alphaCutoff", "1", "expected one into GLINT_materials_glint" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        refused(in, out, &(request){ .pointer = bad[i].pointer, .value = bad[i].value }, bad[i].reason);
        assert_int_equal(access(out, F_OK), -1);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(presets_come_out_as_the_renderer_applies_them),
        TEST(only_the_named_material_changes),
        TEST(primitives_without_a_material_get_one),
        TEST(tangents_without_texture_coordinates_follow_the_planes_of_the_object),
        TEST(tangents_are_those_that_the_reader_computes),
        TEST(values_are_set_where_the_pointer_says),
        TEST(wrong_values_are_refused_and_write_nothing),
    };
    return cmocka_run_group_tests_name("export_gltf_materials", tests, NULL, NULL);
}
