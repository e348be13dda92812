/* What a scene owns, and the defaults of the glTF 2.0 text for what a file leaves out. */
#include "scene/scene.h"

#include <stdlib.h>

static void free_images(scene *s)
{
    for (int i = 0; i < s->image_count; i++) {
        free(s->images[i].name);
        free(s->images[i].path);
        free(s->images[i].bytes);
        free(s->images[i].texels);
    }
    free(s->images);
}

static void free_meshes(scene *s)
{
    for (int i = 0; i < s->mesh_count; i++) {
        scene_mesh *m = &s->meshes[i];
        free(m->name);
        free(m->position);
        free(m->normal);
        free(m->tangent);
        free(m->texcoord[0]);
        free(m->texcoord[1]);
        free(m->color);
        free(m->index);
    }
    free(s->meshes);
}

static void free_names(scene *s)
{
    for (int i = 0; i < s->material_count; i++)
        free(s->materials[i].name);
    for (int i = 0; i < s->instance_count; i++)
        free(s->instances[i].name);
    for (int i = 0; i < s->camera_count; i++)
        free(s->cameras[i].name);
    for (int i = 0; i < s->light_count; i++)
        free(s->lights[i].name);
    for (int i = 0; i < s->variant_count; i++)
        free(s->variants[i]);
    free(s->environment.name);
}

void scene_free(scene *s)
{
    if (!s)
        return;
    free_images(s);
    free_meshes(s);
    free_names(s);
    free(s->materials);
    free(s->instances);
    free(s->cameras);
    free(s->lights);
    free(s->variants);
    free(s->path);
    *s = (scene){ 0 };
}

scene_texture scene_texture_none(void)
{
    return (scene_texture){ .image = SCENE_NONE, .scale = { 1.0F, 1.0F }, .strength = 1.0F };
}

/* The defaults of exporters/gltf/GLINT_materials_glint. The example's are our choice: a tile of one centimetre;
 * scattered ones lie in every direction and differ in size by a fifth. */
static scene_glint glint_default(void)
{
    return (scene_glint){ .texture = scene_texture_none(),
                          .density = 1e8F,
                          .density_texture = scene_texture_none(),
                          .facet_roughness = 0.05F,
                          .color = { 1.0F, 1.0F, 1.0F },
                          .color_texture = scene_texture_none(),
                          .elongation = 1.0F,
                          .coverage = 1.0F,
                          .uv_scale = 1.0F,
                          .example_texture = scene_texture_none(),
                          .example_size = 0.01F,
                          .example_rotation_variation = 3.1415927F,
                          .example_scale_variation = 0.2F };
}

scene_material scene_material_default(void)
{
    return (scene_material){ .base_color = { 1.0F, 1.0F, 1.0F, 1.0F },
                             .base_color_texture = scene_texture_none(),
                             .metallic = 1.0F,
                             .roughness = 1.0F,
                             .metallic_roughness_texture = scene_texture_none(),
                             .normal_texture = scene_texture_none(),
                             .occlusion_texture = scene_texture_none(),
                             .emissive_texture = scene_texture_none(),
                             .alpha_cutoff = 0.5F,
                             .ior = 1.5F,
                             .specular = 1.0F,
                             .specular_color = { 1.0F, 1.0F, 1.0F },
                             .specular_texture = scene_texture_none(),
                             .specular_color_texture = scene_texture_none(),
                             .anisotropy_texture = scene_texture_none(),
                             .clearcoat_texture = scene_texture_none(),
                             .clearcoat_roughness_texture = scene_texture_none(),
                             .clearcoat_normal_texture = scene_texture_none(),
                             .glint = glint_default(),
                             .coat_glint = glint_default() };
}

const scene_glint *scene_layer_glint(const scene_material *m, scene_glint_layer layer)
{
    const scene_glint *const glint =
        layer == SCENE_LAYER_CLEARCOAT && m->coat_glint.present ? &m->coat_glint : &m->glint;
    return glint->present && glint->layer == layer ? glint : NULL;
}
