/* A light of real size as one point sees it: the convex cone of directions towards it, cut at the horizon. */
#include "light/area.h"

#include "math/real.h"

/* Of a light's own size: closer to the plane through it than this, the point sees it edge-on. */
#define EDGE_ON 1e-9

/* ---- polygons ---- */

static double largest_coordinate(const vec3d *v, int count)
{
    double largest = 0.0;
    for (int i = 0; i < count; i++)
        largest = real_max(largest, real_max(fabs(v[i].x), real_max(fabs(v[i].y), fabs(v[i].z))));
    return largest;
}

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

void area_take_corners(area_light *l, const vec3d *corner, int count)
{
    l->kind = AREA_NOTHING;
    l->corner_count = 0;
    for (int i = 0; i < count; i++) {
        const vec3d unit = vec3d_normalize(corner[i]);
        if (vec3d_dot(unit, unit) > 0.5) /* not a corner at the point itself */
            l->corner[l->corner_count++] = unit;
    }
    if (l->corner_count < 3)
        return;
    l->kind = AREA_POLYGON;
}

void area_make_polygon(area_light *l, const vec3d *corner, int count, int two_sided)
{
    l->kind = AREA_NOTHING;
    if (count < 3 || count > AREA_MOST_CORNERS - 2)
        return;
    const double largest = largest_coordinate(corner, count);
    if (!(largest > 1e-30 && largest < 1e30))
        return;
    vec3d v[AREA_MOST_CORNERS];
    for (int i = 0; i < count; i++)
        v[i] = vec3d_scale(corner[i], 1.0 / largest);
    const vec3d area = vector_area(v, count);
    const double height = vec3d_dot(area, v[0]), size = vec3d_length(area);
    if (!(fabs(height) > EDGE_ON * size) || (!two_sided && height > 0.0))
        return;
    vec3d above[AREA_MOST_CORNERS];
    area_take_corners(l, above, cut_at_horizon(v, count, above));
}

void area_make_rectangle(area_light *l, vec3d center, vec3d half_x, vec3d half_y, int two_sided)
{
    const vec3d right = vec3d_add(center, half_x), left = vec3d_sub(center, half_x);
    const vec3d corner[4] = { vec3d_sub(left, half_y), vec3d_sub(right, half_y), vec3d_add(right, half_y),
                              vec3d_add(left, half_y) };
    area_make_polygon(l, corner, 4, two_sided);
}

/* ---- ellipses ---- */

static void take_conic(area_light *l)
{
    l->kind = conic_cut(&l->cone) ? AREA_CONIC : AREA_NOTHING;
}

void area_make_ellipse(area_light *l, vec3d center, vec3d half_x, vec3d half_y, int two_sided)
{
    l->kind = AREA_NOTHING;
    const vec3d all[3] = { center, half_x, half_y };
    const double largest = largest_coordinate(all, 3);
    if (!(largest > 1e-30 && largest < 1e30))
        return;
    const vec3d c = vec3d_scale(center, 1.0 / largest), x = vec3d_scale(half_x, 1.0 / largest),
                y = vec3d_scale(half_y, 1.0 / largest);
    const vec3d normal = vec3d_cross(x, y);
    const double height = vec3d_dot(normal, c), size = vec3d_length(normal);
    if (!(fabs(height) > EDGE_ON * size) || (!two_sided && height > 0.0))
        return;
    area_take_cone(l, c, x, y);
}

void area_take_cone(area_light *l, vec3d middle, vec3d half_x, vec3d half_y)
{
    l->kind = AREA_NOTHING;
    if (conic_make(&l->cone, middle, half_x, half_y))
        take_conic(l);
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
    take_conic(l);
}

/* ---- queries ---- */

int area_measure(area_light *l)
{
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

int area_contains(const area_light *l, vec3d direction)
{
    if (l->kind == AREA_NOTHING || !(direction.z > 0.0))
        return 0;
    if (l->kind == AREA_CONIC) {
        const conic *c = &l->cone;
        const double z = vec3d_dot(direction, c->axis_z);
        const double x = vec3d_dot(direction, c->axis_x) / c->a, y = vec3d_dot(direction, c->axis_y) / c->b;
        return z > 0.0 && x * x + y * y <= z * z;
    }
    int left = 0, right = 0;
    for (int i = 0; i < l->corner_count; i++) {
        const vec3d normal = vec3d_cross(l->corner[i], l->corner[(i + 1) % l->corner_count]);
        const double side = vec3d_dot(normal, direction);
        left |= side > 0.0;
        right |= side < 0.0;
    }
    return !(left && right) && vec3d_dot(l->middle, direction) > 0.0;
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
