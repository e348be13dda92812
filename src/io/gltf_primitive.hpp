// One primitive of the file as triangles, before normals and tangents are completed.
#ifndef IO_GLTF_PRIMITIVE_HPP
#define IO_GLTF_PRIMITIVE_HPP

#include "io/geometry.hpp"
#include "io/gltf_file.hpp"

// pointer is the primitive's own, for messages. Returns false, with a warning, for points and lines.
bool gltf_read_primitive(gltf_file &file, const tinygltf::Mesh &mesh, const tinygltf::Primitive &primitive,
                         const std::string &pointer, geometry &out);

#endif
