/* A light of real size as the directions that it fills, in polar coordinates around one of them. */
#include "area_adaptive.h"

#include <math.h>
#include <stdlib.h>

#include "adaptive.h"

#define PI 3.14159265358979323846
/* Corners of a polygon, and one more by the horizon; pieces of the circle, none longer than a quarter. */
enum { MOST_CORNERS = 9, MOST_PIECES = MOST_CORNERS + 4 };

typedef struct vector {
    double x, y, z;
} vector;

static vector add(vector a, double s, vector b)
{
    return (vector){ a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}

static vector scaled(vector a, double s)
{
    return (vector){ s * a.x, s * a.y, s * a.z };
}

static double dot(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector cross(vector a, vector b)
{
    return (vector){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static vector unit(vector a)
{
    return scaled(a, 1.0 / sqrt(dot(a, a)));
}

static vector of_floats(const float v[3])
{
    return (vector){ (double)v[0], (double)v[1], (double)v[2] };
}

/* Across a unit vector. */
static vector across(vector w)
{
    return unit(fabs(w.x) < 0.6 ? (vector){ 0.0, -w.z, w.y } : (vector){ w.z, 0.0, -w.x });
}

/* Directions w with w.n > 0 for every plane and, of a round light, (w.cone[0])^2 + (w.cone[1])^2 < (w.cone[2])^2 on
 * the side of cone[2]. The last plane is the horizon. */
typedef struct figure {
    vector plane[MOST_CORNERS + 1];
    vector corner[MOST_CORNERS];
    int planes, corners, is_round;
    vector cone[3];
    vector middle; /* a direction inside */
} figure;

static const vector up = { 0.0, 0.0, 1.0 };

/* ---- what a light fills ---- */

/* The part of a polygon above the horizon. */
static int cut_at_horizon(const vector *from, int count, vector to[MOST_CORNERS])
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const vector a = from[i], b = from[(i + 1) % count];
        if (a.z > 0.0)
            to[kept++] = a;
        if ((a.z > 0.0) != (b.z > 0.0))
            to[kept++] = add(a, a.z / (a.z - b.z), add(b, -1.0, a));
    }
    return kept;
}

static int is_polygon(const vector *from, int count, figure *f)
{
    f->corners = cut_at_horizon(from, count, f->corner);
    if (f->corners < 3)
        return 0;
    for (int i = 0; i < f->corners; i++)
        f->middle = add(f->middle, 1.0, unit(f->corner[i]));
    f->middle = unit(f->middle);
    for (int i = 0; i < count; i++) {
        const vector n = unit(cross(from[i], from[(i + 1) % count]));
        const double side = dot(n, f->middle);
        /* Seen edge-on, it has no area. */
        if (!(fabs(side) > 1e-12))
            return 0;
        f->plane[f->planes++] = scaled(n, side < 0.0 ? -1.0 : 1.0);
    }
    return 1;
}

/* Where the cone passes the horizon: the quadratic form in (cos, sin) of the azimuth. */
static void find_corners_of_cone(figure *f)
{
    const vector x = f->cone[0], y = f->cone[1], z = f->cone[2];
    const double of_x = x.x * x.x + y.x * y.x - z.x * z.x, of_y = x.y * x.y + y.y * y.y - z.y * z.y;
    const double mixed = x.x * x.y + y.x * y.y - z.x * z.y, half = 0.5 * (of_x - of_y), mean = 0.5 * (of_x + of_y);
    const double length = hypot(half, mixed);
    if (!(fabs(mean) < length))
        return;
    for (int k = 0; k < 4; k++) {
        const double turn =
            0.5 * (atan2(mixed, half) + (k & 1 ? 1.0 : -1.0) * acos(-mean / length)) + (k & 2 ? PI : 0.0);
        const vector w = { cos(turn), sin(turn), 0.0 };
        if (dot(w, z) > 0.0)
            f->corner[f->corners++] = w;
    }
}

/* A cone of directions of this sine and cosine around an axis. */
static int is_cone(vector axis, double sine, double cosine, figure *f)
{
    const vector a = unit(axis), ground = { a.x, a.y, 0.0 };
    const vector ahead = dot(ground, ground) > 0.0 ? unit(ground) : (vector){ 1.0, 0.0, 0.0 };
    const double half = atan2(sine, cosine), elevation = atan2(a.z, dot(a, ahead));
    const double low = fmax(elevation - half, 0.0), high = fmin(elevation + half, PI), at = 0.5 * (low + high);
    if (!(high > low))
        return 0;
    f->is_round = 1;
    f->cone[0] = scaled(across(a), cosine);
    f->cone[1] = cross(a, f->cone[0]);
    f->cone[2] = scaled(a, sine);
    f->middle = add(scaled(ahead, cos(at)), sin(at), up);
    return 1;
}

/* An ellipse c + s x + t y, s^2 + t^2 < 1: s and t of a direction are quotients of products with the dual basis. */
static int is_disk(vector c, vector x, vector y, figure *f)
{
    const double volume = dot(c, cross(x, y)), tilt = hypot(x.z, y.z);
    if (!(fabs(volume) > 1e-12 * sqrt(dot(c, c) * dot(x, x) * dot(y, y))) || !(c.z + tilt > 0.0))
        return 0;
    f->is_round = 1;
    f->cone[0] = scaled(cross(y, c), 1.0 / volume);
    f->cone[1] = scaled(cross(c, x), 1.0 / volume);
    f->cone[2] = scaled(cross(x, y), 1.0 / volume);
    /* Halfway between the horizon, or the lowest point, and the highest. */
    const double at = tilt > 0.0 ? 0.5 * (1.0 + fmax(-1.0, -c.z / tilt)) : 0.0;
    f->middle = unit(tilt > 0.0 ? add(add(c, at * x.z / tilt, x), at * y.z / tilt, y) : c);
    return 1;
}

/* False: nothing of it is seen. */
static int is_seen(const glint_area_light *l, figure *f)
{
    const vector c = of_floats(l->center), x = of_floats(l->half_x), y = of_floats(l->half_y);
    vector corners[8];
    int seen = 0;
    *f = (figure){ .planes = 0 };
    switch (l->kind) {
    case GLINT_AREA_SUN: {
        const double versine = fmin((double)l->solid_angle_sr / (2.0 * PI), 1.0);
        seen = is_cone(c, sqrt(versine * (2.0 - versine)), 1.0 - versine, f);
        break;
    }
    case GLINT_AREA_SPHERE: {
        const double square = fmin((double)l->radius * (double)l->radius / dot(c, c), 1.0);
        seen = is_cone(c, sqrt(square), sqrt(1.0 - square), f);
        break;
    }
    case GLINT_AREA_RECTANGLE:
        for (int i = 0; i < 4; i++)
            corners[i] = add(add(c, i == 0 || i == 3 ? 1.0 : -1.0, x), i < 2 ? 1.0 : -1.0, y);
        seen = is_polygon(corners, 4, f);
        break;
    case GLINT_AREA_DISK:
        seen = is_disk(c, x, y, f);
        break;
    case GLINT_AREA_POLYGON:
        for (uint32_t i = 0; i < l->corner_count; i++)
            corners[i] = of_floats(l->corners[i]);
        seen = is_polygon(corners, (int)l->corner_count, f);
        break;
    }
    f->plane[f->planes++] = up;
    if (f->is_round)
        find_corners_of_cone(f);
    return seen;
}

/* ---- around a point of it ---- */

typedef struct polar {
    const figure *f;
    const area_truth_lobe *lobe;
    double wo[3];
    vector from, east, north;
    double start[MOST_PIECES], length[MOST_PIECES]; /* azimuths */
    int pieces;
} polar;

static double cone_at(const figure *f, vector a, vector b)
{
    return dot(f->cone[0], a) * dot(f->cone[0], b) + dot(f->cone[1], a) * dot(f->cone[1], b) -
           dot(f->cone[2], a) * dot(f->cone[2], b);
}

static int is_inside(const figure *f, vector w)
{
    for (int i = 0; i < f->planes; i++)
        if (!(dot(f->plane[i], w) > 1e-9))
            return 0;
    return !f->is_round || (dot(f->cone[2], w) > 0.0 && cone_at(f, w, w) < 0.0);
}

/* The angle from the point to the boundary along the great circle cos r from + sin r u. */
static double reach(const polar *p, vector u)
{
    const figure *const f = p->f;
    double most = PI;
    for (int i = 0; i < f->planes; i++)
        most = fmin(most, atan2(dot(f->plane[i], p->from), -dot(f->plane[i], u)));
    if (f->is_round) {
        /* a + 2 b t + c t^2 = 0 for t = tan r, a < 0: the first root on the way, also beyond a right angle. */
        const double a = cone_at(f, p->from, p->from), b = cone_at(f, p->from, u), c = cone_at(f, u, u);
        most = fmin(most, atan2(-a, b + sqrt(fmax(b * b - a * c, 0.0))));
    }
    return most;
}

static void look(const void *user, int square, double x, double y, double value[ADAPTIVE_MOST])
{
    const polar *const p = user;
    const double turn = p->start[square] + x * p->length[square];
    const vector u = add(scaled(p->east, cos(turn)), sin(turn), p->north);
    const double most = reach(p, u), r = y * most;
    const vector w = add(scaled(p->from, cos(r)), sin(r), u);
    area_truth here = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    area_truth_add(&here, p->lobe, p->wo, (const double[3]){ w.x, w.y, w.z }, p->length[square] * most * sin(r));
    value[0] = here.specular;
    value[1] = here.facets;
    value[2] = here.schlick;
    value[3] = here.projected;
    value[4] = here.cosine;
    value[5] = here.solid_angle;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* From corner to corner, in parts of no more than a quarter of the circle. */
static void cut_circle(polar *p)
{
    double at[MOST_CORNERS + 1];
    const int count = p->f->corners;
    for (int i = 0; i < count; i++)
        at[i] = atan2(dot(p->f->corner[i], p->north), dot(p->f->corner[i], p->east));
    qsort(at, (size_t)count, sizeof *at, compare);
    if (count == 0)
        at[0] = -PI;
    at[count > 0 ? count : 1] = at[0] + 2.0 * PI;
    for (int i = 0; i < (count > 0 ? count : 1); i++) {
        const int parts = (int)ceil((at[i + 1] - at[i]) / (0.5 * PI) - 1e-9);
        for (int k = 0; k < parts; k++) {
            p->length[p->pieces] = (at[i + 1] - at[i]) / parts;
            p->start[p->pieces] = at[i] + k * p->length[p->pieces];
            p->pieces++;
        }
    }
}

area_truth area_adaptive_of(const area_truth_lobe *lobe, const float wo[3], const glint_area_light *light,
                            double tolerance, double *error)
{
    figure f;
    const vector view = unit(of_floats(wo)), mirrored = { -view.x, -view.y, view.z };
    *error = 0.0;
    if (!is_seen(light, &f))
        return (area_truth){ 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    polar p = { .f = &f, .lobe = lobe, .wo = { view.x, view.y, view.z } };
    p.from = is_inside(&f, mirrored) ? mirrored : f.middle;
    p.east = across(p.from);
    p.north = cross(p.from, p.east);
    cut_circle(&p);
    const adaptive_result r =
        adaptive_integrate(&(adaptive_task){ look, &p, p.pieces, .wanted = 2, .tolerance = tolerance });
    *error = r.error;
    return (area_truth){ .specular = r.value[0],
                         .facets = r.value[1],
                         .schlick = r.value[2],
                         .projected = r.value[3],
                         .cosine = r.value[4],
                         .solid_angle = r.value[5] };
}

/* ---- all facets ---- */

/* D (n.h) dh is evenly spread in azimuth and in a number that slopes are functions of; 1 / (n.h) is what is left. GGX:
 * tan^2 = a^2 (1 - y^2) / y^2 for y^2 the share of steeper facets; Beckmann: exp(-t^2) steeper, t = 7 y. */
static void look_at_facets(const void *user, int square, double x, double y, double value[ADAPTIVE_MOST])
{
    const area_truth_lobe *const l = user;
    const double turn = 0.5 * PI * x, along = l->alpha_x * cos(turn), aside = l->alpha_y * sin(turn);
    const double square_of_alpha = along * along + aside * aside, t = 7.0 * y;
    (void)square;
    value[0] = l->is_beckmann ? 14.0 * t * exp(-t * t) * sqrt(1.0 + square_of_alpha * t * t)
                              : 2.0 * sqrt(y * y + square_of_alpha * (1.0 - y * y));
}

double area_adaptive_total(const area_truth_lobe *lobe)
{
    return adaptive_integrate(&(adaptive_task){ look_at_facets, lobe, 1, .wanted = 1, .tolerance = 1e-11 }).value[0];
}
