/* A round light where the lobe is a cosine: the cone over an ellipse, moved, along axes of its own.
 *
 * Moved, a disk may be a sliver from horizon to horizon. Seen along its axis a cone's rim is an ellipse, too, x = a cos
 * t, y = b sin t with the sines of the half angles, and t is even in angles even where a is one.
 */
#include "light/ltc.h"
#include "math/real.h"

/* A point of the rim along the cone's axes: unit, by t. */
static vec3d rim_at(const conic *c, double sine_x, double sine_y, double cosine, double sine)
{
    const double x = sine_x * cosine, y = sine_y * sine, z = sqrt(real_max(1.0 - x * x - y * y, 0.0));
    return vec3d_add(vec3d_scale(c->axis_z, z), vec3d_mad(vec3d_scale(c->axis_x, x), c->axis_y, y));
}

/* Goes from (cos t, sin t) one step of Newton's method towards where the rim is highest and so closest to the pole, if
 * it leads there. */
static void approach_pole(const conic *c, double a, double b, double turn[2])
{
    const double x = a * turn[0], y = b * turn[1], z = sqrt(real_max(1.0 - x * x - y * y, 1e-12));
    const double dx = -a * turn[1], dy = b * turn[0], dz = -(x * dx + y * dy) / z;
    const double ddz = -(dx * dx + dy * dy - x * x - y * y + dz * dz) / z;
    const double slope = dx * c->axis_x.z + dy * c->axis_y.z + dz * c->axis_z.z;
    const double change = -x * c->axis_x.z - y * c->axis_y.z + ddz * c->axis_z.z;
    if (!(change < 0.0))
        return;
    const double step = real_max(-0.5, real_min(0.5, -slope / change)), in = 1.0 / sqrt(1.0 + step * step);
    const double next[2] = { (turn[0] - step * turn[1]) * in, (turn[1] + step * turn[0]) * in };
    if (rim_at(c, a, b, next[0], next[1]).z > rim_at(c, a, b, turn[0], turn[1]).z) {
        turn[0] = next[0];
        turn[1] = next[1];
    }
}

/* Where the rim faces the pole: from the point that lies towards it, seen along the axis, or the one that leans towards
 * it. */
static void face_pole(const conic *c, double a, double b, double turn[2])
{
    const double x = c->axis_x.z, y = c->axis_y.z;
    const double other[2] = { x * a, y * b },
                 in = 1.0 / sqrt(real_max(other[0] * other[0] + other[1] * other[1], 1e-200));
    if (rim_at(c, a, b, other[0] * in, other[1] * in).z > rim_at(c, a, b, turn[0], turn[1]).z) {
        turn[0] = other[0] * in;
        turn[1] = other[1] * in;
    }
    approach_pole(c, a, b, turn);
}

/* Axes and apex of a cone whose share is known; turn: cos t and sin t of the apex, or where the pole is within, of
 * where the rim lies towards it. */
static void set_rim(const conic *c, double a, double b, double turn[2], ltc_light *moved)
{
    /* The pole is within if x^2 / a^2 + y^2 / b^2 <= 1 seen along the axis. */
    const double x = c->axis_x.z * b, y = c->axis_y.z * a, reach2 = x * x + y * y;
    const double in_reach = reach2 > 1e-200 ? 1.0 / sqrt(reach2) : 0.0, in = 1.0 / moved->share;
    vec3d apex = { 0.0, 0.0, 1.0 };
    turn[0] = in_reach > 0.0 ? x * in_reach : 1.0;
    turn[1] = y * in_reach;
    if (!(c->axis_z.z > 0.0 && reach2 <= a * a * b * b)) {
        face_pole(c, a, b, turn);
        apex = rim_at(c, a, b, turn[0], turn[1]);
    }
    moved->apex = vec3d_narrow(apex);
    moved->axis_x = vec3d_narrow(c->axis_x);
    moved->axis_y = vec3d_narrow(c->axis_y);
    moved->axis_z = vec3d_narrow(c->axis_z);
    moved->sine_x = (float)a;
    moved->sine_y = (float)b;
    moved->apex_in_axes = (vec3){ (float)(in * vec3d_dot(apex, c->axis_x)), (float)(in * vec3d_dot(apex, c->axis_y)),
                                  (float)(in * vec3d_dot(apex, c->axis_z)) };
    moved->arc_count = CONIC_ARCS;
}

static void set_arc(ltc_light *moved, int i, double cosine, double sine, double half_turns)
{
    moved->arc[i][0] = (float)cosine;
    moved->arc[i][1] = (float)sine;
    moved->half_turns[i] = (float)half_turns;
}

/* The sine of the half angle with this tangent. */
static double sine_of(double tangent)
{
    return tangent / sqrt(1.0 + tangent * tangent);
}

static void move_whole(const ltc *l, const area_light *light, ltc_light *moved)
{
    conic c;
    if (!conic_make(&c, ltc_transform(l, light->span[0]), ltc_transform(l, light->span[1]),
                    ltc_transform(l, light->span[2])))
        return;
    const double a = sine_of(c.a), b = sine_of(c.b);
    moved->share = real_min(a * b * c.axis_z.z, 1.0); /* as conic_moment has it */
    if (!(moved->share > LTC_LEAST_SHARE))
        return;
    double turn[2];
    set_rim(&c, a, b, turn, moved);
    set_arc(moved, 0, turn[0], turn[1], 0.5);
    set_arc(moved, 1, -turn[1], turn[0], 0.5);
    set_arc(moved, 2, -turn[0], -turn[1], 0.5);
    set_arc(moved, 3, turn[1], -turn[0], 0.5);
}

static void set_corner(ltc_light *moved, int i, vec3d v)
{
    const vec3 unit = vec3d_narrow(v);
    moved->x[i] = unit.x;
    moved->y[i] = unit.y;
    moved->z[i] = unit.z;
}

/* The horizon in two halves, between the ends of the arc. */
static void set_horizon(const area_light *cut, ltc_light *moved)
{
    vec3d end[3], derivative;
    area_boundary(cut, CONIC_ARCS, 0.0, &end[0], &derivative);
    area_boundary(cut, CONIC_ARCS, 1.0, &end[2], &derivative);
    end[0] = vec3d_normalize(end[0]);
    end[2] = vec3d_normalize(end[2]);
    end[1] = vec3d_normalize(vec3d_add(end[0], end[2]));
    for (int i = 0; i < 3; i++)
        set_corner(moved, i, end[i]);
    for (int i = 0; i < 2; i++) {
        const vec3d normal = vec3d_cross(end[i], end[i + 1]);
        moved->volume[i] = (float)(fabs(vec3d_dot(vec3d_of(moved->apex), normal)) / moved->share);
        const double y = 1.0 - vec3d_dot(end[i], end[i + 1]);
        moved->bend[i] = (float)(y * (LTC_BEND_1 + y * (LTC_BEND_2 + y * LTC_BEND_3)));
        moved->side[moved->side_count++] = i;
    }
}

static void move_cut(const ltc *l, const area_light *light, ltc_light *moved)
{
    area_light cut;
    area_make_cone(&cut, ltc_transform(l, light->span[0]), ltc_transform(l, light->span[1]),
                   ltc_transform(l, light->span[2]));
    if (!area_measure(&cut))
        return;
    const conic *c = &cut.cone;
    const double a = sine_of(c->a), b = sine_of(c->b);
    moved->share = real_min(cut.moment.z * (1.0 / REAL_PI), 1.0);
    if (!(moved->share > LTC_LEAST_SHARE))
        return;
    double turn[2], node[3][2];
    set_rim(c, a, b, turn, moved);
    /* From one end over the highest point to the other, which the cone has by the tangents. */
    for (int i = 0; i < 3; i++) {
        const double x = c->node[2 * i][0] * c->a / a, y = c->node[2 * i][1] * c->b / b, in = 1.0 / sqrt(x * x + y * y);
        node[i][0] = x * in;
        node[i][1] = y * in;
    }
    for (int i = 0; i < 2; i++) {
        const double *from = node[i], *to = node[i + 1];
        double angle = real_atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
        angle = angle < 0.0 ? angle + 2.0 * REAL_PI : angle;
        const double half = 0.5 * angle / REAL_PI;
        const double mx = from[0] + to[0], my = from[1] + to[1], length = sqrt(mx * mx + my * my);
        /* Half a turn has its middle to the left. */
        const double mid_x = length > 1e-9 ? mx / length : -from[1], mid_y = length > 1e-9 ? my / length : from[0];
        set_arc(moved, 2 * i, from[0], from[1], half);
        set_arc(moved, 2 * i + 1, mid_x, mid_y, half);
    }
    if (c->is_cut)
        set_horizon(&cut, moved);
}

void ltc_move_round(const ltc *l, const area_light *light, ltc_light *moved)
{
    (light->is_whole ? move_whole : move_cut)(l, light, moved);
}
