// Every property of scene_material by its name in glTF 2.0 or in an extension; the reverse of src/io/gltf_material.cpp.
#include "exporters/gltf/scene_material.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "exporters/gltf/patch.hpp"

namespace
{

class material_writer
{
  public:
    material_writer(const scene_material &m, const std::function<size_t(const scene_texture &)> &texture)
        : m_(m), texture_(texture)
    {
    }

    ordered_json run()
    {
        ordered_json out = { { "name", m_.name } };
        write_core(out);
        write_emissive(out);
        if (m_.unlit)
            extensions_["KHR_materials_unlit"] = ordered_json::object();
        if (m_.ior != 1.5F)
            extensions_["KHR_materials_ior"] = { { "ior", export_number(m_.ior) } };
        write_specular();
        write_anisotropy();
        write_clearcoat();
        if (m_.glint.present)
            extensions_[glint_extension] = glint_of(m_.glint, SCENE_LAYER_BASE);
        if (!extensions_.empty())
            out["extensions"] = extensions_;
        return out;
    }

  private:
    static void number(ordered_json &out, const char *name, float value, float standard)
    {
        if (value != standard)
            out[name] = export_number(value);
    }

    static void color(ordered_json &out, const char *name, const float *value, size_t count)
    {
        if (std::any_of(value, value + count, [](float v) { return v != 1.0F; }))
            out[name] = export_numbers(value, count);
    }

    void texture(ordered_json &out, const char *name, const scene_texture &t, const char *strength = nullptr)
    {
        if (t.image == SCENE_NONE)
            return;
        ordered_json info = { { "index", texture_(t) } };
        if (t.texcoord != 0)
            info["texCoord"] = t.texcoord;
        if (strength)
            number(info, strength, t.strength, 1.0F);
        ordered_json transform = ordered_json::object();
        if (t.offset[0] != 0.0F || t.offset[1] != 0.0F)
            transform["offset"] = export_numbers(t.offset, 2);
        number(transform, "rotation", t.rotation, 0.0F);
        color(transform, "scale", t.scale, 2);
        if (!transform.empty())
            info["extensions"]["KHR_texture_transform"] = transform;
        out[name] = info;
    }

    void write_core(ordered_json &out)
    {
        ordered_json pbr = ordered_json::object();
        color(pbr, "baseColorFactor", m_.base_color, 4);
        texture(pbr, "baseColorTexture", m_.base_color_texture);
        number(pbr, "metallicFactor", m_.metallic, 1.0F);
        number(pbr, "roughnessFactor", m_.roughness, 1.0F);
        texture(pbr, "metallicRoughnessTexture", m_.metallic_roughness_texture);
        if (!pbr.empty())
            out["pbrMetallicRoughness"] = pbr;
        texture(out, "normalTexture", m_.normal_texture, "scale");
        texture(out, "occlusionTexture", m_.occlusion_texture, "strength");
        texture(out, "emissiveTexture", m_.emissive_texture);
        if (m_.alpha_mode != SCENE_ALPHA_OPAQUE)
            out["alphaMode"] = m_.alpha_mode == SCENE_ALPHA_MASK ? "MASK" : "BLEND";
        if (m_.alpha_mode == SCENE_ALPHA_MASK)
            number(out, "alphaCutoff", m_.alpha_cutoff, 0.5F);
        if (m_.double_sided)
            out["doubleSided"] = true;
    }

    // Beyond 1 by a strength that is a power of two, so that nothing is rounded.
    void write_emissive(ordered_json &out)
    {
        const float most = *std::max_element(m_.emissive, m_.emissive + 3);
        if (!(most > 0.0F))
            return;
        int exponent = 0;
        if (most > 1.0F)
            std::frexp(most, &exponent);
        float factor[3];
        for (size_t c = 0; c < 3; c++)
            factor[c] = std::ldexp(m_.emissive[c], -exponent);
        out["emissiveFactor"] = export_numbers(factor, 3);
        if (exponent > 0)
            extensions_["KHR_materials_emissive_strength"] = { { "emissiveStrength", std::ldexp(1.0, exponent) } };
    }

    void write_specular()
    {
        ordered_json out = ordered_json::object();
        number(out, "specularFactor", m_.specular, 1.0F);
        texture(out, "specularTexture", m_.specular_texture);
        color(out, "specularColorFactor", m_.specular_color, 3);
        texture(out, "specularColorTexture", m_.specular_color_texture);
        if (!out.empty())
            extensions_["KHR_materials_specular"] = out;
    }

    void write_anisotropy()
    {
        if (m_.anisotropy == 0.0F)
            return;
        ordered_json out = { { "anisotropyStrength", export_number(m_.anisotropy) } };
        number(out, "anisotropyRotation", m_.anisotropy_rotation, 0.0F);
        texture(out, "anisotropyTexture", m_.anisotropy_texture);
        extensions_["KHR_materials_anisotropy"] = out;
    }

    void write_clearcoat()
    {
        ordered_json out = ordered_json::object();
        number(out, "clearcoatFactor", m_.clearcoat, 0.0F);
        texture(out, "clearcoatTexture", m_.clearcoat_texture);
        number(out, "clearcoatRoughnessFactor", m_.clearcoat_roughness, 0.0F);
        texture(out, "clearcoatRoughnessTexture", m_.clearcoat_roughness_texture);
        texture(out, "clearcoatNormalTexture", m_.clearcoat_normal_texture, "scale");
        if (m_.coat_glint.present)
            out["extensions"][glint_extension] = glint_of(m_.coat_glint, SCENE_LAYER_CLEARCOAT);
        if (!out.empty())
            extensions_["KHR_materials_clearcoat"] = out;
    }

    // standard: the layer that the place of the extension means already.
    ordered_json glint_of(const scene_glint &g, scene_glint_layer standard)
    {
        const scene_material plain_material = scene_material_default();
        const scene_glint &plain = plain_material.glint;
        ordered_json out = ordered_json::object();
        number(out, "glintFactor", g.factor, plain.factor);
        texture(out, "glintTexture", g.texture);
        if (g.distribution == GLINT_DISTRIBUTION_BECKMANN)
            out["glintDistribution"] = "beckmann";
        number(out, "glintDensity", g.density, plain.density);
        texture(out, "glintDensityTexture", g.density_texture);
        number(out, "glintFacetRoughness", g.facet_roughness, plain.facet_roughness);
        color(out, "glintColorFactor", g.color, 3);
        texture(out, "glintColorTexture", g.color_texture);
        number(out, "glintColorVariation", g.color_variation, plain.color_variation);
        for (uint32_t i = 0; i < g.color_count; i++)
            out["glintColors"].push_back(export_numbers(g.colors[i], 3));
        number(out, "glintElongation", g.elongation, plain.elongation);
        number(out, "glintCoverage", g.coverage, plain.coverage);
        number(out, "glintDensityVariation", g.density_variation, plain.density_variation);
        if (g.space == SCENE_SPACE_OBJECT)
            out["glintSpace"] = "object";
        if (g.texcoord != 0)
            out["glintTexCoord"] = g.texcoord;
        number(out, "glintUvScale", g.uv_scale, plain.uv_scale);
        if (g.layer != standard)
            out["glintLayer"] = "clearcoat";
        if (g.seed != 0)
            out["glintSeed"] = g.seed;
        write_example(out, g, plain);
        return out;
    }

    void write_example(ordered_json &out, const scene_glint &g, const scene_glint &plain)
    {
        if (g.structure == SCENE_STRUCTURE_EXAMPLE)
            out["glintStructure"] = "example";
        texture(out, "glintExampleTexture", g.example_texture);
        if (g.example_placement == SCENE_PLACEMENT_SCATTERED)
            out["glintExamplePlacement"] = "scattered";
        number(out, "glintExampleSize", g.example_size, plain.example_size);
        number(out, "glintExampleRotationVariation", g.example_rotation_variation, plain.example_rotation_variation);
        number(out, "glintExampleScaleVariation", g.example_scale_variation, plain.example_scale_variation);
    }

    const scene_material &m_;
    const std::function<size_t(const scene_texture &)> &texture_;
    ordered_json extensions_ = ordered_json::object();
};

} // namespace

double export_number(float value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    return std::strtod(text, nullptr);
}

ordered_json export_numbers(const float *values, size_t count)
{
    ordered_json out = ordered_json::array();
    for (size_t i = 0; i < count; i++)
        out.push_back(export_number(values[i]));
    return out;
}

ordered_json export_material(const scene_material &m, const std::function<size_t(const scene_texture &)> &texture)
{
    return material_writer(m, texture).run();
}
