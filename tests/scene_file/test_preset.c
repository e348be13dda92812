/* Presets: found by name or path, applied to scenes, and refused with the names there are. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"

#define PRESET                                                                                                         \
    "{ \"name\": \"inner\", \"pbrMetallicRoughness\": { \"roughnessFactor\": 0.3, \"baseColorTexture\": { \"index\": " \
    "0 } },"                                                                                                           \
    "\"extensions\": { \"GLINT_materials_glint\": { \"glintFactor\": 1, \"glintTexture\": { \"index\": 1 } } },"       \
    "\"extras\": { \"title\": \"Frost\", \"note\": \"made up\", \"images\": [{ \"uri\": \"a.png\" }, { \"uri\": "      \
    "\"b.png\" }],"                                                                                                    \
    "\"textures\": [{ \"source\": 1 }, { \"source\": 0 }] } }"

static void write_text(gltf_case *c, const char *name, const char *text)
{
    gltf_case_write(c, name, text, strlen(text));
}

/* A folder of three presets, and a scene of two materials and one image. */
static int begin(void **state)
{
    if (gltf_case_begin(state) != 0)
        return -1;
    gltf_case *c = *state;
    write_text(c, "frost.gltf-material.json", PRESET);
    write_text(c, "glitter.gltf-material.json", "{ \"extras\": { \"title\": \"Glitter\" } }");
    write_text(c, "gold.gltf-material.json", "{}");
    write_text(c, "notes.txt", "no preset");
    gltf_case_json(c, "'images': [{ 'uri': 'own.png' }], 'materials': [{ 'name': 'body' }, { 'name': 'trim' }]");
    gltf_case_accepted(c);
    return setenv("GLINT_MATERIALS", c->folder, 1);
}

static void list_name(const char *name, const char *title, const char *note, void *user)
{
    char *text = user;
    sprintf(text + strlen(text), "%s=%s=%s;", name, title, note);
}

static void presets_are_listed_in_alphabetical_order(void **state)
{
    gltf_case *c = *state;
    char text[256] = "";
    assert_true(preset_each(list_name, text, &c->said));
    assert_string_equal(text, "frost=Frost=made up;glitter=Glitter=;gold==;");
}

static void preset_replaces_one_material_and_keeps_its_name(void **state)
{
    gltf_case *c = *state;
    assert_true(preset_apply(&c->scene, "trim", "frost", &c->said));
    assert_string_equal(c->scene.materials[1].name, "trim");
    assert_true(c->scene.materials[1].roughness == 0.3F && c->scene.materials[1].glint.present);
    assert_true(c->scene.materials[0].roughness == 1.0F && !c->scene.materials[0].glint.present);
}

static void preset_replaces_every_material_for_a_star(void **state)
{
    gltf_case *c = *state;
    assert_true(preset_apply(&c->scene, "*", "frost", &c->said));
    for (int i = 0; i < 2; i++)
        assert_true(c->scene.materials[i].roughness == 0.3F);
    assert_string_equal(c->scene.materials[0].name, "body");
}

static void images_of_a_preset_follow_those_of_the_scene(void **state)
{
    gltf_case *c = *state;
    scene_material m;
    assert_true(preset_read("frost", &c->scene, &m, &c->said));
    assert_string_equal(m.name, "inner");
    free(m.name);
    assert_int_equal(c->scene.image_count, 3);
    assert_int_equal(m.base_color_texture.image, 2);
    assert_int_equal(m.glint.texture.image, 1);
    char expected[128];
    snprintf(expected, sizeof expected, "%s/b.png", c->folder);
    assert_string_equal(c->scene.images[2].path, expected);
    assert_int_equal(m.normal_texture.image, SCENE_NONE);
}

static void path_names_a_preset_anywhere(void **state)
{
    gltf_case *c = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/gold.gltf-material.json", c->folder);
    assert_int_equal(setenv("GLINT_MATERIALS", "/nonexistent", 1), 0);
    scene_material m;
    assert_true(preset_read(path, &c->scene, &m, &c->said));
    assert_true(m.metallic == 1.0F);
    free(m.name);
}

static void refused(gltf_case *c, const char *preset, const char *says)
{
    c->said.error[0] = '\0';
    scene_material m;
    assert_false(preset_read(preset, &c->scene, &m, &c->said));
    if (!strstr(c->said.error, says))
        fail_msg("\"%s\" does not say \"%s\"", c->said.error, says);
    assert_int_equal(c->scene.image_count, 1);
}

static void unknown_preset_lists_the_nearest_or_all(void **state)
{
    gltf_case *c = *state;
    refused(c, "gliter", "preset gliter: found no preset of this name in");
    refused(c, "gliter", "; did you mean glitter?");
    refused(c, "fros", "; did you mean frost?");
    refused(c, "velvet-curtain", "expected one of: frost, glitter, gold");
    assert_int_equal(setenv("GLINT_MATERIALS", "/nonexistent", 1), 0);
    refused(c, "frost", "the presets cannot be listed: No such file or directory");
}

static void unknown_material_lists_the_nearest_or_all(void **state)
{
    gltf_case *c = *state;
    assert_false(preset_apply(&c->scene, "bodi", "gold", &c->said));
    assert_non_null(strstr(c->said.error, "found no material called \"bodi\"; did you mean body?"));
    c->said.error[0] = '\0';
    assert_false(preset_apply(&c->scene, "window", "gold", &c->said));
    assert_non_null(strstr(c->said.error, "expected one of: body, trim"));
}

/* Places are those of the preset's own file, although it is read as part of a larger document. */
static void broken_presets_are_refused_at_their_place(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        { "[]", "bad.json: found an array of 0, expected a glTF material object" },
        { "{", "bad.json: line 1, column 2: found text that is not JSON" },
        { "{\"pbrMetallicRoughness\":{\"metallicFactor\":3}}",
          "bad.json: /pbrMetallicRoughness/metallicFactor: found 3" },
        { "{\"normalTexture\":{\"index\":0}}",
          "bad.json: /normalTexture/index: found 0, expected an index into \"textures\"" },
        { "{\"extras\":{\"textures\":[{\"source\":0}]}}", "bad.json: /extras/textures/0/source: found 0" },
        { "{\"extras\":{\"images\":[{\"uri\":\"../x.png\"}]}}", "bad.json: /extras/images/0/uri: found the URI" },
        { "{\"extras\":{\"images\":[{\"bufferView\":0}]}}", "bad.json: /extras/images/0/bufferView: found 0" },
    };
    char path[sizeof c->path];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        write_text(c, "bad.json", wrong[i].text);
        memcpy(path, c->path, sizeof path);
        refused(c, path, wrong[i].says);
    }
    snprintf(path, sizeof path, "%s/none.json", c->folder);
    refused(c, path, "cannot be opened: No such file or directory");
}

/* The eight presets of the house, which the build folder shows where an installed program looks. */
static void presets_of_the_house_are_read_and_have_facets(void **state)
{
    gltf_case *c = *state;
    assert_int_equal(unsetenv("GLINT_MATERIALS"), 0);
    static const char *const names[] = {
        "brushed-steel", "craft-glitter", "frosted-plastic", "gold-leaf", "metallic-car-paint", "nail-polish",
        "sand",          "snow"
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        scene_material m;
        if (!preset_read(names[i], &c->scene, &m, &c->said))
            fail_msg("%s", c->said.error);
        assert_string_equal(m.name, names[i]);
        assert_true(m.glint.present && m.glint.factor > 0.0F && m.glint.density > 0.0F);
        free(m.name);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(presets_are_listed_in_alphabetical_order),
        TEST(preset_replaces_one_material_and_keeps_its_name),
        TEST(preset_replaces_every_material_for_a_star),
        TEST(images_of_a_preset_follow_those_of_the_scene),
        TEST(path_names_a_preset_anywhere),
        TEST(unknown_preset_lists_the_nearest_or_all),
        TEST(unknown_material_lists_the_nearest_or_all),
        TEST(broken_presets_are_refused_at_their_place),
        TEST(presets_of_the_house_are_read_and_have_facets),
    };
    return cmocka_run_group_tests_name("preset", tests, NULL, NULL);
}
