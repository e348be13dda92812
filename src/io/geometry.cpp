// Normals, tangents and vertices as glTF 2.0 section 3.7.2.1 wants them.
#include "io/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numeric>

#include "io/tangent_space.h"

namespace
{

// The vertices of out are those of g that the list names, in its order.
void gather(std::vector<float> &values, size_t width, const std::vector<uint32_t> &vertices)
{
    if (values.empty())
        return;
    std::vector<float> gathered(vertices.size() * width);
    for (size_t i = 0; i < vertices.size(); i++)
        std::copy_n(&values[vertices[i] * width], width, &gathered[i * width]);
    values.swap(gathered);
}

void gather_vertices(geometry &g, const std::vector<uint32_t> &vertices)
{
    gather(g.position, 3, vertices);
    gather(g.normal, 3, vertices);
    gather(g.tangent, 4, vertices);
    gather(g.texcoord[0], 2, vertices);
    gather(g.texcoord[1], 2, vertices);
    gather(g.color, 4, vertices);
    g.vertex_count = static_cast<uint32_t>(vertices.size());
}

// Twice the area times the normal of a triangle; in double, so that small triangles far from the origin keep a
// direction.
void area_normal(const geometry &g, const uint32_t *corners, double out[3])
{
    double edge[2][3];
    for (size_t e = 0; e < 2; e++)
        for (size_t k = 0; k < 3; k++)
            edge[e][k] = static_cast<double>(g.position[corners[e + 1] * size_t{ 3 } + k]) -
                         static_cast<double>(g.position[corners[0] * size_t{ 3 } + k]);
    for (size_t k = 0; k < 3; k++) {
        const size_t a = (k + 1) % 3, b = (k + 2) % 3;
        out[k] = edge[0][a] * edge[1][b] - edge[0][b] * edge[1][a];
    }
}

// False when v has no direction. It is made of floats: their squares, and those of products of two, are doubles.
bool normalise(const double v[3], float *out)
{
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0.0) || std::isinf(length))
        return false;
    for (size_t k = 0; k < 3; k++)
        out[k] = static_cast<float>(v[k] / length);
    return true;
}

bool normalise(float *v)
{
    const double wide[3] = { static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]) };
    return normalise(wide, v);
}

// A triangle without area has no normal and is never seen: any unit vector will do.
void normalise_or_up(const double v[3], float *out)
{
    if (normalise(v, out))
        return;
    out[0] = out[1] = 0.0F;
    out[2] = 1.0F;
}

} // namespace

void geometry_drop_unused_vertices(geometry &g)
{
    if (g.vertex_count <= g.index.size())
        return;
    constexpr uint32_t unused = UINT32_MAX;
    std::vector<uint32_t> renumbered(g.vertex_count, unused), vertices;
    for (uint32_t &corner : g.index) {
        if (renumbered[corner] == unused) {
            renumbered[corner] = static_cast<uint32_t>(vertices.size());
            vertices.push_back(corner);
        }
        corner = renumbered[corner];
    }
    gather_vertices(g, vertices);
}

void geometry_make_flat_normals(geometry &g)
{
    g.tangent.clear();
    gather_vertices(g, g.index);
    g.normal.resize(g.vertex_count * size_t{ 3 });
    for (uint32_t i = 0; i < g.vertex_count; i++)
        g.index[i] = i;
    for (uint32_t i = 0; i < g.vertex_count; i += 3) {
        double n[3];
        area_normal(g, &g.index[i], n);
        for (size_t corner = 0; corner < 3; corner++)
            normalise_or_up(n, &g.normal[(i + corner) * 3]);
    }
}

uint32_t geometry_repair_normals(geometry &g)
{
    std::vector<uint32_t> broken;
    for (uint32_t i = 0; i < g.vertex_count; i++)
        if (!normalise(&g.normal[i * size_t{ 3 }]))
            broken.push_back(i);
    if (broken.empty())
        return 0;
    std::vector<double> sums(g.vertex_count * size_t{ 3 }, 0.0);
    for (size_t i = 0; i < g.index.size(); i += 3) {
        double n[3];
        area_normal(g, &g.index[i], n);
        for (size_t corner = 0; corner < 3; corner++)
            for (size_t k = 0; k < 3; k++)
                sums[g.index[i + corner] * size_t{ 3 } + k] += n[k];
    }
    for (const uint32_t i : broken)
        normalise_or_up(&sums[i * size_t{ 3 }], &g.normal[i * size_t{ 3 }]);
    return static_cast<uint32_t>(broken.size());
}

bool geometry_normalise_tangents(geometry &g)
{
    for (size_t i = 0; i < g.tangent.size(); i += 4) {
        if (!normalise(&g.tangent[i]))
            return false;
        g.tangent[i + 3] = g.tangent[i + 3] < 0.0F ? -1.0F : 1.0F;
    }
    return true;
}

void geometry_compute_tangents(geometry &g, int texcoord_set)
{
    std::vector<float> corner_tangents(g.index.size() * 4);
    const tangent_space_input input = { g.vertex_count,  static_cast<uint32_t>(g.index.size() / 3), g.position.data(),
                                        g.normal.data(), g.texcoord[texcoord_set].data(),           g.index.data() };
    if (!tangent_space_compute(&input, corner_tangents.data()))
        throw std::bad_alloc();

    // Sorted, the corners that may share a vertex are neighbours. Only tangents of the same bits share: any order of
    // bits will do.
    std::vector<uint32_t> corners(g.index.size());
    std::iota(corners.begin(), corners.end(), 0U);
    const auto compare = [&](uint32_t a, uint32_t b) {
        return g.index[a] != g.index[b] ? (g.index[a] < g.index[b] ? -1 : 1)
                                        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
                                        : std::memcmp(&corner_tangents[a * size_t{ 4 }],
                                                      &corner_tangents[b * size_t{ 4 }], 4 * sizeof(float));
    };
    std::sort(corners.begin(), corners.end(), [&](uint32_t a, uint32_t b) { return compare(a, b) < 0; });
    std::vector<uint32_t> index(g.index.size()), source;
    std::vector<float> tangents;
    for (size_t i = 0; i < corners.size(); i++) {
        if (i == 0 || compare(corners[i - 1], corners[i]) != 0) {
            source.push_back(g.index[corners[i]]);
            const float *tangent = &corner_tangents[corners[i] * size_t{ 4 }];
            tangents.insert(tangents.end(), tangent, tangent + 4);
        }
        index[corners[i]] = static_cast<uint32_t>(source.size() - 1);
    }
    g.index.swap(index);
    g.tangent.clear();
    gather_vertices(g, source);
    g.tangent.swap(tangents);
}
