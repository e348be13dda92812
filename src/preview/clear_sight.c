/* Proves that no shadow ray can meet anything: planes that keep what it may pass apart from what is there.
 *
 * Rays from a part of the scene to a light stay in the convex hull of both. What a plane keeps apart from that hull
 * blocks none of them; a plane is found by Gilbert's iteration (1966) and counts only once all points have been seen on
 * their sides of it, so that the proof does not rest on the iteration. A part blocks its own rays nowhere above the
 * plane of the triangle that they leave if all of it lies below: if it is flat, or convex and seen from outside.
 */
#include "preview/clear_sight.h"

#include <stdlib.h>

/* Vertices of a part that are taken one by one; of more the box around them. */
#define MOST_VERTICES 64
#define BOX_CORNERS 8
/* A part that no plane keeps away as a whole is looked at triangle by triangle, if there are no more. */
#define MOST_TRIANGLES 4096
/* Of the iteration. What it does not find in so many steps touches, or nearly. */
#define MOST_STEPS 32
/* Points on sides of planes, to be looked at in all: about a twentieth of a second. Taste. */
#define MOST_WORK 50000000
/* Positions are floats: a few units in the last place of the largest coordinate. Rays begin further off the surface
 * than that (resolve_clearance in hit.c). */
#define SLACK (4.0 * 0x1p-23)

typedef struct points {
    vec3 at[MOST_VERTICES + BOX_CORNERS];
    int count;
} points;

typedef struct proof {
    const geometry *geometry;
    double slack, diameter; /* of the scene, m */
    long long work;         /* that is left */
} proof;

/* ---- planes between points ---- */

/* The point that is furthest along a direction. */
static vec3 furthest(const points *p, vec3 along)
{
    vec3 best = p->at[0];
    double most = v3_dot(best, along);
    for (int i = 1; i < p->count; ++i) {
        const double x = v3_dot(p->at[i], along);
        if (x > most) {
            most = x;
            best = p->at[i];
        }
    }
    return best;
}

/* Whether a plane across the axis has all of a below it and all of b above; the way from one to the other across it. */
static bool is_apart(proof *p, const points *a, const points *b, vec3 axis, vec3 *way)
{
    p->work -= a->count + b->count;
    *way = v3_sub(furthest(b, v3_scale(axis, -1.0)), furthest(a, axis));
    return v3_dot(*way, axis) >= -p->slack * v3_length(axis) && v3_length(axis) > 0.0;
}

/* The axis turns to the shortest way between both hulls. */
static bool is_apart_somehow(proof *p, const points *a, const points *b)
{
    vec3 axis = v3_sub(b->at[0], a->at[0]), way;
    for (int i = 0; i < MOST_STEPS && p->work > 0; ++i) {
        if (is_apart(p, a, b, axis, &way))
            return true;
        const vec3 change = v3_sub(way, axis);
        const double square = v3_dot(change, change);
        if (!(square > 0.0))
            return false;
        axis = v3_mad(axis, change, smaller_of(larger_of(-v3_dot(axis, change) / square, 0.0), 1.0));
    }
    return false;
}

/* ---- parts of the scene ---- */

static const scene_mesh *mesh_of(const geometry *g, int instance)
{
    return &g->scene->meshes[g->scene->instances[instance].mesh];
}

static void add(points *p, vec3 at)
{
    p->at[p->count++] = at;
}

/* Corner i of a box. */
static vec3 corner_of(vec3 low, vec3 high, int i)
{
    return v3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
}

static void widen(vec3 *low, vec3 *high, vec3 at)
{
    *low = v3(smaller_of(low->x, at.x), smaller_of(low->y, at.y), smaller_of(low->z, at.z));
    *high = v3(larger_of(high->x, at.x), larger_of(high->y, at.y), larger_of(high->z, at.z));
}

/* The vertices, or a box around them. */
static points points_of(const geometry *g, int instance)
{
    const scene_mesh *const m = mesh_of(g, instance);
    const double *const to_world = g->instances[instance].to_world;
    points p = { .count = 0 };
    vec3 low = v3_from(m->position), high = low;
    for (uint32_t i = 0; i < m->vertex_count; ++i) {
        const vec3 at = v3_from(&m->position[3U * (size_t)i]);
        if (m->vertex_count <= MOST_VERTICES)
            add(&p, m4_point(to_world, at));
        widen(&low, &high, at);
    }
    for (int i = 0; m->vertex_count > MOST_VERTICES && i < BOX_CORNERS; ++i)
        add(&p, m4_point(to_world, corner_of(low, high, i)));
    return p;
}

/* Whether a triangle of a mesh has other vertices above it, or below. One that is no wider than a rounding, as at the
 * poles of a ball, has no side. */
static void look_across(const scene_mesh *m, uint32_t triangle, double slack, bool *above, bool *below)
{
    vec3 c[3];
    for (int k = 0; k < 3; ++k)
        c[k] = v3_from(&m->position[3U * (size_t)m->index[3U * (size_t)triangle + (size_t)k]]);
    const vec3 x = v3_sub(c[1], c[0]), y = v3_sub(c[2], c[0]), across = v3_cross(x, y), n = v3_normalize(across);
    const double longest = larger_of(v3_length(v3_sub(c[2], c[1])), larger_of(v3_length(x), v3_length(y)));
    if (!(v3_length(across) > slack * longest))
        return;
    for (uint32_t i = 0; i < m->vertex_count && !(*above && *below); ++i) {
        const double height = v3_dot(v3_sub(v3_from(&m->position[3U * (size_t)i]), c[0]), n);
        *above = *above || !(height <= slack); /* NaN too */
        *below = *below || height < -slack;
    }
}

/* What a mesh that is alone hides of its own; one that would take more than the work that is left is not begun. */
static clear_sight sight_of_mesh(proof *p, const scene_mesh *m)
{
    double largest = 0.0;
    bool below = false;
    if ((long long)m->triangle_count * m->vertex_count > p->work)
        return CLEAR_UNKNOWN;
    for (uint32_t i = 0; i < 3U * m->vertex_count; ++i)
        largest = larger_of(fabs((double)m->position[i]), largest);
    for (uint32_t t = 0; t < m->triangle_count; ++t) {
        bool above = false;
        p->work -= m->vertex_count;
        look_across(m, t, largest * SLACK, &above, &below);
        if (above)
            return CLEAR_UNKNOWN;
    }
    return below ? CLEAR_IN_FRONT : CLEAR_BOTH_SIDES;
}

/* ---- lights ---- */

/* Rays to a sun leave the scene: where, from any of the points. False: it is so large that they go anywhere. */
static bool add_sun(const proof *p, const light *l, points *to)
{
    const double sine = sqrt(larger_of(1.0 - l->cosine * l->cosine, 0.0)), far = 2.0 * p->diameter;
    if (!(l->cosine > 0.5))
        return false;
    const double around = far * sine / l->cosine;
    vec3 low = to->at[0], high = low;
    for (int i = 0; i < to->count; ++i)
        widen(&low, &high, to->at[i]);
    const vec3 off = v3(around, around, around);
    low = v3_mad(v3_sub(low, off), l->axis, far);
    high = v3_mad(v3_add(high, off), l->axis, far);
    for (int i = 0; i < BOX_CORNERS; ++i)
        add(to, corner_of(low, high, i));
    return true;
}

/* Adds the light to what sees it. */
static bool add_light(const proof *p, const light *l, points *to)
{
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        return add_sun(p, l, to);
    for (int i = 0; i < BOX_CORNERS; ++i) {
        if (!light_is_area(l)) {
            const vec3 around = v3(l->radius, l->radius, l->radius);
            add(to, corner_of(v3_sub(l->position, around), v3_add(l->position, around), i));
        } else if (i < 4) {
            const vec3 x = v3_scale(l->half_x, (i & 1) != 0 ? 1.0 : -1.0), y = v3_scale(l->half_y, i < 2 ? 1.0 : -1.0);
            add(to, v3_add(l->position, v3_add(x, y)));
        }
    }
    return true;
}

/* ---- the proof ---- */

static bool is_triangle_apart(proof *p, const points *rays, int instance, uint32_t triangle)
{
    const triangle_corners c = geometry_triangle(p->geometry, instance, triangle);
    points corners = { .count = 0 };
    vec3 way;
    for (int k = 0; k < 3; ++k)
        add(&corners, m4_point(p->geometry->instances[instance].to_world, c.position[k]));
    const vec3 n = v3_cross(v3_sub(corners.at[1], corners.at[0]), v3_sub(corners.at[2], corners.at[0]));
    return is_apart(p, rays, &corners, n, &way) || is_apart(p, rays, &corners, v3_scale(n, -1.0), &way) ||
           is_apart_somehow(p, rays, &corners);
}

/* Whether a part stands in the way of no ray. */
static bool is_out_of_the_way(proof *p, const points *rays, int instance)
{
    const points all = points_of(p->geometry, instance);
    const uint32_t triangles = mesh_of(p->geometry, instance)->triangle_count;
    if (is_apart_somehow(p, rays, &all))
        return true;
    bool apart = triangles <= MOST_TRIANGLES;
    for (uint32_t t = 0; apart && t < triangles; ++t)
        apart = is_triangle_apart(p, rays, instance, t);
    return apart && p->work > 0;
}

static bool is_there(const geometry *g, int instance)
{
    const scene_mesh *const m = mesh_of(g, instance);
    return g->instances[instance].visible && m->vertex_count > 0 && m->triangle_count > 0;
}

static bool sees_all_of(proof *p, int instance, const light *l)
{
    points rays = points_of(p->geometry, instance);
    bool sees = add_light(p, l, &rays);
    for (int i = 0; sees && i < p->geometry->scene->instance_count; ++i)
        sees = i == instance || !is_there(p->geometry, i) || is_out_of_the_way(p, &rays, i);
    return sees;
}

/* The least of what the parts of a material see. own: of the meshes, where that has been looked at: only where nothing
 * else is in the way. */
static void prove_part(proof *p, int instance, int *own, const light *lights, int light_count, uint8_t *row)
{
    int *const of_mesh = &own[p->geometry->scene->instances[instance].mesh];
    for (int l = 0; l < light_count; ++l) {
        if (row[l] == CLEAR_UNKNOWN)
            continue;
        if (!sees_all_of(p, instance, &lights[l])) {
            row[l] = CLEAR_UNKNOWN;
            continue;
        }
        if (*of_mesh < 0)
            *of_mesh = (int)sight_of_mesh(p, mesh_of(p->geometry, instance));
        row[l] = *of_mesh < row[l] ? (uint8_t)*of_mesh : row[l];
    }
}

static proof begin(const geometry *g)
{
    vec3 low = v3(INFINITY, INFINITY, INFINITY), high = v3_scale(low, -1.0);
    for (int i = 0; i < g->scene->instance_count; ++i) {
        const points p = is_there(g, i) ? points_of(g, i) : (points){ .count = 0 };
        for (int k = 0; k < p.count; ++k)
            widen(&low, &high, p.at[k]);
    }
    return (proof){ g, larger_of(v3_max_abs(low), v3_max_abs(high)) * SLACK, v3_length(v3_sub(high, low)), MOST_WORK };
}

bool clear_sight_find(const geometry *g, const light *lights, int light_count, uint8_t *table, report *r)
{
    const scene *const s = g->scene;
    proof p = begin(g);
    int *const own = calloc((size_t)s->mesh_count + 1U, sizeof *own);
    if (own == NULL)
        return report_error(r, "no memory for what %d meshes hide of themselves", s->mesh_count);
    for (int i = 0; i < s->mesh_count; ++i)
        own[i] = -1;
    for (int i = 0; i < s->material_count * light_count; ++i)
        table[i] = CLEAR_BOTH_SIDES;
    for (int i = 0; i < s->instance_count; ++i)
        if (is_there(g, i))
            prove_part(&p, i, own, lights, light_count, &table[(size_t)mesh_of(g, i)->material * (size_t)light_count]);
    free(own);
    return true;
}

/* ---- at a point ---- */

static bool is_seen_side(clear_sight sight, const hit *h)
{
    return sight == CLEAR_BOTH_SIDES || (sight == CLEAR_IN_FRONT && h->front);
}

bool clear_sight_of_round(clear_sight sight, const hit *h, const light *l, const light_view *view)
{
    /* Without a sine a light with a size is all around. */
    return is_seen_side(sight, h) && (view->sine > 0.0 || !light_is_soft(l)) &&
           v3_dot(view->wi, h->geometric_normal) > view->sine;
}

bool clear_sight_of_flat(clear_sight sight, const hit *h, const light *l)
{
    const vec3 n = h->geometric_normal;
    return is_seen_side(sight, h) &&
           v3_dot(v3_sub(l->position, h->position), n) > fabs(v3_dot(l->half_x, n)) + fabs(v3_dot(l->half_y, n));
}
