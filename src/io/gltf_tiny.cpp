// Hands tinygltf 2.7 a document in which nothing is left that it reads carelessly.
//
// tinygltf follows URIs out of the folder, crashes on images beyond their buffer, drops what has the wrong type without
// a word and refuses indices without a buffer view, as Draco leaves them. So the document is checked before
// (gltf_schema.cpp), buffers and images are read by gltf_resource.cpp, and the accessor of indices travels in the
// extras of the primitive.
#include "io/gltf_tiny.hpp"

#include <algorithm>
#include <array>

#include "io/file_error.hpp"

namespace
{

constexpr std::array<const char *, 16> known_extensions = {
    "EXT_lights_area",
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "GLINT_materials_glint",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

// Keeps what the reader uses. extras mean something on lights alone, which lie below extensions.
void strip(json &value)
{
    if (value.is_array()) {
        for (json &item : value)
            strip(item);
        return;
    }
    if (!value.is_object())
        return;
    value.erase("extras");
    const auto extensions = value.find("extensions");
    if (extensions != value.end())
        for (auto it = extensions->begin(); it != extensions->end();)
            it = gltf_knows_extension(it.key()) ? std::next(it) : extensions->erase(it);
    for (auto &item : value.items())
        if (item.key() != "KHR_lights_punctual")
            strip(item.value());
}

void move_indices_to_extras(json &root)
{
    const auto meshes = root.find("meshes");
    if (meshes == root.end())
        return;
    for (json &mesh : *meshes)
        for (json &primitive : mesh["primitives"])
            if (primitive.contains("indices")) {
                primitive["extras"]["indices"] = primitive["indices"];
                primitive.erase("indices");
            }
}

} // namespace

bool gltf_knows_extension(const std::string &name)
{
    return std::find(known_extensions.begin(), known_extensions.end(), name) != known_extensions.end();
}

tinygltf::Model gltf_tiny_model(json root)
{
    for (const char *unused : { "buffers", "images", "animations" })
        root.erase(unused);
    strip(root);
    move_indices_to_extras(root);
    const std::string text = root.dump();
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    const unsigned int length = static_cast<unsigned int>(text.size());
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(), length, "", tinygltf::NO_REQUIRE))
        throw file_error("", "tinygltf says: " + error);
    return model;
}

int gltf_primitive_indices(const tinygltf::Primitive &primitive)
{
    return gltf_integer(primitive.extras, "indices", -1);
}

const tinygltf::Value *gltf_extension(const tinygltf::ExtensionMap &extensions, const char *name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

const tinygltf::Value *gltf_member(const tinygltf::Value &object, const char *name)
{
    return object.Has(name) ? &object.Get(name) : nullptr;
}

double gltf_number(const tinygltf::Value &object, const char *name, double otherwise)
{
    const tinygltf::Value *value = gltf_member(object, name);
    return value && value->IsNumber() ? value->GetNumberAsDouble() : otherwise;
}

int gltf_integer(const tinygltf::Value &object, const char *name, int otherwise)
{
    const tinygltf::Value *value = gltf_member(object, name);
    return value && value->IsInt() ? value->GetNumberAsInt() : otherwise;
}

std::string gltf_text(const tinygltf::Value &object, const char *name, const char *otherwise)
{
    const tinygltf::Value *value = gltf_member(object, name);
    return value && value->IsString() ? value->Get<std::string>() : otherwise;
}

void gltf_numbers(const tinygltf::Value &object, const char *name, float *out, size_t count)
{
    const tinygltf::Value *value = gltf_member(object, name);
    if (!value || value->ArrayLen() != count)
        return;
    for (size_t i = 0; i < count; i++)
        out[i] = static_cast<float>(value->Get(static_cast<int>(i)).GetNumberAsDouble());
}
