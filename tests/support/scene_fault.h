/* Whether a scene keeps the promises of scene.h, whatever it was read from. */
#ifndef SUPPORT_SCENE_FAULT_H
#define SUPPORT_SCENE_FAULT_H

#include <math.h>

#include "scene/scene.h"

static inline bool scene_fault_finite(const float *values, size_t count)
{
    for (size_t i = 0; values && i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Lengths that differ from 1 by more than a few roundings are a fault; width 3 or 4, of which 3 count. */
static inline bool scene_fault_unit(const float *values, size_t width, size_t count)
{
    for (size_t i = 0; values && i < count; i++) {
        const float *v = &values[width * i];
        if (!(fabsf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1.0F) < 1e-5F))
            return false;
    }
    return true;
}

static inline const char *scene_fault_of_mesh(const scene *s, const scene_mesh *m)
{
    const size_t n = m->vertex_count;
    if (!m->name || m->material < 0 || m->material >= s->material_count)
        return "a mesh without a name or a material";
    if (n == 0 || m->triangle_count == 0 || !m->position || !m->normal || !m->index)
        return "a mesh without geometry";
    for (size_t i = 0; i < 3 * (size_t)m->triangle_count; i++)
        if (m->index[i] >= n)
            return "an index beyond the vertices";
    if (!scene_fault_finite(m->position, 3 * n) || !scene_fault_finite(m->texcoord[0], 2 * n) ||
        !scene_fault_finite(m->texcoord[1], 2 * n) || !scene_fault_finite(m->color, 4 * n))
        return "a vertex that is not finite";
    if (!scene_fault_unit(m->normal, 3, n) || !scene_fault_unit(m->tangent, 4, n))
        return "a normal or tangent that is no unit vector";
    return NULL;
}

/* NULL when nothing is wrong. */
static inline const char *scene_fault(const scene *s)
{
    for (int i = 0; i < s->mesh_count; i++) {
        const char *fault = scene_fault_of_mesh(s, &s->meshes[i]);
        if (fault)
            return fault;
    }
    for (int i = 0; i < s->instance_count; i++)
        if (s->instances[i].mesh < 0 || s->instances[i].mesh >= s->mesh_count ||
            !scene_fault_finite(s->instances[i].to_world, 16))
            return "an instance of nothing or nowhere";
    for (int i = 0; i < s->material_count; i++)
        if (!s->materials[i].name || s->materials[i].base_color_texture.image >= s->image_count ||
            s->materials[i].glint.texture.image >= s->image_count)
            return "a material without a name or with a texture of no image";
    for (int i = 0; i < s->image_count; i++)
        if (!s->images[i].name || (s->images[i].path && s->images[i].bytes))
            return "an image that is both a file and bytes, or has no name";
    return NULL;
}

#endif
