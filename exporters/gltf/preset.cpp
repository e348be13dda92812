// Reads a preset once through the renderer's reader, which checks it, and once as text, whose spelling is kept.
#include "exporters/gltf/preset.hpp"

#include <cstdlib>
#include <memory>

#include "exporters/gltf/textures.hpp"
#include "io/file_error.hpp"
#include "io/gltf_container.hpp"
#include "io/preset.hpp"
#include "io/scene_file.h"

namespace
{

struct freed {
    void operator()(scene *s) const
    {
        scene_free(s);
    }
};

} // namespace

export_preset export_read_preset(const std::string &name, report *r)
{
    scene s = {};
    const std::unique_ptr<scene, freed> owner(&s);
    scene_material material;
    if (!preset_read(name.c_str(), &s, &material, r))
        throw file_error("", r->error);
    std::free(material.name);
    export_preset preset;
    preset.name = name;
    preset.path = preset_path(name);
    const std::vector<uint8_t> bytes = file_bytes(preset.path, preset_max_bytes);
    preset.text.assign(bytes.begin(), bytes.end());
    preset.material = json_parse(preset.text);
    for (int i = 0; i < s.image_count; i++)
        preset.images.push_back(export_image_bytes(s.images[i]));
    return preset;
}
