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

static inline double4 bend_of(double4 cosine)
{
    const double4 y = 1.0 - cosine;
    return y * (LTC_BEND_1 + y * (LTC_BEND_2 + y * LTC_BEND_3));
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
    else
        ltc_move_round(l, light, moved);
    return moved->side_count + moved->arc_count > 0;
}
