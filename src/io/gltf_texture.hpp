// Uses of textures: textureInfo objects of materials and extensions as scene_texture.
#ifndef IO_GLTF_TEXTURE_HPP
#define IO_GLTF_TEXTURE_HPP

#include "io/gltf_file.hpp"

enum class texture_colors { linear, srgb };

// A textureInfo of the core: index -1 is none. pointer is its place in the file.
scene_texture gltf_texture(gltf_file &file, int index, int texcoord, const tinygltf::ExtensionMap &extensions,
                           texture_colors colors, const std::string &pointer);

// The textureInfo called name in an extension, if it has one.
scene_texture gltf_texture(gltf_file &file, const tinygltf::Value &extension, const char *name, texture_colors colors,
                           const std::string &pointer);

#endif
