// A material as the scene has it, in the words of glTF.
#ifndef EXPORTERS_GLTF_SCENE_MATERIAL_HPP
#define EXPORTERS_GLTF_SCENE_MATERIAL_HPP

#include <functional>

#include "io/json.hpp"
#include "scene/scene.h"

// The shortest number that a reader takes for the same float.
double export_number(float value);
ordered_json export_numbers(const float *values, size_t count);

// texture: the index in the new file of a use of an image. Members that have their defaults are left out.
ordered_json export_material(const scene_material &m, const std::function<size_t(const scene_texture &)> &texture);

#endif
