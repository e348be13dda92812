/* Scenes that another program holds in memory: the same checks, normals and tangents as for a file. */
#ifndef IO_SCENE_BUILD_H
#define IO_SCENE_BUILD_H

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Appends the materials of a glTF 2.0 document that holds "materials", "textures" and "samplers" to a scene that has
 * none yet. "source" of a texture is an index into the images that the scene has; "images" of the document do not
 * count. Errors name the JSON pointer. */
bool scene_build_materials(scene *s, const char *text, size_t length, report *r);

/* The caller's arrays; NULL: there is none. They are copied. */
typedef struct scene_arrays {
    const char *name;
    uint32_t vertex_count, triangle_count;
    const float *position;    /* 3 a vertex */
    const float *normal;      /* 3 a vertex, of any length; NULL: flat */
    const float *tangent;     /* 4 a vertex; NULL: MikkTSpace, where the material needs one */
    const float *texcoord[2]; /* 2 a vertex */
    const float *color;       /* 4 a vertex, linear */
    const uint32_t *index;    /* 3 a triangle */
    const int32_t *material;  /* 1 a triangle; NULL: 0 */
} scene_arrays;

/* Appends one mesh for every material that triangles of the arrays have, to meshes that only this function has made.
 * What is not finite and every index out of range is an error that names the array and the place in it. */
bool scene_build_mesh(scene *s, const scene_arrays *from, report *r);

/* Whether scene_build_mesh makes the same meshes with one material as with the other. */
bool scene_build_same_meshes(const scene_material *a, const scene_material *b);

#ifdef __cplusplus
}
#endif

#endif
