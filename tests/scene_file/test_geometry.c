/* Topology, normals, tangents and morph targets: what glTF asks for between the file and the renderer. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"
#include "io/tangent_space.h"

/* Five points of a fan around vertex 0, which is also a strip. */
static const float points[15] = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0 };

static void write_points(gltf_case *c, const char *primitive)
{
    uint8_t bytes[60 + 12] = { 0 };
    static const uint8_t indices[12] = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 5, 0, 0 };
    memcpy(bytes, points, 60);
    memcpy(bytes + 60, indices, 12);
    gltf_case_json_with_buffer(
        c, bytes, sizeof bytes,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 60 }, { 'buffer': 0, 'byteOffset': 60, 'byteLength': 12 }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 5, 'type': 'VEC3' },"
        " { 'bufferView': 1, 'componentType': 5121, 'count': 9, 'type': 'SCALAR' },"
        " { 'bufferView': 1, 'byteOffset': 8, 'componentType': 5121, 'count': 3, 'type': 'SCALAR' },"
        " { 'bufferView': 1, 'componentType': 5121, 'count': 8, 'type': 'SCALAR' },"
        " { 'bufferView': 1, 'componentType': 5121, 'count': 2, 'type': 'SCALAR' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 }%s }] }], 'nodes': [{ 'mesh': 0 }]",
        primitive);
}

/* The corners of triangle i as numbers into points. */
static void corners_of(const scene_mesh *m, uint32_t i, int out[3])
{
    for (uint32_t k = 0; k < 3; k++) {
        const float *p = &m->position[3 * (size_t)m->index[3 * i + k]];
        out[k] = -1;
        for (size_t n = 0; n < 5; n++)
            if (p[0] == points[3 * n] && p[1] == points[3 * n + 1])
                out[k] = (int)n;
    }
}

static void assert_triangles(const gltf_case *c, const int (*expected)[3], uint32_t count)
{
    assert_int_equal(c->scene.meshes[0].triangle_count, count);
    for (uint32_t i = 0; i < count; i++) {
        int found[3];
        corners_of(&c->scene.meshes[0], i, found);
        assert_memory_equal(found, expected[i], sizeof found);
    }
}

/* glTF 2.0 section 3.7.2.1: a strip turns every second triangle round, a fan begins with its second point. */
static void strips_and_fans_keep_their_winding(void **state)
{
    gltf_case *c = *state;
    static const int list[][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } };
    static const int strip[][3] = { { 0, 1, 2 }, { 1, 3, 2 }, { 2, 3, 4 } };
    static const int fan[][3] = { { 1, 2, 0 }, { 2, 3, 0 }, { 3, 4, 0 } };
    write_points(c, ", 'indices': 1");
    gltf_case_accepted(c);
    assert_triangles(c, list, 3);
    write_points(c, ", 'mode': 5");
    gltf_case_accepted(c);
    assert_triangles(c, strip, 3);
    write_points(c, ", 'mode': 6");
    gltf_case_accepted(c);
    assert_triangles(c, fan, 3);
}

static void wrong_corners_are_refused(void **state)
{
    gltf_case *c = *state;
    write_points(c, "");
    gltf_case_refused(c, "/meshes/0/primitives/0: found 5 corners, expected 3 for each triangle", NULL);
    write_points(c, ", 'indices': 3");
    gltf_case_refused(c, "found 8 corners", NULL);
    write_points(c, ", 'indices': 2");
    gltf_case_refused(c, "/meshes/0/primitives/0/indices: found vertex 5 at place 1, expected less than the 5", NULL);
    write_points(c, ", 'indices': 4, 'mode': 5");
    gltf_case_refused(c, "found 2 corners, expected at least 3", NULL);
    write_points(c, ", 'indices': 0");
    gltf_case_refused(c, "/accessors/0: found elements of 3 components, expected 1 for indices", NULL);
    write_points(c, ", 'mode': 7");
    gltf_case_refused(c, "/meshes/0/primitives/0/mode: found 7", NULL);
}

static void points_and_lines_are_left_out_with_a_warning(void **state)
{
    gltf_case *c = *state;
    write_points(c, ", 'mode': 0");
    gltf_case_accepted(c);
    gltf_case_warned(c, "/meshes/0/primitives/0: points are left out");
    assert_int_equal(c->scene.mesh_count, 0);
    assert_int_equal(c->scene.instance_count, 0);
    assert_true(c->scene.bounds_min[0] > c->scene.bounds_max[0]);
}

static void missing_normals_are_flat_and_face_the_winding(void **state)
{
    gltf_case *c = *state;
    write_points(c, ", 'indices': 1");
    gltf_case_accepted(c);
    const scene_mesh *m = &c->scene.meshes[0];
    assert_int_equal(m->vertex_count, 9);
    for (size_t i = 0; i < 9; i++)
        assert_true(m->normal[3 * i] == 0 && m->normal[3 * i + 1] == 0 && m->normal[3 * i + 2] == 1);
    assert_null(m->tangent);
}

/* A square in the plane z = 0 with the texture as a picture hangs: u to the right, v down. Its tangent is +x, and the
 * bitangent cross(n, t) w points up, where normal textures have +y (glTF 2.0 section 3.9.3): w = 1. */
static void write_square(gltf_case *c, const float uv[8])
{
    float data[12 + 12 + 8] = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2 };
    memcpy(data + 24, uv, 32);
    gltf_case_json_with_buffer(
        c, data, sizeof data,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 128 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 48, 'componentType': 5126, 'count': 4, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 96, 'componentType': 5126, 'count': 4, 'type': 'VEC2' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0, 'NORMAL': 1, 'TEXCOORD_0': 2 }, 'mode': 6 }] }],"
        "'nodes': [{ 'mesh': 0 }]");
}

static void tangents_follow_u_and_bitangents_point_up_the_texture(void **state)
{
    gltf_case *c = *state;
    static const struct {
        float uv[8], tangent[4];
    } cases[] = {
        { { 0, 1, 1, 1, 1, 0, 0, 0 }, { 1, 0, 0, 1 } },   /* as a picture hangs */
        { { 1, 1, 0, 1, 0, 0, 1, 0 }, { -1, 0, 0, -1 } }, /* mirrored */
        { { 0, 0, 0, 1, 1, 1, 1, 0 }, { 0, 1, 0, 1 } },   /* turned left by 90 degrees */
    };
    for (size_t i = 0; i < 3; i++) {
        write_square(c, cases[i].uv);
        gltf_case_accepted(c);
        const scene_mesh *m = &c->scene.meshes[0];
        assert_int_equal(m->vertex_count, 4);
        for (uint32_t v = 0; v < 4; v++) {
            assert_true(m->normal[3 * v + 2] == 1.0F); /* of length 2 in the file */
            for (uint32_t k = 0; k < 4; k++)
                assert_true(fabsf(m->tangent[4 * v + k] - cases[i].tangent[k]) < 1e-6F);
        }
    }
}

/* A sphere of longitude u and latitude v: the tangent of its parametrisation is (-sin, 0, -cos) of the longitude.
 * Between the poles MikkTSpace on triangles differs from it by less than a step of the mesh. */
enum {
    SLICES = 48,
    STACKS = 24,
    SPHERE_VERTICES = (SLICES + 1) * (STACKS + 1),
    SPHERE_TRIANGLES = 2 * SLICES * STACKS
};

typedef struct sphere {
    float position[3 * SPHERE_VERTICES], texcoord[2 * SPHERE_VERTICES];
    uint32_t index[3 * SPHERE_TRIANGLES];
} sphere;

static const double pi = 3.14159265358979323846;

static void make_sphere(sphere *s)
{
    for (size_t j = 0, n = 0; j <= STACKS; j++)
        for (size_t i = 0; i <= SLICES; i++, n++) {
            const double longitude = 2.0 * pi * (double)i / SLICES, polar = pi * (double)j / STACKS;
            s->position[3 * n] = (float)(sin(polar) * cos(longitude));
            s->position[3 * n + 1] = (float)cos(polar);
            s->position[3 * n + 2] = (float)(-sin(polar) * sin(longitude));
            s->texcoord[2 * n] = (float)i / SLICES;
            s->texcoord[2 * n + 1] = (float)j / STACKS;
        }
    uint32_t *out = s->index;
    for (uint32_t j = 0; j < STACKS; j++)
        for (uint32_t i = 0; i < SLICES; i++) {
            const uint32_t a = j * (SLICES + 1) + i, b = a + SLICES + 1;
            const uint32_t quad[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(out, quad, sizeof quad);
            out += 6;
        }
}

static void tangents_of_a_sphere_follow_its_parallels(void **state)
{
    (void)state;
    sphere *s = calloc(1, sizeof *s);
    float *tangents = calloc(SPHERE_TRIANGLES, 12 * sizeof *tangents);
    assert_true(s && tangents);
    make_sphere(s);
    const tangent_space_input in = {
        SPHERE_VERTICES, SPHERE_TRIANGLES, s->position, s->position, s->texcoord, s->index
    };
    assert_true(tangent_space_compute(&in, tangents));
    for (size_t corner = 0; corner < (size_t)3 * SPHERE_TRIANGLES; corner++) {
        const float *n = &s->position[3 * (size_t)s->index[corner]], *t = &tangents[4 * corner];
        assert_true(fabsf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1.0F) < 1e-5F);
        assert_true(fabsf(t[0] * n[0] + t[1] * n[1] + t[2] * n[2]) < 1e-5F);
        if (fabsf(n[1]) > 0.9F)
            continue;
        const double longitude = atan2(-(double)n[2], (double)n[0]);
        const double along = -sin(longitude) * (double)t[0] - cos(longitude) * (double)t[2];
        if (!(along > cos(2.0 * pi / SLICES)) || t[3] != 1.0F)
            fail_msg("corner %zu: tangent %g %g %g %g", corner, (double)t[0], (double)t[1], (double)t[2], (double)t[3]);
    }
    free(s);
    free(tangents);
}

/* Two halves that share an edge whose texture is mirrored across it: tangents differ there, so its vertices are split.
 */
static void mirrored_texture_splits_the_vertices_of_its_seam(void **state)
{
    (void)state;
    static const float position[12] = { 0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0 };
    static const float normal[12] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    static const float texcoord[8] = { 0, 1, 0, 0, 1, 1, 1, 1 };
    static const uint32_t index[6] = { 0, 2, 1, 0, 1, 3 };
    const tangent_space_input in = { 4, 2, position, normal, texcoord, index };
    float t[24];
    assert_true(tangent_space_compute(&in, t));
    for (size_t corner = 0; corner < 6; corner++) {
        const float side = corner < 3 ? 1.0F : -1.0F;
        assert_true(fabsf(t[4 * corner] - side) < 1e-6F && t[4 * corner + 3] == side);
    }
}

static void unusable_texture_coordinates_still_give_unit_tangents(void **state)
{
    (void)state;
    static const float position[18] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2, 2, 2, 2, 3, 3, 3 };
    static const float normal[18] = { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.6F, 0.8F, 0, 0, 0, 1, 0, 1, 0 };
    static const float texcoord[12] = { 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0, 0, 1, 0, 0, 1 };
    static const uint32_t index[6] = { 0, 1, 2, 3, 4, 5 };
    const tangent_space_input in = { 6, 2, position, normal, texcoord, index };
    float t[24];
    assert_true(tangent_space_compute(&in, t));
    for (size_t i = 0; i < 6; i++) {
        const float *v = &t[4 * i], *n = &normal[3 * i];
        assert_true(fabsf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1.0F) < 1e-6F);
        assert_true(fabsf(v[0] * n[0] + v[1] * n[1] + v[2] * n[2]) < 1e-6F);
        assert_true(v[3] == 1.0F);
    }
}

static void morph_targets_stand_at_the_weights_of_the_mesh(void **state)
{
    gltf_case *c = *state;
    static const float data[27] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 4, 0, 0, 4, 8, 0, 0, 8, 0, 0, 8, 0, 0 };
    static const char *const format =
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 108 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 36, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 72, 'componentType': 5126, 'count': %d, 'type': 'VEC3' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 }, 'targets': ["
        "{ 'POSITION': 1 }, { 'POSITION': 2 }] }], 'weights': [%s] }], 'nodes': [{ 'mesh': 0 }]";
    gltf_case_json_with_buffer(c, data, sizeof data, format, 3, "0.5, 0.25");
    gltf_case_accepted(c);
    gltf_case_warned(c, "morph targets stand still");
    static const float expected[9] = { 2, 0, 2, 3, 0, 2, 2, 1, 2 };
    assert_memory_equal(c->scene.meshes[0].position, expected, sizeof expected);
    gltf_case_json_with_buffer(c, data, sizeof data, format, 2, "0.5, 0.25");
    gltf_case_refused(c, "/meshes/0/primitives/0/targets/1/POSITION: found 2 elements, expected 3", NULL);
    gltf_case_json_with_buffer(c, data, sizeof data, format, 3, "1e38, 1e38");
    gltf_case_refused(c, "/meshes/0/primitives/0/targets: found weights that move a vertex to infinity", NULL);
}

/* Exporters share one large set of vertices between many primitives. */
static void vertices_that_no_triangle_uses_are_dropped(void **state)
{
    gltf_case *c = *state;
    float data[3 * 1000 * 2 + 3] = { 0 };
    for (size_t i = 0; i < 1000; i++) {
        data[3 * i] = (float)i;
        data[3000 + 3 * i + 2] = 1.0F;
    }
    static const uint16_t indices[6] = { 7, 900, 33, 33, 900, 999 };
    memcpy(data + 6000, indices, 12);
    gltf_case_json_with_buffer(
        c, data, sizeof data,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 24000 }, { 'buffer': 0, 'byteOffset': 24000, 'byteLength': 12 }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 1000, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 12000, 'componentType': 5126, 'count': 1000, 'type': 'VEC3' },"
        "{ 'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0, 'NORMAL': 1 }, 'indices': 2 }] }],"
        "'nodes': [{ 'mesh': 0 }]");
    gltf_case_accepted(c);
    const scene_mesh *m = &c->scene.meshes[0];
    assert_int_equal(m->vertex_count, 4);
    for (uint32_t i = 0; i < 6; i++)
        assert_true(m->position[3 * (size_t)m->index[i]] == (float)indices[i]);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(strips_and_fans_keep_their_winding),
        TEST(wrong_corners_are_refused),
        TEST(points_and_lines_are_left_out_with_a_warning),
        TEST(missing_normals_are_flat_and_face_the_winding),
        TEST(tangents_follow_u_and_bitangents_point_up_the_texture),
        TEST(tangents_of_a_sphere_follow_its_parallels),
        TEST(mirrored_texture_splits_the_vertices_of_its_seam),
        TEST(unusable_texture_coordinates_still_give_unit_tangents),
        TEST(morph_targets_stand_at_the_weights_of_the_mesh),
        TEST(vertices_that_no_triangle_uses_are_dropped),
    };
    return cmocka_run_group_tests_name("gltf_geometry", tests, NULL, NULL);
}
