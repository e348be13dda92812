// A glTF file as bytes: the JSON text and, in a .glb, the BIN chunk (glTF 2.0 section 4.4).
#ifndef IO_GLTF_CONTAINER_HPP
#define IO_GLTF_CONTAINER_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

struct byte_view {
    const uint8_t *data = nullptr;
    size_t size = 0;
};

struct gltf_container {
    std::string_view text; // JSON; points into the bytes
    byte_view bin;
    bool has_bin = false;
};

// Reads a regular file of at most limit bytes; throws a file_error that says why not.
std::vector<uint8_t> file_bytes(const std::string &path, uint64_t limit);

// Finds the parts; .glb is told by its magic, anything else is taken as JSON text. The bytes must outlive the result.
gltf_container gltf_open(const std::vector<uint8_t> &bytes);

#endif
