/* Accessors: component types, strides, sparse elements and bounds, seen through the vertices that they become. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gltf_case.h"

/* One triangle whose POSITION, TEXCOORD_0 and COLOR_0 come from the accessors 0, 1 and 2, as far as attributes says. */
#define MESH(attributes)                                                                                               \
    "'meshes': [{ 'primitives': [{ 'attributes': { " attributes " } }] }], 'nodes': [{ 'mesh': 0 }]"

static const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

static void integers_are_normalised_as_the_text_says(void **state)
{
    gltf_case *c = *state;
    uint8_t bytes[36 + 12 + 24 + 12];
    const uint16_t uv[6] = { 0, 65535, 13107, 52428, 32768, 1 };
    const uint8_t color[12] = { 0, 51, 102, 255, 153, 204, 255, 1, 254, 128, 127, 0 };
    memcpy(bytes, corners, 36);
    memcpy(bytes + 36, uv, 12);
    memcpy(bytes + 48, color, 12);
    gltf_case_json_with_buffer(
        c, bytes, sizeof bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }, { 'buffer': 0, 'byteOffset': 36, 'byteLength': 12 },"
        " { 'buffer': 0, 'byteOffset': 48, 'byteLength': 12 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 1, 'componentType': 5123, 'normalized': true, 'count': 3, 'type': 'VEC2' },"
        "{ 'bufferView': 2, 'componentType': 5121, 'normalized': true, 'count': 3, 'type': 'VEC4' }]," MESH(
            "'POSITION': 0, 'TEXCOORD_0': 1, 'COLOR_0': 2"));
    gltf_case_accepted(c);
    const scene_mesh *m = &c->scene.meshes[0];
    for (int i = 0; i < 6; i++)
        assert_true(m->texcoord[0][i] == (float)uv[i] / 65535.0F);
    for (int i = 0; i < 12; i++)
        assert_true(m->color[i] == (float)color[i] / 255.0F);
}

static void colors_without_alpha_get_one_and_are_clamped(void **state)
{
    gltf_case *c = *state;
    float values[18] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0.5F, 2, 0, 1, 0, 0.25F, 0, 1 };
    gltf_case_json_with_buffer(
        c, values, sizeof values,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 72 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 36, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }]," MESH(
            "'POSITION': 0, 'COLOR_0': 1"));
    gltf_case_accepted(c);
    static const float expected[12] = { 0, 0.5F, 1, 1, 0, 1, 0, 1, 0.25F, 0, 1, 1 };
    assert_memory_equal(c->scene.meshes[0].color, expected, sizeof expected);
}

/* KHR_mesh_quantization allows bytes and shorts, which count only when the file says that it uses it. */
static void quantized_positions_need_the_extension(void **state)
{
    gltf_case *c = *state;
    const int16_t positions[12] = { -32768, 32767, 0, 7, 100, -3, 1, 7, 0, 1, 0, 7 };
    static const char *const format =
        "%s 'bufferViews': [{ 'buffer': 0, 'byteLength': 24, 'byteStride': 8 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5122, %s 'count': 3, 'type': 'VEC3' }]," MESH("'POSITION': 0");
    gltf_case_json_with_buffer(c, positions, sizeof positions, format, "'extensionsUsed': ['KHR_mesh_quantization'],",
                               "");
    gltf_case_accepted(c);
    static const float plain[9] = { -32768, 32767, 0, 100, -3, 1, 0, 1, 0 };
    assert_memory_equal(c->scene.meshes[0].position, plain, sizeof plain);
    gltf_case_json_with_buffer(c, positions, sizeof positions, format, "'extensionsUsed': ['KHR_mesh_quantization'],",
                               "'normalized': true,");
    gltf_case_accepted(c);
    assert_true(c->scene.meshes[0].position[0] == -1.0F && c->scene.meshes[0].position[1] == 1.0F);
    assert_true(c->scene.meshes[0].position[3] == 100.0F / 32767.0F);
    gltf_case_json_with_buffer(c, positions, sizeof positions, format, "", "");
    gltf_case_refused(
        c, "/accessors/0: found components of type short, which POSITION without KHR_mesh_quantization may not have",
        NULL);
}

/* 2 vertices are not read: a stride of s needs 2 s + 12 bytes, and glTF allows multiples of 4 from 4 to 252. */
static void every_stride_is_read_or_refused(void **state)
{
    gltf_case *c = *state;
    uint8_t bytes[2 * 300 + 12] = { 0 };
    for (size_t stride = 1; stride <= 300; stride++) {
        memset(bytes, 0, sizeof bytes);
        for (size_t i = 0; i < 3; i++)
            memcpy(bytes + i * stride, corners + 3 * i, 12);
        gltf_case_json_with_buffer(
            c, bytes, sizeof bytes,
            "'bufferViews': [{ 'buffer': 0, 'byteLength': %zu, 'byteStride': %zu }], 'accessors': ["
            "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }]," MESH("'POSITION': 0"),
            2 * stride + 12, stride);
        if (stride % 4 == 0 && stride >= 12 && stride <= 252) {
            gltf_case_accepted(c);
            assert_memory_equal(c->scene.meshes[0].position, corners, sizeof corners);
        } else {
            gltf_case_refused(c, "/bufferViews/0/byteStride: found", NULL);
        }
    }
}

static void elements_beyond_their_view_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *view, *accessor, *says;
    } wrong[] = {
        { "'byteLength': 36", "'count': 4", "/accessors/0: found 4 elements" },
        { "'byteLength': 36", "'count': 3, 'byteOffset': 1", "/accessors/0: found 3 elements" },
        { "'byteLength': 35", "'count': 3", "/accessors/0: found 3 elements" },
        { "'byteLength': 4", "'count': 1", "/accessors/0: found 1 elements" },
        { "'byteLength': 36", "'count': 3, 'byteOffset': 4294967295", "/accessors/0: found 3 elements" },
        { "'byteLength': 37", "'count': 3", "/bufferViews/0: found bytes 0 to 37" },
        { "'byteLength': 36, 'byteOffset': 1", "'count': 3", "/bufferViews/0: found bytes 1 to 37" },
        { "'byteLength': 4294967295, 'byteOffset': 4294967295", "'count': 3", "/bufferViews/0: found bytes" },
        { "'byteLength': 36", "'count': 4294967295", "/accessors/0: found 4294967295 elements" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json_with_buffer(
            c, corners, sizeof corners,
            "'bufferViews': [{ 'buffer': 0, %s }], 'accessors': ["
            "{ 'bufferView': 0, 'componentType': 5126, %s, 'type': 'VEC3' }]," MESH("'POSITION': 0"),
            wrong[i].view, wrong[i].accessor);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
}

/* Without a buffer view elements are zero; a short file cannot ask for more of them than 2^20 and 64 a byte. */
static void accessor_without_view_is_zero_and_bounded(void **state)
{
    gltf_case *c = *state;
    static const char *const format =
        "'accessors': [{ 'componentType': 5126, 'count': %s, 'type': 'VEC3' }]," MESH("'POSITION': 0");
    gltf_case_json(c, format, "3");
    gltf_case_accepted(c);
    static const float zero[9] = { 0 };
    assert_memory_equal(c->scene.meshes[0].position, zero, sizeof zero);
    gltf_case_json(c, format, "1048578");
    gltf_case_refused(c, "/accessors/0: found 1048578 elements, which makes the geometry too large", NULL);
    gltf_case_json(c, format, "4294967295");
    gltf_case_refused(c, "/accessors/0: found 4294967295 elements", NULL);
}

static void not_finite_numbers_are_refused(void **state)
{
    gltf_case *c = *state;
    static const float values[] = { NAN, INFINITY, -INFINITY };
    for (size_t i = 0; i < 3; i++) {
        float positions[9];
        memcpy(positions, corners, sizeof corners);
        positions[7] = values[i];
        gltf_case_json_with_buffer(
            c, positions, sizeof positions,
            "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }], 'accessors': ["
            "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }]," MESH("'POSITION': 0"));
        gltf_case_refused(
            c, i == 0 ? "/accessors/0: found NaN in element 2" : "/accessors/0: found infinity in element 2", NULL);
    }
}

static void attribute_of_another_length_or_type_is_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *accessor, *says;
    } wrong[] = {
        { "'componentType': 5126, 'count': 2, 'type': 'VEC2'",
          "/meshes/0/primitives/0/attributes/TEXCOORD_0: found 2 elements, expected the 3" },
        { "'componentType': 5126, 'count': 3, 'type': 'VEC3'",
          "/accessors/1: found elements of 3 components, expected 2" },
        { "'componentType': 5126, 'count': 3, 'type': 'MAT2'", "/accessors/1: found elements of small matrices" },
        { "'componentType': 5125, 'count': 3, 'type': 'VEC2'", "/accessors/1: found components of type unsigned int" },
        { "'componentType': 5121, 'count': 3, 'type': 'VEC2'", "/accessors/1: found components of type unsigned byte" },
        { "'componentType': 5124, 'count': 3, 'type': 'VEC2'", "/accessors/1/componentType: found 5124" },
        { "'componentType': 5126, 'count': 3, 'type': 'VEC5'", "/accessors/1/type: found \"VEC5\"" },
        { "'componentType': 5126, 'count': 0, 'type': 'VEC2'", "/accessors/1/count: found 0" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json_with_buffer(c, corners, sizeof corners,
                                   "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }], 'accessors': ["
                                   "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
                                   "{ 'bufferView': 0, %s }]," MESH("'POSITION': 0, 'TEXCOORD_0': 1"),
                                   wrong[i].accessor);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
}

/* Bytes 0 to 35 base positions, 36 and 37 the sparse indices, 40 to 63 their values. */
static void write_sparse(gltf_case *c, int first, int second, const char *base, int count)
{
    uint8_t bytes[64] = { 0 };
    const float values[6] = { 5, 6, 7, 8, 9, 10 };
    memcpy(bytes, corners, 36);
    bytes[36] = (uint8_t)first;
    bytes[37] = (uint8_t)second;
    memcpy(bytes + 40, values, 24);
    gltf_case_json_with_buffer(
        c, bytes, sizeof bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }, { 'buffer': 0, 'byteOffset': 36, 'byteLength': 2 },"
        " { 'buffer': 0, 'byteOffset': 40, 'byteLength': 24 }], 'accessors': ["
        "{ %s 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'sparse': { 'count': %d,"
        " 'indices': { 'bufferView': 1, 'componentType': 5121 }, 'values': { 'bufferView': 2 } } }]," MESH(
            "'POSITION': 0"),
        base, count);
}

static void sparse_elements_replace_those_below(void **state)
{
    gltf_case *c = *state;
    write_sparse(c, 0, 2, "'bufferView': 0,", 2);
    gltf_case_accepted(c);
    static const float over_base[9] = { 5, 6, 7, 1, 0, 0, 8, 9, 10 }, over_zero[9] = { 0, 0, 0, 5, 6, 7, 8, 9, 10 };
    assert_memory_equal(c->scene.meshes[0].position, over_base, sizeof over_base);
    write_sparse(c, 1, 2, "", 2);
    gltf_case_accepted(c);
    assert_memory_equal(c->scene.meshes[0].position, over_zero, sizeof over_zero);
}

static void sparse_indices_must_increase_and_stay_inside(void **state)
{
    gltf_case *c = *state;
    static const int wrong[][2] = { { 2, 0 }, { 1, 1 }, { 0, 3 }, { 255, 0 } };
    for (size_t i = 0; i < 4; i++) {
        write_sparse(c, wrong[i][0], wrong[i][1], "'bufferView': 0,", 2);
        gltf_case_refused(c, "/accessors/0/sparse/indices: found", "expected indices that increase", NULL);
    }
    write_sparse(c, 0, 1, "'bufferView': 0,", 3);
    gltf_case_refused(c, "/accessors/0/sparse/indices: found 3 elements", NULL);
    write_sparse(c, 0, 1, "'bufferView': 0,", 4);
    gltf_case_refused(c, "/accessors/0/sparse/count: found 4", NULL);
}

static void accessors_may_share_bytes(void **state)
{
    gltf_case *c = *state;
    gltf_case_json_with_buffer(
        c, corners, sizeof corners,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36, 'byteStride': 12 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 4, 'componentType': 5126, 'count': 3, 'type': 'VEC2' }]," MESH(
            "'POSITION': 0, 'TEXCOORD_0': 1"));
    gltf_case_accepted(c);
    static const float expected[6] = { 0, 0, 0, 0, 1, 0 };
    assert_memory_equal(c->scene.meshes[0].texcoord[0], expected, sizeof expected);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(integers_are_normalised_as_the_text_says),
        TEST(colors_without_alpha_get_one_and_are_clamped),
        TEST(quantized_positions_need_the_extension),
        TEST(every_stride_is_read_or_refused),
        TEST(elements_beyond_their_view_are_refused),
        TEST(accessor_without_view_is_zero_and_bounded),
        TEST(not_finite_numbers_are_refused),
        TEST(attribute_of_another_length_or_type_is_refused),
        TEST(sparse_elements_replace_those_below),
        TEST(sparse_indices_must_increase_and_stay_inside),
        TEST(accessors_may_share_bytes),
    };
    return cmocka_run_group_tests_name("gltf_accessor", tests, NULL, NULL);
}
