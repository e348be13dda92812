// From a file that has just been opened to a whole scene; the only place where a reader's exceptions become messages.
#include "io/gltf_scene.hpp"

#include <new>

#include "io/gltf_document.hpp"
#include "io/gltf_light.hpp"
#include "io/scene_bounds.h"
#include "io/scene_memory.hpp"

namespace
{

void read_variants(const gltf_file &file, scene *s)
{
    const tinygltf::Value *extension = gltf_extension(file.model.extensions, "KHR_materials_variants");
    const tinygltf::Value *variants = extension ? gltf_member(*extension, "variants") : nullptr;
    for (size_t i = 0; variants && i < variants->ArrayLen(); i++)
        *scene_append(&s->variants, &s->variant_count) =
            scene_string(gltf_text(variants->Get(static_cast<int>(i)), "name", ""));
}

// The index of the variant that the options ask for.
int chosen_variant(const scene *s, const scene_file_options *options)
{
    if (!options || !options->variant)
        return SCENE_NONE;
    std::string names;
    for (int i = 0; i < s->variant_count; i++) {
        if (std::strcmp(s->variants[i], options->variant) == 0)
            return i;
        names += (i > 0 ? ", " : "") + std::string(s->variants[i]);
    }
    throw file_error("", std::string("found no variant called \"") + options->variant +
                             "\", expected one of: " + (names.empty() ? "none, the file has no variants" : names));
}

} // namespace

std::vector<gltf_mesh_range> gltf_read_scene(const char *path, const scene_file_options *options, gltf_file &file,
                                             scene *out, report *r)
{
    file.path = path;
    file.folder = gltf_folder_of(path);
    file.warnings = r;
    file.bytes = file_bytes(path, gltf_max_file_bytes);
    const gltf_container parts = gltf_open(file.bytes);
    out->path = scene_string(path);
    gltf_read_document(file, json_parse(parts.text), parts.bin, parts.has_bin, out);
    read_variants(file, out);
    std::vector<gltf_mesh_range> meshes = gltf_read_meshes(file, out, chosen_variant(out, options));
    gltf_read_nodes(file, meshes, out);
    gltf_read_environment(file, out);
    scene_compute_bounds(out);
    return meshes;
}

void gltf_report(const char *path, report *r)
{
    try {
        throw;
    } catch (const file_error &e) {
        report_error(r, "%s", gltf_message(path, e).c_str());
    } catch (const std::bad_alloc &) {
        report_error(r, "%s: found a scene that needs more memory than there is", path);
    } catch (const std::exception &e) {
        report_error(r, "%s: cannot be read: %s", path, e.what());
    }
}
