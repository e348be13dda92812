// Node transforms (glTF 2.0 section 3.5.3).
#include "io/gltf_transform.hpp"

#include <cmath>
#include <limits>

matrix4 multiply(const matrix4 &a, const matrix4 &b)
{
    matrix4 product = {};
    for (size_t column = 0; column < 4; column++)
        for (size_t row = 0; row < 4; row++)
            for (size_t k = 0; k < 4; k++)
                product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return product;
}

matrix4 compose(const double translation[3], const double rotation[4], const double scale[3])
{
    const double length = std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
    const double x = rotation[0] / length, y = rotation[1] / length, z = rotation[2] / length, w = rotation[3] / length;
    const double turned[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w) },
                                  { 2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w) },
                                  { 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y) } };
    matrix4 m = identity4;
    for (size_t column = 0; column < 3; column++)
        for (size_t row = 0; row < 3; row++)
            m[4 * column + row] = turned[column][row] * scale[column];
    for (size_t row = 0; row < 3; row++)
        m[12 + row] = translation[row];
    return m;
}

matrix4 node_transform(const tinygltf::Node &node, const std::string &pointer)
{
    if (!node.matrix.empty()) {
        matrix4 m;
        std::copy_n(node.matrix.begin(), 16, m.begin());
        if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
            throw file_error(pointer + "/matrix",
                             "found a matrix whose last row is not 0 0 0 1, expected an affine one");
        return m;
    }
    double translation[3] = { 0, 0, 0 }, rotation[4] = { 0, 0, 0, 1 }, scale[3] = { 1, 1, 1 };
    if (!node.translation.empty())
        std::copy_n(node.translation.begin(), 3, translation);
    if (!node.rotation.empty())
        std::copy_n(node.rotation.begin(), 4, rotation);
    if (!node.scale.empty())
        std::copy_n(node.scale.begin(), 3, scale);
    if (!(std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3])) > 0.0))
        throw file_error(pointer + "/rotation", "found a quaternion of length 0, expected a unit quaternion");
    return compose(translation, rotation, scale);
}

double determinant(const matrix4 &m)
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
           m[8] * (m[1] * m[6] - m[2] * m[5]);
}

void store(const matrix4 &m, const std::string &pointer, float out[16])
{
    constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
    for (size_t i = 0; i < 16; i++) {
        if (!(std::abs(m[i]) <= largest))
            throw file_error(pointer, "found transforms that multiply to numbers beyond single precision");
        out[i] = static_cast<float>(m[i]);
    }
}
