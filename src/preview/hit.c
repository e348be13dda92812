/* Interpolates a mesh over a triangle, and differentiates what it interpolates. */
#include "preview/hit.h"

/* The weights of a linear interpolation over the corners. */
static double interpolate(double a, double b, double c, const double w[2])
{
    return a + (b - a) * w[0] + (c - a) * w[1];
}

/* The values of a corner in an array of the mesh. */
static const float *at_corner(const hit *h, const float *values, size_t stride, int corner)
{
    return &values[stride * h->corner[corner]];
}

static vec3 corner_vector(const hit *h, const float *values, size_t stride, int corner)
{
    return v3_from(at_corner(h, values, stride, corner));
}

static vec3 normal_to_world(const hit *h, vec3 n)
{
    return m4_transposed_vector(h->placed->to_object, n);
}

/* One of the values that the mesh has a vertex. */
static double interpolate_value(const hit *h, const float *values, size_t stride, int k)
{
    return interpolate((double)at_corner(h, values, stride, 0)[k], (double)at_corner(h, values, stride, 1)[k],
                       (double)at_corner(h, values, stride, 2)[k], h->weights);
}

void hit_texcoord(const hit *h, int set, double st[2])
{
    const float *const values = h->mesh->texcoord[set];
    for (int k = 0; k < 2; ++k)
        st[k] = values == NULL ? 0.0 : interpolate_value(h, values, 2, k);
}

void hit_color(const hit *h, float rgba[4])
{
    const float *const color = h->mesh->color;
    for (int k = 0; k < 4; ++k)
        rgba[k] = color == NULL ? 1.0F : (float)interpolate_value(h, color, 4, k);
}

void hit_locate(const geometry *g, const trace_hit *found, hit *out)
{
    out->instance = &g->scene->instances[found->instance];
    out->placed = &g->instances[found->instance];
    out->mesh = &g->scene->meshes[out->instance->mesh];
    for (int k = 0; k < 3; ++k)
        out->corner[k] = out->mesh->index[3U * (size_t)found->triangle + (size_t)k];
    out->weights[0] = found->weights[0];
    out->weights[1] = found->weights[1];
    out->distance = found->distance;
}

/* d(N / |N|) = (dN - n (n.dN)) / |N| */
surface_step hit_turn(const hit *h, const hit_step *step)
{
    const vec3 a = corner_vector(h, h->mesh->normal, 3, 0);
    const vec3 ab = v3_sub(corner_vector(h, h->mesh->normal, 3, 1), a);
    const vec3 ac = v3_sub(corner_vector(h, h->mesh->normal, 3, 2), a);
    const vec3 whole = normal_to_world(h, v3_mad(v3_mad(a, ab, h->weights[0]), ac, h->weights[1]));
    const double length = v3_length(whole);
    if (!(length > 0.0))
        return (surface_step){ v3(0.0, 0.0, 0.0), v3(0.0, 0.0, 0.0) };
    const vec3 n = v3_scale(whole, 1.0 / length);
    const double side = (h->front ? 1.0 : -1.0) / length;
    const vec3 dx = normal_to_world(h, v3_mad(v3_scale(ab, step->weights_dx[0]), ac, step->weights_dx[1]));
    const vec3 dy = normal_to_world(h, v3_mad(v3_scale(ab, step->weights_dy[0]), ac, step->weights_dy[1]));
    return (surface_step){ v3_scale(v3_reject(dx, n), side), v3_scale(v3_reject(dy, n), side) };
}

void hit_texcoord_step(const hit *h, const hit_step *step, int set, double dx[2], double dy[2])
{
    const float *const st = h->mesh->texcoord[set];
    for (int k = 0; k < 2; ++k) {
        if (st == NULL) {
            dx[k] = dy[k] = 0.0;
            continue;
        }
        const double a = (double)at_corner(h, st, 2, 0)[k];
        const double along[2] = { (double)at_corner(h, st, 2, 1)[k] - a, (double)at_corner(h, st, 2, 2)[k] - a };
        dx[k] = along[0] * step->weights_dx[0] + along[1] * step->weights_dx[1];
        dy[k] = along[0] * step->weights_dy[0] + along[1] * step->weights_dy[1];
    }
}

void hit_texcoord_axes(const hit *h, int set, vec3 *s, vec3 *t)
{
    const float *const st = h->mesh->texcoord[set];
    *s = *t = v3(0.0, 0.0, 0.0);
    if (st == NULL)
        return;
    double e[2][2]; /* texture coordinates along the edges */
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < 2; c++)
            e[c][k] = (double)at_corner(h, st, 2, c + 1)[k] - (double)at_corner(h, st, 2, 0)[k];
    const vec3 from = corner_vector(h, h->mesh->position, 3, 0);
    vec3 edge[2];
    for (int c = 0; c < 2; c++)
        edge[c] = m4_vector(h->placed->to_world, v3_sub(corner_vector(h, h->mesh->position, 3, c + 1), from));
    /* The inverse of that matrix times the edges, but for its length. */
    const double sign = e[0][0] * e[1][1] - e[0][1] * e[1][0] < 0.0 ? -1.0 : 1.0;
    *s = v3_mad(v3_scale(edge[0], e[1][1] * sign), edge[1], -e[0][1] * sign);
    *t = v3_mad(v3_scale(edge[1], e[0][0] * sign), edge[0], -e[1][0] * sign);
    if (h->mesh->tangent != NULL && v3_dot(h->tangent, *s) > 0.9 * v3_length(*s))
        *s = h->tangent;
}

vec3 hit_leave(const hit *h, vec3 from)
{
    return v3_mad(from, h->geometric_normal, h->clearance);
}
