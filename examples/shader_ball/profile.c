/* Samples the lines and arcs of a profile. */
#include "profile.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static profile_part *append_part(profile *p, size_t count)
{
    if (p->count == PROFILE_PART_LIMIT) {
        fprintf(stderr, "make_shader_ball: a profile has more than %d parts\n", PROFILE_PART_LIMIT);
        exit(1);
    }
    profile_part *part = &p->parts[p->count++];
    part->count = count;
    part->points = calloc(count, sizeof *part->points);
    if (!part->points) {
        fprintf(stderr, "make_shader_ball: no memory for %zu points\n", count);
        exit(1);
    }
    return part;
}

void profile_line(profile *p, double from_out, double from_up, double to_out, double to_up, double step)
{
    const double out = to_out - from_out, up = to_up - from_up;
    const double length = hypot(out, up);
    const size_t rows = (size_t)ceil(length / step);
    const profile_part *part = append_part(p, rows + 1);
    for (size_t i = 0; i <= rows; i++) {
        const double t = (double)i / (double)rows;
        part->points[i] =
            (profile_point){ from_out + t * out, from_up + t * up, -up / length, out / length, p->length + t * length };
    }
    p->length += length;
}

void profile_arc(profile *p, double center_out, double center_up, double radius, double from_rad, double to_rad,
                 double step_rad)
{
    const double turn = to_rad - from_rad, side = turn < 0.0 ? -1.0 : 1.0;
    const size_t rows = (size_t)ceil(fabs(turn) / step_rad);
    const profile_part *part = append_part(p, rows + 1);
    for (size_t i = 0; i <= rows; i++) {
        const double t = (double)i / (double)rows, angle = from_rad + t * turn;
        part->points[i] = (profile_point){ center_out + radius * sin(angle), center_up + radius * cos(angle),
                                           side * sin(angle), side * cos(angle), p->length + t * radius * fabs(turn) };
    }
    p->length += radius * fabs(turn);
}

void profile_free(profile *p)
{
    for (size_t i = 0; i < p->count; i++)
        free(p->parts[i].points);
    *p = (profile){ 0 };
}
