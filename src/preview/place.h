/* Lays the facets out on the surface: from a hit to a footprint in metres. */
#ifndef PREVIEW_PLACE_H
#define PREVIEW_PLACE_H

#include "preview/hit.h"

/* The footprint of the ray on the surface, and in *density_scale what a density per m^2 of surface is to be multiplied
 * with so that it counts the facets of that footprint.
 *
 * In UV space a unit of the texture is glintUvScale metres, by definition. In object space the facets lie on the three
 * planes of the axes, in metres of the world; choice, a uniform in [0, 1), picks the plane, most often the one that
 * faces the surface. */
glint_footprint place_footprint(const scene_glint *g, const hit *h, const hit_step *step, float choice,
                                float *density_scale);

/* Else they lie on the planes, and choice is read. */
bool place_is_in_texture_space(const scene_glint *g, const scene_mesh *mesh);

/* Where u and v of that footprint run to, in world space and of any length; zero where the mesh does not say. */
void place_axes(const scene_glint *g, const hit *h, float choice, vec3 *along_u, vec3 *along_v);

#endif
