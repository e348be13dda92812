// A primitive while it becomes a scene_mesh: growing arrays, and the steps that glTF asks for between file and
// renderer.
#ifndef IO_GEOMETRY_HPP
#define IO_GEOMETRY_HPP

#include <cstdint>
#include <vector>

// Arrays of vertices are empty where the file has none.
struct geometry {
    uint32_t vertex_count = 0;
    std::vector<float> position;    // 3 a vertex
    std::vector<float> normal;      // 3
    std::vector<float> tangent;     // 4
    std::vector<float> texcoord[2]; // 2
    std::vector<float> color;       // 4
    std::vector<uint32_t> index;    // 3 a triangle
};

// Keeps the vertices that triangles use, where there are many others.
void geometry_drop_unused_vertices(geometry &g);

// Splits all vertices and gives each triangle its own normal; tangents are dropped (glTF 2.0 section 3.7.2.1).
void geometry_make_flat_normals(geometry &g);

// Makes all normals unit vectors. One that has no length becomes the mean of its triangles' normals, weighted by area.
// Returns how many of those there were.
uint32_t geometry_repair_normals(geometry &g);

// Makes tangents unit vectors and their handedness 1 or -1. Returns false when one has no length or is not finite.
bool geometry_normalise_tangents(geometry &g);

// MikkTSpace tangents from the texture coordinates of a set; vertices are split where tangents differ.
void geometry_compute_tangents(geometry &g, int texcoord_set);

#endif
