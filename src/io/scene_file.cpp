// Reads a .gltf or .glb file into a scene that stands still.
#include "io/scene_file.h"

#include "io/gltf_scene.hpp"

bool scene_file_read(const char *path, const scene_file_options *options, scene *out, report *r)
{
    *out = scene{};
    try {
        gltf_file file = {};
        gltf_read_scene(path, options, file, out, r);
        return true;
    } catch (...) {
        gltf_report(path, r);
    }
    scene_free(out);
    return false;
}
