// URIs are relative to the folder of the glTF file; in another folder they need the same files.
#include "exporters/gltf/outside.hpp"

#include <filesystem>

#include "io/output_file.h"

namespace
{

namespace fs = std::filesystem;

void copy(const std::string &from, const fs::path &folder, const std::string &name, report *r)
{
    const fs::path to = folder / name;
    std::error_code error;
    if (!fs::exists(from, error) || fs::equivalent(from, to, error))
        return;
    const std::vector<uint8_t> bytes = file_bytes(from, gltf_max_file_bytes);
    if (fs::exists(to, error)) {
        if (file_bytes(to.string(), gltf_max_file_bytes) != bytes)
            throw file_error("", "found another file at " + to.string() + ", where " + from + " has to be copied to");
        return;
    }
    // Folders of the URI, but not the one that the user named.
    if (fs::exists(folder, error))
        fs::create_directories(to.parent_path(), error);
    export_write_file(to.string(), bytes, r);
}

} // namespace

void export_write_file(const std::string &path, const std::vector<uint8_t> &bytes, report *r)
{
    output_file *out = output_file_open(path.c_str(), r);
    if (out)
        output_file_write(out, bytes.data(), bytes.size());
    if (!out || !output_file_commit(out, r))
        throw file_error("", r->error);
}

void export_copy_outside_files(const export_reading &reading, const std::string &output, report *r)
{
    const fs::path folder = gltf_folder_of(output);
    for (const char *array : { "buffers", "images" }) {
        const json all = reading.root.value(array, json::array());
        for (size_t i = 0; i < all.size(); i++) {
            const std::string uri = all[i].value("uri", "");
            if (uri.empty() || uri.compare(0, 5, "data:") == 0)
                continue;
            const std::string pointer = json_pointer(json_pointer("", array), i);
            const std::string from = gltf_path_of_uri(reading.file, uri, pointer + "/uri");
            copy(from, folder, from.substr(reading.file.folder.size() + 1), r);
        }
    }
}
