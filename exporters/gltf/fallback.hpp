// A file for viewers that know nothing of the extension: its glints as a normal map that tiles.
#ifndef EXPORTERS_GLTF_FALLBACK_HPP
#define EXPORTERS_GLTF_FALLBACK_HPP

#include "exporters/gltf/container.hpp"
#include "io/json.hpp"
#include "scene/report.h"
#include "scene/scene.h"

// Changes the parts of an exported file. s: the scene of its input, for the size of texture coordinates. Returns what
// was done for the summary.
ordered_json export_bake_fallback(const std::string &path, const scene &s, export_container &file, report *r);

// "scene.glb" gives "scene.fallback.glb".
std::string export_fallback_path(const std::string &path);

#endif
