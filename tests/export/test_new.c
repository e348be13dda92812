/* A new file of what a renderer sees of another one: the renderer sees the same in it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "io/image.h"
#include "io/scene_file.h"
#include "run_glint.h"
#include "workplace.h"

#define MODELS "/usr/share/assimp/models/glTF2/"

#define glint(...)                                                                                                     \
    do {                                                                                                               \
        outcome ran = glint_run(NULL, __VA_ARGS__);                                                                    \
        assert_exit(&ran, 0);                                                                                          \
        outcome_free(&ran);                                                                                            \
    } while (0)

static image picture_of(const char *path)
{
    report r = { 0 };
    image i;
    if (!image_read(path, &i, &r))
        fail_msg("%s", r.error);
    return i;
}

/* Numbers are written so that they are read as the same floats. Normals and tangents that the reader makes unit vectors
 * once more may turn by a rounding, 2^-23; a pixel changes by that over the width of its narrowest lobe, facets of
 * .0025, and over their edges: so a hundredth in one of a thousand pixels is more than enough, and all others are
 * equal. */
static void assert_same_pictures(const char *a, const char *b, const char *what)
{
    image x = picture_of(a), y = picture_of(b);
    assert_int_equal(x.width, y.width);
    assert_int_equal(x.channel_count, y.channel_count);
    const size_t count = (size_t)x.width * (size_t)x.height * (size_t)x.channel_count;
    size_t off = 0;
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        off += fabsf(x.pixels[i] - y.pixels[i]) > 1e-4F * fabsf(x.pixels[i]) + 1e-6F;
        sum += (double)x.pixels[i];
    }
    assert_true(sum > 0.0);
    if (off > count / 1000)
        fail_msg("%s: %zu of %zu values differ", what, off, count);
    image_free(&x);
    image_free(&y);
}

static void assert_renders_alike(const char *input, const char *output, const char *preset)
{
    char material[256];
    snprintf(material, sizeof material, "*=%s", preset);
    glint("export", "gltf", input, "-o", output, "--new", "--material", material);
    glint("render", input, "-o", "before.exr", "--size", "64x48", "--spp", "1", "--material", material);
    glint("render", output, "-o", "after.exr", "--size", "64x48", "--spp", "1");
    assert_same_pictures("before.exr", "after.exr", input);
}

static void new_files_render_as_the_old_ones(void **state)
{
    (void)state;
    static const char *const files[] = { MODELS "2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
                                         MODELS "BoxTextured-glTF/BoxTextured.gltf",
                                         MODELS "ClearCoat-glTF/ClearCoatTest.gltf",
                                         MODELS "cameras/Cameras.gltf",
                                         MODELS "draco/2CylinderEngine.gltf",
                                         MODELS "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf",
                                         MODELS "simple_skin/simple_skin.gltf",
                                         MODELS "textureTransform/TextureTransformTest.gltf",
                                         SHADER_BALL };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i)
        assert_renders_alike(files[i], i % 2 ? "new.gltf" : "new.glb", i % 3 ? "metallic-car-paint" : "brushed-steel");
}

/* The file's own materials, with textures, coats and all. */
static void materials_of_the_file_stay(void **state)
{
    (void)state;
    static const char *const files[] = { MODELS "ClearCoat-glTF/ClearCoatTest.gltf",
                                         MODELS "textureTransform/TextureTransformTest.gltf", SHADER_BALL };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        glint("export", "gltf", files[i], "-o", "new.glb", "--new");
        glint("render", files[i], "-o", "before.exr", "--size", "96x72", "--spp", "1");
        glint("render", "new.glb", "-o", "after.exr", "--size", "96x72", "--spp", "1");
        assert_same_pictures("before.exr", "after.exr", files[i]);
    }
}

/* One of every light, a node that shears, one that mirrors, and glints in a coat. */
static const char everything[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2,4,5,6,7]}],"
    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"EXT_lights_area\",\"KHR_materials_clearcoat\",\"GLINT_materials_"
    "glint\","
    "\"KHR_materials_emissive_strength\",\"KHR_materials_anisotropy\",\"KHR_materials_specular\",\"KHR_materials_ior\"]"
    ","
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":40,\"color\":[1,0.3,0.1],"
    "\"range\":20,\"spot\":{\"innerConeAngle\":0.2,\"outerConeAngle\":0.7},\"extras\":{\"radius\":0.1}},"
    "{\"type\":\"directional\",\"intensity\":0.7,\"extras\":{\"angularDiameter\":0.02}}]},\"EXT_lights_area\":{"
    "\"lights\":["
    "{\"type\":\"rect\",\"intensity\":3,\"size\":0.5,\"rect\":{\"aspect\":2.5}},{\"type\":\"disk\",\"intensity\":5,"
    "\"size\":0.3}]}},"
    "\"materials\":[{\"name\":\"a\",\"emissiveFactor\":[0.3,0.7,0.1],\"pbrMetallicRoughness\":{\"roughnessFactor\":0.4}"
    ","
    "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":3.3},\"KHR_materials_clearcoat\":{"
    "\"clearcoatFactor\":0.8,\"clearcoatRoughnessFactor\":0.3,\"extensions\":{\"GLINT_materials_glint\":{"
    "\"glintFactor\":1,"
    "\"glintDensity\":5e3,\"glintSpace\":\"object\",\"glintSeed\":7}}},\"KHR_materials_anisotropy\":{"
    "\"anisotropyStrength\":0.4,"
    "\"anisotropyRotation\":0.7},\"GLINT_materials_glint\":{\"glintFactor\":0.9,\"glintDensity\":2e4,"
    "\"glintColorVariation\":"
    "0.4,\"glintColors\":[[1,0.2,0.3],[0.3,0.9,0.5]],\"glintElongation\":3,\"glintCoverage\":0.7}}},{\"name\":\"b\","
    "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.3,\"baseColorFactor\":[0.2,0.5,0.9,1]},"
    "\"doubleSided\":true,\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.7},\"KHR_materials_specular\":{"
    "\"specularFactor\":"
    "0.6,\"specularColorFactor\":[1,0.9,0.8]},\"GLINT_materials_glint\":{\"glintFactor\":1,\"glintDensity\":3e3,"
    "\"glintDistribution\":\"beckmann\",\"glintFacetRoughness\":0.1,\"glintSpace\":\"object\"}}}],"
    "\"nodes\":[{\"children\":[1],\"scale\":[1,2,1]},{\"mesh\":0,\"rotation\":[0,0,0.38268343,0.92387953]},"
    "{\"children\":[3],\"translation\":[-2,0,0.5]},{\"mesh\":1,\"name\":\"mirrored\",\"scale\":[-1,1,1.5]},"
    "{\"translation\":[0,0,6],\"camera\":0},{\"translation\":[1,1,4],\"extensions\":{\"KHR_lights_punctual\":{"
    "\"light\":0}}},"
    "{\"translation\":[-1,1,3],\"rotation\":[0.1,0.2,0,0.9746794],\"extensions\":{\"EXT_lights_area\":{\"light\":0}},"
    "\"children\":[8]},{\"scale\":[2,2,2],\"translation\":[1,-1,3],\"extensions\":{\"EXT_lights_area\":{\"light\":1}}},"
    "{\"rotation\":[-0.3,0,0,0.9539392],\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"aspectRatio\":1.5,\"znear\":0.1,\"zfar\":"
    "50}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":1}]},"
    "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0},{\"attributes\":{\"POSITION\":1},\"material\":1}"
    "]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,"
    "1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,-1,0],\"max\":[1,0,0]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":72,\"uri\":\"data.bin\"}]}";
static const float triangles[18] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 1, -1, 0, 0, 0, 0 };

static void lights_layers_and_odd_transforms_stay(void **state)
{
    (void)state;
    file_write_text("everything.gltf", everything);
    file_write("data.bin", triangles, sizeof triangles);
    outcome o = glint_run(NULL, "export", "gltf", "everything.gltf", "-o", "new.glb", "--new", "--json");
    assert_exit(&o, 0);
    assert_says(o.out, "\"lights\":4");
    assert_says(o.err, "nodes/1: its transform shears");
    outcome_free(&o);
    glint("render", "everything.gltf", "-o", "before.exr", "--size", "96x64", "--spp", "4", "--model", "smooth");
    glint("render", "new.glb", "-o", "after.exr", "--size", "96x64", "--spp", "4", "--model", "smooth");
    assert_same_pictures("before.exr", "after.exr", "smooth");

    /* The parts of one node are one object again, under its number. */
    report r = { 0 };
    scene before, after;
    assert_true(scene_file_read("everything.gltf", NULL, &before, &r));
    assert_true(scene_file_read("new.glb", NULL, &after, &r));
    assert_int_equal(before.instance_count, after.instance_count);
    for (int i = 0; i < before.instance_count; ++i)
        assert_int_equal(before.instances[i].node, after.instances[i].node);
    assert_memory_equal(before.materials[0].glint.colors, after.materials[0].glint.colors,
                        sizeof before.materials[0].glint.colors);
    assert_int_equal(before.materials[0].coat_glint.seed, after.materials[0].coat_glint.seed);
    assert_memory_equal(before.materials[0].emissive, after.materials[0].emissive, sizeof before.materials[0].emissive);
    scene_free(&before);
    scene_free(&after);
}

/* Six faces of which no two are alike, two levels of which the second is left out, and faces in another order than
 * their images. */
static void surroundings_stay(void **state)
{
    (void)state;
    enum { SIDE = 8 };
    for (int face = 0; face < 6; ++face) {
        uint16_t rgb[SIDE * SIDE * 3];
        for (int i = 0; i < SIDE * SIDE; ++i)
            for (int c = 0; c < 3; ++c)
                rgb[3 * i + c] = (uint16_t)(40 * (face + 1) + i * (c + 1) % 16);
        char name[16];
        snprintf(name, sizeof name, "%c.png", 'a' + face);
        report r = { 0 };
        assert_true(image_write_data_png(name, SIDE, SIDE, 8, rgb, &r));
    }
    file_write("data.bin", triangles, sizeof triangles);
    file_write_text(
        "studio.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"EXT_lights_image_based\",\"GLINT_materials_glint\"],"
        "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"b.png\"},{\"uri\":\"c.png\"},{\"uri\":\"d.png\"},{\"uri\":"
        "\"e.png\"},{\"uri\":\"f.png\"}],\"extensions\":{\"EXT_lights_image_based\":{\"lights\":[{\"name\":\"studio\","
        "\"intensity\":2.5,\"rotation\":[0,0.6,0,0.8],\"specularImageSize\":8,\"specularImages\":[[5,3,4,2,1,0],"
        "[0,0,0,0,0,0]],\"irradianceCoefficients\":[[1,1,1],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],"
        "[0,0,0]]}]}},\"scenes\":[{\"nodes\":[0],\"extensions\":{\"EXT_lights_image_based\":{\"light\":0}}}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"roughnessFactor\":0.3},\"extensions\":{\"GLINT_materials_glint\":{"
        "\"glintDensity\":1e4,\"glintSpace\":\"object\"}}}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
        "\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":"
        "36}],\"buffers\":[{\"byteLength\":72,\"uri\":\"data.bin\"}]}");
    glint("render", "studio.gltf", "-o", "before.exr", "--size", "64x48", "--spp", "2");
    static const char *const outputs[] = { "new.glb", "new.gltf" };
    for (size_t i = 0; i < 2; ++i) {
        glint("export", "gltf", "studio.gltf", "-o", outputs[i], "--new");
        glint("render", outputs[i], "-o", "after.exr", "--size", "64x48", "--spp", "2");
        assert_same_pictures("before.exr", "after.exr", outputs[i]);
    }
}

static void the_same_input_gives_the_same_bytes(void **state)
{
    (void)state;
    glint("export", "gltf", SHADER_BALL, "-o", "a.gltf", "--new");
    glint("export", "gltf", SHADER_BALL, "-o", "b.gltf", "--new");
    assert_same_files("a.gltf", "b.gltf");
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "export", "gltf", SHADER_BALL, "-o", "x.obj", "--new"), 2, ".gltf or .glb");
    assert_refused(glint_run(NULL, "export", "gltf", SHADER_BALL, "-o", "x.glb", "--new", "--strip"), 2, "--new");
    assert_refused(glint_run(NULL, "export", "gltf", SHADER_BALL, "-o", "x.glb", "--variant", "a"), 2, "--variant");
    assert_refused(glint_run(NULL, "export", "gltf", SHADER_BALL, "-o", "x.glb", "--new", "--variant", "a"), 1,
                   "variant");
    assert_refused(glint_run(NULL, "export", "gltf", "none.glb", "-o", "x.glb", "--new"), 1, "none.glb");
    assert_refused(glint_run(NULL, "export", "gltf", SHADER_BALL, "-o", "no/x.glb", "--new"), 1, "no/x.glb");
    file_write_text("lost.gltf",
                    "{\"asset\":{\"version\":\"2.0\"},\"images\":[{\"uri\":\"lost.png\"}],\"textures\":[{\"source\":"
                    "0}],\"materials\":[{\"normalTexture\":{\"index\":0}}]}");
    assert_refused(glint_run(NULL, "export", "gltf", "lost.gltf", "-o", "x.glb", "--new"), 1, "lost.png");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, workplace_enter, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(new_files_render_as_the_old_ones),      TEST(materials_of_the_file_stay),
        TEST(lights_layers_and_odd_transforms_stay), TEST(surroundings_stay),
        TEST(the_same_input_gives_the_same_bytes),   TEST(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests_name("export_new", tests, NULL, NULL);
}
