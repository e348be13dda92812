/* Builds rows of vertices along a profile and joins neighbouring rows with triangles that face outwards. */
#include "solid.h"

#include <math.h>
#include <stdbool.h>

static const double pi = 3.14159265358979323846;

/* Within a chart the radius varies by this factor at most; its middle, in ratio, sets the scale: sqrt(1.25) = 1.12. */
static const double chart_radius_ratio = 1.25;
/* Around a pole the radius goes to zero and no ratio holds: there one chart reaches to this radius, in metres. */
static const double pole_chart_radius_m = 0.002;

/* Joins two rows of segments + 1 vertices. Where the upper row is a pole its edges have no length: one triangle each.
 */
static void join_rows(glb_mesh *mesh, uint32_t upper, uint32_t lower, int segments, bool upper_is_pole,
                      bool lower_is_pole)
{
    for (uint32_t i = 0; i < (uint32_t)segments; i++) {
        if (!upper_is_pole)
            glb_add_triangle(mesh, upper + i, lower + i, upper + i + 1);
        if (!lower_is_pole)
            glb_add_triangle(mesh, upper + i + 1, lower + i, lower + i + 1);
    }
}

static bool is_pole(const profile_point *point)
{
    return point->out < 1e-9;
}

/* The points [first, returned value) share a chart; the last of them is the first of the next one. */
static size_t chart_end(const profile_part *part, size_t first, double *radius)
{
    double low = part->points[first].out, high = low;
    size_t end = first + 1;
    for (; end < part->count; end++) {
        const double r = part->points[end].out;
        const double new_low = fmin(low, r), new_high = fmax(high, r);
        const bool fits = new_high <= pole_chart_radius_m || new_high <= chart_radius_ratio * new_low;
        if (!fits && end > first + 1)
            break;
        low = new_low;
        high = new_high;
    }
    *radius = low > 0.0 ? sqrt(low * high) : 0.5 * high;
    return end;
}

static void turn_point(glb_mesh *mesh, const profile_point *point, double chart_radius, int segments)
{
    for (int i = 0; i <= segments; i++) {
        const double angle = pi * (2.0 * i / segments - 1.0), s = sin(angle), c = cos(angle);
        const glb_vertex vertex = {
            .position = { (float)(point->out * s), (float)point->up, (float)(point->out * c) },
            .normal = { (float)(point->normal_out * s), (float)point->normal_up, (float)(point->normal_out * c) },
            .tangent = { (float)c, 0.0F, (float)-s, 1.0F },
            .texcoord = { (float)(angle * chart_radius), (float)point->length },
        };
        glb_add_vertex(mesh, &vertex);
    }
}

void solid_turn(glb_mesh *mesh, const profile *p, int segments)
{
    const uint32_t row = (uint32_t)segments + 1;
    for (size_t k = 0; k < p->count; k++) {
        const profile_part *part = &p->parts[k];
        for (size_t first = 0; first + 1 < part->count;) {
            double radius;
            const size_t end = chart_end(part, first, &radius);
            for (size_t i = first; i < end; i++) {
                turn_point(mesh, &part->points[i], radius, segments);
                if (i > first)
                    join_rows(mesh, mesh->vertex_count - 2 * row, mesh->vertex_count - row, segments,
                              is_pole(&part->points[i - 1]), is_pole(&part->points[i]));
            }
            first = end - 1;
        }
    }
}

static void draw_out_point(glb_mesh *mesh, const profile_point *point, double half_width, int segments)
{
    for (int i = 0; i <= segments; i++) {
        const double x = half_width * (2.0 * i / segments - 1.0);
        const glb_vertex vertex = {
            .position = { (float)x, (float)point->up, (float)point->out },
            .normal = { 0.0F, (float)point->normal_up, (float)point->normal_out },
            .tangent = { 1.0F, 0.0F, 0.0F, 1.0F },
            .texcoord = { (float)x, (float)point->length },
        };
        glb_add_vertex(mesh, &vertex);
    }
}

void solid_draw_out(glb_mesh *mesh, const profile *p, double half_width, int segments)
{
    const uint32_t row = (uint32_t)segments + 1;
    for (size_t k = 0; k < p->count; k++) {
        for (size_t i = 0; i < p->parts[k].count; i++) {
            draw_out_point(mesh, &p->parts[k].points[i], half_width, segments);
            if (i > 0)
                join_rows(mesh, mesh->vertex_count - 2 * row, mesh->vertex_count - row, segments, false, false);
        }
    }
}
