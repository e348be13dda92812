/* The real and the malformed files of Debian's assimp-testmodels. The counts come from their JSON alone, not from our
 * reader. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gltf_case.h"

#define MODELS "/usr/share/assimp/models/glTF2/"
#define MODES "glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_"

static void take(gltf_case *c, const char *file)
{
    snprintf(c->path, sizeof c->path, "%s%s", MODELS, file);
}

/* Primitives of triangles, instances, their triangles before and after instancing, materials (with the default where
 * one is needed), images and cameras. */
typedef struct expected {
    const char *file;
    int meshes, instances;
    unsigned triangles, visible;
    int materials, images, cameras;
} expected;

static const expected good[] = {
    { "2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 34, 115, 75730, 121496, 34, 0, 1 },
    { "BoxBadNormals-glTF-Binary/BoxBadNormals.glb", 1, 1, 12, 12, 1, 0, 0 },
    { "BoxTexcoords-glTF/boxTexcoords.gltf", 1, 1, 12, 12, 1, 1, 0 },
    { "BoxTextured-glTF-Binary/BoxTextured.glb", 1, 1, 12, 12, 1, 1, 0 },
    { "BoxTextured-glTF-Embedded/BoxTextured.gltf", 1, 1, 12, 12, 1, 1, 0 },
    { "BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf", 1, 1, 12, 12, 1, 1, 0 },
    { "BoxTextured-glTF/BoxTextured.gltf", 1, 1, 12, 12, 1, 1, 0 },
    { "ClearCoat-glTF/ClearCoatTest.gltf", 27, 27, 37116, 37116, 19, 6, 0 },
    { "TestNoRootNode/SceneWithoutNodes.gltf", 0, 0, 0, 0, 0, 0, 0 },
    { "cameras/Cameras.gltf", 1, 1, 2, 2, 1, 0, 2 },
    { "draco/2CylinderEngine.gltf", 34, 115, 65311, 110336, 34, 0, 1 },
    { MODES "00.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "01.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "02.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "03.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "04.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "05.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "06.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "07.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "08.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "09.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "10.gltf", 0, 0, 0, 0, 1, 0, 0 },
    { MODES "11.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "12.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "13.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "14.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { MODES "15.gltf", 1, 1, 2, 2, 1, 0, 0 },
    { "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 1, 1, 12, 12, 1, 0, 0 },
    { "issue_3269/texcoord_crash.gltf", 5, 5, 10, 10, 5, 1, 0 },
    { "simple_skin/simple_skin.gltf", 1, 1, 8, 8, 1, 0, 0 },
    { "textureTransform/TextureTransformTest.gltf", 9, 12, 18, 24, 9, 5, 0 },
};

static void good_files_load_with_the_counts_of_their_json(void **state)
{
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        const expected *e = &good[i];
        take(c, e->file);
        gltf_case_accepted(c);
        const scene *s = &c->scene;
        unsigned triangles = 0, visible = 0;
        for (int k = 0; k < s->mesh_count; k++)
            triangles += s->meshes[k].triangle_count;
        for (int k = 0; k < s->instance_count; k++)
            visible += s->meshes[s->instances[k].mesh].triangle_count;
        const int found[] = { s->mesh_count,     s->instance_count, (int)triangles, (int)visible,
                              s->material_count, s->image_count,    s->camera_count };
        const int wanted[] = { e->meshes,    e->instances, (int)e->triangles, (int)e->visible,
                               e->materials, e->images,    e->cameras };
        for (size_t k = 0; k < 7; k++)
            if (found[k] != wanted[k])
                fail_msg("%s: count %zu is %d, expected %d", e->file, k, found[k], wanted[k]);
    }
}

typedef struct refusal {
    const char *file, *place, *text;
} refusal;

/* NoScene names a scene where there is none; IncorrectVertexArrays has 35 corners; the WebGL file requires its shaders.
 */
static const refusal bad[] = {
    { "BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", "/extensionsRequired/0", "KHR_technique_webgl" },
    { "BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "/accessors/2", "infinity" },
    { "IncorrectVertexArrays/Cube.gltf", "/meshes/1/primitives/0", "found 35 corners" },
    { "IndexOutOfRange/AllIndicesOutOfRange.gltf", "/meshes/0/primitives/0/indices",
      "expected less than the 24 vertices" },
    { "IndexOutOfRange/IndexOutOfRange.gltf", "/meshes/0/primitives/0/indices", "found vertex 255" },
    { "MissingBin/BoxTextured.gltf", "/buffers/0/uri", "BoxTextured0.bin cannot be opened" },
    { "RecursiveNodes/RecursiveNodes.gltf", "/nodes/0", "cycle" },
    { "SchemaFailures/sceneWrongType.gltf", "/scene", "found \"hello\", expected an index" },
    { "TestNoRootNode/NoScene.gltf", "/scene", "expected an index into \"scenes\", of which there are 0" },
    { "wrongTypes/badArray.gltf", "/meshes/0/primitives", "found an object, expected an array" },
    { "wrongTypes/badExtension.gltf",
      "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform", "expected an object" },
    { "wrongTypes/badNumber.gltf", "/materials/0/normalTexture", "found no \"index\"" },
    { "wrongTypes/badObject.gltf", "/materials/0/pbrMetallicRoughness", "found an array of 1, expected an object" },
    { "wrongTypes/badString.gltf", "/scenes/0/name", "found 42, expected a string" },
    { "wrongTypes/badUint.gltf", "/materials/0/pbrMetallicRoughness/baseColorTexture/index", "found -1" },
};

static void malformed_files_are_refused_with_place_and_reason(void **state)
{
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        take(c, bad[i].file);
        gltf_case_refused(c, bad[i].place, bad[i].text, NULL);
    }
}

static void normals_without_length_are_repaired_with_a_warning(void **state)
{
    gltf_case *c = *state;
    take(c, "BoxBadNormals-glTF-Binary/BoxBadNormals.glb");
    gltf_case_accepted(c);
    gltf_case_warned(c, "/attributes/NORMAL: 4 normals have no length");
    const scene_mesh *m = &c->scene.meshes[0];
    for (size_t i = 0; i < m->vertex_count; i++) {
        const float *n = &m->normal[3 * i], *p = &m->position[3 * i];
        assert_true(fabsf(hypotf(hypotf(n[0], n[1]), n[2]) - 1.0F) < 1e-6F);
        assert_true(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > 0.0F); /* out of the box around the origin */
    }
}

static void extent(const scene_mesh *m, float low[3], float high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = FLT_MAX;
        high[k] = -FLT_MAX;
        for (uint32_t i = 0; i < m->vertex_count; i++) {
            low[k] = fminf(low[k], m->position[3 * i + (uint32_t)k]);
            high[k] = fmaxf(high[k], m->position[3 * i + (uint32_t)k]);
        }
    }
}

/* The largest component of the way to the nearest vertex. */
static float distance_to(const scene_mesh *m, const float p[3])
{
    float nearest = FLT_MAX;
    for (size_t i = 0; i < m->vertex_count; i++) {
        const float *q = &m->position[3 * i];
        nearest = fminf(nearest, fmaxf(fabsf(p[0] - q[0]), fmaxf(fabsf(p[1] - q[1]), fabsf(p[2] - q[2]))));
    }
    return nearest;
}

/* Draco rounds each coordinate to a step of (largest extent) / (2^11 - 1), so it is off by at most half a step. */
static void draco_positions_are_those_of_the_plain_file_within_half_a_step(void **state)
{
    gltf_case *c = *state;
    take(c, "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    gltf_case_accepted(c);
    scene plain = c->scene;
    c->scene = (scene){ 0 };
    take(c, "draco/2CylinderEngine.gltf");
    gltf_case_accepted(c);
    assert_int_equal(c->scene.mesh_count, plain.mesh_count);
    for (int i = 0; i < plain.mesh_count; i++) {
        const scene_mesh *a = &plain.meshes[i], *b = &c->scene.meshes[i];
        float low[3], high[3], range = 0.0F;
        extent(a, low, high);
        for (int k = 0; k < 3; k++)
            range = fmaxf(range, high[k] - low[k]);
        const float bound =
            0.5F * range / 2047.0F + 4.0F * FLT_EPSILON * (range + fabsf(low[0]) + fabsf(low[1]) + fabsf(low[2]));
        for (size_t v = 0; v < b->vertex_count; v += 7) {
            const float found = distance_to(a, &b->position[3 * v]);
            if (!(found <= bound))
                fail_msg("%s vertex %zu is off by %g, expected at most %g", b->name, v, (double)found, (double)bound);
        }
    }
    scene_free(&plain);
}

static void cameras_keep_their_kind_and_numbers(void **state)
{
    gltf_case *c = *state;
    take(c, "cameras/Cameras.gltf");
    gltf_case_accepted(c);
    const scene_camera *a = &c->scene.cameras[0], *b = &c->scene.cameras[1];
    assert_int_equal(a->projection, SCENE_PERSPECTIVE);
    assert_true(a->yfov_rad == 0.7F && a->aspect == 1.0F && a->znear == 0.01F && a->zfar == 100.0F);
    assert_int_equal(b->projection, SCENE_ORTHOGRAPHIC);
    assert_true(b->xmag == 1.0F && b->ymag == 1.0F && b->znear == 0.01F && b->zfar == 100.0F);
    assert_true(a->to_world[12] == 0.5F && a->to_world[13] == 0.5F && a->to_world[14] == 3.0F);
}

static void texture_transforms_reach_the_textures(void **state)
{
    gltf_case *c = *state;
    take(c, "textureTransform/TextureTransformTest.gltf");
    gltf_case_accepted(c);
    const scene_material *m = c->scene.materials;
    assert_true(m[0].base_color_texture.offset[0] == 0.5F && m[0].base_color_texture.offset[1] == 0.0F);
    assert_true(m[3].base_color_texture.rotation == 0.39269908169872415480783042290994F);
    assert_true(m[4].base_color_texture.scale[0] == 1.5F && m[4].base_color_texture.scale[1] == 1.5F);
    assert_true(m[0].base_color_texture.srgb);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(good_files_load_with_the_counts_of_their_json),
        TEST(malformed_files_are_refused_with_place_and_reason),
        TEST(normals_without_length_are_repaired_with_a_warning),
        TEST(draco_positions_are_those_of_the_plain_file_within_half_a_step),
        TEST(cameras_keep_their_kind_and_numbers),
        TEST(texture_transforms_reach_the_textures),
    };
    return cmocka_run_group_tests_name("assimp_models", tests, NULL, NULL);
}
