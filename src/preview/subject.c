/* Finds what a camera looks at: the half of the vertices in the middle of the view that is nearer is in front of it. */
#include "preview/subject.h"

#include <stdlib.h>

/* Of the picture's height: around its middle. */
#define WINDOW 0.5
/* Vertices that are looked at, at most: of larger scenes every n-th. */
#define MOST_VERTICES 200000.0

typedef struct view_axes {
    vec3 right, up, backward, eye;
    bool perspective;
    double slope, height; /* half the height of the picture: at depth 1, or anywhere */
} view_axes;

static view_axes axes_of(const scene_camera *c)
{
    double m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = (double)c->to_world[i];
    return (view_axes){ .right = v3_normalize(m4_column(m, 0)),
                        .up = v3_normalize(m4_column(m, 1)),
                        .backward = v3_normalize(m4_column(m, 2)),
                        .eye = m4_column(m, 3),
                        .perspective = c->projection == SCENE_PERSPECTIVE,
                        .slope = tan(0.5 * (double)c->yfov_rad),
                        .height = (double)c->ymag };
}

static double half_height(const view_axes *v, double depth)
{
    return v->perspective ? v->slope * depth : v->height;
}

static bool in_the_middle(const view_axes *v, vec3 point, double *depth)
{
    const vec3 from_eye = v3_sub(point, v->eye);
    *depth = -v3_dot(from_eye, v->backward);
    const double reach = WINDOW * half_height(v, *depth);
    return *depth > 0.0 && fabs(v3_dot(from_eye, v->right)) < reach && fabs(v3_dot(from_eye, v->up)) < reach;
}

static int by_depth(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static double vertices_of(const scene *s)
{
    double count = 0.0;
    for (int i = 0; i < s->instance_count; ++i)
        count += s->meshes[s->instances[i].mesh].vertex_count;
    return count;
}

/* Their median depth; 0 where there are none. */
static double median_depth(const scene *s, const view_axes *v)
{
    const uint32_t step = 1U + (uint32_t)(vertices_of(s) / MOST_VERTICES);
    const size_t room = (size_t)(vertices_of(s) / step) + (size_t)s->instance_count + 1;
    float *const depths = malloc(room * sizeof *depths);
    if (depths == NULL)
        return 0.0;
    size_t count = 0;
    for (int i = 0; i < s->instance_count; ++i) {
        const scene_mesh *const mesh = &s->meshes[s->instances[i].mesh];
        double m[16], depth;
        for (int k = 0; k < 16; ++k)
            m[k] = (double)s->instances[i].to_world[k];
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex += step)
            if (in_the_middle(v, m4_point(m, v3_from(&mesh->position[3 * vertex])), &depth))
                depths[count++] = (float)depth;
    }
    qsort(depths, count, sizeof *depths, by_depth);
    const double median = count > 0 ? (double)depths[count / 2] : 0.0;
    free(depths);
    return median;
}

subject subject_of(const scene *s, const scene_camera *view)
{
    const view_axes v = axes_of(view);
    double depth = median_depth(s, &v);
    if (!(depth > 0.0)) {
        const vec3 middle = v3_scale(v3_add(v3_from(s->bounds_min), v3_from(s->bounds_max)), 0.5);
        depth = fmax(v3_dot(v3_sub(v.eye, middle), v.backward), 0.0);
    }
    double radius = half_height(&v, depth);
    if (!(radius > 0.0) || !isfinite(radius)) {
        depth = 1.0;
        radius = 1.0;
    }
    return (subject){ v3_mad(v.eye, v.backward, -depth), radius };
}
