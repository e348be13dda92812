/* Linearly transformed cosines: a microfacet lobe for one view as a clamped cosine whose directions a matrix has moved.
 */
#include "light/ltc.h"

#include <string.h>

#include "math/real.h"

/* Where x lies on a grid of LTC_SIDE points from 0 to 1: the point below, and how far behind it. */
static int locate(double x, double *fraction)
{
    const double at = real_min(real_max(x, 0.0), 1.0) * (LTC_SIDE - 1);
    const int i = at < LTC_SIDE - 1 ? (int)at : LTC_SIDE - 2;
    *fraction = at - i;
    return i;
}

ltc ltc_find(ndf_kind kind, double alpha, vec3d wo)
{
    double s, t;
    const int i = locate(sqrt(alpha), &s), j = locate(sqrt(real_max(0.0, 1.0 - wo.z) * (1.0 / 0.99)), &t);
    /* Two neighbours along the view lie side by side. */
    const float *low = ltc_table[kind == NDF_BECKMANN][i][j], *high = ltc_table[kind == NDF_BECKMANN][i + 1][j];
    const double w[4] = { (1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t };
    double n[LTC_NUMBERS];
    for (int k = 0; k < LTC_NUMBERS; k++)
        n[k] = (w[0] * (double)low[k] + w[1] * (double)low[LTC_NUMBERS + k]) +
               (w[2] * (double)high[k] + w[3] * (double)high[LTC_NUMBERS + k]);
    /* x' = along (x cos - z sin) + shift z, x away from the viewer; y' = across y; z' = z. A view closer to the horizon
     * than the table goes has the table's last lobe. */
    const double sine = sqrt(wo.x * wo.x + wo.y * wo.y), cosine = real_max(wo.z, 0.01);
    const double in_sine = sine > 0.0 ? -1.0 / sine : 0.0, ex = sine > 0.0 ? wo.x * in_sine : 1.0, ey = wo.y * in_sine;
    const double half = 0.5 / (alpha * cosine);
    const double along = n[0] * (cosine * cosine + alpha * alpha) * half;
    const double a = along * cosine, b = n[1] * (alpha * alpha * half) - along * real_min(sine, sqrt(1.0 - 1e-4));
    const double across = n[2] * (cosine * half), in_a = 1.0 / a, in_across = 1.0 / across;
    ltc l = { .row = { { a * ex, a * ey, b }, { -across * ey, across * ex, 0.0 }, { 0.0, 0.0, 1.0 } },
              .column = { { ex * in_a, ey * in_a, 0.0 },
                          { -ey * in_across, ex * in_across, 0.0 },
                          { -b * in_a * ex, -b * in_a * ey, 1.0 } },
              .determinant = a * across,
              .albedo = n[3],
              .schlick = n[4],
              .facets = n[5] };
    return l;
}

static vec3d transform(const ltc *l, vec3d v)
{
    return (vec3d){ vec3d_dot(l->row[0], v), l->row[1].x * v.x + l->row[1].y * v.y, v.z };
}

/* ---- the light, moved ---- */

/* The angle between unit vectors over its sine, by their scalar product in [-1, 1]; relative error below 3e-9.
 * Interpolated at the Chebyshev nodes of 1 - x in [0, 1]. */
static double angle_over_sine(double cosine)
{
    /* By Estrin's scheme, whose steps wait less for each other than Horner's. */
    const double y = 1.0 - fabs(cosine), y2 = y * y, y4 = y2 * y2;
    const double p0 = 1.0000000016817341 + 0.3333329271689951 * y, p2 = 0.1333494156142809 + 0.056896698215951551 * y;
    const double p4 = 0.027309139201823915 + 0.0029899804229361754 * y,
                 p6 = 0.02876296956848861 - 0.037681055414478498 * y,
                 p8 = 0.043536176732066625 - 0.024990347118794245 * y + 0.0072904174528296362 * y2;
    const double p = (p0 + p2 * y2) + y4 * ((p4 + p6 * y2) + p8 * y4);
    return cosine >= 0.0 ? p : REAL_PI / sqrt(real_max(y * (2.0 - y), 1e-30)) - p;
}

static void move_polygon(const ltc *l, const area_light *light, ltc_light *moved)
{
    int count = 0;
    for (int i = 0; i < light->corner_count; i++) {
        moved->corner[count] = vec3d_normalize(transform(l, light->corner[i]));
        count += vec3d_dot(moved->corner[count], moved->corner[count]) > 0.5;
    }
    moved->corner[count] = moved->corner[0];
    /* Lambert: half the sum of the sides' angles times their normals, as in area.c, with less care for the last digits.
     */
    vec3d sum = { 0.0, 0.0, 0.0 }, towards = { 0.0, 0.0, (double)count };
    for (int i = 0; i < count; i++) {
        const vec3d a = moved->corner[i], b = moved->corner[i + 1];
        moved->normal[i] = vec3d_cross(a, vec3d_sub(b, a));
        towards = vec3d_add(towards, a);
        sum = vec3d_mad(sum, moved->normal[i], angle_over_sine(vec3d_dot(a, b)));
    }
    moved->side_count = count;
    moved->middle = vec3d_dot(sum, towards) < 0.0 ? vec3d_scale(sum, -1.0) : sum;
    moved->share = moved->middle.z * (0.5 / REAL_PI);
}

static void move_whole_cone(const ltc *l, const area_light *light, ltc_light *moved)
{
    static const double turn[CONIC_ARCS][2] = { { 1.0, 0.0 }, { 0.0, 1.0 }, { -1.0, 0.0 }, { 0.0, -1.0 } };
    for (int i = 0; i < 3; i++)
        moved->span[i] = transform(l, light->span[i]);
    moved->middle = conic_whole_moment(moved->span[0], moved->span[1], moved->span[2]);
    moved->share = moved->middle.z * (1.0 / REAL_PI);
    moved->arc_count = CONIC_ARCS;
    memcpy(moved->arc, turn, sizeof(turn));
    moved->half_turns = 0.5;
}

static void move_cut_cone(const ltc *l, const area_light *light, ltc_light *moved)
{
    area_light cut;
    area_make_cone(&cut, transform(l, light->span[0]), transform(l, light->span[1]), transform(l, light->span[2]));
    if (!area_measure(&cut))
        return;
    const conic *c = &cut.cone;
    moved->middle = cut.moment;
    moved->share = cut.moment.z * (1.0 / REAL_PI);
    moved->span[0] = c->axis_z;
    moved->span[1] = vec3d_scale(c->axis_x, c->a);
    moved->span[2] = vec3d_scale(c->axis_y, c->b);
    moved->arc_count = CONIC_ARCS;
    memcpy(moved->arc, c->node, sizeof(moved->arc));
    /* The nodes halve the whole arc, and its halves. */
    const double *from = c->node[0], *to = c->node[1];
    moved->half_turns = real_atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]) / REAL_PI;
    if (!c->is_cut)
        return;
    moved->side_count = 1;
    for (int i = 0; i < 2; i++) {
        vec3d end, derivative;
        area_boundary(&cut, CONIC_ARCS, (double)i, &end, &derivative);
        moved->corner[i] = vec3d_normalize(end);
    }
    moved->normal[0] = vec3d_cross(moved->corner[0], moved->corner[1]);
}

int ltc_move(const ltc *l, const area_light *light, ltc_light *moved)
{
    moved->side_count = moved->arc_count = 0;
    moved->share = 0.0;
    moved->middle = (vec3d){ 0.0, 0.0, 0.0 };
    if (light->kind == AREA_POLYGON)
        move_polygon(l, light, moved);
    else if (light->is_whole)
        move_whole_cone(l, light, moved);
    else
        move_cut_cone(l, light, moved);
    moved->middle = vec3d_normalize(moved->middle);
    /* Corners that do not run around once may add up to more. */
    moved->share = real_min(moved->share, 1.0);
    return moved->share > 1e-26 && vec3d_dot(moved->middle, moved->middle) > 0.5;
}
