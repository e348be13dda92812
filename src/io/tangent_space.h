/* Tangents as MikkTSpace defines them, which is what normal textures are baked for and glTF 2.0 asks for. */
#ifndef IO_TANGENT_SPACE_H
#define IO_TANGENT_SPACE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tangent_space_input {
    uint32_t vertex_count, triangle_count;
    const float *position; /* 3 a vertex */
    const float *normal;   /* 3, unit */
    const float *texcoord; /* 2 */
    const uint32_t *index; /* 3 a triangle, each below vertex_count */
} tangent_space_input;

/* Writes 4 floats for each corner of each triangle: the unit tangent, orthogonal to the normal of the vertex, and the
 * handedness w (bitangent = w * cross(normal, tangent)). Corners of one vertex may differ: where texture coordinates
 * are mirrored or break. A corner without usable texture coordinates gets a tangent that is orthogonal to its normal, w
 * = 1. Returns false when memory is short. */
bool tangent_space_compute(const tangent_space_input *in, float *corner_tangents);

#ifdef __cplusplus
}
#endif

#endif
