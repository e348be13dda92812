// From a JSON document to a scene: the steps that scene files and presets share.
#ifndef IO_GLTF_DOCUMENT_HPP
#define IO_GLTF_DOCUMENT_HPP

#include "io/gltf_file.hpp"

// No more than a .glb can hold.
constexpr uint64_t gltf_max_file_bytes = uint64_t{ 1 } << 32;

// The folder of a path, without a closing slash.
std::string gltf_folder_of(const std::string &path);

// Checks the document, loads what it names and appends images and materials. bin is the BIN chunk, where there is one.
void gltf_read_document(gltf_file &file, json root, byte_view bin, bool has_bin, scene *s);

// The message of a file_error: "PATH: PLACE: TEXT".
std::string gltf_message(const std::string &path, const file_error &e);

#endif
