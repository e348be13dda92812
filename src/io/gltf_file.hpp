// A glTF file while it is read: its JSON as tinygltf's structs, the bytes of its buffers, and where warnings go.
#ifndef IO_GLTF_FILE_HPP
#define IO_GLTF_FILE_HPP

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "io/file_error.hpp"
#include "io/gltf_container.hpp"
#include "io/gltf_tiny.hpp"
#include "io/json.hpp"
#include "scene/report.h"
#include "scene/scene.h"

struct gltf_file {
    std::string path, folder; // folder: what URIs are relative to, without a closing slash
    report *warnings;
    std::vector<uint8_t> bytes;                // the file itself, which .glb buffers point into
    std::vector<std::vector<uint8_t>> storage; // buffers from elsewhere
    std::vector<byte_view> buffers;
    uint64_t elements_left = 0; // how many more accessor elements may be read; see gltf_load_buffers
    tinygltf::Model model;
    std::set<std::string> warned;
    bool moves = false;              // whether animations are read
    json animations = json::array(); // checked; empty where they are not read

    // Warns about a place of the file; the same warning comes once.
    void warn(const std::string &pointer, const std::string &text)
    {
        if (warned.insert(pointer + text).second)
            report_warning(warnings, "%s: %s: %s", path.c_str(), pointer.c_str(), text.c_str());
    }
};

// ---- gltf_resource.cpp: what URIs and buffer views name ----

// The file that a relative URI names. Throws a file_error for an absolute one and for one that leaves the folder.
std::string gltf_path_of_uri(const gltf_file &file, const std::string &uri, const std::string &pointer);
// Fills buffers. root has passed gltf::check_schema.
void gltf_load_buffers(gltf_file &file, const json &root, byte_view bin, bool has_bin);
// Appends one scene_image for every element of the root array "images".
void gltf_read_images(const gltf_file &file, const json &images, scene *s);
// The bytes of a buffer view; throws where it reaches beyond its buffer.
byte_view gltf_buffer_view(const gltf_file &file, size_t index);

// ---- gltf_material.cpp ----

// Appends all materials and, where a primitive has none, the default material behind them. The file's images are the
// scene's, in order.
void gltf_read_materials(gltf_file &file, scene *s);

// ---- gltf_mesh.cpp ----

// Where the primitives of a glTF mesh are in the scene.
struct gltf_mesh_range {
    int first, count;
};
// Appends one scene_mesh for every primitive of triangles. variant is an index into the file's variants or SCENE_NONE.
std::vector<gltf_mesh_range> gltf_read_meshes(gltf_file &file, scene *s, int variant);

// ---- gltf_node.cpp ----

// Walks the scene graph: appends instances, cameras and lights.
void gltf_read_nodes(gltf_file &file, const std::vector<gltf_mesh_range> &meshes, scene *s);

#endif
