// The properties of the extensions that the reader knows, each from its own text at Khronos, and GLINT_materials_glint.
#include "glint.h"
#include "io/gltf_schema.hpp"

namespace gltf
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_int = 2147483647.0;
constexpr double max_intensity = 1e30; // our choice: products with it stay finite in single precision
constexpr double half_pi = 1.5707963267948966;
constexpr const char *lights = "extensions/KHR_lights_punctual/lights";
constexpr const char *area_lights = "extensions/EXT_lights_area/lights";
constexpr const char *image_based_lights = "extensions/EXT_lights_image_based/lights";
constexpr const char *variants = "extensions/KHR_materials_variants/variants";

const schema &lights_schema()
{
    // Exporters write pi / 2 in single precision, which is a little more.
    static const schema spot = {
        { number("innerConeAngle", 0.0, half_pi + 1e-6), number("outerConeAngle", 0.0, half_pi + 1e-6) }, {}
    };
    static const schema light = { { text("name"), numbers("color", 3, 0.0, infinity),
                                    number("intensity", 0.0, infinity), choice("type", "directional|point|spot").must(),
                                    number_above("range", 0.0), object("spot", spot) },
                                  {} };
    static const schema all = { { objects("lights", light, 0).must() }, {} };
    return all;
}

const schema &area_lights_schema()
{
    static const schema rect = { { number_above("aspect", 0.0) }, {} };
    static const schema light = { { text("name"), numbers("color", 3, 0.0, infinity),
                                    number("intensity", 0.0, max_intensity), choice("type", "rect|disk").must(),
                                    number_above("size", 0.0), object("rect", rect) },
                                  {} };
    static const schema all = { { objects("lights", light, 0).must() }, {} };
    return all;
}

// The arrays of arrays, specularImages and irradianceCoefficients, are left to gltf_rules.cpp.
const schema &image_based_lights_schema()
{
    static const schema light = { { text("name"), numbers("rotation", 4, -infinity, infinity),
                                    number("intensity", 0.0, max_intensity),
                                    integer("specularImageSize", 1, max_int).must() },
                                  {} };
    static const schema all = { { objects("lights", light, 0).must() }, {} };
    return all;
}

const schema &variants_schema()
{
    static const schema variant = { { text("name").must() }, {} };
    static const schema all = { { objects("variants", variant, 1).must() }, {} };
    return all;
}

const schema &variant_mappings_schema()
{
    static const schema mapping = {
        { indices("variants", variants, 1).must(), index("material", "materials").must(), text("name") }, {}
    };
    static const schema all = { { objects("mappings", mapping, 1).must() }, {} };
    return all;
}

schema specular_schema()
{
    return { { number("specularFactor", 0.0, 1.0), object("specularTexture", texture_info_schema()),
               numbers("specularColorFactor", 3, 0.0, infinity),
               object("specularColorTexture", texture_info_schema()) },
             {} };
}

schema clearcoat_schema()
{
    return { { number("clearcoatFactor", 0.0, 1.0), object("clearcoatTexture", texture_info_schema()),
               number("clearcoatRoughnessFactor", 0.0, 1.0), object("clearcoatRoughnessTexture", texture_info_schema()),
               object("clearcoatNormalTexture", normal_texture_schema()) },
             {} };
}

schema specular_glossiness_schema()
{
    return { { numbers("diffuseFactor", 4, 0.0, 1.0), object("diffuseTexture", texture_info_schema()),
               numbers("specularFactor", 3, 0.0, 1.0), number("glossinessFactor", 0.0, 1.0),
               object("specularGlossinessTexture", texture_info_schema()) },
             {} };
}

schema glint_schema()
{
    return { { number("glintFactor", 0.0, 1.0),
               choice("glintDistribution", "ggx|beckmann"),
               object("glintTexture", texture_info_schema()),
               number_above("glintDensity", 0.0),
               object("glintDensityTexture", texture_info_schema()),
               number("glintFacetRoughness", 0.0, 1.0),
               numbers("glintColorFactor", 3, 0.0, 1.0),
               object("glintColorTexture", texture_info_schema()),
               number("glintColorVariation", 0.0, 1.0),
               triples("glintColors", 1, GLINT_MAX_COLORS, 0.0, 1.0),
               number("glintElongation", 1.0, infinity),
               number("glintCoverage", 0.0, 1.0),
               number("glintDensityVariation", 0.0, infinity),
               choice("glintSpace", "uv|object"),
               integer("glintTexCoord", 0, 1),
               number_above("glintUvScale", 0.0),
               choice("glintLayer", "base|clearcoat"),
               integer("glintSeed", 0, 2147483647.0),
               choice("glintStructure", "flakes|example"),
               object("glintExampleTexture", texture_info_schema()),
               choice("glintExamplePlacement", "tiled|scattered"),
               number_above("glintExampleSize", 0.0),
               number("glintExampleRotationVariation", 0.0, 3.1415927),
               number("glintExampleScaleVariation", 0.0, 0.5) },
             {} };
}

} // namespace

const std::vector<extension> &root_extensions()
{
    static const std::vector<extension> all = { { "KHR_lights_punctual", &lights_schema() },
                                                { "EXT_lights_area", &area_lights_schema() },
                                                { "EXT_lights_image_based", &image_based_lights_schema() },
                                                { "KHR_materials_variants", &variants_schema() } };
    return all;
}

const std::vector<extension> &scene_extensions()
{
    static const schema light = { { index("light", image_based_lights).must() }, {} };
    static const std::vector<extension> all = { { "EXT_lights_image_based", &light } };
    return all;
}

const std::vector<extension> &node_extensions()
{
    static const schema light = { { index("light", lights).must() }, {} };
    static const schema area_light = { { index("light", area_lights).must() }, {} };
    static const schema instancing = { { index_map("attributes", "accessors").must() }, {} };
    static const std::vector<extension> all = { { "KHR_lights_punctual", &light },
                                                { "EXT_lights_area", &area_light },
                                                { "EXT_mesh_gpu_instancing", &instancing } };
    return all;
}

const std::vector<extension> &primitive_extensions()
{
    static const schema draco = {
        { index("bufferView", "bufferViews").must(), integer_map("attributes", 0, max_int).must() }, {}
    };
    static const std::vector<extension> all = { { "KHR_draco_mesh_compression", &draco },
                                                { "KHR_materials_variants", &variant_mappings_schema() } };
    return all;
}

const std::vector<extension> &material_extensions()
{
    static const schema specular = specular_schema(), clearcoat = clearcoat_schema(), glint = glint_schema(),
                        specular_glossiness = specular_glossiness_schema();
    static const schema ior = { { number("ior", 0.0, infinity) }, {} };
    static const schema anisotropy = { { number("anisotropyStrength", 0.0, 1.0),
                                         number("anisotropyRotation", -infinity, infinity),
                                         object("anisotropyTexture", texture_info_schema()) },
                                       {} };
    static const schema emissive_strength = { { number("emissiveStrength", 0.0, infinity) }, {} };
    static const std::vector<extension> all = { { "KHR_materials_specular", &specular },
                                                { "KHR_materials_ior", &ior },
                                                { "KHR_materials_anisotropy", &anisotropy },
                                                { "KHR_materials_clearcoat", &clearcoat },
                                                { "KHR_materials_emissive_strength", &emissive_strength },
                                                { "KHR_materials_pbrSpecularGlossiness", &specular_glossiness },
                                                { "GLINT_materials_glint", &glint } };
    return all;
}

const std::vector<extension> &texture_info_extensions()
{
    static const schema transform = { { numbers("offset", 2, -infinity, infinity),
                                        number("rotation", -infinity, infinity),
                                        numbers("scale", 2, -infinity, infinity), integer("texCoord", 0, max_int) },
                                      {} };
    static const std::vector<extension> all = { { "KHR_texture_transform", &transform } };
    return all;
}

} // namespace gltf
