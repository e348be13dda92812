/* Texture coordinates or three planes: both give u and v in metres, with derivatives per pixel. */
#include "preview/place.h"

#include "preview/effects.h"
#include "preview/hash.h"

/* Instances of one node are one object and share their facets; other nodes have others. */
static uint32_t seed_of(const hit *h, uint32_t plane)
{
    return hash_combine((uint32_t)h->instance->node, plane);
}

static glint_footprint place_by_texcoord(const scene_glint *g, const hit *h, const hit_step *step)
{
    const double scale = (double)g->uv_scale;
    double st[2], dx[2], dy[2];
    hit_texcoord(h, g->texcoord, st);
    hit_texcoord_step(h, step, g->texcoord, dx, dy);
    return (glint_footprint){ .u = st[0] * scale,
                              .v = st[1] * scale,
                              .dudx = (float)(dx[0] * scale),
                              .dudy = (float)(dy[0] * scale),
                              .dvdx = (float)(dx[1] * scale),
                              .dvdy = (float)(dy[1] * scale),
                              .seed = seed_of(h, 0U) };
}

/* The object's axes at the size they have in the world. */
static vec3 to_metres(const hit *h, vec3 object)
{
    const vec3 s = h->placed->axis_scale;
    return v3(object.x * s.x, object.y * s.y, object.z * s.z);
}

static vec3 step_to_metres(const hit *h, vec3 world_step)
{
    return to_metres(h, m4_vector(h->placed->to_object, world_step));
}

/* The squared normal squared: a band of half a right angle in which two planes mix. */
static int choose_plane(const double n[3], float choice)
{
    double weights[3];
    for (int i = 0; i < 3; ++i)
        weights[i] = n[i] * n[i] * n[i] * n[i];
    const double target = (double)choice * (weights[0] + weights[1] + weights[2]);
    if (target < weights[0])
        return 0;
    return target < weights[0] + weights[1] ? 1 : 2;
}

/* The normal of the triangle in the object's axes. */
static void flat_normal(const hit *h, double n[3])
{
    vec3 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = v3_from(&h->mesh->position[3U * (size_t)h->corner[k]]);
    const vec3 normal = v3_normalize(v3_cross(to_metres(h, v3_sub(p[1], p[0])), to_metres(h, v3_sub(p[2], p[0]))));
    n[0] = normal.x;
    n[1] = normal.y;
    n[2] = normal.z;
}

static glint_footprint place_on_planes(const hit *h, const hit_step *step, float choice, float *density_scale)
{
    double n[3];
    flat_normal(h, n);
    const int plane = choose_plane(n, choice);

    const vec3 at = to_metres(h, h->position_object);
    const vec3 dx = step_to_metres(h, step->position.dx);
    const vec3 dy = step_to_metres(h, step->position.dy);
    const double a[3][3] = { { at.x, dx.x, dy.x }, { at.y, dx.y, dy.y }, { at.z, dx.z, dy.z } };
    const double *const u = a[(plane + 1) % 3];
    const double *const v = a[(plane + 2) % 3];

    /* A tilted surface covers n of its area on the plane; N counts the surface. */
    if (fabs(n[plane]) > 0.0)
        *density_scale = (float)(1.0 / fabs(n[plane]));
    return (glint_footprint){ .u = u[0],
                              .v = v[0],
                              .dudx = (float)u[1],
                              .dudy = (float)u[2],
                              .dvdx = (float)v[1],
                              .dvdy = (float)v[2],
                              .seed = seed_of(h, (uint32_t)plane + 1U) };
}

bool place_is_in_texture_space(const scene_glint *g, const scene_mesh *mesh)
{
    return g->space == SCENE_SPACE_UV && mesh->texcoord[g->texcoord] != NULL;
}

glint_footprint place_footprint(const scene_glint *g, const hit *h, const hit_step *step, float choice,
                                float *density_scale)
{
    *density_scale = 1.0F;
    if (!EFFECT_FACET_PLANES || place_is_in_texture_space(g, h->mesh))
        return place_by_texcoord(g, h, step);
    return place_on_planes(h, step, choice, density_scale);
}

void place_axes(const scene_glint *g, const hit *h, float choice, vec3 *along_u, vec3 *along_v)
{
    if (place_is_in_texture_space(g, h->mesh)) {
        hit_texcoord_axes(h, g->texcoord, along_u, along_v);
        return;
    }
    double n[3];
    flat_normal(h, n);
    const int plane = choose_plane(n, choice);
    *along_u = m4_column(h->placed->to_world, (plane + 1) % 3);
    *along_v = m4_column(h->placed->to_world, (plane + 2) % 3);
}
