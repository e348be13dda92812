/* Textures and buffers go into the file or beside it; what is wrong is refused and leaves no file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "export_case.h"
#include "glint_export.h"

static void write_textured_preset(gltf_case *c)
{
    const char *preset =
        "{\"normalTexture\":{\"index\":1},\"extensions\":{\"GLINT_materials_glint\":{\"glintFactor\":1,"
        "\"glintTexture\":{\"index\":0}}},\"extras\":{\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0}],"
        "\"images\":[{\"uri\":\"logo.png\"}],\"samplers\":[{\"magFilter\":9728}]}}";
    const bytes logo = read_bytes(MODELS "BoxTextured-glTF/CesiumLogoFlat.png");
    gltf_case_write(c, "logo.png", logo.data, logo.size);
    free(logo.data);
    gltf_case_write(c, "textured.json", preset, strlen(preset));
}

static void assert_image(const scene *s, int image, const char *path)
{
    const bytes wanted = read_bytes(path);
    assert_null(s->images[image].path);
    assert_int_equal(s->images[image].byte_count, wanted.size);
    assert_memory_equal(s->images[image].bytes, wanted.data, wanted.size);
    free(wanted.data);
}

/* The bytes of the BIN chunk: behind a header of 12 bytes and a JSON chunk. */
static const char *bin_of(const bytes *glb, size_t *size)
{
    uint32_t json, bin;
    memcpy(&json, glb->data + 12, 4);
    memcpy(&bin, glb->data + 20 + json, 4);
    *size = bin;
    return glb->data + 28 + json;
}

static void textures_go_behind_the_bytes_of_a_glb(void **state)
{
    gltf_case *c = *state;
    const char *file = MODELS "2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
    write_textured_preset(c);
    const request q = { .material = "*", .preset = in_folder(c, "textured.json") };
    exported(file, in_folder(c, "out.glb"), &q);
    const scene *s = read_output(c, in_folder(c, "out.glb"));
    assert_int_equal(s->image_count, 1);
    assert_image(s, 0, in_folder(c, "logo.png"));
    assert_true(s->materials[0].normal_texture.nearest && !s->materials[0].glint.texture.nearest);
    /* The model has no texture coordinates: they are made, or the file would not be valid. */
    assert_non_null(s->meshes[0].texcoord[0]);

    const bytes before = read_bytes(file), after = read_bytes(in_folder(c, "out.glb"));
    size_t old_size, new_size;
    const char *old_bin = bin_of(&before, &old_size), *new_bin = bin_of(&after, &new_size);
    assert_true(new_size > old_size);
    assert_memory_equal(old_bin, new_bin, old_size);
    free(before.data);
    free(after.data);

    exported(in_folder(c, "out.glb"), in_folder(c, "again.glb"), &q);
    assert_same_files(in_folder(c, "out.glb"), in_folder(c, "again.glb"));
    exported(in_folder(c, "out.glb"), in_folder(c, "out.glb"), &(request){ .strip = 1 });
    assert_same_files(file, in_folder(c, "out.glb"));
}

static void textures_go_into_a_gltf_and_its_own_files_beside_it(void **state)
{
    gltf_case *c = *state;
    write_textured_preset(c);
    /* Its one image is the preset's, so that it is used again. */
    exported(MODELS "BoxTextured-glTF/BoxTextured.gltf", in_folder(c, "out.gltf"),
             &(request){ .material = "*", .preset = in_folder(c, "textured.json") });
    const scene *s = read_output(c, in_folder(c, "out.gltf"));
    assert_int_equal(s->image_count, 1);
    assert_same_files(in_folder(c, "CesiumLogoFlat.png"), MODELS "BoxTextured-glTF/CesiumLogoFlat.png");
    assert_same_files(in_folder(c, "BoxTextured0.bin"), MODELS "BoxTextured-glTF/BoxTextured0.bin");
    /* This one has no image of its own. */
    exported(MODELS "cameras/Cameras.gltf", in_folder(c, "cameras.gltf"),
             &(request){ .material = "*", .preset = in_folder(c, "textured.json") });
    s = read_output(c, in_folder(c, "cameras.gltf"));
    assert_int_equal(s->image_count, 1);
    assert_image(s, 0, in_folder(c, "logo.png"));
}

static void a_file_of_others_is_not_overwritten(void **state)
{
    gltf_case *c = *state;
    gltf_case_write(c, "BoxTextured0.bin", "mine", 4);
    refused(MODELS "BoxTextured-glTF/BoxTextured.gltf", in_folder(c, "out.gltf"), &(request){ 0 }, "another file");
    assert_int_equal(access(in_folder(c, "out.gltf"), F_OK), -1);
}

static void malformed_files_are_refused_and_write_nothing(void **state)
{
    static const char *const bad[] = {
        "BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf",
        "BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
        "IncorrectVertexArrays/Cube.gltf",
        "IndexOutOfRange/AllIndicesOutOfRange.gltf",
        "IndexOutOfRange/IndexOutOfRange.gltf",
        "MissingBin/BoxTextured.gltf",
        "RecursiveNodes/RecursiveNodes.gltf",
        "SchemaFailures/sceneWrongType.gltf",
        "TestNoRootNode/NoScene.gltf",
        "wrongTypes/badArray.gltf",
        "wrongTypes/badExtension.gltf",
        "wrongTypes/badNumber.gltf",
        "wrongTypes/badObject.gltf",
        "wrongTypes/badString.gltf",
        "wrongTypes/badUint.gltf",
    };
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char in[512], out[64];
        snprintf(in, sizeof in, MODELS "%s", bad[i]);
        snprintf(out, sizeof out, "out%s", strrchr(bad[i], '.'));
        refused(in, in_folder(c, out), &(request){ .material = "*", .preset = "snow" }, in);
        assert_int_equal(access(in_folder(c, out), F_OK), -1);
    }
}

static void the_library_is_told_from_its_options(void **state)
{
    (void)state;
    char message[256];
    assert_int_equal(glint_export_gltf(NULL, message, sizeof message), GLINT_EXPORT_WRONG_USAGE);
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    assert_int_equal(glint_export_gltf(&o, message, sizeof message), GLINT_EXPORT_WRONG_USAGE);
    o.input = "a.gltf";
    o.output = "a.glb";
    assert_int_equal(glint_export_gltf(&o, message, sizeof message), GLINT_EXPORT_WRONG_USAGE);
    assert_non_null(strstr(message, ".glb"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(textures_go_behind_the_bytes_of_a_glb), TEST(textures_go_into_a_gltf_and_its_own_files_beside_it),
        TEST(a_file_of_others_is_not_overwritten),   TEST(malformed_files_are_refused_and_write_nothing),
        TEST(the_library_is_told_from_its_options),
    };
    return cmocka_run_group_tests_name("export_gltf_files", tests, NULL, NULL);
}
