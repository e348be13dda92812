/* Presets on glTF files: what does not change by a single byte, and that it can all be taken back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export_case.h"

#define PRESET "{\"name\":\"p\",\"extensions\":{\"GLINT_materials_glint\":{\"glintDensity\":7.0e8}}}"

/* Numbers, names and blanks that a reader and writer would spell otherwise, and values that it would lose. */
static void all_but_the_material_keeps_its_bytes(void **state)
{
    gltf_case *c = *state;
    const char *head =
                   "{ \"asset\" :{\"version\":\"2.0\",\"x\":[1.0, 1, 1e-3, 1E+2, -0.0, 18446744073709551615, 0.10]},"
                   "\"extras\": null,\n\t\"extensionsUsed\": [\"X_unknown\" ",
               *name = "],\n\"materials\":[ { \"name\" : \"a\\u0062\", ",
               *old = "\"emissiveFactor\":[1,1,1], \"extensions\":{\"X_unknown\":{\"e\":[],\"n\":null}} }",
               *fresh = "\"extensions\":{\"X_unknown\":{\"e\":[],\"n\":null},\"GLINT_materials_glint\":{"
                        "\"glintDensity\":7.0e8}} }",
               *tail =
                   ",{ \"name\":\"other\" , \"emissiveFactor\":[0.0,0,0e0] } ], \"unknown\" : {\"deep\":[ { } ,[]]}";
    char text[2048];
    snprintf(text, sizeof text, "%s%s%s%s }", head, name, old, tail);
    gltf_case_write(c, "p.json", PRESET, strlen(PRESET));
    gltf_case_write(c, "in.gltf", text, strlen(text));
    exported(in_folder(c, "in.gltf"), in_folder(c, "out.gltf"),
             &(request){ .material = "ab", .preset = in_folder(c, "p.json") });

    bytes found = read_bytes(in_folder(c, "out.gltf"));
    /* The blank behind the last name of the list stays before the bracket. */
    snprintf(text, sizeof text, "%.*s,\"GLINT_materials_glint\" %s%s%s,", (int)strlen(head) - 1, head, name, fresh,
             tail);
    if (strncmp(found.data, text, strlen(text)) != 0)
        fail_msg("found\n%s\nexpected it to begin with\n%s", found.data, text);
    /* Behind it there is the record and nothing else. */
    assert_int_equal(strncmp(found.data + strlen(text), " \"extensions\":{\"GLINT_materials_glint\":{\"extras\":", 49),
                     0);
    free(found.data);
    exported(in_folder(c, "out.gltf"), in_folder(c, "back.gltf"), &(request){ .strip = 1 });
    assert_same_files(in_folder(c, "in.gltf"), in_folder(c, "back.gltf"));
}

static const char *const good[] = {
    "2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
    "BoxBadNormals-glTF-Binary/BoxBadNormals.glb",
    "BoxTexcoords-glTF/boxTexcoords.gltf",
    "BoxTextured-glTF-Binary/BoxTextured.glb",
    "BoxTextured-glTF-Embedded/BoxTextured.gltf",
    "BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf",
    "BoxTextured-glTF/BoxTextured.gltf",
    "ClearCoat-glTF/ClearCoatTest.gltf",
    "TestNoRootNode/SceneWithoutNodes.gltf",
    "cameras/Cameras.gltf",
    "draco/2CylinderEngine.gltf",
    "glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_11.gltf",
    "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf",
    "issue_3269/texcoord_crash.gltf",
    "simple_skin/simple_skin.gltf",
    "textureTransform/TextureTransformTest.gltf",
};
enum { GOOD_COUNT = sizeof good / sizeof good[0] };

static const char *suffix_of(const char *file)
{
    return strrchr(file, '.');
}

/* A file of the test's folder that ends as the model does. */
static char *output_for(const gltf_case *c, size_t model, const char *name)
{
    char file[64];
    snprintf(file, sizeof file, "%zu%s%s", model, name, suffix_of(good[model]));
    return in_folder(c, file);
}

static const char *model_path(size_t model)
{
    static char path[512];
    snprintf(path, sizeof path, MODELS "%s", good[model]);
    return path;
}

/* The models of one file name have other buffers, so each has a folder of its own. */
static void for_each_model(gltf_case *c, void (*check)(gltf_case *c, size_t model))
{
    for (size_t i = 0; i < GOOD_COUNT; i++) {
        void *state = NULL;
        gltf_case_begin(&state);
        check(state, i);
        gltf_case_end(&state);
    }
    (void)c;
}

/* brushed-steel adds TANGENT, the others do not; a second preset replaces the first. */
static void check_that_all_is_taken_back(gltf_case *c, size_t model)
{
    char *const first = output_for(c, model, "first"), *const second = output_for(c, model, "second");
    exported(model_path(model), first, &(request){ .material = "*", .preset = "brushed-steel" });
    exported(first, second,
             &(request){ .material = "*", .preset = "snow", .pointer = "/glintDensity", .value = "12.50e6" });
    exported(second, second, &(request){ .strip = 1 });
    assert_same_files(model_path(model), second);
    exported(first, first, &(request){ .strip = 1 });
    assert_same_files(model_path(model), first);
}

static void strip_gives_back_every_byte(void **state)
{
    for_each_model(*state, check_that_all_is_taken_back);
}

static void check_that_a_second_export_changes_nothing(gltf_case *c, size_t model)
{
    const request q = { .material = "*", .preset = "brushed-steel", .pointer = "/glintSeed", .value = "3" };
    char *const first = output_for(c, model, "first"), *const second = output_for(c, model, "second");
    exported(model_path(model), first, &q);
    exported(first, second, &q);
    assert_same_files(first, second);
}

static void a_second_export_changes_nothing(void **state)
{
    for_each_model(*state, check_that_a_second_export_changes_nothing);
}

static void check_that_geometry_stays(gltf_case *c, size_t model)
{
    char *const out = output_for(c, model, "out");
    exported(model_path(model), out, &(request){ .material = "*", .preset = "craft-glitter" });
    snprintf(c->path, sizeof c->path, "%s", out);
    gltf_case_accepted(c);
    scene before = { 0 };
    report r = { 0 };
    assert_true(scene_file_read(model_path(model), NULL, &before, &r));
    assert_int_equal(before.mesh_count, c->scene.mesh_count);
    for (int i = 0; i < before.mesh_count; i++) {
        const scene_mesh *a = &before.meshes[i], *b = &c->scene.meshes[i];
        assert_int_equal(a->vertex_count, b->vertex_count);
        assert_int_equal(a->triangle_count, b->triangle_count);
        assert_memory_equal(a->position, b->position, 3 * sizeof(float) * a->vertex_count);
        assert_memory_equal(a->normal, b->normal, 3 * sizeof(float) * a->vertex_count);
        assert_memory_equal(a->index, b->index, 3 * sizeof(uint32_t) * a->triangle_count);
    }
    scene_free(&before);
}

static void geometry_stays_bit_for_bit(void **state)
{
    for_each_model(*state, check_that_geometry_stays);
}

static void strip_without_a_record_removes_the_extension(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'materials': [{'name': 'a', 'extensions': {'GLINT_materials_glint': {'glintFactor': 1}}},"
                      "{'extensions': {'X': {}, 'GLINT_materials_glint': {}}, 'name': 'b'}],"
                      "'extensionsUsed': ['GLINT_materials_glint', 'X']");
    char *const out = in_folder(c, "out.gltf");
    exported(in_folder(c, "scene.gltf"), out, &(request){ .strip = 1 });
    const bytes text = read_bytes(out);
    assert_null(strstr(text.data, "GLINT"));
    assert_non_null(strstr(text.data, "\"X\": {}"));
    free(text.data);
    assert_int_equal(read_output(c, out)->material_count, 2);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(all_but_the_material_keeps_its_bytes),
        TEST(strip_gives_back_every_byte),
        TEST(a_second_export_changes_nothing),
        TEST(geometry_stays_bit_for_bit),
        TEST(strip_without_a_record_removes_the_extension),
    };
    return cmocka_run_group_tests_name("export_gltf", tests, NULL, NULL);
}
