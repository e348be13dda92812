/* A light where the lobe is a cosine: its directions moved by the matrix of a linearly transformed cosine.
 *
 * It is cut into sectors that share an apex: the direction of the light that is closest to the pole, where the cosine
 * is greatest and the lobe nearly so. From there the lobe only falls, towards whatever part of the rim: points near the
 * apex cannot miss what the light shows of it. A pole within the light is the apex itself. Corners are moved four at a
 * time, in double precision: sums over the sides of a small light nearly cancel.
 */
#include "light/ltc.h"

#define GLINT_LANES 8
#include "math/lanes.h"
#include "math/real.h"

typedef half_double double4;
typedef float float4 __attribute__((vector_size(4 * sizeof(float))));
typedef int64_t mask4 __attribute__((vector_size(sizeof(double4))));

static inline double4 splat4(double x)
{
    return (double4){ x, x, x, x };
}

static inline double4 choose4(mask4 m, double4 a, double4 b)
{
    return (double4)(((mask4)a & m) | ((mask4)b & ~m));
}

static inline double4 max4(double4 a, double4 b)
{
    return choose4(a > b, a, b);
}

#if defined(__AVX2__)

static inline double4 sqrt4(double4 x)
{
    return (double4)_mm256_sqrt_pd((__m256d)x);
}

static inline int bits4(mask4 m)
{
    return _mm256_movemask_pd((__m256d)m);
}

#else

static inline double4 sqrt4(double4 x)
{
    return (double4){ sqrt(x[0]), sqrt(x[1]), sqrt(x[2]), sqrt(x[3]) };
}

static inline int bits4(mask4 m)
{
    return (int)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
}

#endif

static inline double4 load4(const double *p)
{
    double4 v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline void store4(double *p, double4 v)
{
    memcpy(p, &v, sizeof(v));
}

/* ---- polygons ---- */

/* Corners from 0 to count, the last of which is the first again, and as often as fills the vectors. */
enum { ROOM = 2 * AREA_MOST_CORNERS + 8 };

typedef struct moved_corners {
    int count;
    double x[ROOM], y[ROOM], z[ROOM];
} moved_corners;

/* The first corner once more, and as often as fills the vectors. */
static inline void close_corners(moved_corners *c)
{
    store4(c->x + c->count, splat4(c->x[0]));
    store4(c->y + c->count, splat4(c->y[0]));
    store4(c->z + c->count, splat4(c->z[0]));
}

/* 0: one of them is the point itself and has no direction. */
static inline int move_corners(const ltc *l, const vec3d *corner, int count, moved_corners *out)
{
    int is_short = 0, i = 0;
    out->count = count;
    do {
        const vec3d *const a = &corner[i], *const b = &corner[i + 1 < count ? i + 1 : i],
                           *const c = &corner[i + 2 < count ? i + 2 : i], *const d = &corner[i + 3 < count ? i + 3 : i];
        const double4 x = { a->x, b->x, c->x, d->x }, y = { a->y, b->y, c->y, d->y }, z = { a->z, b->z, c->z, d->z };
        const double4 u = l->row[0].x * x + l->row[0].y * y + l->row[0].z * z, v = l->row[1].x * x + l->row[1].y * y;
        const double4 length2 = u * u + v * v + z * z;
        is_short |= bits4(length2 < splat4(1e-200));
        const double4 in = 1.0 / sqrt4(max4(length2, splat4(1e-200)));
        store4(out->x + i, u * in);
        store4(out->y + i, v * in);
        store4(out->z + i, z * in);
        i += 4;
    } while (i < count);
    close_corners(out);
    return !is_short;
}

static inline int has_long_side(const moved_corners *c)
{
    int is_long = 0;
    for (int i = 0; i < c->count; i += 4)
        is_long |= bits4(load4(c->x + i) * load4(c->x + i + 1) + load4(c->y + i) * load4(c->y + i + 1) +
                             load4(c->z + i) * load4(c->z + i + 1) <
                         splat4(0.0));
    return is_long;
}

/* Halves the sides of more than a quarter turn: points that are even along a chord bunch at the ends of its arc. */
static void halve_long_sides(moved_corners *c)
{
    const moved_corners from = *c;
    c->count = 0;
    for (int i = 0; i < from.count; i++) {
        const vec3d a = { from.x[i], from.y[i], from.z[i] }, b = { from.x[i + 1], from.y[i + 1], from.z[i + 1] };
        const vec3d middle = vec3d_normalize(vec3d_add(a, b));
        const int is_long = vec3d_dot(a, b) < 0.0 && vec3d_dot(middle, middle) > 0.5;
        for (int k = 0; k <= is_long; k++) {
            const vec3d v = k == 0 ? a : middle;
            c->x[c->count] = v.x;
            c->y[c->count] = v.y;
            c->z[c->count++] = v.z;
        }
    }
    close_corners(c);
}

/* The angle between unit vectors over its sine, by their scalar product in [-1, 1]; relative error below 3e-9.
 * Interpolated at the Chebyshev nodes of 1 - x in [0, 1]. */
static inline double4 angle_over_sine(double4 cosine)
{
    /* By Estrin's scheme, whose steps wait less for each other than Horner's. */
    const mask4 is_sharp = cosine >= 0.0;
    const double4 y = 1.0 - choose4(is_sharp, cosine, -cosine), y2 = y * y, y4 = y2 * y2;
    const double4 p0 = 1.0000000016817341 + 0.3333329271689951 * y, p2 = 0.1333494156142809 + 0.056896698215951551 * y;
    const double4 p4 = 0.027309139201823915 + 0.0029899804229361754 * y,
                  p6 = 0.02876296956848861 - 0.037681055414478498 * y,
                  p8 = 0.043536176732066625 - 0.024990347118794245 * y + 0.0072904174528296362 * y2;
    const double4 p = (p0 + p2 * y2) + y4 * ((p4 + p6 * y2) + p8 * y4);
    if (bits4(is_sharp) == 15)
        return p;
    return choose4(is_sharp, p, REAL_PI / sqrt4(max4(y * (2.0 - y), splat4(1e-30))) - p);
}

/* Of a side, by its angle's cosine in [0, 1]: a fit to half the angle and to the nodes of quadrature. */
static inline double4 bend_of(double4 cosine)
{
    const double4 y = 1.0 - cosine;
    return y * (0.3333 + y * (0.0857 + y * 0.0487));
}

/* The sides, corner i x corner i + 1. */
typedef struct moved_sides {
    double x[ROOM], y[ROOM], z[ROOM];
    double bend[ROOM];
    int left, right; /* of some of them the pole is on the one side, of some on the other */
} moved_sides;

/* Lambert: half the sum of the sides' angles times their normals, as in area.c, with less care for the last digits; its
 * height is all that a cosine asks for. Returns the integral of the cosine over pi. */
static inline double measure_sides(const moved_corners *c, moved_sides *s)
{
    double4 sum = splat4(0.0);
    s->left = s->right = 0;
    for (int i = 0; i < c->count; i += 4) {
        const double4 ax = load4(c->x + i), ay = load4(c->y + i), az = load4(c->z + i);
        const double4 bx = load4(c->x + i + 1), by = load4(c->y + i + 1), bz = load4(c->z + i + 1);
        const double4 dx = bx - ax, dy = by - ay, dz = bz - az;
        const double4 x = ay * dz - az * dy, y = az * dx - ax * dz, z = ax * dy - ay * dx;
        const double4 cosine = ax * bx + ay * by + az * bz;
        sum += z * angle_over_sine(cosine);
        store4(s->bend + i, bend_of(cosine));
        s->left |= bits4(z > splat4(0.0));
        s->right |= bits4(z < splat4(0.0));
        store4(s->x + i, x);
        store4(s->y + i, y);
        store4(s->z + i, z);
    }
    return real_min(fabs((sum[0] + sum[1]) + (sum[2] + sum[3])) * (0.5 / REAL_PI), 1.0);
}

/* The direction closest to a pole that lies outside: a corner, or where a side has its highest point, which is where
 * the pole is dropped onto its plane. */
static vec3d nearest_to_pole(const moved_corners *c, const moved_sides *s)
{
    int side = 0, is_corner = 1;
    double best = -1.0;
    for (int i = 0; i < c->count; i += 4) {
        const double4 nx = load4(s->x + i), ny = load4(s->y + i), nz = load4(s->z + i), z = load4(c->z + i);
        const mask4 is_within =
            (nx * load4(c->y + i) >= ny * load4(c->x + i)) & (ny * load4(c->x + i + 1) >= nx * load4(c->y + i + 1));
        const double4 flat2 = nx * nx + ny * ny, corner2 = z * z;
        const double4 foot2 = choose4(is_within, flat2 / max4(flat2 + nz * nz, splat4(1e-300)), splat4(0.0));
        const mask4 by_corner = foot2 <= corner2;
        const double4 height2 = choose4(by_corner, corner2, foot2);
        double all[4];
        store4(all, height2);
        for (int k = 0; k < 4; k++)
            if (all[k] > best) {
                best = all[k];
                side = i + k;
                is_corner = bits4(by_corner) >> k & 1;
            }
    }
    if (is_corner)
        return (vec3d){ c->x[side], c->y[side], c->z[side] };
    const double x = s->x[side], y = s->y[side], z = s->z[side];
    return vec3d_normalize((vec3d){ -z * x, -z * y, x * x + y * y });
}

static inline void narrow4(float *to, double4 v)
{
    const float4 f = __builtin_convertvector(v, float4);
    memcpy(to, &f, sizeof(f));
}

static void move_polygon(const ltc *l, const area_light *light, ltc_light *moved)
{
    moved_corners c;
    moved_sides s;
    if (!move_corners(l, light->corner, light->corner_count, &c)) {
        vec3d kept[AREA_MOST_CORNERS];
        int count = 0;
        for (int i = 0; i < light->corner_count; i++)
            if (vec3d_dot(light->corner[i], light->corner[i]) > 1e-100)
                kept[count++] = light->corner[i];
        if (count < 3 || !move_corners(l, kept, count, &c))
            return;
    }
    if (has_long_side(&c))
        halve_long_sides(&c);
    moved->share = measure_sides(&c, &s);
    if (!(moved->share > LTC_LEAST_SHARE))
        return;
    const vec3d apex = s.left && s.right ? nearest_to_pole(&c, &s) : (vec3d){ 0.0, 0.0, 1.0 };
    moved->apex = vec3d_narrow(apex);
    const double scale = 1.0 / moved->share;
    for (int i = 0; i < c.count; i += 4) {
        const double4 v = scale * (apex.x * load4(s.x + i) + apex.y * load4(s.y + i) + apex.z * load4(s.z + i));
        narrow4(moved->volume + i, choose4(v < splat4(0.0), -v, v));
        narrow4(moved->bend + i, load4(s.bend + i));
    }
    for (int i = 0; i <= c.count; i += 4) {
        narrow4(moved->x + i, load4(c.x + i));
        narrow4(moved->y + i, load4(c.y + i));
        narrow4(moved->z + i, load4(c.z + i));
    }
    for (int i = 0; i < c.count; i++) {
        /* Sides through the apex span nothing but what rounding leaves. */
        moved->side[moved->side_count] = i;
        moved->side_count += moved->volume[i] > 1e-6F;
    }
}

/* ---- cones over ellipses ---- */

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

static void move_whole_cone(const ltc *l, const area_light *light, ltc_light *moved)
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
        moved->bend[i] = (float)bend_of(splat4(vec3d_dot(end[i], end[i + 1])))[0];
        moved->side[moved->side_count++] = i;
    }
}

static void move_cut_cone(const ltc *l, const area_light *light, ltc_light *moved)
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

#if defined(__AVX2__) && defined(GLINT_LTC_AVX2)
#define LTC_MOVE ltc_move_avx2
#else
#define LTC_MOVE ltc_move_base
#endif

int LTC_MOVE(const ltc *l, const area_light *light, ltc_light *moved)
{
    moved->side_count = moved->arc_count = 0;
    moved->share = 0.0;
    if (light->kind == AREA_POLYGON)
        move_polygon(l, light, moved);
    else if (light->is_whole)
        move_whole_cone(l, light, moved);
    else
        move_cut_cone(l, light, moved);
    return moved->side_count + moved->arc_count > 0;
}
