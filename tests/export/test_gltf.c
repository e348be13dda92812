/* Presets on glTF files: what changes, what does not change by a single byte, and that it can all be taken back. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "glint_export.h"
#include "gltf_case.h"

#define MODELS "/usr/share/assimp/models/glTF2/"

/* ---- files ---- */

typedef struct bytes {
    char *data; /* with a terminating zero */
    size_t size;
} bytes;

static bytes read_bytes(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s cannot be opened", path);
    fseek(file, 0, SEEK_END);
    bytes b = { NULL, (size_t)ftell(file) };
    rewind(file);
    b.data = calloc(b.size + 1, 1);
    assert_non_null(b.data);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

static void assert_same_files(const char *a, const char *b)
{
    bytes x = read_bytes(a), y = read_bytes(b);
    if (x.size != y.size || memcmp(x.data, y.data, x.size) != 0)
        fail_msg("%s (%zu bytes) and %s (%zu bytes) differ", a, x.size, b, y.size);
    free(x.data);
    free(y.data);
}

static char *in_folder(const gltf_case *c, const char *name)
{
    static char paths[8][600];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", c->folder, name);
    return path;
}

/* ---- exports ---- */

typedef struct request {
    const char *material, *preset, *pointer, *value;
    int strip;
} request;

static glint_export_result export(const char *input, const char *output, const request *q, char message[1024])
{
    const glint_export_assignment material = { q->material, q->preset }, value = { q->pointer, q->value };
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    o.input = input;
    o.output = output;
    o.materials = &material;
    o.material_count = q->preset ? 1 : 0;
    o.values = &value;
    o.value_count = q->value ? 1 : 0;
    o.strip = q->strip;
    return glint_export_gltf(&o, message, 1024);
}

static void exported(const char *input, const char *output, const request *q)
{
    char message[1024];
    if (export(input, output, q, message) != GLINT_EXPORT_OK)
        fail_msg("%s", message);
}

static void refused(const char *input, const char *output, const request *q, const char *reason)
{
    char message[1024] = "";
    assert_int_equal(export(input, output, q, message), GLINT_EXPORT_BAD_INPUT);
    if (!strstr(message, reason))
        fail_msg("said \"%s\", expected it to hold \"%s\"", message, reason);
}

/* ---- what does not change ---- */

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

/* ---- what changes ---- */

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

/* Reads what was written; the file's own warnings do not matter here. */
static const scene *read_output(gltf_case *c, const char *path)
{
    scene_free(&c->scene);
    snprintf(c->path, sizeof c->path, "%s", path);
    gltf_case_accepted(c);
    return &c->scene;
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

/* ---- textures ---- */

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

/* ---- single values ---- */

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

/* ---- files that are wrong, files that others changed ---- */

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
        snprintf(out, sizeof out, "out%s", suffix_of(bad[i]));
        refused(in, in_folder(c, out), &(request){ .material = "*", .preset = "snow" }, in);
        assert_int_equal(access(in_folder(c, out), F_OK), -1);
    }
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
        TEST(all_but_the_material_keeps_its_bytes),
        TEST(strip_gives_back_every_byte),
        TEST(a_second_export_changes_nothing),
        TEST(geometry_stays_bit_for_bit),
        TEST(presets_come_out_as_the_renderer_applies_them),
        TEST(only_the_named_material_changes),
        TEST(primitives_without_a_material_get_one),
        TEST(tangents_without_texture_coordinates_follow_the_planes_of_the_object),
        TEST(tangents_are_those_that_the_reader_computes),
        TEST(textures_go_behind_the_bytes_of_a_glb),
        TEST(textures_go_into_a_gltf_and_its_own_files_beside_it),
        TEST(a_file_of_others_is_not_overwritten),
        TEST(values_are_set_where_the_pointer_says),
        TEST(wrong_values_are_refused_and_write_nothing),
        TEST(malformed_files_are_refused_and_write_nothing),
        TEST(strip_without_a_record_removes_the_extension),
        TEST(the_library_is_told_from_its_options),
    };
    return cmocka_run_group_tests_name("export_gltf", tests, NULL, NULL);
}
