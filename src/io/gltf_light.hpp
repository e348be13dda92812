// The lights of a file: those that hang on nodes, and the one that is all around.
#ifndef IO_GLTF_LIGHT_HPP
#define IO_GLTF_LIGHT_HPP

#include <string>

#include "io/gltf_transform.hpp"

// The first text that is not empty, else the kind and its number.
std::string gltf_name_of(const std::string &first, const std::string &second, const char *kind, int number);

// Appends the lights of a node: KHR_lights_punctual and EXT_lights_area.
void gltf_read_lights(gltf_file &file, const tinygltf::Node &node, const matrix4 &to_world, const std::string &pointer,
                      scene *s);

// EXT_lights_image_based of the scene that the file shows. The file's images are the scene's, in order.
void gltf_read_environment(gltf_file &file, scene *s);

#endif
