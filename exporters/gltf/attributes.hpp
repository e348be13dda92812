// TANGENT and TEXCOORD of primitives whose material needs them and that have none.
#ifndef EXPORTERS_GLTF_ATTRIBUTES_HPP
#define EXPORTERS_GLTF_ATTRIBUTES_HPP

#include "exporters/gltf/data.hpp"
#include "io/gltf_file.hpp"

struct attribute_count {
    size_t tangents = 0, texcoords = 0;
};

// materials: the text of those that changed, by their index; without: the index that counts for primitives without one.
// Warns of what a primitive lacks and cannot be given.
attribute_count add_missing_attributes(gltf_file &file, const std::map<size_t, std::string> &materials, size_t without,
                                       patch &p, export_data &data);

#endif
