/* Tangents after Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), section 3.3, with the conventions of
 * his mikktspace: corners around a vertex form a group while their triangles share edges and texture orientation; a
 * group's tangent is the mean of its triangles' tangents, projected on the plane of the vertex normal and weighted by
 * the angle at the corner.
 *
 * The reference can also split a group by an angle; its default of 180 degrees keeps groups whole, and so does this
 * file.
 */
#include "io/tangent_space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

/* A vertex by what makes it one: vertices that agree in all of it are the same corner of the surface. */
typedef struct weld_key {
    float value[8];
    uint32_t vertex;
} weld_key;

typedef struct half_edge {
    uint32_t low, high; /* welded vertices */
    uint32_t backward;  /* 1 when the triangle runs from high to low */
    uint32_t corner;    /* 3 * triangle + where the edge starts */
} half_edge;

typedef struct triangle {
    float tangent[3]; /* the direction in which u grows; zero where texture coordinates do not say */
    bool degenerate;  /* two corners in one place */
    bool any;         /* texture coordinates without area: joins either orientation */
    bool preserving;  /* the texture is not mirrored, in the v-up space of mikktspace */
} triangle;

typedef struct work {
    const tangent_space_input *in;
    uint32_t corner_count;
    weld_key *keys;
    uint32_t *welded; /* per vertex */
    triangle *triangles;
    half_edge *edges;
    uint32_t *neighbor;  /* per corner: the corner of the next triangle across the edge that starts there, or NONE */
    uint32_t *group;     /* per corner: the corner that started its group, or NONE */
    uint32_t *members;   /* corners of the group at hand */
    uint32_t *at_vertex; /* per welded vertex: a corner that has a tangent, or NONE */
} work;

/* ---- vectors ---- */

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const float a[3], const float b[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

/* Zero stays zero. In double: squares of small floats vanish. */
static void normalise(float v[3])
{
    const double x = (double)v[0], y = (double)v[1], z = (double)v[2], length = sqrt(x * x + y * y + z * z);
    for (int k = 0; k < 3; k++)
        v[k] = length > 0.0 ? (float)((double)v[k] / length) : 0.0F;
}

/* The part of v in the plane of the unit vector n, as a unit vector. */
static void project(const float n[3], float v[3])
{
    const float along = dot(n, v);
    for (int k = 0; k < 3; k++)
        v[k] -= along * n[k];
    normalise(v);
}

static const float *position(const work *w, uint32_t corner)
{
    return &w->in->position[3 * (size_t)w->in->index[corner]];
}

static const float *normal(const work *w, uint32_t corner)
{
    return &w->in->normal[3 * (size_t)w->in->index[corner]];
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static uint32_t previous_corner(uint32_t corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/* ---- welding ---- */

static int compare_keys(const void *left, const void *right)
{
    const weld_key *a = left, *b = right;
    for (int k = 0; k < 8; k++)
        if (a->value[k] != b->value[k])
            return a->value[k] < b->value[k] ? -1 : 1;
    return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

static bool same_key(const weld_key *a, const weld_key *b)
{
    for (int k = 0; k < 8; k++)
        if (a->value[k] != b->value[k])
            return false;
    return true;
}

static void weld(work *w)
{
    const tangent_space_input *in = w->in;
    for (uint32_t i = 0; i < in->vertex_count; i++) {
        memcpy(&w->keys[i].value[0], &in->position[3 * (size_t)i], 3 * sizeof(float));
        memcpy(&w->keys[i].value[3], &in->normal[3 * (size_t)i], 3 * sizeof(float));
        memcpy(&w->keys[i].value[6], &in->texcoord[2 * (size_t)i], 2 * sizeof(float));
        w->keys[i].vertex = i;
    }
    qsort(w->keys, in->vertex_count, sizeof *w->keys, compare_keys);
    for (uint32_t i = 0; i < in->vertex_count; i++) {
        const bool repeats = i > 0 && same_key(&w->keys[i - 1], &w->keys[i]);
        w->welded[w->keys[i].vertex] = repeats ? w->welded[w->keys[i - 1].vertex] : w->keys[i].vertex;
    }
}

/* ---- triangles ---- */

static bool same_place(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void measure(const work *w, uint32_t number)
{
    const uint32_t corner = 3 * number;
    triangle *t = &w->triangles[number];
    const float *p[3], *uv[3];
    for (uint32_t k = 0; k < 3; k++) {
        p[k] = position(w, corner + k);
        uv[k] = &w->in->texcoord[2 * (size_t)w->in->index[corner + k]];
    }
    t->degenerate = same_place(p[0], p[1]) || same_place(p[1], p[2]) || same_place(p[2], p[0]);
    float edge1[3], edge2[3];
    subtract(p[1], p[0], edge1);
    subtract(p[2], p[0], edge2);
    /* v grows downwards in glTF and upwards in mikktspace. */
    const float du1 = uv[1][0] - uv[0][0], dv1 = uv[0][1] - uv[1][1], du2 = uv[2][0] - uv[0][0],
                dv2 = uv[0][1] - uv[2][1];
    const float area = du1 * dv2 - dv1 * du2;
    t->preserving = area > 0.0F;
    for (int k = 0; k < 3; k++)
        t->tangent[k] = (t->preserving ? 1.0F : -1.0F) * (dv2 * edge1[k] - dv1 * edge2[k]);
    normalise(t->tangent);
    t->any = !(fabsf(area) > 0.0F) || !isfinite(area) || !(dot(t->tangent, t->tangent) > 0.0F);
}

/* ---- neighbours ---- */

static int compare_edges(const void *left, const void *right)
{
    const half_edge *a = left, *b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    if (a->backward != b->backward)
        return a->backward < b->backward ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static uint32_t collect_edges(work *w)
{
    uint32_t count = 0;
    for (uint32_t corner = 0; corner < w->corner_count; corner++) {
        const uint32_t from = w->welded[w->in->index[corner]], to = w->welded[w->in->index[next_corner(corner)]];
        if (w->triangles[corner / 3].degenerate)
            continue;
        const bool backward = from > to;
        w->edges[count++] = (half_edge){ backward ? to : from, backward ? from : to, backward ? 1 : 0, corner };
    }
    qsort(w->edges, count, sizeof *w->edges, compare_edges);
    return count;
}

static bool same_edge(const half_edge *a, const half_edge *b)
{
    return a->low == b->low && a->high == b->high;
}

/* Joins the triangles on both sides of each edge. Where more than two meet, they are paired in the order of the file.
 */
static void find_neighbors(work *w)
{
    const uint32_t count = collect_edges(w);
    memset(w->neighbor, 0xFF, w->corner_count * sizeof *w->neighbor);
    for (uint32_t start = 0; start < count;) {
        uint32_t middle = start, end = start;
        while (end < count && same_edge(&w->edges[start], &w->edges[end]))
            end++;
        while (middle < end && !w->edges[middle].backward)
            middle++;
        for (uint32_t k = 0; start + k < middle && middle + k < end; k++) {
            const uint32_t forward = w->edges[start + k].corner, backward = w->edges[middle + k].corner;
            w->neighbor[forward] = backward;
            w->neighbor[backward] = forward;
        }
        start = end;
    }
}

/* ---- groups ---- */

static bool has_no_group(const work *w, uint32_t number)
{
    const uint32_t *group = &w->group[3 * (size_t)number];
    return group[0] == NONE && group[1] == NONE && group[2] == NONE;
}

/* Takes a corner into the group when its triangle's orientation allows; a triangle without one takes that of its first
 * group. */
static bool join(work *w, uint32_t corner, uint32_t start)
{
    if (corner == NONE || w->group[corner] != NONE)
        return false;
    triangle *t = &w->triangles[corner / 3];
    if (t->any && has_no_group(w, corner / 3))
        t->preserving = w->triangles[start / 3].preserving;
    if (t->preserving != w->triangles[start / 3].preserving)
        return false;
    w->group[corner] = start;
    return true;
}

/* The corner at the same vertex across the edge that leaves it, and across the edge that reaches it. */
static uint32_t across_leaving_edge(const work *w, uint32_t corner)
{
    const uint32_t other = w->neighbor[corner];
    return other == NONE ? NONE : next_corner(other);
}

static uint32_t across_reaching_edge(const work *w, uint32_t corner)
{
    return w->neighbor[previous_corner(corner)];
}

static uint32_t gather_group(work *w, uint32_t start)
{
    uint32_t count = 0;
    w->group[start] = start;
    w->members[count++] = start;
    for (uint32_t corner = across_leaving_edge(w, start); join(w, corner, start);
         corner = across_leaving_edge(w, corner))
        w->members[count++] = corner;
    for (uint32_t corner = across_reaching_edge(w, start); join(w, corner, start);
         corner = across_reaching_edge(w, corner))
        w->members[count++] = corner;
    return count;
}

/* The angle at a corner between its edges, seen along the normal. */
static float corner_angle(const work *w, uint32_t corner, const float n[3])
{
    float to_next[3], to_previous[3];
    subtract(position(w, next_corner(corner)), position(w, corner), to_next);
    subtract(position(w, previous_corner(corner)), position(w, corner), to_previous);
    project(n, to_next);
    project(n, to_previous);
    return acosf(fminf(1.0F, fmaxf(-1.0F, dot(to_next, to_previous))));
}

static void group_tangent(const work *w, uint32_t count, float out[3])
{
    const float *n = normal(w, w->members[0]);
    out[0] = out[1] = out[2] = 0.0F;
    for (uint32_t i = 0; i < count; i++) {
        const triangle *t = &w->triangles[w->members[i] / 3];
        if (t->any)
            continue;
        float tangent[3];
        memcpy(tangent, t->tangent, sizeof tangent);
        project(n, tangent);
        const float angle = corner_angle(w, w->members[i], n);
        for (int k = 0; k < 3; k++)
            out[k] += angle * tangent[k];
    }
    project(n, out);
}

/* Some unit vector in the plane of n. */
static void any_tangent(const float n[3], float out[3])
{
    const int axis = fabsf(n[0]) < 0.7F ? 0 : 1;
    out[0] = axis == 0 ? 1.0F : 0.0F;
    out[1] = axis == 1 ? 1.0F : 0.0F;
    out[2] = 0.0F;
    project(n, out);
}

static void write_group(work *w, uint32_t count, float *corner_tangents)
{
    float tangent[4];
    group_tangent(w, count, tangent);
    if (!(dot(tangent, tangent) > 0.0F))
        any_tangent(normal(w, w->members[0]), tangent);
    tangent[3] = w->triangles[w->members[0] / 3].preserving ? 1.0F : -1.0F;
    for (uint32_t i = 0; i < count; i++)
        memcpy(&corner_tangents[4 * (size_t)w->members[i]], tangent, sizeof tangent);
    w->at_vertex[w->welded[w->in->index[w->members[0]]]] = w->members[0];
}

static void write_groups(work *w, float *corner_tangents)
{
    memset(w->group, 0xFF, w->corner_count * sizeof *w->group);
    memset(w->at_vertex, 0xFF, w->in->vertex_count * sizeof *w->at_vertex);
    for (uint32_t corner = 0; corner < w->corner_count; corner++) {
        const triangle *t = &w->triangles[corner / 3];
        if (!t->degenerate && !t->any && w->group[corner] == NONE)
            write_group(w, gather_group(w, corner), corner_tangents);
    }
}

/* Corners in no group take the tangent of another corner at their vertex, or any. */
static void write_rest(const work *w, float *corner_tangents)
{
    for (uint32_t corner = 0; corner < w->corner_count; corner++) {
        if (w->group[corner] != NONE)
            continue;
        float *out = &corner_tangents[4 * (size_t)corner];
        const uint32_t other = w->at_vertex[w->welded[w->in->index[corner]]];
        if (other != NONE) {
            memcpy(out, &corner_tangents[4 * (size_t)other], 4 * sizeof(float));
        } else {
            any_tangent(normal(w, corner), out);
            out[3] = 1.0F;
        }
    }
}

static bool allocate(work *w)
{
    const size_t vertices = w->in->vertex_count, corners = w->corner_count;
    w->keys = malloc(vertices * sizeof *w->keys);
    w->welded = malloc(vertices * sizeof *w->welded);
    w->at_vertex = malloc(vertices * sizeof *w->at_vertex);
    w->triangles = calloc(corners / 3, sizeof *w->triangles);
    w->edges = malloc(corners * sizeof *w->edges);
    w->neighbor = malloc(corners * sizeof *w->neighbor);
    w->group = malloc(corners * sizeof *w->group);
    w->members = malloc(corners * sizeof *w->members);
    return w->keys && w->welded && w->at_vertex && w->triangles && w->edges && w->neighbor && w->group && w->members;
}

static void release(work *w)
{
    free(w->keys);
    free(w->welded);
    free(w->at_vertex);
    free(w->triangles);
    free(w->edges);
    free(w->neighbor);
    free(w->group);
    free(w->members);
}

bool tangent_space_compute(const tangent_space_input *in, float *corner_tangents)
{
    if (in->triangle_count == 0)
        return true;
    work w = { .in = in, .corner_count = 3 * in->triangle_count };
    const bool allocated = allocate(&w);
    if (allocated) {
        weld(&w);
        for (uint32_t i = 0; i < in->triangle_count; i++)
            measure(&w, i);
        find_neighbors(&w);
        write_groups(&w, corner_tangents);
        write_rest(&w, corner_tangents);
    }
    release(&w);
    return allocated;
}
