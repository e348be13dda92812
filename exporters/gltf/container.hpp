// A glTF file taken apart so that it can be put together again byte for byte: text, BIN chunk, and what follows it.
#ifndef EXPORTERS_GLTF_CONTAINER_HPP
#define EXPORTERS_GLTF_CONTAINER_HPP

#include "io/gltf_container.hpp"

struct export_container {
    bool glb = false, has_bin = false;
    std::string text;          // JSON, without the spaces that pad it in a .glb
    size_t padding = 0;        // how many spaces there were
    std::vector<uint8_t> bin;  // the chunk with its own padding
    std::vector<uint8_t> rest; // chunks behind
};

// Throws a file_error as gltf_open does.
export_container export_take_apart(const std::vector<uint8_t> &bytes);

// How many spaces bring the text to a multiple of four bytes.
size_t export_padding(const export_container &c);

// Puts it together; chunks that are no multiple of four bytes are padded, the text as the padding says.
std::vector<uint8_t> export_put_together(const export_container &c);

#endif
