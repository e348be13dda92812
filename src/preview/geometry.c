/* Exact meeting of a ray with a triangle that Embree has found: Embree says which, this says where. */
#include "preview/geometry.h"

#include <stdlib.h>

bool geometry_make(const scene *s, geometry *out, report *r)
{
    out->scene = s;
    out->instances = calloc(s->instance_count > 0 ? (size_t)s->instance_count : 1U, sizeof *out->instances);
    if (out->instances == NULL)
        return report_error(r, "%s: no memory for %d instances", s->path ? s->path : "scene", s->instance_count);

    for (int i = 0; i < s->instance_count; ++i) {
        geometry_instance *const to = &out->instances[i];
        for (int k = 0; k < 16; ++k)
            to->to_world[k] = (double)s->instances[i].to_world[k];
        to->axis_scale = v3(v3_length(m4_column(to->to_world, 0)), v3_length(m4_column(to->to_world, 1)),
                            v3_length(m4_column(to->to_world, 2)));
        to->mirrored =
            v3_dot(m4_column(to->to_world, 0), v3_cross(m4_column(to->to_world, 1), m4_column(to->to_world, 2))) < 0.0;
        to->visible = m4_invert_affine(to->to_world, to->to_object);
    }
    geometry_warn_of_flat(out, r);
    return true;
}

void geometry_warn_of_flat(const geometry *g, report *r)
{
    const scene *const s = g->scene;
    for (int i = 0; i < s->instance_count; ++i) {
        if (!g->instances[i].visible)
            report_warning(r, "%s: nodes/%d (\"%s\"): its transform flattens it; it is not rendered",
                           s->path ? s->path : "scene", s->instances[i].node,
                           s->instances[i].name ? s->instances[i].name : "");
    }
}

void geometry_free(geometry *g)
{
    free(g->instances);
    *g = (geometry){ 0 };
}

triangle_corners geometry_triangle(const geometry *g, int instance, uint32_t triangle)
{
    const scene_mesh *const mesh = &g->scene->meshes[g->scene->instances[instance].mesh];
    triangle_corners c;
    for (int k = 0; k < 3; ++k) {
        c.index[k] = mesh->index[3U * (size_t)triangle + (size_t)k];
        c.position[k] = v3_from(&mesh->position[3U * (size_t)c.index[k]]);
    }
    return c;
}

bool geometry_meet(const geometry *g, int instance, uint32_t triangle, vec3 origin, vec3 direction, double weights[2],
                   double *distance)
{
    const geometry_instance *const placed = &g->instances[instance];
    const triangle_corners c = geometry_triangle(g, instance, triangle);
    const vec3 o = m4_point(placed->to_object, origin);
    const vec3 d = m4_vector(placed->to_object, direction); /* not unit: keeps distances in metres of the world */
    const vec3 e1 = v3_sub(c.position[1], c.position[0]);
    const vec3 e2 = v3_sub(c.position[2], c.position[0]);
    const vec3 n = v3_cross(e1, e2);
    const vec3 to_corner = v3_sub(c.position[0], o);

    /* Cramer's rule for o + t d = v0 + b1 e1 + b2 e2 (Moeller and Trumbore 1997). */
    const double determinant = v3_dot(n, d);
    const double t = v3_dot(n, to_corner) / determinant;
    const vec3 q = v3_cross(to_corner, d);
    const double b1 = v3_dot(e2, q) / determinant;
    const double b2 = -v3_dot(e1, q) / determinant;
    if (!isfinite(t) || !isfinite(b1) || !isfinite(b2))
        return false;

    weights[0] = smaller_of(larger_of(b1, 0.0), 1.0);
    weights[1] = smaller_of(larger_of(b2, 0.0), 1.0 - weights[0]);
    *distance = t;
    return true;
}
