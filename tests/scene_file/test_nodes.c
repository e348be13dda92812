/* The node graph: transforms, trees, instancing, cameras and lights. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"

/* A mesh of one triangle, and the nodes of the test. */
static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

#define WITH_MESH                                                                                                      \
    "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }],"                                                              \
    "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }],"                           \
    "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } }] }],"

static void write_nodes(gltf_case *c, const char *nodes)
{
    gltf_case_json_with_buffer(c, triangle, sizeof triangle, WITH_MESH "%s", nodes);
}

/* Where an instance puts a point. */
static void place(const scene_instance *i, const float p[3], float out[3])
{
    const float *m = i->to_world;
    for (int k = 0; k < 3; k++)
        out[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
}

static void assert_near(const float found[3], float x, float y, float z)
{
    const float expected[3] = { x, y, z };
    for (int k = 0; k < 3; k++)
        if (!(fabsf(found[k] - expected[k]) < 1e-5F))
            fail_msg("found %g %g %g, expected %g %g %g", (double)found[0], (double)found[1], (double)found[2],
                     (double)x, (double)y, (double)z);
}

/* Scaled by (1, -2, 3), turned by 90 degrees about z (x to y, y to -x), moved by (10, 0, 0); the parent doubles and
 * lifts by 5. */
static void transforms_scale_then_turn_then_move_and_chain(void **state)
{
    gltf_case *c = *state;
    static const char *const child[] = {
        "'translation': [10, 0, 0], 'rotation': [0, 0, 1.41421356, 1.41421356], 'scale': [1, -2, 3]", /* of length 2 */
        "'matrix': [0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 3, 0, 10, 0, 0, 1]",
    };
    for (size_t i = 0; i < 2; i++) {
        char nodes[512];
        snprintf(nodes, sizeof nodes,
                 "'nodes': [{ 'children': [1], 'scale': [2, 2, 2], 'translation': [0, 5, 0] }, { 'mesh': 0, 'name': "
                 "'leaf', %s }]",
                 child[i]);
        write_nodes(c, nodes);
        gltf_case_accepted(c);
        const scene_instance *instance = &c->scene.instances[0];
        assert_string_equal(instance->name, "leaf");
        assert_int_equal(instance->node, 1);
        float p[3];
        place(instance, (const float[]){ 1, 0, 0 }, p);
        assert_near(p, 20, 7, 0);
        place(instance, (const float[]){ 0, 1, 1 }, p);
        assert_near(p, 24, 5, 6);
        assert_near(c->scene.bounds_min, 20, 5, 0);
        assert_near(c->scene.bounds_max, 24, 7, 0);
    }
}

static void transforms_that_are_none_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *node, *says;
    } wrong[] = {
        { "'rotation': [0, 0, 0, 0]", "/nodes/0/rotation: found a quaternion of length 0" },
        { "'matrix': [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]",
          "/nodes/0/matrix: found a matrix whose last row" },
        { "'matrix': [1, 0, 0]", "/nodes/0/matrix: found an array of 3, expected an array of 16 numbers" },
        { "'matrix': [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], 'scale': [1, 1, 1]",
          "/nodes/0: found both \"matrix\" and \"scale\"" },
        { "'scale': [1, 1, 'x']", "/nodes/0/scale/2: found \"x\", expected a number" },
        { "'mesh': 1", "/nodes/0/mesh: found 1, expected an index into \"meshes\", of which there is 1" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char nodes[256];
        snprintf(nodes, sizeof nodes, "'nodes': [{ %s }]", wrong[i].node);
        write_nodes(c, nodes);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
    write_nodes(c, "'nodes': [{ 'scale': [1e38, 1, 1], 'children': [1] }, { 'mesh': 0, 'scale': [1e38, 1, 1] }]");
    gltf_case_refused(c, "/nodes/1: found transforms that multiply to numbers beyond single precision", NULL);
}

static void mesh_scaled_to_nothing_is_left_out_with_a_warning(void **state)
{
    gltf_case *c = *state;
    write_nodes(c, "'nodes': [{ 'mesh': 0, 'scale': [1, 0, 1] }, { 'mesh': 0 }]");
    gltf_case_accepted(c);
    gltf_case_warned(c, "/nodes/0: is scaled to nothing");
    assert_int_equal(c->scene.instance_count, 1);
    assert_int_equal(c->scene.instances[0].node, 1);
}

static void nodes_that_are_no_trees_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *nodes, *says;
    } wrong[] = {
        { "'nodes': [{ 'children': [0] }]", "/nodes/0: found a node in a cycle" },
        { "'nodes': [{}, { 'children': [2] }, { 'children': [3] }, { 'children': [1] }]",
          "/nodes/1: found a node in a cycle" },
        { "'nodes': [{ 'children': [2] }, { 'children': [2] }, {}]",
          "/nodes/1/children: found node 2, which is already a child of node 0" },
        { "'nodes': [{ 'children': [1, 1] }, {}]", "/nodes/0/children/1: found 1, expected each value only once" },
        { "'nodes': [{ 'children': [1] }, {}], 'scenes': [{ 'nodes': [1] }]",
          "/scenes/0/nodes: found node 1, which is a child of node 0" },
        { "'nodes': [{ 'children': [1] }]", "/nodes/0/children/0: found 1, expected an index" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json(c, "%s", wrong[i].nodes);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
}

static void chain_of_a_hundred_thousand_nodes_is_walked(void **state)
{
    gltf_case *c = *state;
    enum { DEPTH = 100000 };
    char *text = calloc(DEPTH, 40), *end = text;
    assert_non_null(text);
    end += sprintf(end, "'nodes': [");
    for (int i = 1; i < DEPTH; i++)
        end += sprintf(end, "{'children':[%d]},", i);
    sprintf(end, "{'mesh':0}]");
    write_nodes(c, text);
    gltf_case_accepted(c);
    assert_int_equal(c->scene.instance_count, 1);
    free(text);
}

static void scene_is_the_named_one_or_the_first_or_all_roots(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *scenes;
        int instances;
    } cases[] = { { "", 3 },
                  { "'scenes': [{ 'nodes': [1] }, { 'nodes': [0, 1, 2] }],", 1 },
                  { "'scene': 1, 'scenes': [{ 'nodes': [1] }, { 'nodes': [0, 1] }],", 2 } };
    for (size_t i = 0; i < 3; i++) {
        char nodes[256];
        snprintf(nodes, sizeof nodes, "%s 'nodes': [{ 'mesh': 0 }, { 'mesh': 0 }, { 'mesh': 0 }]", cases[i].scenes);
        write_nodes(c, nodes);
        gltf_case_accepted(c);
        assert_int_equal(c->scene.instance_count, cases[i].instances);
        assert_int_equal(c->scene.mesh_count, 1);
    }
}

static void gpu_instances_are_placed_under_their_node(void **state)
{
    gltf_case *c = *state;
    write_nodes(c, "'nodes': [{ 'mesh': 0, 'translation': [0, 0, 7], 'extensions': { 'EXT_mesh_gpu_instancing': {"
                   " 'attributes': { 'TRANSLATION': 0 } } } }]");
    gltf_case_accepted(c);
    assert_int_equal(c->scene.instance_count, 3);
    for (size_t i = 0; i < 3; i++)
        assert_near(&c->scene.instances[i].to_world[12], triangle[3 * i], triangle[3 * i + 1], 7);
}

/* 1000 instances of 1000 meshes would be 10^6 from a file of some kilobytes; a file of the allowance is still read. */
static void instances_beyond_the_size_of_the_file_are_refused(void **state)
{
    gltf_case *c = *state;
    enum { NODES = 1200, PRIMITIVES = 1200 };
    char *text = calloc(NODES + PRIMITIVES, 48), *end = text;
    assert_non_null(text);
    end += sprintf(
        end, "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }], 'accessors': ["
             "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }], 'meshes': [{ 'primitives': [");
    for (int i = 0; i < PRIMITIVES; i++)
        end += sprintf(end, "%s{'attributes':{'POSITION':0}}", i > 0 ? "," : "");
    end += sprintf(end, "] }], 'nodes': [");
    for (int i = 0; i < NODES; i++)
        end += sprintf(end, "%s{'mesh':0}", i > 0 ? "," : "");
    sprintf(end, "]");
    gltf_case_json_with_buffer(c, triangle, sizeof triangle, "%s", text);
    gltf_case_refused(c, "found more instances than the bytes of the file account for", NULL);
    free(text);
}

/* Joint 1 at (0, 3, 0) with the inverse bind matrix of a move by (0, -1, 0): what is left is a move by (0, 2, 0). */
static void skins_stand_in_their_bind_pose(void **state)
{
    gltf_case *c = *state;
    float data[9 + 16] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1 };
    gltf_case_json_with_buffer(
        c, data, sizeof data,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 100 }], 'accessors': ["
        "{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' },"
        "{ 'bufferView': 0, 'byteOffset': 36, 'componentType': 5126, 'count': 1, 'type': 'MAT4' }],"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } }] }],"
        "'skins': [{ 'joints': [1], 'inverseBindMatrices': 1 }],"
        "'nodes': [{ 'mesh': 0, 'skin': 0, 'translation': [100, 0, 0] }, { 'translation': [0, 3, 0] }]");
    gltf_case_accepted(c);
    gltf_case_warned(c, "/nodes/0: skins stand still, in their bind pose");
    assert_near(&c->scene.instances[0].to_world[12], 0, 2, 0);
}

static void cameras_that_cannot_be_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *camera, *says;
    } wrong[] = {
        { "'type': 'perspective'", "/cameras/0: found no \"perspective\"" },
        { "'type': 'fisheye'", "/cameras/0/type: found \"fisheye\", expected one of perspective|orthographic" },
        { "'type': 'perspective', 'perspective': { 'yfov': 3.2, 'znear': 1 }",
          "/cameras/0/perspective/yfov: found 3.2" },
        { "'type': 'perspective', 'perspective': { 'yfov': 0, 'znear': 1 }", "/cameras/0/perspective/yfov: found 0" },
        { "'type': 'perspective', 'perspective': { 'yfov': 1, 'znear': 1, 'zfar': 1 }",
          "/cameras/0/perspective/zfar: found 1" },
        { "'type': 'perspective', 'perspective': { 'yfov': 1 }", "/cameras/0/perspective: found no \"znear\"" },
        { "'type': 'orthographic', 'orthographic': { 'xmag': 0, 'ymag': 1, 'zfar': 2, 'znear': 1 }",
          "/cameras/0/orthographic/xmag: found 0" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json(c, "'cameras': [{ %s }]", wrong[i].camera);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
}

static void lights_keep_their_numbers_and_their_size(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'extensionsUsed': ['KHR_lights_punctual'], 'extensions': { 'KHR_lights_punctual': { 'lights': ["
                      "{ 'type': 'directional', 'intensity': 3, 'extras': { 'angularDiameter': 0.02 } },"
                      "{ 'type': 'point', 'color': [1, 0.5, 0.25], 'range': 8, 'extras': { 'radius': 0.3 } },"
                      "{ 'type': 'spot', 'name': 'lamp', 'spot': { 'innerConeAngle': 0.1, 'outerConeAngle': 0.4 } },"
                      "{ 'type': 'spot', 'spot': {} }, { 'type': 'directional' }] } },"
                      "'nodes': [{ 'name': 'sun', 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } },"
                      "{ 'translation': [1, 2, 3], 'extensions': { 'KHR_lights_punctual': { 'light': 1 } } },"
                      "{ 'extensions': { 'KHR_lights_punctual': { 'light': 2 } } }, { 'extensions': { "
                      "'KHR_lights_punctual': { 'light': 3 } } },"
                      "{ 'extensions': { 'KHR_lights_punctual': { 'light': 4 } } }]");
    gltf_case_accepted(c);
    assert_int_equal(c->scene.light_count, 5);
    const scene_light *l = c->scene.lights;
    assert_int_equal(l[0].kind, SCENE_LIGHT_DIRECTIONAL);
    assert_string_equal(l[0].name, "sun");
    assert_true(l[0].intensity == 3.0F && l[0].angular_diameter_rad == 0.02F && l[0].color[2] == 1.0F);
    assert_int_equal(l[1].kind, SCENE_LIGHT_POINT);
    assert_true(l[1].color[1] == 0.5F && l[1].range == 8.0F && l[1].radius_m == 0.3F && l[1].intensity == 1.0F);
    assert_near(&l[1].to_world[12], 1, 2, 3);
    assert_int_equal(l[2].kind, SCENE_LIGHT_SPOT);
    assert_string_equal(l[2].name, "lamp");
    assert_true(l[2].inner_cone_rad == 0.1F && l[2].outer_cone_rad == 0.4F && l[2].radius_m == 0.01F &&
                l[2].range == 0.0F);
    assert_true(l[3].inner_cone_rad == 0.0F && fabsf(l[3].outer_cone_rad - 0.78539816F) < 1e-6F);
    assert_true(l[4].angular_diameter_rad == 0.00929F);
}

static void lights_that_cannot_be_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *light, *place;
    } wrong[] = {
        { "'type': 'area'", "/type: found \"area\"" },
        { "'type': 'spot'", ": found no \"spot\"" },
        { "'type': 'spot', 'spot': { 'innerConeAngle': 0.5, 'outerConeAngle': 0.5 }",
          "/spot/innerConeAngle: found 0.5" },
        { "'type': 'spot', 'spot': { 'outerConeAngle': 1.6 }", "/spot/outerConeAngle: found 1.6" },
        { "'type': 'point', 'intensity': -1", "/intensity: found -1" },
        { "'type': 'point', 'range': 0", "/range: found 0, expected a number above 0" },
        { "'type': 'point', 'color': [1, 1]", "/color: found an array of 2, expected an array of 3 numbers" },
        { "'type': 'point', 'extras': { 'radius': -1 }", "/extras/radius: found -1" },
        { "'type': 'point', 'extras': { 'radius': 'big' }", "/extras/radius: found no number" },
        { "'type': 'directional', 'extras': { 'angularDiameter': 4 }", "/extras/angularDiameter: found 4" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        gltf_case_json(c,
                       "'extensions': { 'KHR_lights_punctual': { 'lights': [{ %s }] } },"
                       "'nodes': [{ 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } }]",
                       wrong[i].light);
        char says[128];
        snprintf(says, sizeof says, "/extensions/KHR_lights_punctual/lights/0%s", wrong[i].place);
        gltf_case_refused(c, says, NULL);
    }
    gltf_case_json(c, "'nodes': [{ 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } }]");
    gltf_case_refused(c, "/nodes/0/extensions/KHR_lights_punctual/light: found 0, expected an index", NULL);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(transforms_scale_then_turn_then_move_and_chain),
        TEST(transforms_that_are_none_are_refused),
        TEST(mesh_scaled_to_nothing_is_left_out_with_a_warning),
        TEST(nodes_that_are_no_trees_are_refused),
        TEST(chain_of_a_hundred_thousand_nodes_is_walked),
        TEST(scene_is_the_named_one_or_the_first_or_all_roots),
        TEST(gpu_instances_are_placed_under_their_node),
        TEST(instances_beyond_the_size_of_the_file_are_refused),
        TEST(skins_stand_in_their_bind_pose),
        TEST(cameras_that_cannot_be_are_refused),
        TEST(lights_keep_their_numbers_and_their_size),
        TEST(lights_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests_name("gltf_nodes", tests, NULL, NULL);
}
