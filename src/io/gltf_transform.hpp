// 4x4 matrices, column-major as in glTF, in double until they reach the scene.
#ifndef IO_GLTF_TRANSFORM_HPP
#define IO_GLTF_TRANSFORM_HPP

#include <array>

#include "io/gltf_file.hpp"

using matrix4 = std::array<double, 16>;

constexpr matrix4 identity4 = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

// Of affine matrices.
matrix4 multiply(const matrix4 &a, const matrix4 &b);

// Translation * rotation * scale; rotation is a quaternion x, y, z, w of any length but zero.
matrix4 compose(const double translation[3], const double rotation[4], const double scale[3]);

// The local transform of a node; throws for a matrix that is not affine and a rotation without length.
matrix4 node_transform(const tinygltf::Node &node, const std::string &pointer);

// Of the upper left 3x3 part: its sign says whether the transform mirrors, 0 that it flattens.
double determinant(const matrix4 &m);

// Writes m as floats; throws when one is too large.
void store(const matrix4 &m, const std::string &pointer, float out[16]);

#endif
