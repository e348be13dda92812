// The files around a glTF file: what it points to goes where it goes.
#ifndef EXPORTERS_GLTF_OUTSIDE_HPP
#define EXPORTERS_GLTF_OUTSIDE_HPP

#include "exporters/gltf/document.hpp"

// Writes a file whole or not at all. Throws a file_error.
void export_write_file(const std::string &path, const std::vector<uint8_t> &bytes, report *r);

// Copies buffers and images that the file names by URI to where the same URIs lead from output. A file that is there
// with other bytes is an error.
void export_copy_outside_files(const export_reading &reading, const std::string &output, report *r);

#endif
