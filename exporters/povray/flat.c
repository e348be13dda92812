/* Finds the plane on which the flakes of a flat object lie, so that they can be the very flakes of libglint. */
#include "exporters/povray/povray.h"

/* Relative to the size of the object, or of a right angle: single precision over a few operations. */
#define TOLERANCE 1e-4

static vec world_vertex(const scene_mesh *mesh, const scene_instance *i, uint32_t vertex)
{
    return matrix_point(i->to_world, vec_of(&mesh->position[3 * (size_t)vertex]));
}

/* The corners of the triangle with the most area, so that its plane is the best known. */
static bool largest_triangle(const scene_mesh *mesh, const scene_instance *i, uint32_t corner[3], vec *normal)
{
    double largest = 0.0;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        const uint32_t *c = &mesh->index[3 * (size_t)t];
        const vec a = world_vertex(mesh, i, c[0]);
        const vec n = vec_cross(vec_sub(world_vertex(mesh, i, c[1]), a), vec_sub(world_vertex(mesh, i, c[2]), a));
        const double area = vec_length(n);
        if (!(area > largest))
            continue;
        largest = area;
        *normal = vec_scale(n, 1.0 / area);
        for (int k = 0; k < 3; ++k)
            corner[k] = c[k];
    }
    return largest > 0.0;
}

/* All vertices in the plane, all normals along it. *size: the furthest from the corner. */
static bool is_flat(const scene_mesh *mesh, const scene_instance *i, vec corner, vec *normal, double *size)
{
    double off = 0.0;
    *size = 0.0;
    for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
        const vec d = vec_sub(world_vertex(mesh, i, v), corner);
        *size = fmax(*size, vec_length(d));
        off = fmax(off, fabs(vec_dot(d, *normal)));
    }
    if (!(off <= TOLERANCE * *size))
        return false;
    const vec first = matrix_normal(i->to_world, vec_of(mesh->normal));
    if (vec_dot(first, *normal) < 0.0)
        *normal = vec_scale(*normal, -1.0);
    for (uint32_t v = 0; v < mesh->vertex_count; ++v)
        if (vec_dot(matrix_normal(i->to_world, vec_of(&mesh->normal[3 * (size_t)v])), *normal) < 1.0 - TOLERANCE)
            return false;
    return true;
}

/* Texture coordinates that are a similarity of the plane: u and v at right angles and of one scale. */
static bool by_texcoord(const scene_mesh *mesh, const scene_instance *i, const scene_glint *g, const uint32_t corner[3],
                        double size, flat *out)
{
    const float *uv = mesh->texcoord[g->texcoord];
    const double scale = (double)g->uv_scale;
    const vec p0 = world_vertex(mesh, i, corner[0]);
    const vec e1 = vec_sub(world_vertex(mesh, i, corner[1]), p0), e2 = vec_sub(world_vertex(mesh, i, corner[2]), p0);
    const float *a = &uv[2 * (size_t)corner[0]], *b = &uv[2 * (size_t)corner[1]], *c = &uv[2 * (size_t)corner[2]];
    const double u0 = (double)a[0] * scale, v0 = (double)a[1] * scale;
    const double u1 = (double)b[0] * scale - u0, v1 = (double)b[1] * scale - v0;
    const double u2 = (double)c[0] * scale - u0, v2 = (double)c[1] * scale - v0;
    const double determinant = u1 * v2 - u2 * v1;
    if (!(fabs(determinant) > 0.0))
        return false;
    const vec du = vec_scale(vec_sub(vec_scale(e1, v2), vec_scale(e2, v1)), 1.0 / determinant);
    const vec dv = vec_scale(vec_sub(vec_scale(e2, u1), vec_scale(e1, u2)), 1.0 / determinant);
    const double lu = vec_length(du), lv = vec_length(dv);
    if (!(lu > 0.0) || !(fabs(lv / lu - 1.0) < TOLERANCE) || !(fabs(vec_dot(du, dv)) < TOLERANCE * lu * lv))
        return false;
    const vec at = vec_sub(p0, vec_add(vec_scale(du, u0), vec_scale(dv, v0)));
    for (uint32_t k = 0; k < mesh->vertex_count; ++k) {
        const double u = (double)uv[2 * (size_t)k] * scale, v = (double)uv[2 * (size_t)k + 1] * scale;
        const vec expected = vec_add(at, vec_add(vec_scale(du, u), vec_scale(dv, v)));
        if (!(vec_length(vec_sub(expected, world_vertex(mesh, i, k))) <= TOLERANCE * size))
            return false;
    }
    out->at = at;
    out->across = vec_unit(du);
    out->along = vec_unit(vec_sub(dv, vec_scale(out->across, vec_dot(dv, out->across))));
    out->stretch = lu;
    return true;
}

/* A surface that faces one of the object's axes: the other two carry the flakes, in metres of the world. */
static bool by_axis(const scene_instance *i, vec point, flat *out)
{
    vec axis[3];
    for (int k = 0; k < 3; ++k)
        axis[k] = vec_unit(matrix_column(i->to_world, k));
    int plane = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(vec_dot(axis[k], out->normal)) > fabs(vec_dot(axis[plane], out->normal)))
            plane = k;
    out->across = axis[(plane + 1) % 3];
    out->along = axis[(plane + 2) % 3];
    if (fabs(vec_dot(out->across, out->along)) > TOLERANCE || fabs(vec_dot(out->across, out->normal)) > TOLERANCE ||
        fabs(vec_dot(out->along, out->normal)) > TOLERANCE)
        return false;
    const vec origin = matrix_column(i->to_world, 3);
    out->at = vec_add(origin, vec_scale(out->normal, vec_dot(vec_sub(point, origin), out->normal)));
    out->stretch = 1.0;
    return true;
}

bool flat_find(const scene *s, const scene_instance *instance, flat *out)
{
    const scene_mesh *mesh = &s->meshes[instance->mesh];
    const scene_glint *g = &s->materials[mesh->material].glint;
    uint32_t corner[3] = { 0 };
    double size;
    *out = (flat){ 0 };
    if (!largest_triangle(mesh, instance, corner, &out->normal))
        return false;
    const vec point = world_vertex(mesh, instance, corner[0]);
    if (!is_flat(mesh, instance, point, &out->normal, &size))
        return false;
    if (g->present && g->space == SCENE_SPACE_UV && mesh->texcoord[g->texcoord])
        return by_texcoord(mesh, instance, g, corner, size, out);
    return by_axis(instance, point, out);
}
