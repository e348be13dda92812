/* tinygltf as another program uses it: reads a .glb with its own image loader and writes it again. */
#ifndef EXPORT_CARRY_TINYGLTF_H
#define EXPORT_CARRY_TINYGLTF_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* density: glintDensity of the first material; tangents: how many primitives of the first mesh have TANGENT. */
bool carry_tinygltf(const char *from, const char *to, double *density, int *tangents);

#ifdef __cplusplus
}
#endif

#endif
