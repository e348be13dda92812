/* glint export povray as users run it: what it writes renders in POV-Ray without a warning, whatever the scene is
 * called and lacks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>
#include <jansson.h>

#include "povray_run.h"
#include "run_glint.h"
#include "workplace.h"

/* Small, and without antialiasing: that it renders is what counts here. */
#define SMALL "--size", "32x24"
#define QUICK "-A"

static int enter(void **state)
{
    const int result = workplace_enter(state);
    if (result == 0)
        scene_write("plane");
    return result;
}

#define export(...)                                                                                                    \
    do {                                                                                                               \
        outcome exported = glint_run(NULL, "export", "povray", __VA_ARGS__);                                           \
        assert_exit(&exported, 0);                                                                                     \
        outcome_free(&exported);                                                                                       \
    } while (0)

static void assert_renders(const char *folder, const char *name)
{
    image picture = povray_render_ini(folder, name, QUICK);
    assert_true(picture.width > 0);
    image_free(&picture);
}

static json_t *document_of(const outcome *o)
{
    json_error_t error;
    json_t *d = json_loads(o->out, 0, &error);
    if (!d)
        fail_msg("line %d: %s in: %s", error.line, error.text, o->out);
    return d;
}

/* ---- forms ---- */

static void each_form_renders_and_auto_takes_exact_on_a_plane(void **state)
{
    (void)state;
    static const struct {
        const char *asked, *got;
    } forms[] = { { "auto", "exact" },
                  { "portable", "portable" },
                  { "exact", "exact" },
                  { "analytic", "analytic" },
                  { "mesh", "mesh" } };
    /* Flakes of a centimetre: the mesh has ten thousand. */
    file_write_text("coarse.gltf-material.json",
                    "{\"name\":\"coarse\",\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.6},"
                    "\"extensions\":{\"GLINT_materials_glint\":{\"glintFactor\":1,\"glintDensity\":1e4,"
                    "\"glintDistribution\":\"beckmann\",\"glintFacetRoughness\":0.3,\"glintSpace\":\"object\"}}}");
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        outcome o = glint_run(NULL, "export", "povray", "plane.gltf", "-o", forms[i].asked, SMALL, "--json", "--form",
                              forms[i].asked, "--material", "*=./coarse.gltf-material.json");
        assert_exit(&o, 0);
        json_t *d = document_of(&o);
        assert_string_equal(
            json_string_value(json_object_get(json_array_get(json_object_get(d, "objects"), 0), "form")), forms[i].got);
        json_decref(d);
        outcome_free(&o);
        assert_renders(forms[i].asked, "plane");
    }
}

static void same_input_gives_the_same_bytes(void **state)
{
    (void)state;
    export("plane.gltf", "-o", "a", SMALL, "--material", "*=snow");
    export("plane.gltf", "-o", "b", SMALL, "--material", "*=snow");
    static const char *const files[] = { "glint.inc", "plane_materials.inc", "plane.pov", "plane.ini" };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        char a[64], b[64];
        snprintf(a, sizeof a, "a/%s", files[i]);
        snprintf(b, sizeof b, "b/%s", files[i]);
        assert_same_files(a, b);
    }
    assert_int_equal(folder_count("a"), 4);
}

/* ---- names ---- */

static void hostile_names_are_names_of_nothing(void **state)
{
    (void)state;
    static const char *const names[] = { "\\\"",
                                         "*/ #end }",
                                         "/*",
                                         "a\\nb\\r\\u0000c",
                                         "\\u00fc\\u4e2d\\ud83d\\ude00",
                                         "sphere",
                                         "",
                                         "../../etc/passwd",
                                         "#include \\\"x\\\"",
                                         "Glint_Size",
                                         "%s%n",
                                         "\\\\" };
    char *long_name = malloc(10001);
    memset(long_name, 'x', 10000);
    long_name[10000] = '\0';
    for (size_t i = 0; i <= sizeof names / sizeof names[0]; ++i) {
        const bool is_long = i == sizeof names / sizeof names[0];
        const char *name = is_long ? long_name : names[i];
        char *text = NULL;
        size_t size;
        FILE *scene_file = open_memstream(&text, &size);
        fprintf(
            scene_file,
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
            "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":"
            "[{\"type\":\"point\",\"intensity\":5,\"name\":\"%s\"}]}},"
            "\"nodes\":[{\"mesh\":0,\"name\":\"%s\"},{\"translation\":[0,2,0],\"extensions\":"
            "{\"KHR_lights_punctual\":{\"light\":0}},\"name\":\"%s\"}],"
            "\"materials\":[{\"name\":\"%s\"}],\"meshes\":[{\"name\":\"%s\",\"primitives\":[{\"attributes\":"
            "{\"POSITION\":0},\"material\":0}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
            "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,0,1]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
            "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/\"}]}",
            name, name, name, name, name);
        fclose(scene_file);
        file_write_text("names.gltf", text);
        free(text);
        export("names.gltf", "-o", "names", SMALL);
        assert_renders("names", "names");
    }
    free(long_name);
}

static void hostile_file_names_make_plain_ones(void **state)
{
    (void)state;
    scene_write("-a b;$(x)'\"");
    export("-o", "odd", SMALL, "--", "-a b;$(x)'\".gltf");
    assert_renders("odd", "_a_b___x___");
}

/* A matte floor below a spot light, seen from above: bright in the inner cone, as glint render has it, dark outside of
 * the outer one, and in between less than it would be without the cone. */
static void spot_light_has_the_cone_of_the_file(void **state)
{
    (void)state;
    file_write_text("spot.gltf",
                    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],"
                    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_materials_specular\"],"
                    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":5,"
                    "\"spot\":{\"innerConeAngle\":0.2,\"outerConeAngle\":0.5}}]}},"
                    "\"cameras\":[{\"type\":\"orthographic\","
                    "\"orthographic\":{\"xmag\":2,\"ymag\":1.5,\"znear\":0.1,\"zfar\":10}}],"
                    "\"nodes\":[{\"mesh\":0},"
                    "{\"translation\":[0,2,0],\"rotation\":[-0.70710678,0,0,0.70710678],"
                    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
                    "{\"translation\":[0,5,0],\"rotation\":[-0.70710678,0,0,0.70710678],\"camera\":0}],"
                    "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0},"
                    "\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}}}],"
                    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\","
                    "\"min\":[-2,0,-2],\"max\":[2,0,2]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":72}],"
                    "\"buffers\":[{\"byteLength\":72,\"uri\":\"data:application/octet-stream;base64,"
                    "AAAAwAAAAAAAAADAAAAAwAAAAAAAAABAAAAAQAAAAAAAAABA"
                    "AAAAwAAAAAAAAADAAAAAQAAAAAAAAABAAAAAQAAAAAAAAADA\"}]}");
    export("spot.gltf", "-o", "spot", "--size", "64x48");
    image povray = povray_render_ini("spot", "spot", QUICK);
    outcome o = glint_run(NULL, "render", "spot.gltf", "-o", "spot.exr", "--size", "64x48", "--bounces", "0");
    assert_exit(&o, 0);
    outcome_free(&o);
    report r = { 0 };
    image ours;
    assert_true(image_read("spot.exr", &ours, &r));
    /* 1/16 m a pixel: .28, .72 and 1.28 m from the middle, which the light sees at .14, .35 and .57 rad. */
    const double inside = (double)pixel_at(&povray, 36, 24)[0], between = (double)pixel_at(&povray, 43, 24)[0];
    const double expected = (double)pixel_at(&ours, 36, 24)[0];
    print_message("in the inner cone %.5g, expected %.5g; between the cones %.5g\n", inside, expected, between);
    /* A pixel's middle against the mean of its samples, and half floats: less than a hundredth. */
    assert_true(fabs(inside / expected - 1.0) < 0.01);
    assert_true(pixel_at(&povray, 52, 24)[0] == 0.0F && pixel_at(&ours, 52, 24)[0] == 0.0F);
    /* The cosine to the fourth alone would leave .81 of it. */
    assert_true(between > 0.0 && between < 0.7 * inside);
    image_free(&povray);
    image_free(&ours);
}

/* ---- what is missing, and what is left out ---- */

static void says_what_is_added_and_what_is_left_out(void **state)
{
    (void)state;
    file_write_text("empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}");
    outcome o = glint_run(NULL, "export", "povray", "empty.gltf", "-o", "empty", SMALL, "--json");
    assert_exit(&o, 0);
    json_t *d = document_of(&o);
    const json_t *warnings = json_object_get(d, "warnings");
    assert_int_equal(json_array_size(warnings), 3);
    assert_non_null(strstr(o.out, "no camera"));
    assert_non_null(strstr(o.out, "no lights"));
    assert_non_null(strstr(o.out, "nothing to see"));
    json_decref(d);
    outcome_free(&o);
    assert_renders("empty", "empty");

    file_write_text("odd.gltf-material.json",
                    "{\"name\":\"odd\",\"alphaMode\":\"BLEND\",\"extensions\":{\"GLINT_materials_glint\":"
                    "{\"glintFactor\":1,\"glintDensityVariation\":1}}}");
    o = glint_run(NULL, "export", "povray", "plane.gltf", "-o", "left", SMALL, "--material",
                  "*=./odd.gltf-material.json");
    assert_exit(&o, 0);
    assert_says(o.err, "alphaMode BLEND is left out");
    assert_says(o.err, "glintDensityVariation is left out");
    assert_says(o.err, "plane.gltf: materials/0");
    outcome_free(&o);
    assert_renders("left", "plane");
}

static void what_stands_still_is_said(void **state)
{
    (void)state;
    static const char *const files[][2] = {
        { "simple_skin/simple_skin.gltf", "/nodes/0: skins stand still" },
        { "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", "/targets: morph targets stand still" },
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", GLINT_TEST_MODELS, files[i][0]);
        outcome o = glint_run(NULL, "export", "povray", path, "-o", "still", SMALL);
        assert_exit(&o, 0);
        assert_says(o.err, files[i][1]);
        outcome_free(&o);
    }
}

static size_t count_of(const char *text, const char *what)
{
    size_t count = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what))
        ++count;
    return count;
}

/* A node for each of five materials that lack the same. */
static void the_same_words_are_one_warning_with_the_first_names(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    fputs("{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,4]}],\"nodes\":[", file);
    for (int i = 0; i < 5; ++i)
        fprintf(file, "%s{\"mesh\":%d}", i ? "," : "", i);
    fputs("],\"materials\":[", file);
    for (int i = 0; i < 5; ++i)
        fprintf(file, "%s{\"name\":\"m%d: x\",\"alphaMode\":\"BLEND\"}", i ? "," : "", i);
    fputs("],\"meshes\":[", file);
    for (int i = 0; i < 5; ++i)
        fprintf(file, "%s{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":%d}]}", i ? "," : "", i);
    fputs(
        "],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
        "\"max\":[1,0,1]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
        "\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/\"}]}",
        file);
    fclose(file);
    file_write_text("five.gltf", text);
    free(text);
    outcome o = glint_run(NULL, "export", "povray", "five.gltf", "-o", "five", SMALL);
    assert_exit(&o, 0);
    assert_int_equal(count_of(o.err, "alphaMode BLEND"), 1);
    assert_says(o.err,
                "five.gltf: materials/0 (\"m0: x\"), materials/1 (\"m1: x\"), materials/2 (\"m2: x\") and 2 more: "
                "alphaMode BLEND is left out");
    outcome_free(&o);
}

static void form_that_does_not_fit_is_said_and_replaced(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "export", "povray", SHADER_BALL, "-o", "ball", SMALL, "--form", "mesh", "--material",
                          "ball=metallic-car-paint", "--json");
    assert_exit(&o, 0);
    assert_says(o.err, "flakes are too many");
    json_t *d = document_of(&o);
    assert_string_equal(json_string_value(json_object_get(json_array_get(json_object_get(d, "objects"), 0), "form")),
                        "portable");
    json_decref(d);
    outcome_free(&o);
}

/* ---- failures ---- */

static void failure_leaves_nothing_behind(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "export", "povray", "plane.gltf"), 2, "-o DIR is missing");
    assert_refused(glint_run(NULL, "export", "povray", "plane.gltf", "-o", "x", "--form", "best"), 2, "--form");
    assert_refused(glint_run(NULL, "export", "povray", "none.gltf", "-o", "x"), 1, "none.gltf");
    assert_refused(glint_run(NULL, "export", "povray", "plane.gltf", "-o", "x", "--camera", "Far"), 1,
                   "'Far' is unknown");
    assert_refused(glint_run(NULL, "export", "povray", "plane.gltf", "-o", "x/y"), 1, "x/y");
    assert_refused(glint_run(NULL, "export", "povray", "plane.gltf", "-o", "plane.bin"), 1, "expected a folder");
    struct stat there;
    assert_int_not_equal(stat("x", &there), 0);

    /* Too little room for the meshes: the old files stay, and no other comes. */
    export("plane.gltf", "-o", "kept", SMALL);
    size_t size, again;
    char *before = file_read("kept/plane.pov", &size);
    const run_setup little = { .file_size_limit = 20000 };
    outcome o = glint_run(&little, "export", "povray", SHADER_BALL, "-o", "kept");
    assert_exit(&o, 1);
    outcome_free(&o);
    char *after = file_read("kept/plane.pov", &again);
    assert_int_equal(size, again);
    assert_memory_equal(before, after, size);
    assert_int_equal(folder_count("kept"), 4);
    free(before);
    free(after);
}

/* ---- files that others made ---- */

static void files_of_others_render(void **state)
{
    (void)state;
    static const char *const files[][2] = {
        { "BoxTextured-glTF-Binary/BoxTextured.glb", "BoxTextured" },
        { "2CylinderEngine-glTF-Binary/2CylinderEngine.glb", "2CylinderEngine" },
        { "textureTransform/TextureTransformTest.gltf", "TextureTransformTest" },
        { "ClearCoat-glTF/ClearCoatTest.gltf", "ClearCoatTest" },
        { "simple_skin/simple_skin.gltf", "simple_skin" },
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", GLINT_TEST_MODELS, files[i][0]);
        export(path, "-o", files[i][1], SMALL);
        assert_renders(files[i][1], files[i][1]);
    }
}

static void shader_ball_renders_in_every_preset(void **state)
{
    (void)state;
    static const char *const presets[] = { "brushed-steel", "snow", "metallic-car-paint" };
    for (size_t i = 0; i < sizeof presets / sizeof presets[0]; ++i) {
        char material[64];
        snprintf(material, sizeof material, "ball=%s", presets[i]);
        export(SHADER_BALL, "-o", presets[i], "--size", "24x18", "--material", material);
        image picture = povray_render_ini(presets[i], "shader_ball", QUICK);
        double sum = 0.0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                sum += (double)pixel_at(&picture, x, y)[1];
        /* The room has a mean of about a tenth: neither black nor blown out. */
        assert_true(sum / (24.0 * 18.0) > 0.02 && sum / (24.0 * 18.0) < 2.0);
        image_free(&picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_form_renders_and_auto_takes_exact_on_a_plane, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(same_input_gives_the_same_bytes, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(hostile_names_are_names_of_nothing, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(hostile_file_names_make_plain_ones, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(spot_light_has_the_cone_of_the_file, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(says_what_is_added_and_what_is_left_out, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(what_stands_still_is_said, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(the_same_words_are_one_warning_with_the_first_names, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(form_that_does_not_fit_is_said_and_replaced, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(failure_leaves_nothing_behind, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(files_of_others_render, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(shader_ball_renders_in_every_preset, enter, workplace_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
