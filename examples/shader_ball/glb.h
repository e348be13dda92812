/* A binary glTF file of triangle meshes; the nodes, materials, cameras and lights come as JSON text. */
#ifndef SHADER_BALL_GLB_H
#define SHADER_BALL_GLB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct glb_vertex {
    float position[3], normal[3];
    float tangent[4]; /* w: the bitangent is w * cross(normal, tangent) */
    float texcoord[2];
} glb_vertex;

typedef struct glb_mesh {
    const char *name;
    int material;
    glb_vertex *vertices;
    uint32_t vertex_count, vertex_capacity;
    uint32_t *indices;
    uint32_t index_count, index_capacity;
} glb_mesh;

/* These end the program when there is no memory. */
void glb_add_vertex(glb_mesh *mesh, const glb_vertex *vertex);
void glb_add_triangle(glb_mesh *mesh, uint32_t a, uint32_t b, uint32_t c);
void glb_mesh_free(glb_mesh *mesh);

/* members: the members of the glTF object other than meshes, accessors, bufferViews and buffers, without braces. The
 * file appears under its name only when it is whole. On failure says why on standard error and returns false. */
bool glb_write(const char *path, const char *members, const glb_mesh *meshes, size_t mesh_count);

#endif
