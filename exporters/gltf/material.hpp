// The text of a material: with a preset's appearance, or with one value set.
#ifndef EXPORTERS_GLTF_MATERIAL_HPP
#define EXPORTERS_GLTF_MATERIAL_HPP

#include "exporters/gltf/json_text.hpp"
#include "exporters/gltf/textures.hpp"

// Where a material's text stands in a file.
struct material_text {
    std::string raw;
    json_style style;
    size_t level;
};

// The preset's text with the indices of its textures in the file.
std::string preset_with_textures(const export_preset &preset, texture_packer &packer);

// Replaces the appearance: what glTF 2.0 itself says of a material, the extensions KHR_materials_..., and whatever the
// preset says. name, extras, other extensions and unknown members stay as they are spelled.
void material_take_preset(material_text &m, const std::string &preset);

// Sets a member of the extension, which comes into being where there is none. pointer starts at the material and leads
// into the extension; value is JSON, or a string without its quotes. Throws a file_error for a property that the
// extension does not have.
void material_set(material_text &m, const std::string &pointer, const std::string &value);

// Sets any member to raw text; objects on the way come into being.
void material_put(material_text &m, const std::string &pointer, std::string raw);

// Takes a member out, and "extensions" with the last of them. Nothing happens where it is not there.
void material_remove(material_text &m, const std::string &pointer);

// The names of all extensions that the material's text has, at any depth.
std::set<std::string> material_extension_names(const std::string &raw);

#endif
