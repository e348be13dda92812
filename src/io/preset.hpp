// Where presets are, for those that need more of them than the scene_material of io/scene_file.h.
#ifndef IO_PRESET_HPP
#define IO_PRESET_HPP

#include <cstdint>
#include <string>

#include "io/json.hpp"

constexpr uint64_t preset_max_bytes = uint64_t{ 1 } << 24; // our choice: presets are written by hand

// The file of an installed preset, or the name itself where it is a path. Throws a file_error for an unknown name.
std::string preset_path(const std::string &name);

// The smallest glTF document around a preset's material, and places in it as places in the preset's file.
json preset_document(json material);
std::string preset_place(const std::string &place);

#endif
