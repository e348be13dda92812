// Materials of glTF 2.0 with the KHR extensions that change how a surface reflects.
#include "io/gltf_glint.hpp"
#include "io/gltf_texture.hpp"
#include "io/scene_memory.hpp"

namespace
{

// One material while it is read.
struct material_reader {
    gltf_file &file;
    const tinygltf::Material &in;
    std::string pointer;
    scene_material *out;

    template <class Info> scene_texture texture(const Info &info, texture_colors colors, const char *name)
    {
        return gltf_texture(file, info.index, info.texCoord, info.extensions, colors, pointer + "/" + name);
    }

    const tinygltf::Value *extension(const char *name) const
    {
        return gltf_extension(in.extensions, name);
    }

    std::string extension_pointer(const char *name) const
    {
        return pointer + "/extensions/" + name;
    }
};

template <size_t count> void copy_numbers(const std::vector<double> &from, float (&to)[count])
{
    for (size_t i = 0; i < count && i < from.size(); i++)
        to[i] = static_cast<float>(from[i]);
}

void read_core(material_reader &r)
{
    const tinygltf::PbrMetallicRoughness &pbr = r.in.pbrMetallicRoughness;
    scene_material *m = r.out;
    copy_numbers(pbr.baseColorFactor, m->base_color);
    copy_numbers(r.in.emissiveFactor, m->emissive);
    m->metallic = static_cast<float>(pbr.metallicFactor);
    m->roughness = static_cast<float>(pbr.roughnessFactor);
    m->base_color_texture =
        r.texture(pbr.baseColorTexture, texture_colors::srgb, "pbrMetallicRoughness/baseColorTexture");
    m->metallic_roughness_texture = r.texture(pbr.metallicRoughnessTexture, texture_colors::linear,
                                              "pbrMetallicRoughness/metallicRoughnessTexture");
    m->normal_texture = r.texture(r.in.normalTexture, texture_colors::linear, "normalTexture");
    m->normal_texture.strength = static_cast<float>(r.in.normalTexture.scale);
    m->occlusion_texture = r.texture(r.in.occlusionTexture, texture_colors::linear, "occlusionTexture");
    m->occlusion_texture.strength = static_cast<float>(r.in.occlusionTexture.strength);
    m->emissive_texture = r.texture(r.in.emissiveTexture, texture_colors::srgb, "emissiveTexture");
    m->alpha_mode = r.in.alphaMode == "MASK"    ? SCENE_ALPHA_MASK
                    : r.in.alphaMode == "BLEND" ? SCENE_ALPHA_BLEND
                                                : SCENE_ALPHA_OPAQUE;
    m->alpha_cutoff = static_cast<float>(r.in.alphaCutoff);
    m->double_sided = r.in.doubleSided;
    m->unlit = r.extension("KHR_materials_unlit") != nullptr;
}

void read_ior(material_reader &r)
{
    const tinygltf::Value *extension = r.extension("KHR_materials_ior");
    if (!extension)
        return;
    const double ior = gltf_number(*extension, "ior", 1.5);
    if (ior != 0.0 && ior < 1.0)
        throw file_error(r.extension_pointer("KHR_materials_ior") + "/ior",
                         "found " + json(ior).dump() + ", expected 0 or a number of at least 1");
    r.out->ior = static_cast<float>(ior);
}

void read_emissive_strength(material_reader &r)
{
    const tinygltf::Value *extension = r.extension("KHR_materials_emissive_strength");
    const float strength = extension ? static_cast<float>(gltf_number(*extension, "emissiveStrength", 1.0)) : 1.0F;
    for (float &channel : r.out->emissive)
        channel *= strength;
}

void read_specular(material_reader &r)
{
    constexpr const char *name = "KHR_materials_specular";
    const tinygltf::Value *extension = r.extension(name);
    if (!extension)
        return;
    const std::string pointer = r.extension_pointer(name);
    r.out->specular = static_cast<float>(gltf_number(*extension, "specularFactor", 1.0));
    gltf_numbers(*extension, "specularColorFactor", r.out->specular_color, 3);
    r.out->specular_texture = gltf_texture(r.file, *extension, "specularTexture", texture_colors::linear, pointer);
    r.out->specular_color_texture =
        gltf_texture(r.file, *extension, "specularColorTexture", texture_colors::srgb, pointer);
}

void read_anisotropy(material_reader &r)
{
    constexpr const char *name = "KHR_materials_anisotropy";
    const tinygltf::Value *extension = r.extension(name);
    if (!extension)
        return;
    r.out->anisotropy = static_cast<float>(gltf_number(*extension, "anisotropyStrength", 0.0));
    r.out->anisotropy_rotation = static_cast<float>(gltf_number(*extension, "anisotropyRotation", 0.0));
    r.out->anisotropy_texture =
        gltf_texture(r.file, *extension, "anisotropyTexture", texture_colors::linear, r.extension_pointer(name));
}

void read_clearcoat(material_reader &r)
{
    constexpr const char *name = "KHR_materials_clearcoat";
    const tinygltf::Value *extension = r.extension(name);
    if (!extension)
        return;
    const std::string pointer = r.extension_pointer(name);
    scene_material *m = r.out;
    m->clearcoat = static_cast<float>(gltf_number(*extension, "clearcoatFactor", 0.0));
    m->clearcoat_roughness = static_cast<float>(gltf_number(*extension, "clearcoatRoughnessFactor", 0.0));
    m->clearcoat_texture = gltf_texture(r.file, *extension, "clearcoatTexture", texture_colors::linear, pointer);
    m->clearcoat_roughness_texture =
        gltf_texture(r.file, *extension, "clearcoatRoughnessTexture", texture_colors::linear, pointer);
    m->clearcoat_normal_texture =
        gltf_texture(r.file, *extension, "clearcoatNormalTexture", texture_colors::linear, pointer);
}

// The retired KHR_materials_pbrSpecularGlossiness as a dielectric: F0 = 0.04 specularColor at an ior of 1.5, so a
// specular colour of F0 / 0.04 gives the same reflectance. Glossiness in a texture's alpha has no counterpart.
void convert_specular_glossiness(material_reader &r)
{
    constexpr const char *name = "KHR_materials_pbrSpecularGlossiness";
    const tinygltf::Value *extension = r.extension(name);
    if (!extension)
        return;
    const std::string pointer = r.extension_pointer(name);
    scene_material *m = r.out;
    constexpr float white[4] = { 1.0F, 1.0F, 1.0F, 1.0F };
    std::copy_n(white, 4, m->base_color);
    std::copy_n(white, 3, m->specular_color);
    gltf_numbers(*extension, "diffuseFactor", m->base_color, 4);
    gltf_numbers(*extension, "specularFactor", m->specular_color, 3);
    for (float &channel : m->specular_color)
        channel /= 0.04F;
    m->metallic = 0.0F;
    m->roughness = 1.0F - static_cast<float>(gltf_number(*extension, "glossinessFactor", 1.0));
    m->metallic_roughness_texture = scene_texture_none();
    m->base_color_texture = gltf_texture(r.file, *extension, "diffuseTexture", texture_colors::srgb, pointer);
    m->specular_color_texture =
        gltf_texture(r.file, *extension, "specularGlossinessTexture", texture_colors::srgb, pointer);
    const bool textured = m->specular_color_texture.image != SCENE_NONE;
    r.file.warn(pointer, textured ? "is converted to metallic-roughness; the texture's glossiness is left out"
                                  : "is converted to metallic-roughness");
}

// The material's own, of the layer that it names, and those of the coat, which KHR_materials_clearcoat holds.
void read_glints(material_reader &r)
{
    constexpr const char *name = "GLINT_materials_glint", *coat_name = "KHR_materials_clearcoat";
    if (const tinygltf::Value *glint = r.extension(name))
        gltf_read_glint(r.file, *glint, r.extension_pointer(name), &r.out->glint);
    const tinygltf::Value *coat = r.extension(coat_name);
    if (coat && coat->Has("extensions") && coat->Get("extensions").Has(name)) {
        const std::string pointer = r.extension_pointer(coat_name) + "/extensions/" + name;
        gltf_read_coat_glint(r.file, coat->Get("extensions").Get(name), pointer, r.out);
    }
}

void read_material(gltf_file &file, size_t number, scene *s)
{
    const tinygltf::Material &in = file.model.materials[number];
    scene_material *out = scene_append(&s->materials, &s->material_count);
    *out = scene_material_default();
    material_reader r = { file, in, json_pointer("/materials", number), out };
    out->name = scene_string(in.name.empty() ? r.pointer.substr(1) : in.name);
    read_core(r);
    read_ior(r);
    read_emissive_strength(r);
    read_specular(r);
    read_anisotropy(r);
    read_clearcoat(r);
    convert_specular_glossiness(r);
    read_glints(r);
}

bool needs_default_material(const tinygltf::Model &model)
{
    for (const tinygltf::Mesh &mesh : model.meshes)
        for (const tinygltf::Primitive &primitive : mesh.primitives)
            if (primitive.material < 0)
                return true;
    return false;
}

} // namespace

void gltf_read_materials(gltf_file &file, scene *s)
{
    for (size_t i = 0; i < file.model.materials.size(); i++)
        read_material(file, i, s);
    if (!needs_default_material(file.model))
        return;
    scene_material *fallback = scene_append(&s->materials, &s->material_count);
    *fallback = scene_material_default();
    fallback->name = scene_string("default");
}
