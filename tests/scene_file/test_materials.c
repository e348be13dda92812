/* Materials: every property lands where it belongs, every range is kept, and the error has the JSON pointer. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gltf_case.h"

/* Three textures of the images 0 to 2. */
#define TEXTURES                                                                                                       \
    "'images': [{ 'uri': 'a.png' }, { 'uri': 'b.png' }, { 'uri': 'c.png' }],"                                          \
    "'samplers': [{ 'wrapS': 33071, 'wrapT': 33648, 'magFilter': 9728 }],"                                             \
    "'textures': [{ 'source': 0 }, { 'source': 1, 'sampler': 0 }, { 'source': 2 }]"

static void write_material(gltf_case *c, const char *material)
{
    gltf_case_json(c, "%s, 'materials': [{ %s }]", TEXTURES, material);
}

static const scene_material *read_material(gltf_case *c, const char *material)
{
    write_material(c, material);
    gltf_case_accepted(c);
    return &c->scene.materials[0];
}

static void missing_properties_have_the_defaults_of_the_text(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(c, "'name': 'plain'");
    assert_string_equal(m->name, "plain");
    for (int k = 0; k < 4; k++)
        assert_true(m->base_color[k] == 1.0F);
    assert_true(m->metallic == 1.0F && m->roughness == 1.0F && m->alpha_cutoff == 0.5F && m->ior == 1.5F);
    assert_true(m->specular == 1.0F && m->specular_color[1] == 1.0F && m->emissive[0] == 0.0F);
    assert_true(m->anisotropy == 0.0F && m->clearcoat == 0.0F && m->clearcoat_roughness == 0.0F);
    assert_int_equal(m->alpha_mode, SCENE_ALPHA_OPAQUE);
    assert_false(m->double_sided || m->unlit || m->glint.present);
    assert_int_equal(m->base_color_texture.image, SCENE_NONE);
    assert_int_equal(c->scene.material_count, 1);
}

static void core_properties_are_read(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(
        c, "'pbrMetallicRoughness': { 'baseColorFactor': [0.1, 0.2, 0.3, 0.4], 'metallicFactor': 0.5, "
           "'roughnessFactor': 0.6,"
           " 'baseColorTexture': { 'index': 1, 'texCoord': 1 }, 'metallicRoughnessTexture': { 'index': 0 } },"
           "'normalTexture': { 'index': 2, 'scale': -0.7 }, 'occlusionTexture': { 'index': 0, 'strength': 0.8 },"
           "'emissiveTexture': { 'index': 2 }, 'emissiveFactor': [0.9, 0.8, 0.7], 'alphaMode': 'MASK', 'alphaCutoff': "
           "0.25,"
           "'doubleSided': true, 'extensions': { 'KHR_materials_emissive_strength': { 'emissiveStrength': 10 } }");
    assert_true(m->base_color[0] == 0.1F && m->base_color[3] == 0.4F && m->metallic == 0.5F && m->roughness == 0.6F);
    const scene_texture *t = &m->base_color_texture;
    assert_true(t->image == 1 && t->texcoord == 1 && t->srgb && t->nearest);
    assert_true(t->wrap_s == SCENE_WRAP_CLAMP && t->wrap_t == SCENE_WRAP_MIRROR);
    assert_true(m->metallic_roughness_texture.image == 0 && !m->metallic_roughness_texture.srgb);
    assert_true(m->metallic_roughness_texture.wrap_s == SCENE_WRAP_REPEAT && !m->metallic_roughness_texture.nearest);
    assert_true(m->normal_texture.image == 2 && m->normal_texture.strength == -0.7F && !m->normal_texture.srgb);
    assert_true(m->occlusion_texture.strength == 0.8F && m->emissive_texture.srgb);
    assert_true(m->emissive[0] == 9.0F && m->emissive[2] == 7.0F);
    assert_true(m->alpha_mode == SCENE_ALPHA_MASK && m->alpha_cutoff == 0.25F && m->double_sided);
}

static void extensions_are_read(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(
        c, "'extensions': { 'KHR_materials_specular': { 'specularFactor': 0.1, 'specularTexture': { 'index': 0 },"
           " 'specularColorFactor': [2, 3, 4], 'specularColorTexture': { 'index': 1 } },"
           "'KHR_materials_ior': { 'ior': 1.8 }, 'KHR_materials_unlit': {},"
           "'KHR_materials_anisotropy': { 'anisotropyStrength': 0.6, 'anisotropyRotation': 1.5, 'anisotropyTexture': { "
           "'index': 2 } },"
           "'KHR_materials_clearcoat': { 'clearcoatFactor': 0.7, 'clearcoatTexture': { 'index': 0 }, "
           "'clearcoatRoughnessFactor': 0.2,"
           " 'clearcoatRoughnessTexture': { 'index': 1 }, 'clearcoatNormalTexture': { 'index': 2, 'scale': 0.5 } } }");
    assert_true(m->specular == 0.1F && m->specular_color[0] == 2.0F && m->specular_color[2] == 4.0F);
    assert_true(m->specular_texture.image == 0 && !m->specular_texture.srgb);
    assert_true(m->specular_color_texture.image == 1 && m->specular_color_texture.srgb);
    assert_true(m->ior == 1.8F && m->unlit);
    assert_true(m->anisotropy == 0.6F && m->anisotropy_rotation == 1.5F && m->anisotropy_texture.image == 2);
    assert_true(m->clearcoat == 0.7F && m->clearcoat_roughness == 0.2F);
    assert_true(m->clearcoat_texture.image == 0 && m->clearcoat_roughness_texture.image == 1);
    assert_true(m->clearcoat_normal_texture.image == 2 && m->clearcoat_normal_texture.strength == 0.5F);
}

static void texture_transform_is_read_and_overrides_the_set(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(
        c,
        "'normalTexture': { 'index': 0, 'texCoord': 0, 'extensions': { 'KHR_texture_transform': { 'offset': [0.1, 0.2],"
        " 'rotation': -0.3, 'scale': [4, -5], 'texCoord': 1 } } },"
        "'extensions': { 'GLINT_materials_glint': { 'glintTexture': { 'index': 1, 'extensions': {"
        " 'KHR_texture_transform': { 'scale': [8, 9] } } } } }");
    const scene_texture *t = &m->normal_texture;
    assert_true(t->offset[0] == 0.1F && t->offset[1] == 0.2F && t->rotation == -0.3F && t->scale[1] == -5.0F);
    assert_int_equal(t->texcoord, 1);
    assert_true(m->glint.texture.scale[0] == 8.0F && m->glint.texture.scale[1] == 9.0F &&
                m->glint.texture.offset[0] == 0.0F);
    read_material(c, "'normalTexture': { 'index': 0, 'texCoord': 2 }");
    gltf_case_warned(c, "/materials/0/normalTexture: uses TEXCOORD_2");
    assert_int_equal(c->scene.materials[0].normal_texture.image, SCENE_NONE);
}

static void glint_defaults_are_those_of_its_text(void **state)
{
    gltf_case *c = *state;
    const scene_glint *g = &read_material(c, "'extensions': { 'GLINT_materials_glint': {} }")->glint;
    assert_true(g->present && g->factor == 0.0F && g->density == 1e8F && g->facet_roughness == 0.05F);
    assert_true(g->color_count == 0);
    assert_true(g->color[0] == 1.0F && g->color_variation == 0.0F && g->elongation == 1.0F && g->coverage == 1.0F);
    assert_true(g->density_variation == 0.0F && g->texcoord == 0 && g->uv_scale == 1.0F && g->seed == 0);
    assert_true(g->distribution == GLINT_DISTRIBUTION_GGX && g->space == SCENE_SPACE_UV &&
                g->layer == SCENE_LAYER_BASE);
    assert_true(g->structure == SCENE_STRUCTURE_FLAKES && g->example_placement == SCENE_PLACEMENT_TILED);
    assert_true(g->texture.image == SCENE_NONE && g->example_texture.image == SCENE_NONE);
}

static void glint_properties_are_read(void **state)
{
    gltf_case *c = *state;
    const scene_glint *g =
        &read_material(
             c, "'extensions': { 'GLINT_materials_glint': { 'glintFactor': 0.5, 'glintDistribution': 'beckmann',"
                "'glintTexture': { 'index': 0 }, 'glintDensity': 2e6, 'glintDensityTexture': { 'index': 1 },"
                "'glintFacetRoughness': 0.1, 'glintColorFactor': [0.2, 0.3, 0.4], 'glintColorTexture': { 'index': 2 },"
                "'glintColorVariation': 0.6, 'glintColors': [[1, 0.5, 0], [0, 0.25, 0.75]], 'glintElongation': 7, "
                "'glintCoverage': 0.8, 'glintDensityVariation': 0.9,"
                "'glintSpace': 'object', 'glintTexCoord': 1, 'glintUvScale': 0.25, 'glintLayer': 'clearcoat',"
                "'glintSeed': 2147483647, 'glintStructure': 'example', 'glintExampleTexture': { 'index': 1 },"
                "'glintExamplePlacement': 'scattered', 'glintExampleSize': 0.03 } }")
             ->glint;
    assert_true(g->factor == 0.5F && g->distribution == GLINT_DISTRIBUTION_BECKMANN && g->density == 2e6F);
    assert_true(g->texture.image == 0 && g->density_texture.image == 1 && g->color_texture.image == 2);
    assert_true(g->color_texture.srgb && !g->texture.srgb && !g->density_texture.srgb);
    assert_true(g->facet_roughness == 0.1F && g->color[2] == 0.4F && g->color_variation == 0.6F &&
                g->elongation == 7.0F);
    assert_true(g->color_count == 2 && g->colors[0][1] == 0.5F && g->colors[1][0] == 0.0F && g->colors[1][2] == 0.75F);
    assert_true(g->coverage == 0.8F && g->density_variation == 0.9F && g->space == SCENE_SPACE_OBJECT &&
                g->texcoord == 1);
    assert_true(g->uv_scale == 0.25F && g->layer == SCENE_LAYER_CLEARCOAT && g->seed == 2147483647U);
    assert_true(g->structure == SCENE_STRUCTURE_EXAMPLE && g->example_texture.image == 1);
    assert_true(g->example_placement == SCENE_PLACEMENT_SCATTERED && g->example_size == 0.03F);
}

static void both_layers_may_have_glints(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(
        c, "'extensions': { 'GLINT_materials_glint': { 'glintFactor': 1, 'glintDensity': 3e7, 'glintSeed': 4 },"
           " 'KHR_materials_clearcoat': { 'clearcoatFactor': 1, 'extensions': { 'GLINT_materials_glint': {"
           " 'glintFactor': 0.5, 'glintTexture': { 'index': 1 }, 'glintSpace': 'object' } } } }");
    assert_true(m->glint.present && m->glint.layer == SCENE_LAYER_BASE && m->glint.density == 3e7F);
    assert_true(m->coat_glint.present && m->coat_glint.layer == SCENE_LAYER_CLEARCOAT);
    assert_true(m->coat_glint.factor == 0.5F && m->coat_glint.density == 1e8F && m->coat_glint.texture.image == 1 &&
                m->coat_glint.space == SCENE_SPACE_OBJECT);
    assert_ptr_equal(scene_layer_glint(m, SCENE_LAYER_BASE), &m->glint);
    assert_ptr_equal(scene_layer_glint(m, SCENE_LAYER_CLEARCOAT), &m->coat_glint);
    m = read_material(c, "'extensions': { 'KHR_materials_clearcoat': { 'extensions': { 'GLINT_materials_glint': {"
                         " 'glintLayer': 'clearcoat' } } } }");
    assert_true(!m->glint.present && m->coat_glint.present);
    assert_null(scene_layer_glint(m, SCENE_LAYER_BASE));
    m = read_material(c, "'extensions': { 'KHR_materials_clearcoat': {},"
                         " 'GLINT_materials_glint': { 'glintLayer': 'clearcoat' } }");
    assert_ptr_equal(scene_layer_glint(m, SCENE_LAYER_CLEARCOAT), &m->glint);
    assert_null(scene_layer_glint(m, SCENE_LAYER_BASE));
}

static void glints_of_the_coat_are_of_the_coat_and_there_once(void **state)
{
    gltf_case *c = *state;
    const char *const in_coat = "'materials': [{ 'extensions': { 'KHR_materials_clearcoat': { 'extensions': {"
                                " 'GLINT_materials_glint': { %s } } }%s } }]";
    gltf_case_json(c, in_coat, "'glintLayer': 'base'", "");
    gltf_case_refused(c,
                      "/materials/0/extensions/KHR_materials_clearcoat/extensions/GLINT_materials_glint/glintLayer: "
                      "found \"base\" inside KHR_materials_clearcoat, expected \"clearcoat\" or nothing",
                      NULL);
    gltf_case_json(c, in_coat, "'glintFactor': 1", ", 'GLINT_materials_glint': { 'glintLayer': 'clearcoat' }");
    gltf_case_refused(c,
                      "/materials/0/extensions/KHR_materials_clearcoat/extensions/GLINT_materials_glint: found glints "
                      "of the coat, expected none beside those of the material",
                      NULL);
    gltf_case_json(c, in_coat, "'glintDensity': 0", "");
    gltf_case_refused(c,
                      "/materials/0/extensions/KHR_materials_clearcoat/extensions/GLINT_materials_glint/glintDensity: "
                      "found 0, expected a number above 0",
                      NULL);
    gltf_case_json(c, in_coat, "'glintTexture': { 'index': 7 }", "");
    gltf_case_refused(c, "GLINT_materials_glint/glintTexture/index: found 7", NULL);
}

/* Each property with a value outside its range, of another type, or unknown. */
static void glint_ranges_are_kept(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *name, *value, *says;
    } wrong[] = {
        { "glintFactor", "1.5", "found 1.5, expected a number from 0 to 1" },
        { "glintFactor", "-0.1", "expected a number from" },
        { "glintFactor", "'x'", "found \"x\", expected a number" },
        { "glintDistribution", "'phong'", "found \"phong\", expected one of ggx|beckmann" },
        { "glintDistribution", "''", "found \"\", expected one of" },
        { "glintTexture", "{}", "found no \"index\"" },
        { "glintTexture", "3", "found 3, expected an object" },
        { "glintDensity", "0", "found 0, expected a number above 0" },
        { "glintDensity", "-1e8", "expected a number above 0" },
        { "glintDensity", "1e39", "found 1e+39, expected a number above 0" },
        { "glintFacetRoughness", "2", "expected a number from" },
        { "glintColorFactor", "[1, 1]", "found an array of 2, expected an array of 3 numbers" },
        { "glintColorVariation", "1.1", "expected a number from" },
        { "glintColors", "[]", "found an array of 0, expected an array of 1 to 8 arrays of 3 numbers" },
        { "glintColors", "[[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1]]",
          "found an array of 9, expected an array of 1 to 8 arrays of 3 numbers" },
        { "glintColors", "[1, 0, 0]", "/0: found 1, expected an array of 3 numbers" },
        { "glintColors", "[[1, 0, 0], [1, 0]]", "/1: found an array of 2, expected an array of 3 numbers" },
        { "glintColors", "[[1, 0, 1.5]]", "/0/2: found 1.5, expected a number from 0 to 1" },
        { "glintColors", "[[1, 0, 'x']]", "/0/2: found \"x\", expected a number" },
        { "glintElongation", "0.5", "expected a number of at least 1" },
        { "glintCoverage", "1.01", "expected a number from" },
        { "glintDensityVariation", "-1", "expected a number of at least 0" },
        { "glintSpace", "'world'", "expected one of uv|object" },
        { "glintTexCoord", "2", "expected an integer from 0 to 1" },
        { "glintUvScale", "0", "expected a number above 0" },
        { "glintLayer", "'top'", "expected one of base|clearcoat" },
        { "glintSeed", "2147483648", "found 2147483648, expected an integer" },
        { "glintSeed", "1.5", "found 1.5, expected an integer" },
        { "glintStructure", "'foam'", "expected one of flakes|example" },
        { "glintStructure", "'example'", "without glintExampleTexture" },
        { "glintExampleTexture", "{ 'index': 3 }",
          "/index: found 3, expected an index into \"textures\", of which there are 3" },
        { "glintExamplePlacement", "'random'", "expected one of tiled|scattered" },
        { "glintExampleSize", "0", "expected a number above 0" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char material[256], place[128];
        snprintf(material, sizeof material, "'extensions': { 'GLINT_materials_glint': { '%s': %s } }", wrong[i].name,
                 wrong[i].value);
        snprintf(place, sizeof place, "/materials/0/extensions/GLINT_materials_glint/%s", wrong[i].name);
        write_material(c, material);
        gltf_case_refused(c, place, wrong[i].says, NULL);
    }
}

static void other_ranges_are_kept(void **state)
{
    gltf_case *c = *state;
    static const struct {
        const char *material, *says;
    } wrong[] = {
        { "'pbrMetallicRoughness': { 'metallicFactor': 2 }",
          "/materials/0/pbrMetallicRoughness/metallicFactor: found 2" },
        { "'pbrMetallicRoughness': { 'baseColorFactor': [1, 1, 1, 2] }", "/baseColorFactor/3: found 2" },
        { "'alphaMode': 'ADD'", "/materials/0/alphaMode: found \"ADD\"" },
        { "'emissiveFactor': 1", "/materials/0/emissiveFactor: found 1, expected an array" },
        { "'occlusionTexture': { 'index': 0, 'strength': 2 }", "/materials/0/occlusionTexture/strength: found 2" },
        { "'normalTexture': { 'index': 9 }", "/materials/0/normalTexture/index: found 9" },
        { "'doubleSided': 1", "/materials/0/doubleSided: found 1, expected true or false" },
        { "'extensions': { 'KHR_materials_ior': { 'ior': 0.5 } }",
          "/KHR_materials_ior/ior: found 0.5, expected 0 or a number of at least 1" },
        { "'extensions': { 'KHR_materials_clearcoat': { 'clearcoatFactor': -1 } }", "/clearcoatFactor: found -1" },
        { "'extensions': 3", "/materials/0/extensions: found 3, expected an object" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        write_material(c, wrong[i].material);
        gltf_case_refused(c, wrong[i].says, NULL);
    }
    assert_true(read_material(c, "'extensions': { 'KHR_materials_ior': { 'ior': 0 } }")->ior == 0.0F);
}

/* F0 = 0.04 * specular colour at an ior of 1.5, so F0 of 0.08, 0.04, 0.02 is a colour of 2, 1, 1/2. */
static void specular_glossiness_keeps_its_reflectance(void **state)
{
    gltf_case *c = *state;
    const scene_material *m = read_material(
        c, "'extensions': { 'KHR_materials_pbrSpecularGlossiness': { 'diffuseFactor': [0.1, 0.2, 0.3, 0.5],"
           " 'specularFactor': [0.08, 0.04, 0.02], 'glossinessFactor': 0.75, 'diffuseTexture': { 'index': 2 } } }");
    gltf_case_warned(c, "is converted to metallic-roughness");
    assert_true(m->metallic == 0.0F && m->roughness == 0.25F && m->base_color[1] == 0.2F && m->base_color[3] == 0.5F);
    assert_true(fabsf(m->specular_color[0] - 2.0F) < 1e-6F && fabsf(m->specular_color[2] - 0.5F) < 1e-6F);
    assert_true(m->base_color_texture.image == 2 && m->base_color_texture.srgb);
}

/* A primitive without a material, and one whose material depends on the variant. */
static void write_variants(gltf_case *c)
{
    static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    gltf_case_json_with_buffer(
        c, triangle, sizeof triangle,
        "'bufferViews': [{ 'buffer': 0, 'byteLength': 36 }],"
        "'accessors': [{ 'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3' }],"
        "'materials': [{ 'name': 'red' }, { 'name': 'blue' }], 'nodes': [{ 'mesh': 0 }],"
        "'extensions': { 'KHR_materials_variants': { 'variants': [{ 'name': 'day' }, { 'name': 'night' }] } },"
        "'meshes': [{ 'primitives': [{ 'attributes': { 'POSITION': 0 } },"
        "{ 'attributes': { 'POSITION': 0 }, 'material': 0, 'extensions': { 'KHR_materials_variants': {"
        " 'mappings': [{ 'variants': [1], 'material': 1 }] } } }] }]");
}

static void variant_picks_its_materials_and_an_unknown_one_lists_them(void **state)
{
    gltf_case *c = *state;
    static const char *const chosen[] = { NULL, "day", "night" }, *const expected[] = { "red", "red", "blue" };
    write_variants(c);
    for (int i = 0; i < 3; i++) {
        assert_true(gltf_case_read_variant(c, chosen[i]));
        assert_int_equal(c->scene.variant_count, 2);
        assert_string_equal(c->scene.variants[1], "night");
        assert_string_equal(c->scene.materials[c->scene.meshes[1].material].name, expected[i]);
    }
    assert_false(gltf_case_read_variant(c, "dusk"));
    assert_non_null(strstr(c->said.error, "found no variant called \"dusk\", expected one of: day, night"));
}

static void primitive_without_a_material_gets_the_default_one(void **state)
{
    gltf_case *c = *state;
    write_variants(c);
    gltf_case_accepted(c);
    assert_int_equal(c->scene.material_count, 3);
    assert_int_equal(c->scene.meshes[0].material, 2);
    assert_string_equal(c->scene.materials[2].name, "default");
    assert_true(c->scene.materials[2].metallic == 1.0F);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, gltf_case_begin, gltf_case_end)
    const struct CMUnitTest tests[] = {
        TEST(missing_properties_have_the_defaults_of_the_text),
        TEST(core_properties_are_read),
        TEST(extensions_are_read),
        TEST(texture_transform_is_read_and_overrides_the_set),
        TEST(glint_defaults_are_those_of_its_text),
        TEST(glint_properties_are_read),
        TEST(both_layers_may_have_glints),
        TEST(glints_of_the_coat_are_of_the_coat_and_there_once),
        TEST(glint_ranges_are_kept),
        TEST(other_ranges_are_kept),
        TEST(specular_glossiness_keeps_its_reflectance),
        TEST(variant_picks_its_materials_and_an_unknown_one_lists_them),
        TEST(primitive_without_a_material_gets_the_default_one),
    };
    return cmocka_run_group_tests_name("gltf_materials", tests, NULL, NULL);
}
