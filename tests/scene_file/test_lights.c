/* Lights of real size in files: EXT_lights_area and EXT_lights_image_based, and what is refused of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"
#include "io/scene_file.h"

#define AREA(lights, nodes)                                                                                            \
    "'extensionsUsed': ['EXT_lights_area'], 'extensions': { 'EXT_lights_area': { 'lights': [" lights "] } },"          \
    "'nodes': [" nodes "]"
#define USES(number) "'extensions': { 'EXT_lights_area': { 'light': " number " } }"

static void assert_close(float found, double expected)
{
    if (!(fabs((double)found - expected) <= 1e-6 * fabs(expected)))
        fail_msg("found %.9g, expected %.9g", (double)found, expected);
}

/* The draft's own example, and its defaults. */
static void area_lights_have_the_size_that_the_draft_says(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(
        c, AREA("{ 'type': 'rect', 'name': 'panel', 'color': [1, 0.5, 0.25], 'intensity': 20, 'size': 1.5,"
                "  'rect': { 'aspect': 2 } },"
                "{ 'type': 'disk', 'intensity': 1500, 'size': 1.2, 'rect': { 'aspect': 7 } },"
                "{ 'type': 'rect' }",
                "{ 'translation': [1, 2, 3], " USES("0") "},{" USES("1") ", 'name': 'lamp' }, {" USES("2") "}"));
    gltf_case_accepted(c);
    assert_int_equal(c->scene.light_count, 3);
    const scene_light *l = c->scene.lights;
    assert_int_equal(l[0].kind, SCENE_LIGHT_RECT);
    assert_string_equal(l[0].name, "panel");
    assert_close(l[0].width_m, 3.0);
    assert_close(l[0].height_m, 1.5);
    assert_true(l[0].color[1] == 0.5F && l[0].intensity == 20.0F && l[0].to_world[13] == 2.0F);
    assert_int_equal(l[1].kind, SCENE_LIGHT_DISK);
    assert_string_equal(l[1].name, "lamp");
    assert_close(l[1].width_m, 1.2); /* the aspect is a rectangle's */
    assert_close(l[1].height_m, 1.2);
    assert_true(l[2].intensity == 1000.0F && l[2].width_m == 1.0F && l[2].height_m == 1.0F && l[2].color[0] == 1.0F);
}

/* "The scaling is always uniform and positive": by the largest of the world's scales, whatever the node's turn. */
static void area_lights_grow_with_the_largest_scale_of_their_node(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, AREA("{ 'type': 'rect', 'size': 0.5, 'rect': { 'aspect': 3 } }",
                           "{ 'scale': [2, 2, 2], 'children': [1] },"
                           "{ 'scale': [1, -5, 3], 'rotation': [0.6, 0, 0, 0.8], " USES("0") "}"));
    gltf_case_accepted(c);
    assert_close(c->scene.lights[0].height_m, 5.0);
    assert_close(c->scene.lights[0].width_m, 15.0);
}

static void area_lights_that_cannot_be_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *light, *place;
    } wrong[] = {
        { "'type': 'sphere'", "/type: found \"sphere\"" },
        { "'intensity': 1", ": found no \"type\"" },
        { "'type': 'rect', 'size': 0", "/size: found 0, expected a number above 0" },
        { "'type': 'disk', 'size': -1", "/size: found -1, expected a number above 0" },
        { "'type': 'disk', 'size': 'nan'", "/size: found \"nan\", expected a number" },
        { "'type': 'rect', 'rect': { 'aspect': 0 }", "/rect/aspect: found 0, expected a number above 0" },
        { "'type': 'rect', 'rect': 2", "/rect: found 2, expected an object" },
        { "'type': 'rect', 'intensity': -3", "/intensity: found -3" },
        { "'type': 'rect', 'intensity': 1e300", "/intensity: found 1e+300" },
        { "'type': 'rect', 'color': [1, 1, -1]", "/color/2: found -1" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char says[160];
        gltf_case_json(c, AREA("{ %s }", "{" USES("0") "}"), wrong[i].light);
        snprintf(says, sizeof says, "/extensions/EXT_lights_area/lights/0%s", wrong[i].place);
        gltf_case_refused(c, says, NULL);
    }
    gltf_case_json(c, AREA("{ 'type': 'rect' }", "{" USES("1") "}"));
    gltf_case_refused(c, "/nodes/0/extensions/EXT_lights_area/light: found 1, expected an index", NULL);
    gltf_case_json(c, AREA("{ 'type': 'rect', 'size': 1e30 }", "{ 'scale': [1e20, 1, 1], " USES("0") "}"));
    gltf_case_refused(c, "/nodes/0: found an area light whose size in the world is beyond single precision", NULL);
}

static void area_light_scaled_to_nothing_is_left_out_with_a_warning(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, AREA("{ 'type': 'disk' }", "{ 'scale': [0, 1, 1], " USES("0") "}"));
    gltf_case_accepted(c);
    gltf_case_warned(c, "/nodes/0: is scaled to nothing; its area light is left out");
    assert_int_equal(c->scene.light_count, 0);
}

/* ---- image-based light ---- */

#define COEFFICIENTS                                                                                                   \
    "'irradianceCoefficients': [[1,1,1],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]"
#define FACES "'specularImages': [[5, 4, 3, 2, 1, 0]]"
#define SIX_IMAGES                                                                                                     \
    "'images': [{ 'uri': 'a.png' }, { 'uri': 'b.png' }, { 'uri': 'c.png' }, { 'uri': 'd.png' }, { 'uri': 'e.png' },"   \
    "{ 'uri': 'f.png' }],"
#define SCENE_USES(number) "'scenes': [{ 'extensions': { 'EXT_lights_image_based': { 'light': " number " } } }]"
#define IMAGE_BASED(light)                                                                                             \
    SIX_IMAGES "'extensions': { 'EXT_lights_image_based': { 'lights': [{ " light " }] } }," SCENE_USES("0")

static void image_based_light_is_the_one_of_the_scene_that_is_shown(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, IMAGE_BASED("'name': 'studio', 'intensity': 2.5, 'rotation': [0, 0.6, 0, 0.8],"
                                  "'specularImageSize': 64, " FACES "," COEFFICIENTS));
    gltf_case_accepted(c);
    const scene_environment *e = &c->scene.environment;
    assert_true(e->present && e->intensity == 2.5F && e->rotation[1] == 0.6F && e->rotation[3] == 0.8F);
    assert_string_equal(e->name, "studio");
    for (int face = 0; face < 6; face++)
        assert_int_equal(e->faces[face], 5 - face);

    char *text = scene_describe(&c->scene, false);
    assert_non_null(text);
    assert_non_null(strstr(text, "environment studio: intensity 2.5"));
    assert_null(strstr(text, "lookdev rig"));
    free(text);

    gltf_case_json(c,
                   SIX_IMAGES "'extensions': { 'EXT_lights_image_based': { 'lights': [{ 'specularImageSize': 8," FACES
                              "," COEFFICIENTS "}] } }, 'scenes': [{}]");
    gltf_case_accepted(c);
    assert_false(c->scene.environment.present);
}

static void image_based_lights_that_cannot_be_are_refused(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *light, *place;
    } wrong[] = {
        { FACES "," COEFFICIENTS, ": found no \"specularImageSize\"" },
        { "'specularImageSize': 8," COEFFICIENTS, ": found no \"specularImages\"" },
        { "'specularImageSize': 8," FACES, ": found no \"irradianceCoefficients\"" },
        { "'specularImageSize': 8, 'specularImages': []," COEFFICIENTS,
          "/specularImages: found an array of 0, expected an array of mip levels" },
        { "'specularImageSize': 8, 'specularImages': 7," COEFFICIENTS, "/specularImages: found 7" },
        { "'specularImageSize': 8, 'specularImages': [[0,1,2]]," COEFFICIENTS,
          "/specularImages/0: found an array of 3, expected an array of 6 images" },
        { "'specularImageSize': 8, 'specularImages': [[0,1,2,3,4,6]]," COEFFICIENTS,
          "/specularImages/0/5: found 6, expected an index into \"images\", of which there are 6" },
        { "'specularImageSize': 8, 'specularImages': [[0,1,2,3,4,-1]]," COEFFICIENTS, "/specularImages/0/5: found -1" },
        { "'specularImageSize': 8," FACES ", 'irradianceCoefficients': [[1,1,1]]",
          "/irradianceCoefficients: found an array of 1, expected an array of 9 colours" },
        { "'specularImageSize': 8," FACES ", 'rotation': [0, 0, 0, 0]," COEFFICIENTS,
          "/rotation: found a quaternion of length 0" },
        { "'specularImageSize': 8," FACES ", 'rotation': [0, 0, 1]," COEFFICIENTS, "/rotation: found an array of 3" },
        { "'specularImageSize': 8," FACES ", 'intensity': -1," COEFFICIENTS, "/intensity: found -1" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char says[200];
        gltf_case_json(c, IMAGE_BASED("%s"), wrong[i].light);
        snprintf(says, sizeof says, "/extensions/EXT_lights_image_based/lights/0%s", wrong[i].place);
        gltf_case_refused(c, says, NULL);
    }
    gltf_case_json(c, SCENE_USES("0"));
    gltf_case_refused(c, "/scenes/0/extensions/EXT_lights_image_based/light: found 0, expected an index", NULL);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(area_lights_have_the_size_that_the_draft_says),
        TEST(area_lights_grow_with_the_largest_scale_of_their_node),
        TEST(area_lights_that_cannot_be_are_refused),
        TEST(area_light_scaled_to_nothing_is_left_out_with_a_warning),
        TEST(image_based_light_is_the_one_of_the_scene_that_is_shown),
        TEST(image_based_lights_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
