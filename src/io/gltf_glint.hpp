// GLINT_materials_glint: the facets of a material.
#ifndef IO_GLTF_GLINT_HPP
#define IO_GLTF_GLINT_HPP

#include "io/gltf_file.hpp"

// Reads the extension over the defaults in out. Types and ranges have passed the schema.
void gltf_read_glint(gltf_file &file, const tinygltf::Value &extension, const std::string &pointer, scene_glint *out);
// The same inside KHR_materials_clearcoat, for which glintLayer is always "clearcoat"; out has its own glints already.
void gltf_read_coat_glint(gltf_file &file, const tinygltf::Value &extension, const std::string &pointer,
                          scene_material *out);

#endif
