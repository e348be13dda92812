/* A mesh of one polygon a flake: triangles cut along the grid of flakes, each piece tilted about its middle. */
#include "exporters/povray/flake.h"
#include "exporters/povray/povray.h"

enum { MOST_FLAKES = 250000, MOST_CORNERS = 8 };

/* A corner of a triangle or of a piece: where it is in the grid, in flakes, and in the world, in metres. */
typedef struct corner {
    double u, v;
    vec at, normal;
} corner;

typedef struct piece {
    corner corners[MOST_CORNERS];
    int count;
} piece;

typedef struct cutter {
    const povray *p;
    const scene_instance *instance;
    const scene_mesh *mesh;
    flake_law law;
    uint32_t seed;
    double flakes_u, flakes_v; /* per metre */
    bool tinted;
    text vertices, faces;
    text tints, tint_faces; /* one a piece, as its uv vector */
    uint32_t vertex_count, piece_count, face_count;
} cutter;

static corner between(const corner *a, const corner *b, double t)
{
    const double s = 1.0 - t;
    return (corner){ s * a->u + t * b->u, s * a->v + t * b->v, vec_add(vec_scale(a->at, s), vec_scale(b->at, t)),
                     vec_add(vec_scale(a->normal, s), vec_scale(b->normal, t)) };
}

/* Sutherland and Hodgman: keeps the side where sign * (coordinate - edge) >= 0. */
static piece cut(const piece *from, bool along_u, double edge, double sign)
{
    piece out = { .count = 0 };
    for (int i = 0; i < from->count; ++i) {
        const corner *a = &from->corners[i], *b = &from->corners[(i + 1) % from->count];
        const double da = sign * ((along_u ? a->u : a->v) - edge), db = sign * ((along_u ? b->u : b->v) - edge);
        if (da >= 0.0 && out.count < MOST_CORNERS)
            out.corners[out.count++] = *a;
        if ((da < 0.0) != (db < 0.0) && da != 0.0 && db != 0.0 && out.count < MOST_CORNERS)
            out.corners[out.count++] = between(a, b, da / (da - db));
    }
    return out;
}

static piece cut_cell(const piece *from, bool along_u, double low)
{
    const piece above = cut(from, along_u, low, 1.0);
    return cut(&above, along_u, low + 1.0, -1.0);
}

/* u and v of a corner in metres: texture coordinates, or the two axes that the triangle faces least. */
static void place(const cutter *c, const uint32_t index[3], corner out[3])
{
    const scene_glint *g = &c->p->scene->materials[c->mesh->material].glint;
    const float *m = c->instance->to_world;
    const float *uv = g->space == SCENE_SPACE_UV ? c->mesh->texcoord[g->texcoord] : NULL;
    vec object[3];
    for (int k = 0; k < 3; ++k) {
        const vec local = vec_of(&c->mesh->position[3 * (size_t)index[k]]);
        out[k].at = matrix_point(m, local);
        out[k].normal = matrix_normal(m, vec_of(&c->mesh->normal[3 * (size_t)index[k]]));
        object[k] = (vec){ local.x * vec_length(matrix_column(m, 0)), local.y * vec_length(matrix_column(m, 1)),
                           local.z * vec_length(matrix_column(m, 2)) };
    }
    const vec n = vec_cross(vec_sub(object[1], object[0]), vec_sub(object[2], object[0]));
    const int plane = fabs(n.x) >= fabs(n.y) && fabs(n.x) >= fabs(n.z) ? 0 : fabs(n.y) >= fabs(n.z) ? 1 : 2;
    for (int k = 0; k < 3; ++k) {
        const double axes[3] = { object[k].x, object[k].y, object[k].z };
        const float *t = uv ? &uv[2 * (size_t)index[k]] : NULL;
        out[k].u = (t ? (double)t[0] * (double)g->uv_scale : axes[(plane + 1) % 3]) * c->flakes_u;
        out[k].v = (t ? (double)t[1] * (double)g->uv_scale : axes[(plane + 2) % 3]) * c->flakes_v;
    }
}

/* The direction in the world in which u grows, of any length; zero where the triangle has no such direction. */
static vec along_u(const corner t[3])
{
    const double v1 = t[1].v - t[0].v, v2 = t[2].v - t[0].v;
    const double determinant = (t[1].u - t[0].u) * v2 - (t[2].u - t[0].u) * v1;
    const vec d = vec_sub(vec_scale(vec_sub(t[1].at, t[0].at), v2), vec_scale(vec_sub(t[2].at, t[0].at), v1));
    return vec_scale(d, determinant < 0.0 ? -1.0 : 1.0);
}

static void write_face(cutter *c, uint32_t first, uint32_t last)
{
    text_print(&c->faces, ",\n  <%u, %u, %u>", first, first + last - 1U, first + last);
    if (c->tinted)
        text_print(&c->tint_faces, ",\n  <%u, %u, %u>", c->piece_count, c->piece_count, c->piece_count);
}

/* Turns a piece about its middle so that the surface's normal becomes the flake's. */
static void write_piece(cutter *c, const piece *q, vec x_axis, double y_sign, int64_t x, int64_t y)
{
    double slopes[2];
    flake_slopes(&c->law, x, y, c->seed, slopes);
    vec n = { 0 }, middle = { 0 };
    for (int i = 0; i < q->count; ++i) {
        n = vec_add(n, q->corners[i].normal);
        middle = vec_add(middle, vec_scale(q->corners[i].at, 1.0 / q->count));
    }
    n = vec_unit(n);
    const vec t = vec_unit(vec_sub(x_axis, vec_scale(n, vec_dot(x_axis, n))));
    const vec b = vec_scale(vec_cross(n, t), y_sign);
    const vec m = vec_unit(vec_add(n, vec_add(vec_scale(t, slopes[0]), vec_scale(b, slopes[1]))));
    const vec turned_t = vec_unit(vec_sub(t, vec_scale(m, vec_dot(t, m))));
    const vec turned_b = vec_scale(vec_cross(m, turned_t), y_sign);
    const uint32_t first = c->vertex_count;
    for (int i = 0; i < q->count; ++i, ++c->vertex_count) {
        const vec d = vec_sub(q->corners[i].at, middle);
        const vec turned = vec_add(vec_scale(turned_t, vec_dot(d, t)),
                                   vec_add(vec_scale(turned_b, vec_dot(d, b)), vec_scale(m, vec_dot(d, n))));
        text_print(&c->vertices, ",\n  ");
        text_vector(&c->vertices, vec_scale(vec_add(middle, turned), c->p->unit));
    }
    for (int i = 2; i < q->count; ++i, ++c->face_count)
        write_face(c, first, (uint32_t)i);
    if (c->tinted)
        text_print(&c->tints, ",\n  <%.9g, 0>", flake_tint(x, y, c->seed));
    ++c->piece_count;
}

static double lowest(const corner t[3], bool u)
{
    return u ? fmin(t[0].u, fmin(t[1].u, t[2].u)) : fmin(t[0].v, fmin(t[1].v, t[2].v));
}

static double highest(const corner t[3], bool u)
{
    return u ? fmax(t[0].u, fmax(t[1].u, t[2].u)) : fmax(t[0].v, fmax(t[1].v, t[2].v));
}

/* Rows first, so that a long thin triangle costs its own cells and not those of its box. */
static void cut_triangle(cutter *c, const corner t[3])
{
    const vec x_axis = along_u(t);
    const vec face = vec_cross(vec_sub(t[1].at, t[0].at), vec_sub(t[2].at, t[0].at));
    const double turn = (t[1].u - t[0].u) * (t[2].v - t[0].v) - (t[2].u - t[0].u) * (t[1].v - t[0].v);
    const double y_sign = (turn < 0.0) != (vec_dot(face, t[0].normal) < 0.0) ? -1.0 : 1.0;
    const piece whole = { { t[0], t[1], t[2] }, 3 };
    for (double y = floor(lowest(t, false)); y < highest(t, false); y += 1.0) {
        const piece row = cut_cell(&whole, false, y);
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int i = 0; i < row.count; ++i) {
            low = fmin(low, row.corners[i].u);
            high = fmax(high, row.corners[i].u);
        }
        for (double x = floor(low); x < high; x += 1.0) {
            const piece cell = cut_cell(&row, true, x);
            if (cell.count >= 3)
                write_piece(c, &cell, x_axis, y_sign, (int64_t)x, (int64_t)y);
        }
    }
}

/* Cells that a triangle may touch: its area, and one more row and column along its sides. */
static double cells_of(const corner t[3])
{
    const double area = 0.5 * fabs((t[1].u - t[0].u) * (t[2].v - t[0].v) - (t[2].u - t[0].u) * (t[1].v - t[0].v));
    return area + 2.0 * (highest(t, true) - lowest(t, true) + highest(t, false) - lowest(t, false)) + 1.0;
}

static double count_cells(const cutter *c)
{
    double count = 0.0;
    for (uint32_t i = 0; i < c->mesh->triangle_count; ++i) {
        corner t[3];
        place(c, &c->mesh->index[3 * (size_t)i], t);
        count += cells_of(t);
    }
    return count;
}

static void write_list(text *out, const char *what, uint32_t count, const text *list)
{
    text_print(out, "  %s {\n  %u", what, count);
    if (list->failed)
        out->failed = true;
    else if (list->length > 0)
        text_add(out, list->bytes, list->length);
    text_print(out, "\n  }\n");
}

bool flake_mesh_write(const povray *p, const scene_instance *instance, uint32_t seed, text *out, double *count)
{
    const scene_mesh *mesh = &p->scene->meshes[instance->mesh];
    const material_look look = material_look_of(p, mesh->material);
    const double stretch = sqrt((double)look.material->glint.elongation);
    const scene_glint *g = &look.material->glint;
    cutter c = { .p = p, .instance = instance, .mesh = mesh, .seed = seed };
    c.tinted = g->color_variation > 0.0F || g->color_count > 0;
    c.law = flake_law_of(look.material->glint.distribution, (double)look.surface.alpha_x, (double)look.surface.alpha_y);
    c.flakes_u = 1.0 / ((double)look.edge_m * stretch);
    c.flakes_v = stretch / (double)look.edge_m;
    *count = count_cells(&c);
    if (!(*count <= MOST_FLAKES))
        return false;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        corner t[3];
        place(&c, &mesh->index[3 * (size_t)i], t);
        cut_triangle(&c, t);
    }
    text_print(out, "#declare Object_%d_Flakes = mesh2 {\n", (int)(instance - p->scene->instances));
    write_list(out, "vertex_vectors", c.vertex_count, &c.vertices);
    if (c.tinted)
        write_list(out, "uv_vectors", c.piece_count, &c.tints);
    write_list(out, "face_indices", c.face_count, &c.faces);
    if (c.tinted)
        write_list(out, "uv_indices", c.face_count, &c.tint_faces);
    text_print(out, "}\n");
    text_free(&c.vertices);
    text_free(&c.tints);
    text_free(&c.faces);
    text_free(&c.tint_faces);
    return true;
}
