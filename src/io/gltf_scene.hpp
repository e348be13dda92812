// From a file that has just been opened to a whole scene.
#ifndef IO_GLTF_SCENE_HPP
#define IO_GLTF_SCENE_HPP

#include <vector>

#include "io/gltf_file.hpp"
#include "io/scene_file.h"

// Fills file, but for file.moves, which the caller has set. Returns where the meshes are.
std::vector<gltf_mesh_range> gltf_read_scene(const char *path, const scene_file_options *options, gltf_file &file,
                                             scene *out, report *r);

// What the readers throw, as the error of a file that cannot be read. To be called in a catch block.
void gltf_report(const char *path, report *r);

#endif
