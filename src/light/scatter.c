/* Points of a light: directions to it, and the density with which they are drawn. */
#include "light/scatter.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/real.h"

/* ---- polygons: uniform points of the flat triangles between the middle and the sides ---- */

typedef struct triangle {
    vec3d a, b, c, normal; /* normal: twice the area */
} triangle;

static triangle triangle_of(const area_light *l, int side)
{
    triangle t = { l->middle, l->corner[side], l->corner[(side + 1) % l->corner_count], { 0.0, 0.0, 0.0 } };
    t.normal = vec3d_cross(vec3d_sub(t.b, t.a), vec3d_sub(t.c, t.a));
    return t;
}

static double whole_area(const area_light *l)
{
    double sum = 0.0;
    for (int i = 0; i < l->corner_count; i++) {
        const triangle t = triangle_of(l, i);
        sum += vec3d_length(t.normal);
    }
    return sum;
}

static vec3d polygon_direction(const area_light *l, double u1, double u2)
{
    double wanted = u1 * whole_area(l);
    for (int i = 0;; i++) {
        const triangle t = triangle_of(l, i);
        const double area = vec3d_length(t.normal);
        if (wanted >= area && i + 1 < l->corner_count) {
            wanted -= area;
            continue;
        }
        const double u = area > 0.0 ? real_min(wanted / area, 1.0) : 0.5, root = sqrt(u);
        const vec3d rim = vec3d_mad(t.b, vec3d_sub(t.c, t.b), u2);
        return vec3d_normalize(vec3d_mad(t.a, vec3d_sub(rim, t.a), root));
    }
}

static double polygon_density(const area_light *l, vec3d w)
{
    for (int i = 0; i < l->corner_count; i++) {
        const triangle t = triangle_of(l, i);
        const double ab = vec3d_dot(vec3d_cross(t.a, t.b), w), ca = vec3d_dot(vec3d_cross(t.c, t.a), w);
        const double volume = vec3d_dot(t.a, t.normal), facing = vec3d_dot(w, t.normal);
        /* Between the two inner sides: the sides that the light has itself have been looked at by whoever asks. */
        if (!(ab * volume >= 0.0 && ca * volume >= 0.0 && facing * volume > 0.0))
            continue;
        /* The plane is volume / facing away; a unit area of it has facing / (|normal| distance^2). */
        const double distance = volume / facing;
        return distance * distance * vec3d_length(t.normal) / fabs(facing) / (0.5 * whole_area(l));
    }
    return 0.0;
}

/* ---- cones: a meridian by the angle on the ellipse, then a uniform height on it ---- */

/* 1 - cos of the half angle along the meridian at (cos t, sin t) of the ellipse, and the squared tangent. */
static double versine_at(const conic *c, double cosine, double sine, double *tangent2)
{
    const double x = c->a * cosine, y = c->b * sine;
    *tangent2 = x * x + y * y;
    const double root = sqrt(1.0 + *tangent2);
    return *tangent2 / (root * (1.0 + root));
}

static vec3d cone_direction(const conic *c, double u1, double u2)
{
    float sine, cosine;
    const float turn = 2.0F * (float)real_min(u1, 0.99999994);
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const double sign = turn < 1.0F ? 1.0 : -1.0, co = sign * (double)cosine, si = sign * (double)sine;
    double tangent2;
    const double versine = u2 * versine_at(c, co, si, &tangent2);
    const double across = sqrt(versine * (2.0 - versine) / real_max(tangent2, 1e-300));
    return vec3d_add(vec3d_scale(c->axis_z, 1.0 - versine),
                     vec3d_mad(vec3d_scale(c->axis_x, across * c->a * co), c->axis_y, across * c->b * si));
}

static double cone_density(const conic *c, vec3d w)
{
    const double x = vec3d_dot(w, c->axis_x) / c->a, y = vec3d_dot(w, c->axis_y) / c->b;
    const double length = sqrt(x * x + y * y);
    const double cosine = length > 0.0 ? x / length : 1.0, sine = length > 0.0 ? y / length : 0.0;
    double tangent2;
    const double versine = versine_at(c, cosine, sine, &tangent2);
    /* Azimuth turns by a b / tangent^2 times the angle on the ellipse. */
    return tangent2 / (2.0 * REAL_PI * c->a * c->b * versine);
}

/* ---- either ---- */

vec3d scatter_direction(const area_light *light, double u1, double u2)
{
    return light->kind == AREA_POLYGON ? polygon_direction(light, u1, u2) : cone_direction(&light->cone, u1, u2);
}

double scatter_density(const area_light *light, vec3d direction)
{
    return light->kind == AREA_POLYGON ? polygon_density(light, direction) : cone_density(&light->cone, direction);
}
