/* A light of real size as one point sees it: the convex cone of directions towards it, cut at the horizon. */
#include "light/area.h"

#include <string.h>

#include "math/real.h"

/* Of a light's own size: closer to the plane through it than this, the point sees it edge-on. */
#define EDGE_ON 1e-9

/* ---- polygons ---- */

/* Twice the vector area (Newell). */
static vec3d vector_area(const vec3d *v, int count)
{
    vec3d sum = { 0.0, 0.0, 0.0 };
    for (int i = 1; i + 1 < count; i++)
        sum = vec3d_add(sum, vec3d_cross(vec3d_sub(v[i], v[0]), vec3d_sub(v[i + 1], v[0])));
    return sum;
}

/* The part of the polygon above z = 0 (Sutherland and Hodgman); room for two more corners than there are. */
static int cut_at_horizon(const vec3d *v, int count, vec3d *out)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        const vec3d a = v[i], b = v[(i + 1) % count];
        if (a.z >= 0.0 && n < AREA_MOST_CORNERS)
            out[n++] = a;
        if ((a.z < 0.0) != (b.z < 0.0) && n < AREA_MOST_CORNERS) {
            const double t = a.z / (a.z - b.z);
            out[n] = vec3d_mad(a, vec3d_sub(b, a), t);
            out[n++].z = 0.0;
        }
    }
    return n;
}

/* Lambert: the integral of the direction over a spherical polygon is half the sum of its sides' angles times their
 * normals. A normal is found from one corner and the way to the next: the product of two directions that are nearly the
 * same would have no digit of a small light. */
static vec3d polygon_moment(const vec3d *corner, int count)
{
    vec3d sum = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < count; i++) {
        const vec3d a = corner[i], b = corner[(i + 1) % count];
        const vec3d normal = vec3d_cross(a, vec3d_sub(b, a));
        const double sine = vec3d_length(normal);
        if (sine > 0.0)
            sum = vec3d_mad(sum, normal, 0.5 * real_atan2(sine, vec3d_dot(a, b)) / sine);
    }
    return sum;
}

/* The same whichever way the corners run: towards the light, and up. A small light at the horizon has so little of
 * either that both are asked. */
static vec3d outward_moment(const vec3d *corner, int count)
{
    vec3d towards = { 0.0, 0.0, (double)count };
    for (int i = 0; i < count; i++)
        towards = vec3d_add(towards, corner[i]);
    const vec3d moment = polygon_moment(corner, count);
    return vec3d_dot(moment, towards) < 0.0 ? vec3d_scale(moment, -1.0) : moment;
}

static int is_above(const vec3d *v, int count)
{
    int above = 1;
    for (int i = 0; i < count; i++)
        above &= v[i].z >= 0.0;
    return above;
}

/* Whether the point at the origin sees a side of the flat light through `at` that shines. */
static int is_seen(vec3d at, vec3d other, vec3d normal, int two_sided)
{
    const double height = vec3d_dot(normal, at), size2 = vec3d_dot(at, at) + vec3d_dot(other, other);
    return height * height > EDGE_ON * EDGE_ON * size2 * vec3d_dot(normal, normal) && (two_sided || height <= 0.0);
}

static void take_corners(area_light *l, const vec3d *corner, int count)
{
    l->corner_count = count;
    if (is_above(corner, count))
        memcpy(l->corner, corner, (size_t)count * sizeof(corner[0]));
    else
        l->corner_count = cut_at_horizon(corner, count, l->corner);
    l->kind = l->corner_count < 3 ? AREA_NOTHING : AREA_POLYGON;
}

void area_make_polygon(area_light *l, const vec3d *corner, int count, int two_sided)
{
    l->kind = AREA_NOTHING;
    if (count >= 3 && count <= AREA_MOST_CORNERS - 2 &&
        is_seen(corner[0], corner[2], vector_area(corner, count), two_sided))
        take_corners(l, corner, count);
}

void area_make_rectangle(area_light *l, vec3d center, vec3d half_x, vec3d half_y, int two_sided)
{
    const vec3d right = vec3d_add(center, half_x), left = vec3d_sub(center, half_x);
    const vec3d corner[4] = { vec3d_sub(left, half_y), vec3d_sub(right, half_y), vec3d_add(right, half_y),
                              vec3d_add(left, half_y) };
    l->kind = AREA_NOTHING;
    if (is_seen(corner[0], corner[2], vec3d_cross(half_x, half_y), two_sided))
        take_corners(l, corner, 4);
}

/* ---- ellipses ---- */

static void take_cone(area_light *l)
{
    const double reach = sqrt(l->span[1].z * l->span[1].z + l->span[2].z * l->span[2].z);
    l->is_whole = l->span[0].z > reach;
    l->kind = l->span[0].z > -reach ? AREA_CONIC : AREA_NOTHING;
}

void area_make_cone(area_light *l, vec3d center, vec3d half_x, vec3d half_y)
{
    l->span[0] = center;
    l->span[1] = half_x;
    l->span[2] = half_y;
    l->has_axes = 0;
    take_cone(l);
}

void area_make_ellipse(area_light *l, vec3d center, vec3d half_x, vec3d half_y, int two_sided)
{
    l->kind = AREA_NOTHING;
    const vec3d normal = vec3d_cross(half_x, half_y);
    const double height = vec3d_dot(normal, center);
    const double size2 = vec3d_dot(center, center) + vec3d_dot(half_x, half_x) + vec3d_dot(half_y, half_y);
    if (!(height * height > EDGE_ON * EDGE_ON * size2 * vec3d_dot(normal, normal)) || (!two_sided && height > 0.0))
        return;
    area_make_cone(l, center, half_x, half_y);
}

void area_make_round(area_light *l, vec3d axis, double sine, double cosine)
{
    l->kind = AREA_NOTHING;
    /* Half the sphere of directions at most, a hair less so that its tangent is a number. */
    const double least = 1e-7, c = real_max(cosine, least);
    if (!(sine > 1e-13))
        return;
    const vec3d u = vec3d_any_normal(axis);
    l->cone = (conic){ .axis_x = u, .axis_y = vec3d_cross(axis, u), .axis_z = axis, .a = sine / c, .b = sine / c };
    l->span[0] = axis;
    l->span[1] = vec3d_scale(l->cone.axis_x, l->cone.a);
    l->span[2] = vec3d_scale(l->cone.axis_y, l->cone.b);
    l->has_axes = 1;
    take_cone(l);
}

/* Its axes, and the part above the horizon. */
static int measure_cone(area_light *l)
{
    l->has_axes = l->has_axes || conic_make(&l->cone, l->span[0], l->span[1], l->span[2]);
    return l->has_axes && conic_cut(&l->cone);
}

/* ---- queries ---- */

/* Makes the corners unit and drops those at the point itself. */
static int measure_corners(area_light *l)
{
    int count = 0;
    for (int i = 0; i < l->corner_count; i++) {
        const vec3d unit = vec3d_normalize(l->corner[i]);
        if (vec3d_dot(unit, unit) > 0.5)
            l->corner[count++] = unit;
    }
    l->corner_count = count;
    return count >= 3;
}

int area_measure(area_light *l)
{
    if ((l->kind == AREA_CONIC && !measure_cone(l)) || (l->kind == AREA_POLYGON && !measure_corners(l)))
        l->kind = AREA_NOTHING;
    if (l->kind == AREA_NOTHING)
        return 0;
    l->moment = l->kind == AREA_CONIC ? conic_moment(&l->cone) : outward_moment(l->corner, l->corner_count);
    const double size = vec3d_length(l->moment);
    if (!(size > 1e-26) || !(l->moment.z > 0.0)) {
        l->kind = AREA_NOTHING;
        return 0;
    }
    l->middle = vec3d_scale(l->moment, 1.0 / size);
    return 1;
}

/* slack: how far beyond the rim a direction may lie, of its length. */
static int lies_within(const area_light *l, vec3d direction, double slack)
{
    if (l->kind == AREA_NOTHING || !(direction.z > 0.0))
        return 0;
    if (l->kind == AREA_CONIC) {
        const conic *c = &l->cone;
        const double z = vec3d_dot(direction, c->axis_z);
        const double x = vec3d_dot(direction, c->axis_x) / c->a, y = vec3d_dot(direction, c->axis_y) / c->b;
        const double reach = z * (1.0 + slack / c->b);
        return z > 0.0 && x * x + y * y <= reach * reach;
    }
    int left = 0, right = 0;
    const double length = slack > 0.0 ? slack * vec3d_length(direction) : 0.0;
    for (int i = 0; i < l->corner_count; i++) {
        const vec3d normal = vec3d_cross(l->corner[i], l->corner[(i + 1) % l->corner_count]);
        const double side = vec3d_dot(normal, direction), least = length > 0.0 ? length * vec3d_length(normal) : 0.0;
        left |= side > least;
        right |= side < -least;
    }
    return !(left && right) && vec3d_dot(l->middle, direction) > 0.0;
}

int area_contains(const area_light *l, vec3d direction)
{
    return lies_within(l, direction, 0.0);
}

int area_touches(const area_light *l, vec3d direction)
{
    return lies_within(l, direction, 1e-6);
}

int area_piece_count(const area_light *l)
{
    switch (l->kind) {
    case AREA_POLYGON:
        return l->corner_count;
    case AREA_CONIC:
        return CONIC_ARCS + l->cone.is_cut;
    case AREA_NOTHING:
        break;
    }
    return 0;
}

static vec3d rim(const conic *c, double cosine, double sine, double height)
{
    return vec3d_add(vec3d_scale(c->axis_z, height),
                     vec3d_mad(vec3d_scale(c->axis_x, c->a * cosine), c->axis_y, c->b * sine));
}

void area_boundary(const area_light *l, int piece, double t, vec3d *at, vec3d *derivative)
{
    const conic *c = &l->cone;
    if (l->kind == AREA_CONIC && piece < CONIC_ARCS) {
        /* The chord between two nodes of the unit circle, brought back to it. */
        const double *from = c->node[piece], *to = c->node[piece + 1];
        const double dx = to[0] - from[0], dy = to[1] - from[1];
        const double x = from[0] + t * dx, y = from[1] + t * dy;
        const double inverse = 1.0 / sqrt(x * x + y * y);
        const double cosine = x * inverse, sine = y * inverse, rate = (cosine * dy - sine * dx) * inverse;
        *at = rim(c, cosine, sine, 1.0);
        *derivative = rim(c, -sine * rate, cosine * rate, 0.0);
        return;
    }
    const int is_line = l->kind == AREA_CONIC; /* along the horizon */
    const vec3d a = is_line ? rim(c, c->node[CONIC_ARCS][0], c->node[CONIC_ARCS][1], 1.0) : l->corner[piece];
    const vec3d b = is_line ? rim(c, c->node[0][0], c->node[0][1], 1.0) : l->corner[(piece + 1) % l->corner_count];
    *derivative = vec3d_sub(b, a);
    *at = vec3d_mad(a, *derivative, t);
}
