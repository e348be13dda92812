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
 * than that (clearance in hit_kernel.h). */
#define SLACK (4.0 * 0x1p-23)

typedef struct points {
    vec3 at[MOST_VERTICES + BOX_CORNERS];
    int count;
} points;

typedef struct box {
    vec3 low, high;
} box;

typedef struct proof {
    const geometry *geometry;
    box *mesh;              /* around each mesh, in its own space */
    box *part;              /* around each instance, in the world */
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

#define FAR ((double)INFINITY)
static const box nothing = { { FAR, FAR, FAR }, { -FAR, -FAR, -FAR } };

static vec3 corner_of(const box *b, int i)
{
    return v3((i & 1) != 0 ? b->high.x : b->low.x, (i & 2) != 0 ? b->high.y : b->low.y,
              (i & 4) != 0 ? b->high.z : b->low.z);
}

static void widen(box *b, vec3 at)
{
    b->low = v3(smaller_of(b->low.x, at.x), smaller_of(b->low.y, at.y), smaller_of(b->low.z, at.z));
    b->high = v3(larger_of(b->high.x, at.x), larger_of(b->high.y, at.y), larger_of(b->high.z, at.z));
}

static box box_around(const points *p)
{
    box b = nothing;
    for (int i = 0; i < p->count; ++i)
        widen(&b, p->at[i]);
    return b;
}

/* The axes of the world before any other: most of a scene is far from most rays. */
static bool are_boxes_apart(proof *p, const box *a, const box *b)
{
    const vec3 up = v3_sub(b->low, a->high), down = v3_sub(a->low, b->high);
    p->work--;
    return larger_of(larger_of(larger_of(up.x, up.y), larger_of(up.z, down.x)), larger_of(down.y, down.z)) >= -p->slack;
}

/* The vertices, or a box around them. */
static points points_of(const proof *p, int instance)
{
    const scene_instance *const from = &p->geometry->scene->instances[instance];
    const scene_mesh *const m = &p->geometry->scene->meshes[from->mesh];
    const double *const to_world = p->geometry->instances[instance].to_world;
    points found = { .count = 0 };
    if (m->vertex_count > MOST_VERTICES)
        for (int i = 0; i < BOX_CORNERS; ++i)
            add(&found, m4_point(to_world, corner_of(&p->mesh[from->mesh], i)));
    else
        for (uint32_t i = 0; i < m->vertex_count; ++i)
            add(&found, m4_point(to_world, v3_from(&m->position[3U * (size_t)i])));
    return found;
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
    box b = box_around(to);
    const vec3 off = v3(around, around, around);
    b.low = v3_mad(v3_sub(b.low, off), l->axis, far);
    b.high = v3_mad(v3_add(b.high, off), l->axis, far);
    for (int i = 0; i < BOX_CORNERS; ++i)
        add(to, corner_of(&b, i));
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
            const box b = { v3_sub(l->position, around), v3_add(l->position, around) };
            add(to, corner_of(&b, i));
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

/* Whether a part stands in the way of no ray. around: all of them. */
static bool is_out_of_the_way(proof *p, const points *rays, const box *around, int instance)
{
    if (are_boxes_apart(p, around, &p->part[instance]))
        return true;
    const points all = points_of(p, instance);
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
    if (p->work <= 0)
        return false;
    points rays = points_of(p, instance);
    p->work -= rays.count;
    bool sees = add_light(p, l, &rays);
    const box around = box_around(&rays);
    for (int i = 0; sees && i < p->geometry->scene->instance_count; ++i)
        sees = p->work > 0 && (i == instance || !is_there(p->geometry, i) || is_out_of_the_way(p, &rays, &around, i));
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

/* Boxes around everything. */
static void begin(proof *p)
{
    const scene *const s = p->geometry->scene;
    box all = nothing;
    for (int i = 0; i < s->mesh_count; ++i) {
        p->mesh[i] = nothing;
        for (uint32_t k = 0; k < s->meshes[i].vertex_count; ++k)
            widen(&p->mesh[i], v3_from(&s->meshes[i].position[3U * (size_t)k]));
    }
    for (int i = 0; i < s->instance_count; ++i) {
        const points here = is_there(p->geometry, i) ? points_of(p, i) : (points){ .count = 0 };
        p->part[i] = box_around(&here);
        for (int k = 0; k < here.count; ++k)
            widen(&all, here.at[k]);
    }
    p->slack = larger_of(v3_max_abs(all.low), v3_max_abs(all.high)) * SLACK;
    p->diameter = v3_length(v3_sub(all.high, all.low));
}

static void prove_all(proof *p, const light *lights, int light_count, int *own, uint8_t *table)
{
    const scene *const s = p->geometry->scene;
    begin(p);
    for (int i = 0; i < s->mesh_count; ++i)
        own[i] = -1;
    for (int i = 0; i < s->material_count * light_count; ++i)
        table[i] = CLEAR_BOTH_SIDES;
    for (int i = 0; i < s->instance_count; ++i)
        if (is_there(p->geometry, i))
            prove_part(p, i, own, lights, light_count,
                       &table[(size_t)mesh_of(p->geometry, i)->material * (size_t)light_count]);
}

bool clear_sight_find(const geometry *g, const light *lights, int light_count, uint8_t *table, report *r)
{
    const size_t meshes = (size_t)g->scene->mesh_count + 1U, parts = (size_t)g->scene->instance_count + 1U;
    box *const boxes = malloc((meshes + parts) * sizeof *boxes);
    int *const own = malloc(meshes * sizeof *own);
    const bool is_room = boxes != NULL && own != NULL;
    if (is_room) {
        proof p = { .geometry = g, .mesh = boxes, .part = boxes + meshes, .work = MOST_WORK };
        prove_all(&p, lights, light_count, own, table);
    } else {
        report_error(r, "no memory for the shadows of %d parts", g->scene->instance_count);
    }
    free(boxes);
    free(own);
    return is_room;
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
