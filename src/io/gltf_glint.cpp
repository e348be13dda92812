// The properties of GLINT_materials_glint, one by one.
#include "io/gltf_glint.hpp"

#include "io/gltf_texture.hpp"

namespace
{

void read_number(const tinygltf::Value &extension, const char *name, float *out)
{
    *out = static_cast<float>(gltf_number(extension, name, static_cast<double>(*out)));
}

void read_colors(const tinygltf::Value &extension, scene_glint *out)
{
    const tinygltf::Value *colors = gltf_member(extension, "glintColors");
    out->color_count = colors ? static_cast<uint32_t>(colors->ArrayLen()) : 0;
    for (uint32_t i = 0; i < out->color_count; i++)
        for (int c = 0; c < 3; c++)
            out->colors[i][c] = static_cast<float>(colors->Get(static_cast<int>(i)).Get(c).GetNumberAsDouble());
}

void read_facets(const tinygltf::Value &extension, scene_glint *out)
{
    read_number(extension, "glintFactor", &out->factor);
    read_number(extension, "glintDensity", &out->density);
    read_number(extension, "glintFacetRoughness", &out->facet_roughness);
    gltf_numbers(extension, "glintColorFactor", out->color, 3);
    read_number(extension, "glintColorVariation", &out->color_variation);
    read_colors(extension, out);
    read_number(extension, "glintElongation", &out->elongation);
    read_number(extension, "glintCoverage", &out->coverage);
    read_number(extension, "glintDensityVariation", &out->density_variation);
    if (gltf_text(extension, "glintDistribution", "ggx") == "beckmann")
        out->distribution = GLINT_DISTRIBUTION_BECKMANN;
    out->seed = static_cast<uint32_t>(gltf_integer(extension, "glintSeed", 0));
}

void read_placement(const tinygltf::Value &extension, scene_glint *out)
{
    if (gltf_text(extension, "glintSpace", "uv") == "object")
        out->space = SCENE_SPACE_OBJECT;
    out->texcoord = gltf_integer(extension, "glintTexCoord", 0);
    read_number(extension, "glintUvScale", &out->uv_scale);
    if (gltf_text(extension, "glintLayer", "base") == "clearcoat")
        out->layer = SCENE_LAYER_CLEARCOAT;
    if (gltf_text(extension, "glintStructure", "flakes") == "example")
        out->structure = SCENE_STRUCTURE_EXAMPLE;
    if (gltf_text(extension, "glintExamplePlacement", "tiled") == "scattered")
        out->example_placement = SCENE_PLACEMENT_SCATTERED;
    read_number(extension, "glintExampleSize", &out->example_size);
    read_number(extension, "glintExampleRotationVariation", &out->example_rotation_variation);
    read_number(extension, "glintExampleScaleVariation", &out->example_scale_variation);
}

} // namespace

void gltf_read_glint(gltf_file &file, const tinygltf::Value &extension, const std::string &pointer, scene_glint *out)
{
    out->present = true;
    read_facets(extension, out);
    read_placement(extension, out);
    out->texture = gltf_texture(file, extension, "glintTexture", texture_colors::linear, pointer);
    out->density_texture = gltf_texture(file, extension, "glintDensityTexture", texture_colors::linear, pointer);
    out->color_texture = gltf_texture(file, extension, "glintColorTexture", texture_colors::srgb, pointer);
    out->example_texture = gltf_texture(file, extension, "glintExampleTexture", texture_colors::linear, pointer);
    if (out->structure == SCENE_STRUCTURE_EXAMPLE && out->example_texture.image == SCENE_NONE)
        throw file_error(json_pointer(pointer, "glintStructure"),
                         "found \"example\" without glintExampleTexture, expected that texture too");
}
