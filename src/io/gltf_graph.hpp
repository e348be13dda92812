// The node hierarchy: which nodes the scene shows and where they are.
#ifndef IO_GLTF_GRAPH_HPP
#define IO_GLTF_GRAPH_HPP

#include <vector>

#include "io/gltf_transform.hpp"

struct gltf_graph {
    std::vector<size_t> visible;   // nodes of the scene, parents before children
    std::vector<matrix4> to_world; // of every node of the file
};

// Throws unless the nodes are strict trees and the scene lists roots (glTF 2.0 section 3.5.2).
gltf_graph gltf_read_graph(const gltf_file &file);

#endif
