/* From what a glTF material says to what libglint evaluates. */
#ifndef SCENE_SURFACE_H
#define SCENE_SURFACE_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The values at one point, textures and vertex colours multiplied in. */
typedef struct scene_texels {
    float base_color[4];
    float metallic, roughness;
    float specular, specular_color[3];
    float anisotropy; /* strength */
    float clearcoat, clearcoat_roughness;
    float glint_factor, glint_density, glint_color[3];                /* of scene_material.glint */
    float coat_glint_factor, coat_glint_density, coat_glint_color[3]; /* of scene_material.coat_glint */
} scene_texels;

/* The material's own factors: what every texel is multiplied with. */
scene_texels scene_texels_of(const scene_material *m);

/* The base layer at a point: metallic-roughness with KHR_materials_specular, _ior and _anisotropy (glTF 2.0 appendix
 * B). */
glint_surface scene_base_surface(const scene_material *m, const scene_texels *t);
/* The clear coat at a point: a dielectric of ior 1.5 over the base (KHR_materials_clearcoat), without its weight. */
glint_surface scene_coat_surface(const scene_material *m, const scene_texels *t);

/* The model that shows what a layer asks for: example for a normal map, dictionary for a density that varies, counting
 * otherwise. */
glint_model scene_model_of(const scene_glint *g);

/* A map of normals has its own directions: of the roughness only the size counts, which stretches its slopes. */
void scene_forget_directions(glint_surface *s);

/* What is common to all points; model GLINT_MODEL_SMOOTH where the layer has no glints. Layers never share facets:
 * where both have glints the coat's seed is another even when the file says the same. */
glint_material_options scene_base_options(const scene_material *m, glint_model model);
glint_material_options scene_coat_options(const scene_material *m, glint_model model);

#ifdef __cplusplus
}
#endif

#endif
