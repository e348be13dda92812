/* A light that is not plain, at one point: what the horizon leaves of it, as maps of squares that area_cells.c cuts
 * into cells. */
#include "math/real.h"
#include "model/area.h"
#include "model/area_cells.h"

static void put(float to[3][AREA_ROOM], int i, vec3d v)
{
    to[0][i] = (float)v.x;
    to[1][i] = (float)v.y;
    to[2][i] = (float)v.z;
}

/* a . (b x c), by the ways from a: a small light's has digits. */
static double volume(vec3d a, vec3d b, vec3d c)
{
    return vec3d_dot(a, vec3d_cross(vec3d_sub(b, a), vec3d_sub(c, a)));
}

/* The patch between four corners; two may coincide. */
static void put_patch(area_patches *p, const vec3d q[4])
{
    const vec3d a = vec3d_sub(q[1], q[0]), b = vec3d_sub(q[2], q[3]), c = vec3d_sub(q[3], q[0]),
                sum = vec3d_add(vec3d_add(q[0], q[1]), vec3d_add(q[2], q[3]));
    const vec3d d = vec3d_sub(q[2], q[1]);
    double at[4]; /* the map's area at the corners, four times over */
    for (int i = 0; i < 4; i++)
        at[i] = volume(q[i], q[(i + 1) & 3], q[(i + 3) & 3]);
    const double sign = 0.25 * ((at[0] + at[1]) + (at[2] + at[3]) < 0.0 ? -1.0 : 1.0);
    const int i = p->count++;
    put(p->middle, i, vec3d_scale(sum, 0.25));
    put(p->u, i, vec3d_scale(vec3d_add(a, b), 0.25));
    put(p->v, i, vec3d_scale(vec3d_add(c, d), 0.25));
    put(p->w, i, vec3d_scale(vec3d_sub(b, a), 0.25));
    p->size[0][i] = (float)(sign * ((at[0] + at[1]) + (at[2] + at[3])));
    p->size[1][i] = (float)(sign * ((at[1] + at[2]) - (at[0] + at[3])));
    p->size[2][i] = (float)(sign * ((at[2] + at[3]) - (at[0] + at[1])));
    p->size[3][i] = (float)(sign * ((at[0] + at[2]) - (at[1] + at[3])));
}

static int map_polygon(const area_light *light, area_patches *p)
{
    vec3d corner[AREA_MOST_CORNERS + 1];
    int count = 0;
    for (int i = 0; i < light->corner_count; i++) {
        corner[count] = vec3d_normalize(light->corner[i]);
        count += vec3d_dot(corner[count], corner[count]) > 0.5; /* or at the point itself */
    }
    corner[count] = corner[0];
    p->is_round = p->count = 0;
    for (int i = 1; i + 1 < count; i += 2)
        put_patch(p, (const vec3d[4]){ corner[0], corner[i], corner[i + 1], corner[i + 2] });
    return p->count > 0;
}

/* What is flatter or wider than that, of its distance, squared, is no matter for floats. */
static int is_moderate(double size2, double distance2)
{
    return size2 > 1e-20 * distance2 && size2 < 1e4 * distance2;
}

/* Chords of the disk that are level, from its highest point down to the horizon or its lowest. */
static int map_round(const area_light *light, area_patches *p)
{
    const vec3d center = light->span[0], a = light->span[1], b = light->span[2];
    const double distance2 = vec3d_dot(center, center), rise = sqrt(a.z * a.z + b.z * b.z);
    vec3d up = a, level = b;
    if (rise > 0.0) {
        const double x = a.z / rise, y = b.z / rise;
        up = vec3d_mad(vec3d_scale(a, x), b, y);
        level = vec3d_mad(vec3d_scale(a, -y), b, x);
        level.z = 0.0;
    }
    double turn = 0.5;
    if (!light->is_whole) {
        const double lowest = rise > 0.0 ? real_max(-1.0, real_min(1.0, -center.z / rise)) : 1.0;
        turn = real_atan2(sqrt((1.0 - lowest) * (1.0 + lowest)), lowest) * (0.5 / REAL_PI);
    }
    if (!is_moderate(vec3d_dot(up, up), distance2) || !is_moderate(vec3d_dot(level, level), distance2) ||
        !(turn > 1e-6))
        return 0;
    const double scale = 1.0 / sqrt(distance2);
    p->is_round = p->count = 1;
    p->turn = (float)turn;
    put(p->middle, 0, vec3d_scale(vec3d_add(center, up), scale));
    put(p->u, 0, vec3d_scale(level, scale));
    put(p->v, 0, vec3d_scale(up, scale));
    /* d x d y = 2 pi turn sin^2 for an angle of 2 pi turn over x in [0, 1], and y in [-1, 1]; sin = 2 s c. */
    p->size[0][0] = (float)(16.0 * REAL_PI * turn * fabs(vec3d_dot(center, vec3d_cross(a, b))) * scale * scale * scale);
    return 1;
}

static area_cells_sum *sum_for_this_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return area_cells_sum_avx2;
#endif
    return area_cells_sum_base;
}

float area_eval_parts(const model_query *q, const area_light *light, area_value *value)
{
    area_patches patches;
    area_node_sums sums;
    if (!(light->kind == AREA_POLYGON ? map_polygon : map_round)(light, &patches))
        return 1.0F;
    const area_eye eye = area_eye_of(q);
    const float left = sum_for_this_machine()(&eye, &patches, &sums);
    if (left < 1.0F)
        area_shade(q, &sums, value);
    return left;
}
