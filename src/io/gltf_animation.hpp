// What the animations of a file move: translations, rotations and scales of its nodes.
#ifndef IO_GLTF_ANIMATION_HPP
#define IO_GLTF_ANIMATION_HPP

#include <map>
#include <utility>
#include <vector>

#include "io/gltf_file.hpp"
#include "io/gltf_keyframes.hpp"

enum class gltf_moved { translation, rotation, scale };

struct gltf_channel {
    size_t node;
    gltf_moved moved;
    gltf_keyframes keys; // in arrays of the animation
};

struct gltf_animation {
    std::vector<gltf_channel> channels; // each moves something else
    double end_s = 0.0;                 // of the last key
    // What accessors hold, by number and use. Channels point into it, and many share their times.
    std::map<std::pair<int, int>, std::vector<float>> arrays;
};

// Plays the animation of that name, or of that number where none is called so; NULL: all of the file together, which is
// an error where two of them move the same. file.animations has passed gltf::check_animations. What stands still though
// a channel is about it gives one warning for each reason.
gltf_animation gltf_read_animation(gltf_file &file, const char *wanted);

// Puts the nodes of the model where they are at a time. What no channel moves stays.
void gltf_pose(const gltf_animation &animation, double time_s, tinygltf::Model &model);

#endif
