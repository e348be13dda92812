// The checks of the reader on bytes that may not be on the disk yet.
#include "exporters/gltf/document.hpp"

export_reading::export_reading(const std::string &path, const export_container &parts, report *r)
    : file{ path, gltf_folder_of(path), r, {}, {}, {}, 0, {}, {} }, root(json_parse(parts.text))
{
    try {
        gltf_read_document(file, root, { parts.bin.data(), parts.bin.size() }, parts.has_bin, &images_and_materials);
    } catch (...) {
        scene_free(&images_and_materials);
        throw;
    }
}

export_reading::~export_reading()
{
    scene_free(&images_and_materials);
}
