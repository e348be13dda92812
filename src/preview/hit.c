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
    return &values[stride * h->corners.index[corner]];
}

static vec3 corner_vector(const hit *h, const float *values, size_t stride, int corner)
{
    return v3_from(at_corner(h, values, stride, corner));
}

static vec3 interpolate_vector(const hit *h, const float *values, size_t stride)
{
    const vec3 a = corner_vector(h, values, stride, 0);
    const vec3 b = corner_vector(h, values, stride, 1);
    const vec3 c = corner_vector(h, values, stride, 2);
    return v3_mad(v3_mad(a, v3_sub(b, a), h->weights[0]), v3_sub(c, a), h->weights[1]);
}

static vec3 normal_to_world(const hit *h, vec3 n)
{
    return m4_transposed_vector(h->placed->to_object, n);
}

static void resolve_normals(hit *h, vec3 direction)
{
    const vec3 *const p = h->corners.position;
    const vec3 flat = v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0]));
    h->geometric_normal = v3_normalize(normal_to_world(h, flat));
    h->normal = v3_normalize(normal_to_world(h, interpolate_vector(h, h->mesh->normal, 3)));
    if (v3_dot(h->normal, h->normal) == 0.0)
        h->normal = h->geometric_normal;
    h->front = v3_dot(h->geometric_normal, direction) <= 0.0;
}

/* Perpendicular to the normal, as the glTF text wants it; any one where the mesh has none. */
static void resolve_tangent(hit *h)
{
    vec3 along = v3(0.0, 0.0, 0.0);
    double handedness = 1.0;
    if (h->mesh->tangent != NULL) {
        along = v3_reject(m4_vector(h->placed->to_world, interpolate_vector(h, h->mesh->tangent, 4)), h->normal);
        handedness = at_corner(h, h->mesh->tangent, 4, 0)[3] < 0.0F ? -1.0 : 1.0;
    }
    h->tangent = v3_dot(along, along) > 0.0 ? v3_normalize(along) : v3_any_tangent(h->normal);
    /* A mirroring node swaps right and left, and the bitangent follows the texture on the mesh. */
    h->bitangent = v3_scale(v3_cross(h->normal, h->tangent), h->placed->mirrored ? -handedness : handedness);
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

/* The mean of the projections of the point onto the tangent planes of the corners, where those lie outside: keeps the
 * facets of a coarse mesh out of its own shadow. J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II
 * (2021). */
static void resolve_shadow_origin(hit *h)
{
    const double weights[3] = { 1.0 - h->weights[0] - h->weights[1], h->weights[0], h->weights[1] };
    vec3 lift = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        const vec3 corner = m4_point(h->placed->to_world, h->corners.position[k]);
        vec3 n = v3_normalize(normal_to_world(h, corner_vector(h, h->mesh->normal, 3, k)));
        if (!h->front)
            n = v3_scale(n, -1.0);
        const double below = smaller_of(v3_dot(v3_sub(h->position, corner), n), 0.0);
        lift = v3_mad(lift, n, -below * weights[k]);
    }
    h->shadow_origin = v3_add(h->position, lift);
}

/* Embree sees the vertices, the transform and the ray in float: a few units in the last place of the largest number
 * that takes part, 2^-23 each. 32 of them cover the chain of products and sums, and are 4 micrometres at 1 m. */
static void resolve_clearance(hit *h)
{
    const double largest =
        larger_of(v3_max_abs(h->position), larger_of(v3_max_abs(m4_vector(h->placed->to_world, h->position_object)),
                                                     larger_of(v3_max_abs(h->edge[0]), v3_max_abs(h->edge[1]))));
    h->clearance = largest * 32.0 * 0x1p-23;
}

void hit_locate(const geometry *g, const trace_hit *found, hit *out)
{
    out->instance = &g->scene->instances[found->instance];
    out->placed = &g->instances[found->instance];
    out->mesh = &g->scene->meshes[out->instance->mesh];
    out->corners = geometry_triangle(g, found->instance, found->triangle);
    out->weights[0] = found->weights[0];
    out->weights[1] = found->weights[1];
    out->distance = found->distance;
}

void hit_resolve(const geometry *g, const trace_ray *ray, const trace_hit *found, hit *out)
{
    hit *const h = out;
    hit_locate(g, found, h);
    const vec3 *const p = h->corners.position;
    const vec3 e1 = v3_sub(p[1], p[0]);
    const vec3 e2 = v3_sub(p[2], p[0]);
    h->position_object = v3_mad(v3_mad(p[0], e1, h->weights[0]), e2, h->weights[1]);
    h->position = m4_point(h->placed->to_world, h->position_object);
    h->edge[0] = m4_vector(h->placed->to_world, e1);
    h->edge[1] = m4_vector(h->placed->to_world, e2);

    resolve_normals(h, ray->direction);
    resolve_tangent(h);
    if (!h->front) {
        h->geometric_normal = v3_scale(h->geometric_normal, -1.0);
        h->normal = v3_scale(h->normal, -1.0);
    }
    resolve_shadow_origin(h);
    resolve_clearance(h);
}

/* The weights w with w0 e0 + w1 e1 = step, by the normal equations. */
static void weights_of_step(const hit *h, vec3 step, double w[2])
{
    const double aa = v3_dot(h->edge[0], h->edge[0]);
    const double ab = v3_dot(h->edge[0], h->edge[1]);
    const double bb = v3_dot(h->edge[1], h->edge[1]);
    const double sa = v3_dot(h->edge[0], step);
    const double sb = v3_dot(h->edge[1], step);
    const double determinant = aa * bb - ab * ab;
    w[0] = determinant > 0.0 ? (sa * bb - sb * ab) / determinant : 0.0;
    w[1] = determinant > 0.0 ? (sb * aa - sa * ab) / determinant : 0.0;
}

hit_step hit_differentiate(const hit *h, const differential *d, vec3 direction)
{
    hit_step s;
    s.position = differential_transfer(d, direction, h->distance, h->geometric_normal);
    weights_of_step(h, s.position.dx, s.weights_dx);
    weights_of_step(h, s.position.dy, s.weights_dy);
    return s;
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
    /* The inverse of that matrix times the edges, but for its length. */
    const double sign = e[0][0] * e[1][1] - e[0][1] * e[1][0] < 0.0 ? -1.0 : 1.0;
    *s = v3_mad(v3_scale(h->edge[0], e[1][1] * sign), h->edge[1], -e[0][1] * sign);
    *t = v3_mad(v3_scale(h->edge[1], e[0][0] * sign), h->edge[0], -e[1][0] * sign);
    if (h->mesh->tangent != NULL && v3_dot(h->tangent, *s) > 0.9 * v3_length(*s))
        *s = h->tangent;
}

vec3 hit_leave(const hit *h, vec3 from)
{
    return v3_mad(from, h->geometric_normal, h->clearance);
}
