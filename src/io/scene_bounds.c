/* The box around all instances, in world space. */
#include "io/scene_bounds.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Our choice: about a second of work. */
static const uint64_t max_transforms = (uint64_t)1 << 28;

typedef struct box {
    float low[3], high[3];
} box;

static const box empty_box = { { FLT_MAX, FLT_MAX, FLT_MAX }, { -FLT_MAX, -FLT_MAX, -FLT_MAX } };

static void extend(box *b, const float point[3])
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = point[k] < b->low[k] ? point[k] : b->low[k];
        b->high[k] = point[k] > b->high[k] ? point[k] : b->high[k];
    }
}

static void extend_transformed(box *b, const float m[16], const float p[3])
{
    float moved[3];
    for (int k = 0; k < 3; k++)
        moved[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
    extend(b, moved);
}

static box box_of_mesh(const scene_mesh *mesh)
{
    box b = empty_box;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        extend(&b, &mesh->position[3 * (size_t)i]);
    return b;
}

static void extend_by_corners(box *b, const float m[16], const box *local)
{
    for (int corner = 0; corner < 8; corner++) {
        const float p[3] = { corner & 1 ? local->high[0] : local->low[0], corner & 2 ? local->high[1] : local->low[1],
                             corner & 4 ? local->high[2] : local->low[2] };
        extend_transformed(b, m, p);
    }
}

static void extend_by_vertices(box *b, const float m[16], const scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        extend_transformed(b, m, &mesh->position[3 * (size_t)i]);
}

static bool is_small(const scene *s)
{
    uint64_t transforms = 0;
    for (int i = 0; i < s->instance_count; i++)
        transforms += s->meshes[s->instances[i].mesh].vertex_count;
    return transforms <= max_transforms;
}

void scene_compute_bounds(scene *s)
{
    box world = empty_box;
    box *boxes = is_small(s) ? NULL : malloc((size_t)s->mesh_count * sizeof *boxes);
    for (int i = 0; boxes && i < s->mesh_count; i++)
        boxes[i] = box_of_mesh(&s->meshes[i]);
    for (int i = 0; i < s->instance_count; i++) {
        const scene_instance *instance = &s->instances[i];
        if (boxes)
            extend_by_corners(&world, instance->to_world, &boxes[instance->mesh]);
        else
            extend_by_vertices(&world, instance->to_world, &s->meshes[instance->mesh]);
    }
    free(boxes);
    for (int k = 0; k < 3; k++) {
        s->bounds_min[k] = s->instance_count > 0 ? world.low[k] : 1.0F;
        s->bounds_max[k] = s->instance_count > 0 ? world.high[k] : -1.0F;
    }
}

/* An edge of a triangle in the world; in double, so that small triangles far from the origin keep their area. */
static void world_edge(const scene_mesh *mesh, const float *m, const uint32_t *corners, int which, double edge[3])
{
    const float *from = &mesh->position[3 * (size_t)corners[0]], *to = &mesh->position[3 * (size_t)corners[which]];
    for (int k = 0; k < 3; k++) {
        edge[k] = 0.0;
        for (int j = 0; j < 3; j++)
            edge[k] += (double)m[4 * j + k] * ((double)to[j] - (double)from[j]);
    }
}

double scene_triangle_area(const scene *s, const scene_instance *instance, uint32_t triangle)
{
    const scene_mesh *mesh = &s->meshes[instance->mesh];
    double a[3], b[3];
    world_edge(mesh, instance->to_world, &mesh->index[3 * (size_t)triangle], 1, a);
    world_edge(mesh, instance->to_world, &mesh->index[3 * (size_t)triangle], 2, b);
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return 0.5 * sqrt(x * x + y * y + z * z);
}
