// KHR_draco_mesh_compression: the only place that knows Draco.
#ifndef IO_GLTF_DRACO_HPP
#define IO_GLTF_DRACO_HPP

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gltf_container.hpp"

// What is wanted of an attribute of the compressed mesh.
struct draco_request {
    uint32_t id;    // Draco's unique id of the attribute
    int components; // 1 to 4
    float divisor;  // what integers are divided by that Draco does not normalise itself; 1 for none
};

struct draco_geometry {
    uint32_t vertex_count = 0;
    std::vector<uint32_t> indices;                        // 3 a triangle
    std::map<std::string, std::vector<float>> attributes; // by the names of the requests
};

// Throws a file_error at pointer when the bytes are not a mesh with these attributes or hold more than max_elements.
draco_geometry draco_decode(byte_view bytes, const std::map<std::string, draco_request> &requests,
                            uint64_t max_elements, const std::string &pointer);

#endif
