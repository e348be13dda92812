/* Each code of `glint validate` for a file that has this one fault, and none for files that have none. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_case.h"
#include "io/validate.h"

#define MODELS "/usr/share/assimp/models/glTF2/"

/* What was said, as lines "severity CODE POINTER: FOUND". */
typedef struct said {
    char text[8192];
    unsigned count[3];
} said;

static void take(const validate_issue *issue, void *user)
{
    static const char *const names[] = { "error", "warning", "info" };
    said *s = user;
    s->count[issue->severity]++;
    const size_t used = strlen(s->text);
    snprintf(s->text + used, sizeof s->text - used, "%s %s %s: %s\n", names[issue->severity], issue->code,
             issue->pointer, issue->found);
}

static said validated(const char *path, bool valid)
{
    said s = { "", { 0 } };
    if (validate_file(path, take, &s) != valid)
        fail_msg("%s is %svalid:\n%s", path, valid ? "in" : "", s.text);
    assert_int_equal(valid, s.count[VALIDATE_ERROR] == 0);
    return s;
}

static void expect(const said *s, const char *wanted)
{
    if (!strstr(s->text, wanted))
        fail_msg("said\n%sexpected it to hold\n%s", s->text, wanted);
}

#define GLINT "/materials/0/extensions/GLINT_materials_glint"

/* A file with one material whose extension is the text. */
static void write_material(gltf_case *c, const char *glint, const char *rest)
{
    gltf_case_json(c,
                   "'extensionsUsed': ['GLINT_materials_glint'], 'images': [{'uri': 'a.png'}],"
                   "'textures': [{'source': 0}, {}], 'materials': [{'extensions': {'GLINT_materials_glint': {%s}}%s}]",
                   glint, rest);
}

static void faults_of_the_extension_have_their_codes(void **state)
{
    static const struct {
        const char *glint, *rest, *wanted;
    } cases[] = {
        { "'glintFactor': '1'", "", "error TYPE " GLINT "/glintFactor: \"1\"" },
        { "'glintFactor': 2", "", "error RANGE " GLINT "/glintFactor: 2" },
        { "'glintSpace': 'world'", "", "error ENUM " GLINT "/glintSpace: \"world\"" },
        { "'glintTexture': {'index': 2}", "", "error INDEX " GLINT "/glintTexture/index: 2" },
        { "'glintTexture': {}", "", "error REQUIRED " GLINT "/glintTexture: no \"index\"" },
        { "'glintColorFactor': [1]", "", "error COUNT " GLINT "/glintColorFactor: an array of 1" },
        { "'glintStructure': 'example'", "", "error CONTENT " GLINT "/glintStructure: \"example\" without" },
        { "'glintDensty': 1", "", "warning UNKNOWN_PROPERTY " GLINT "/glintDensty: \"glintDensty\"" },
        { "'glintExampleSize': 1", "", "warning UNUSED_PROPERTY " GLINT "/glintExampleSize" },
        { "'glintSeed': 16777217", "", "warning SEED_NOT_FLOAT " GLINT "/glintSeed: 16777217" },
        { "'glintDensity': 1e15", "", "warning DENSITY_UNRESOLVED " GLINT "/glintDensity: 1e+15" },
        { "'glintLayer': 'clearcoat'", "", "warning NO_COAT " GLINT "/glintLayer" },
        { "", "", "info OFF " GLINT "/glintFactor: none" },
        { "'glintFactor': 0", "", "info OFF " GLINT "/glintFactor: 0" },
        { "'glintTexture': {'index': 1}", "", "warning TEXTURE_IMAGE " GLINT "/glintTexture" },
        { "'glintTexture': {'index': 0}", ", 'emissiveTexture': {'index': 0}",
          "warning TEXTURE_KIND " GLINT
          "/glintTexture: image 0 as data, but at /materials/0/emissiveTexture as colour" },
        { "'glintFacetRoughness': 0.5", ", 'pbrMetallicRoughness': {'roughnessFactor': 0.5}",
          "warning FACET_ROUGHNESS " GLINT "/glintFacetRoughness: 0.5" },
    };
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_material(c, cases[i].glint, cases[i].rest);
        const said s = validated(c->path, strncmp(cases[i].wanted, "error", 5) != 0);
        expect(&s, cases[i].wanted);
    }
}

/* Facets of .2: below the base's .5 and above the coat's .1, or the other way round. */
static void facets_are_compared_with_the_layer_that_they_are_in(void **state)
{
#define FACETS "'GLINT_materials_glint': {'glintFactor': 1, 'glintFacetRoughness': 0.2"
#define COAT "'KHR_materials_clearcoat': {'clearcoatFactor': 1, 'clearcoatRoughnessFactor': "
    static const struct {
        const char *base, *extensions, *found;
    } cases[] = {
        { "0.5", COAT "0.1, 'extensions': {" FACETS "}}}",
          "clearcoat/extensions/GLINT_materials_glint/glintFacetRoughness" },
        { "0.1", COAT "0.5, 'extensions': {" FACETS "}}}", NULL },
        { "0.5", COAT "0.1}, " FACETS ", 'glintLayer': 'clearcoat'}", GLINT "/glintFacetRoughness" },
        { "0.1", COAT "0.5}, " FACETS ", 'glintLayer': 'clearcoat'}", NULL },
        { "0.1", COAT "0.5}, " FACETS "}", GLINT "/glintFacetRoughness" },
    };
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        gltf_case_json(c,
                       "'extensionsUsed': ['GLINT_materials_glint', 'KHR_materials_clearcoat'], 'materials':"
                       "[{'pbrMetallicRoughness': {'roughnessFactor': %s}, 'extensions': {%s}}]",
                       cases[i].base, cases[i].extensions);
        const said s = validated(c->path, true);
        if (cases[i].found)
            expect(&s, cases[i].found);
        else if (strstr(s.text, "FACET_ROUGHNESS"))
            fail_msg("case %zu: said\n%s", i, s.text);
    }
}

static void a_material_without_fault_has_no_issue(void **state)
{
    gltf_case *c = *state;
    write_material(c, "'glintFactor': 1, 'glintSeed': 16777216, 'glintColorTexture': {'index': 0}", "");
    const said s = validated(c->path, true);
    assert_string_equal(s.text, "");
}

static void all_faults_are_told_and_not_the_first_alone(void **state)
{
    gltf_case *c = *state;
    write_material(c, "'glintFactor': 2, 'glintDensity': 0, 'glintSpace': 1, 'glintSeed': 0.5", "");
    const said s = validated(c->path, false);
    assert_int_equal(s.count[VALIDATE_ERROR], 4);
}

static void the_second_object_in_the_coat_is_looked_at_too(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'extensionsUsed': ['GLINT_materials_glint'], 'materials': [{'extensions': {"
                      "'KHR_materials_clearcoat': {'clearcoatFactor': 1, 'extensions': {'GLINT_materials_glint': "
                      "{'glintFactor': 1, 'glintSeeed': 1}}}}}]");
    const said s = validated(c->path, true);
    expect(&s, "UNKNOWN_PROPERTY /materials/0/extensions/KHR_materials_clearcoat/extensions/GLINT_materials_glint");
}

static void faults_of_the_file_around_have_their_codes(void **state)
{
    gltf_case *c = *state;
    gltf_case_json(c, "'materials': [{'extensions': {'GLINT_materials_glint': {}}}], 'scenes': []");
    said s = validated(c->path, false);
    expect(&s, "error UNDECLARED " GLINT);
    gltf_case_json(c, "'extensionsUsed': ['GLINT_materials_glint'], 'extensionsRequired': ['GLINT_materials_glint']");
    s = validated(c->path, true);
    expect(&s, "warning REQUIRED_EXTENSION /extensionsRequired");
    gltf_case_json(c,
                   "'extensionsUsed': ['GLINT_materials_glint', 'KHR_animation_pointer'],"
                   "'materials': [{'extensions': {'GLINT_materials_glint': {'glintFactor': 1}}}],"
                   "'animations': [{'samplers': [], 'channels': [%s, %s]}]",
                   "{'target': {'extensions': {'KHR_animation_pointer': {'pointer': '" GLINT "/glintDensity'}}}}",
                   "{'target': {'extensions': {'KHR_animation_pointer': {'pointer': '" GLINT "/glintSeed'}}}}");
    s = validated(c->path, false);
    assert_int_equal(s.count[VALIDATE_ERROR], 1);
    expect(&s, "error ANIMATION_POINTER /animations/0/channels/1/target");
    gltf_case_write(c, "no.gltf", "{", 1);
    s = validated(c->path, false);
    expect(&s, "error FILE line 1");
    s = validated("/nonexistent.gltf", false);
    expect(&s, "error FILE : a file that cannot be opened");
    s = validated(MODELS "IndexOutOfRange/IndexOutOfRange.gltf", false);
    expect(&s, "error CONTENT /meshes/0/primitives/0/indices: vertex 255");
}

/* A right triangle of half a square metre. */
static void write_triangle(gltf_case *c, const char *glint)
{
    static const float points[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    gltf_case_json_with_buffer(
        c, points, sizeof points,
        "'bufferViews': [{'buffer': 0, 'byteLength': 36}], 'accessors': [{'bufferView': 0, 'componentType': 5126,"
        "'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], 'max': [1, 1, 0]}], 'images': [{'uri': 'a.png'}], 'textures': "
        "[{'source': 0}], 'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'material': 0}]}], 'nodes': "
        "[{'mesh': 0}], 'scenes': [{'nodes': [0]}], 'extensionsUsed': ['GLINT_materials_glint'], 'materials': "
        "[{'extensions': {'GLINT_materials_glint': {'glintFactor': 1, %s}}, 'pbrMetallicRoughness': "
        "{'roughnessFactor': 0.3}}]",
        glint);
}

/* One facet on half a square metre is 2 a square metre. Of the diagonal of sqrt 2 m a pixel of 3840 sees 1.36e-7 m^2;
 * with alpha .09 the sun lights p = 6.8e-5 / (4 pi .09^2) = 6.7e-4; N p = 255^2 at 7.1e14 - 1 per mille. */
static void faults_of_meshes_have_their_codes(void **state)
{
    static const struct {
        const char *glint, *wanted;
        bool valid;
    } cases[] = {
        { "'glintTexture': {'index': 0}, 'glintSpace': 'object'",
          "error NO_TEXCOORD /meshes/0/primitives/0/attributes: no TEXCOORD_0", false },
        { "'glintSpace': 'uv'", "warning NO_TEXCOORD /meshes/0/primitives/0/attributes: no TEXCOORD_0", true },
        { "'glintElongation': 2", "warning NO_TANGENT /meshes/0/primitives/0/attributes", true },
        { "'glintDensity': 1.9", "warning DENSITY_EMPTY " GLINT "/glintDensity: 1.9", true },
    };
    gltf_case *c = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_triangle(c, cases[i].glint);
        const said s = validated(c->path, cases[i].valid);
        expect(&s, cases[i].wanted);
    }
    write_triangle(c, "'glintSpace': 'object', 'glintDensity': 2.1");
    assert_string_equal(validated(c->path, true).text, "");
    write_triangle(c, "'glintSpace': 'object', 'glintDensity': 7.0e14");
    assert_int_equal(validated(c->path, true).count[VALIDATE_WARNING], 1); /* half a wavelength */
    write_triangle(c, "'glintSpace': 'object', 'glintDensity': 7.2e14");
    assert_int_equal(validated(c->path, true).count[VALIDATE_WARNING], 2);
}

static void presets_are_checked_by_their_own_places(void **state)
{
    gltf_case *c = *state;
    const char *text = "{\"extensions\":{\"GLINT_materials_glint\":{\"glintFactor\":1,\"glintDensity\":-1}}}";
    gltf_case_write(c, "a.gltf-material.json", text, strlen(text));
    const said s = validated(c->path, false);
    expect(&s, "error RANGE /extensions/GLINT_materials_glint/glintDensity: -1");
    text = "{\"extensions\":{\"GLINT_materials_glint\":{\"glintFactor\":1,\"glintSed\":1}}}";
    gltf_case_write(c, "a.gltf-material.json", text, strlen(text));
    const said t = validated(c->path, true);
    expect(&t, "warning UNKNOWN_PROPERTY /extensions/GLINT_materials_glint/glintSed");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(facets_are_compared_with_the_layer_that_they_are_in),
        TEST(faults_of_the_extension_have_their_codes),
        TEST(a_material_without_fault_has_no_issue),
        TEST(all_faults_are_told_and_not_the_first_alone),
        TEST(the_second_object_in_the_coat_is_looked_at_too),
        TEST(faults_of_the_file_around_have_their_codes),
        TEST(faults_of_meshes_have_their_codes),
        TEST(presets_are_checked_by_their_own_places),
    };
    return cmocka_run_group_tests_name("validate", tests, NULL, NULL);
}
