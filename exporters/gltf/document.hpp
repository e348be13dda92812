// A glTF file that is about to be changed: its parts, its text with the changes so far, and what the reader makes of
// it.
#ifndef EXPORTERS_GLTF_DOCUMENT_HPP
#define EXPORTERS_GLTF_DOCUMENT_HPP

#include "exporters/gltf/container.hpp"
#include "io/gltf_document.hpp"

// What the renderer's reader says of a file in memory. file keeps pointers into parts.
class export_reading
{
  public:
    // Throws a file_error where the renderer would refuse the file. path: for messages and for what the file points to.
    export_reading(const std::string &path, const export_container &parts, report *r);
    ~export_reading();
    export_reading(const export_reading &) = delete;
    export_reading &operator=(const export_reading &) = delete;

    gltf_file file;
    scene images_and_materials = {};
    json root;
};

#endif
