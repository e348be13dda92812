/* The one list of a material's textures, for all that is done to each of them alike. */
#include <string.h>

#include "scene/scene.h"

void scene_material_textures(const scene_material *m, const scene_texture *list[SCENE_MATERIAL_TEXTURES])
{
    const scene_texture *const all[SCENE_MATERIAL_TEXTURES] = {
        &m->base_color_texture,          &m->metallic_roughness_texture, &m->normal_texture,
        &m->occlusion_texture,           &m->emissive_texture,           &m->specular_texture,
        &m->specular_color_texture,      &m->anisotropy_texture,         &m->clearcoat_texture,
        &m->clearcoat_roughness_texture, &m->clearcoat_normal_texture,   &m->glint.texture,
        &m->glint.density_texture,       &m->glint.color_texture,        &m->glint.example_texture,
        &m->coat_glint.texture,          &m->coat_glint.density_texture, &m->coat_glint.color_texture,
        &m->coat_glint.example_texture,
    };
    memcpy(list, all, sizeof all);
}
