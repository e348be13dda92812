// Transforms of nodes: what glTF can say of them, and what is written in their place where it cannot.
#include "exporters/gltf/scene_transform.hpp"

#include <algorithm>
#include <cmath>

#include "exporters/gltf/scene_material.hpp"

namespace
{

double axis_length(const float m[16], size_t axis)
{
    const float *a = &m[4 * axis];
    return std::hypot(static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2]));
}

bool has_no_scale(const float m[16])
{
    for (size_t axis = 0; axis < 3; axis++)
        if (!(std::fabs(axis_length(m, axis) - 1.0) <= 1e-6))
            return false;
    return true;
}

void append_transformed(std::vector<float> &out, const double m[3][3], const float *v, bool unit)
{
    double w[3];
    for (size_t k = 0; k < 3; k++)
        w[k] = m[k][0] * static_cast<double>(v[0]) + m[k][1] * static_cast<double>(v[1]) +
               m[k][2] * static_cast<double>(v[2]);
    const double length = unit ? std::hypot(w[0], w[1], w[2]) : 1.0;
    for (const double component : w)
        out.push_back(static_cast<float>(length > 0.0 ? component / length : component));
}

} // namespace

bool is_right_angled(const float m[16])
{
    double length[3];
    for (size_t a = 0; a < 3; a++)
        length[a] = axis_length(m, a);
    for (size_t a = 0; a < 3; a++) {
        const size_t b = (a + 1) % 3;
        double dot = 0.0;
        for (size_t k = 0; k < 3; k++)
            dot += static_cast<double>(m[4 * a + k]) * static_cast<double>(m[4 * b + k]);
        if (!(std::fabs(dot) <= 1e-6 * length[a] * length[b]))
            return false;
    }
    return true;
}

void set_matrix(ordered_json &node, const float m[16])
{
    constexpr float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    if (!std::equal(m, m + 16, identity))
        node["matrix"] = export_numbers(m, 16);
}

std::array<float, 16> rigid(const float m[16])
{
    std::array<float, 16> out = {};
    if (is_right_angled(m) && has_no_scale(m)) {
        std::copy_n(m, 16, out.begin());
        return out;
    }
    double z[3], y[3];
    const double z_length = axis_length(m, 2);
    double dot = 0.0;
    for (size_t k = 0; k < 3; k++) {
        z[k] = static_cast<double>(m[8 + k]) / z_length;
        dot += z[k] * static_cast<double>(m[4 + k]);
    }
    for (size_t k = 0; k < 3; k++)
        y[k] = static_cast<double>(m[4 + k]) - dot * z[k];
    const double y_length = std::hypot(y[0], y[1], y[2]);
    for (size_t k = 0; k < 3; k++) {
        const size_t i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = static_cast<float>((y[i] * z[j] - y[j] * z[i]) / y_length);
        out[4 + k] = static_cast<float>(y[k] / y_length);
        out[8 + k] = static_cast<float>(z[k]);
        out[12 + k] = m[12 + k];
    }
    out[15] = 1.0F;
    return out;
}

placed_mesh placed(const scene_mesh &mesh, const float to_world[16])
{
    double m[3][3], cofactor[3][3];
    for (size_t row = 0; row < 3; row++)
        for (size_t column = 0; column < 3; column++)
            m[row][column] = static_cast<double>(to_world[4 * column + row]);
    for (size_t r = 0; r < 3; r++)
        for (size_t c = 0; c < 3; c++)
            cofactor[r][c] = m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] -
                             m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3];
    const double turn = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    for (auto &row : cofactor)
        for (double &value : row)
            value = turn < 0.0 ? -value : value;
    placed_mesh out;
    for (size_t v = 0; v < mesh.vertex_count; v++) {
        append_transformed(out.position, m, &mesh.position[3 * v], false);
        for (size_t k = 0; k < 3; k++)
            out.position[3 * v + k] += to_world[12 + k];
        append_transformed(out.normal, cofactor, &mesh.normal[3 * v], true);
        if (!mesh.tangent)
            continue;
        append_transformed(out.tangent, m, &mesh.tangent[4 * v], true);
        out.tangent.push_back(turn < 0.0 ? -mesh.tangent[4 * v + 3] : mesh.tangent[4 * v + 3]);
    }
    out.index.assign(mesh.index, mesh.index + size_t{ 3 } * mesh.triangle_count);
    for (size_t t = 0; turn < 0.0 && t < mesh.triangle_count; t++)
        std::swap(out.index[3 * t + 1], out.index[3 * t + 2]);
    return out;
}
