// The order in which a document is read: everything is checked before anything is used.
#include "io/gltf_document.hpp"

#include "io/gltf_rules.hpp"
#include "io/gltf_schema.hpp"
#include "io/scene_memory.hpp"

namespace
{

void warn_of_unknown_extensions(gltf_file &file)
{
    for (const std::string &name : file.model.extensionsUsed)
        if (!gltf_knows_extension(name) &&
            !(file.moves && name == "KHR_animation_pointer")) // whose channels are counted
            file.warn("/extensionsUsed", "the extension " + name + " is not known here and has no effect");
}

} // namespace

std::string gltf_folder_of(const std::string &path)
{
    const size_t slash = path.rfind('/');
    return slash == path.npos ? "." : path.substr(0, slash);
}

std::string gltf_message(const std::string &path, const file_error &e)
{
    return path + ": " + (e.place.empty() ? "" : e.place + ": ") + e.text;
}

void gltf_read_document(gltf_file &file, json root, byte_view bin, bool has_bin, scene *s)
{
    gltf::check_schema(root);
    gltf::check_rules(root);
    gltf_load_buffers(file, root, bin, has_bin);
    root.erase("buffers");
    const json images = root.value("images", json::array());
    root.erase("images");
    if (file.moves) {
        gltf::check_animations(root);
        file.animations = root.value("animations", json::array());
    }
    // Indices into both were checked above; tinygltf gets neither.
    file.model = gltf_tiny_model(std::move(root));
    warn_of_unknown_extensions(file);
    gltf_read_images(file, images, s);
    gltf_read_materials(file, s);
}
