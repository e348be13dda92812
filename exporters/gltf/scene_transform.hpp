// Transforms of nodes: what glTF can say of them, and what is written in their place where it cannot.
#ifndef EXPORTERS_GLTF_SCENE_TRANSFORM_HPP
#define EXPORTERS_GLTF_SCENE_TRANSFORM_HPP

#include <array>
#include <vector>

#include "io/json.hpp"
#include "scene/scene.h"

// Translation, rotation and scale can make it: its axes are at right angles, as far as single precision says.
bool is_right_angled(const float m[16]);

// Nothing for the identity.
void set_matrix(ordered_json &node, const float m[16]);

// For cameras and lights, which look along -z and have no size but their own: right angles, no scale.
std::array<float, 16> rigid(const float m[16]);

// A primitive whose vertices are in the world, for a transform that no node can have.
struct placed_mesh {
    std::vector<float> position, normal, tangent;
    std::vector<uint32_t> index;
};

placed_mesh placed(const scene_mesh &mesh, const float to_world[16]);

#endif
