/* A scene of libglint_preview.so that changes is, bit for bit, the scene that would be made anew, and after a failure
 * the one that it was. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "caller.h"

#define VALUES (8 * 8 * 4)

static void show(const glint_preview_scene *s, float rgba[VALUES])
{
    const glint_preview_camera camera = from_above(0.9F);
    glint_preview_picture_options o = small(&camera);
    o.bounces = 1;
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    get(p, GLINT_PREVIEW_COMBINED, rgba, VALUES);
    glint_preview_picture_destroy(p);
}

static bool same(const float a[VALUES], const float b[VALUES])
{
    for (int i = 0; i < VALUES; ++i) {
        if (a[i] != b[i])
            return false;
    }
    return true;
}

/* What a caller begins with, and what it wants next: a square of two materials, one of them with a picture, under a sun
 * and a map. */
typedef struct looks {
    square_scene square;
    glint_preview_image image;
    int32_t materials[2];
    float pixels[8], map[3 * 8 * 4];
} looks;

static const char TEXTURED[] =
    "{\"samplers\": [{\"magFilter\": 9728}], \"textures\": [{\"source\": 0, \"sampler\": 0}], \"materials\": "
    "[" MATTE("1, 1, 1", ", \"baseColorTexture\": {\"index\": 0}") ", " FLAKES("2500") "]}";

static void make_looks(looks *l)
{
    const float pixels[8] = { 1, 0, 0, 1, 0, 1, 0, 1 };
    memcpy(l->pixels, pixels, sizeof pixels);
    for (int i = 0; i < 3 * 8 * 4; ++i)
        l->map[i] = (float)(i % 7) / 7.0F;
    l->materials[0] = 0;
    l->materials[1] = 1;
    l->image = (glint_preview_image)GLINT_PREVIEW_IMAGE_INIT;
    l->image.pixels = l->pixels;
    l->image.width = 2;
    l->image.height = 1;
    make_square(&l->square);
    l->square.sun.angular_diameter_rad = 0.3F; /* lights flakes in numbers, and has a shape */
    l->square.mesh.materials = l->materials;
    l->square.options.images = &l->image;
    l->square.options.image_count = 1;
    l->square.options.materials = TEXTURED;
    l->square.options.world.map = l->map;
    l->square.options.world.map_width = 8;
    l->square.options.world.map_height = 4;
}

/* ---- what is changed ---- */

static void change_flakes(looks *l)
{
    l->square.options.materials =
        "{\"samplers\": [{\"magFilter\": 9728}], \"textures\": [{\"source\": 0, \"sampler\": 0}], \"materials\": "
        "[" MATTE("0.5, 0.25, 1", ", \"baseColorTexture\": {\"index\": 0}") ", " FLAKES("400") "]}";
}

static void glow(looks *l)
{
    l->square.options.materials =
        "{\"materials\": [{\"emissiveFactor\": [0.5, 1, 0.25], \"pbrMetallicRoughness\": {\"metallicFactor\": 0}}, "
        "" FLAKES("400") "]}";
}

/* The picture was decoded as colours; now it is wanted as data too. */
static void use_the_picture_otherwise(looks *l)
{
    l->square.options.materials =
        "{\"textures\": [{\"source\": 0}], \"materials\": [{\"pbrMetallicRoughness\": {\"metallicRoughnessTexture\": "
        "{\"index\": 0}}}, " FLAKES("2500") "]}";
}

static void change_model(looks *l)
{
    l->square.options.model = 0; /* smooth */
}

static void integrate_over_lights(looks *l)
{
    l->square.options.exact_lights = 1;
}

static void change_picture(looks *l)
{
    l->pixels[2] = l->pixels[6] = 1.0F;
}

static void change_lights(looks *l)
{
    l->square.sun.intensity = 7.0F;
    l->square.sun.color[1] = 0.25F;
}

static void switch_lights_off(looks *l)
{
    l->square.options.light_count = 0;
}

static void change_map(looks *l)
{
    l->map[17] = 9.0F;
    l->square.options.world.map_rotation[1] = l->square.options.world.map_rotation[3] = sqrtf(0.5F);
}

static void change_map_to_a_color(looks *l)
{
    l->square.options.world.map = NULL;
    l->square.options.world.color[2] = 1.0F;
}

static void change_everything(looks *l)
{
    change_flakes(l);
    change_picture(l);
    change_lights(l);
    change_map(l);
}

enum {
    MATERIALS = GLINT_PREVIEW_MATERIALS,
    IMAGES = GLINT_PREVIEW_MATERIALS | GLINT_PREVIEW_IMAGES,
    LIGHTS = GLINT_PREVIEW_LIGHTS,
    WORLD = GLINT_PREVIEW_WORLD
};

static const struct {
    void (*change)(looks *);
    int32_t parts;
} CHANGES[] = { { change_flakes, MATERIALS },
                { glow, MATERIALS },
                { use_the_picture_otherwise, MATERIALS },
                { change_model, MATERIALS },
                { integrate_over_lights, MATERIALS },
                { change_picture, IMAGES },
                { change_lights, LIGHTS },
                { switch_lights_off, LIGHTS },
                { change_map, WORLD },
                { change_map_to_a_color, WORLD },
                { change_everything, IMAGES | LIGHTS | WORLD } };

static void change(glint_preview_scene *s, int32_t parts, const glint_preview_scene_options *o)
{
    char message[512];
    const glint_preview_result result = glint_preview_scene_change(s, parts, o, message, sizeof message);
    if (result != GLINT_PREVIEW_OK)
        fail_msg("%d: %s", (int)result, message);
}

static void a_changed_scene_is_the_one_that_would_be_made_anew(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof CHANGES / sizeof *CHANGES; ++i) {
        looks l;
        make_looks(&l);
        glint_preview_scene *const s = create(&l.square.options);
        float before[VALUES], after[VALUES], anew[VALUES];
        show(s, before);
        CHANGES[i].change(&l);
        glint_preview_scene_options only = l.square.options;
        only.mesh_count = only.instance_count = 0; /* is not looked at */
        change(s, CHANGES[i].parts, &only);
        show(s, after);
        glint_preview_scene *const fresh = create(&l.square.options);
        show(fresh, anew);
        if (!same(after, anew) || same(after, before))
            fail_msg("change %zu: found %s", i, same(after, before) ? "the old picture" : "another picture than anew");
        assert_string_equal(glint_preview_scene_warnings(s), glint_preview_scene_warnings(fresh));
        glint_preview_scene_destroy(fresh);
        glint_preview_scene_destroy(s);
    }
}

static void a_scene_that_changes_to_and_fro_is_what_it_was(void **state)
{
    (void)state;
    looks l, other;
    make_looks(&l);
    make_looks(&other);
    change_everything(&other);
    glint_preview_scene *const s = create(&l.square.options);
    float first[VALUES], last[VALUES];
    show(s, first);
    for (int i = 0; i < 3; ++i) {
        change(s, IMAGES | LIGHTS | WORLD, &other.square.options);
        change(s, IMAGES | LIGHTS | WORLD, &l.square.options);
    }
    show(s, last);
    assert_true(same(first, last));
    glint_preview_scene_destroy(s);
}

static void a_change_takes_its_own_warnings_along_and_no_others(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    const float flat[32] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
    const int32_t twice[2] = { 0, 0 };
    q.options.instance_count = 2;
    q.options.instance_to_world = flat;
    q.options.instance_mesh = twice;
    q.options.materials =
        "{\"materials\": [{\"extensions\": {\"GLINT_materials_glint\": {\"glintFactor\": 1, \"glintDensity\": 2500, "
        "\"glintDensityVariation\": 0.5}}}]}";
    q.options.model = 1; /* counting, which has no such variation */
    glint_preview_scene *const s = create(&q.options);
    assert_non_null(strstr(glint_preview_scene_warnings(s), "flattens"));
    assert_non_null(strstr(glint_preview_scene_warnings(s), "glintDensityVariation"));
    change(s, LIGHTS, &q.options);
    assert_non_null(strstr(glint_preview_scene_warnings(s), "glintDensityVariation"));
    q.options.materials = GLITTER;
    change(s, MATERIALS, &q.options);
    assert_non_null(strstr(glint_preview_scene_warnings(s), "flattens"));
    assert_null(strstr(glint_preview_scene_warnings(s), "glintDensityVariation"));
    glint_preview_scene_destroy(s);
}

/* ---- what fails ---- */

#define TWO(first) "{\"materials\": [" first ", " FLAKES("2500") "]}"

static void what_needs_other_meshes_is_said_and_nothing_changes(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "{\"materials\": [" FLAKES("2500") "]}", TWO(FLAKES("2500")), /* now along the texture */
        TWO("{\"alphaMode\": \"BLEND\"}"),       TWO("{\"alphaMode\": \"MASK\"}"),
        TWO("{\"doubleSided\": true}"),
    };
    looks l;
    make_looks(&l);
    glint_preview_scene *const s = create(&l.square.options);
    float before[VALUES], after[VALUES];
    show(s, before);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        l.square.options.materials = rows[i];
        assert_int_equal(glint_preview_scene_change(s, MATERIALS, &l.square.options, NULL, 0),
                         GLINT_PREVIEW_OTHER_MESHES);
        show(s, after);
        assert_true(same(before, after));
    }
    glint_preview_scene_destroy(s);
}

static void refuse_change(glint_preview_scene *s, int32_t parts, const glint_preview_scene_options *o,
                          const char *named)
{
    char message[512] = "";
    assert_int_equal(glint_preview_scene_change(s, parts, o, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    if (strstr(message, named) == NULL)
        fail_msg("\"%s\" does not say \"%s\"", message, named);
}

static void what_makes_no_sense_is_named_and_nothing_changes(void **state)
{
    (void)state;
    looks l, bad;
    make_looks(&l);
    glint_preview_scene *const s = create(&l.square.options);
    float before[VALUES], after[VALUES];
    show(s, before);
    refuse_change(NULL, LIGHTS, &l.square.options, "scene is NULL");
    refuse_change(s, LIGHTS, NULL, "options is NULL");
    refuse_change(s, 16, &l.square.options, "parts is 16");
    refuse_change(s, GLINT_PREVIEW_IMAGES, &l.square.options, "expected the materials");
    make_looks(&bad);
    change_everything(&bad);
    bad.square.options.materials = "[]";
    refuse_change(s, IMAGES | LIGHTS | WORLD, &bad.square.options, "expected an object");
    make_looks(&bad);
    change_everything(&bad);
    bad.image.pixels = NULL; /* found out when everything else is in its place */
    bad.image.path = "/no/such/file.png";
    refuse_change(s, IMAGES | LIGHTS | WORLD, &bad.square.options, "images/0");
    make_looks(&bad);
    change_everything(&bad);
    bad.square.options.model = 1000;
    refuse_change(s, IMAGES | LIGHTS | WORLD, &bad.square.options, "model is 1000");
    make_looks(&bad);
    change_everything(&bad);
    bad.square.options.world.map_rotation[0] = NAN;
    refuse_change(s, IMAGES | LIGHTS | WORLD, &bad.square.options, "map_rotation");
    show(s, after);
    assert_true(same(before, after));
    glint_preview_scene_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_changed_scene_is_the_one_that_would_be_made_anew),
        cmocka_unit_test(a_scene_that_changes_to_and_fro_is_what_it_was),
        cmocka_unit_test(a_change_takes_its_own_warnings_along_and_no_others),
        cmocka_unit_test(what_needs_other_meshes_is_said_and_nothing_changes),
        cmocka_unit_test(what_makes_no_sense_is_named_and_nothing_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
