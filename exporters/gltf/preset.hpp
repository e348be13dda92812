// A preset's own text, and what its textures point to.
#ifndef EXPORTERS_GLTF_PRESET_HPP
#define EXPORTERS_GLTF_PRESET_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "scene/report.h"

constexpr uint64_t export_max_image_bytes = uint64_t{ 1 } << 30; // our choice: far more than a texture needs

// NOLINTNEXTLINE(bugprone-exception-escape): moving a json asserts its invariant, which is taken for a throw
struct export_preset {
    std::string name, path, text;
    json material;                            // the text, parsed
    std::vector<std::vector<uint8_t>> images; // of extras.images, in order
};

// Checks the preset as the renderer does. Throws a file_error whose text names the preset's file.
export_preset export_read_preset(const std::string &name, report *r);

#endif
