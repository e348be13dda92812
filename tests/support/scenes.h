/* Scenes made in C for tests: planes, spheres, lights and textures whose right picture is known by hand. */
#ifndef SUPPORT_SCENES_H
#define SUPPORT_SCENES_H

#include "scene/scene.h"

/* Everything is freed by scene_free. A failed allocation ends the test program. */
scene scenes_empty(void);

/* Diffuse and nothing else: specular 0, so that f = color / pi. */
scene_material scenes_matte(float color);
/* A metal with counted facets in texture space, one unit a metre. */
scene_material scenes_flakes(float roughness, float facets_per_m2);

/* Each returns an index into its array of the scene. */
int scenes_add_material(scene *s, const scene_material *m);
/* A square in the plane y = 0 that faces +y, half_size metres to each side, (s, t) from (0, 0) at (-x, -z) to (1, 1).
 */
int scenes_add_square(scene *s, int material, float half_size);
/* Centred, y up, smooth normals; (s, t) are longitude and colatitude, both in [0, 1]. */
int scenes_add_sphere(scene *s, int material, float radius, int slices, int stacks);
/* Any triangles, with flat normals and without texture coordinates. Three vertices a triangle. */
int scenes_add_triangles(scene *s, int material, const float *positions, uint32_t triangle_count);

/* to_world: column-major, or NULL for the identity. Grows the bounds. */
void scenes_add_instance(scene *s, int mesh, const float *to_world, int node);
/* Shines from `from` towards the origin; a directional light only takes the direction. Fields may be changed after. */
scene_light *scenes_add_light(scene *s, scene_light_kind kind, const float from[3], float intensity);
/* At eye, looking at target; yfov as given for a perspective, half the height in metres for an orthographic one. */
scene_camera scenes_camera(scene_projection projection, const float eye[3], const float target[3], float size);

/* A picture of width x height texels, RGBA bytes as the file stores them, and a texture that shows it unfiltered. */
scene_texture scenes_add_texture(scene *s, const uint8_t *rgba, int width, int height);

/* Column-major, for scenes_add_instance. */
void scenes_translation(float m[16], float x, float y, float z);

#endif
