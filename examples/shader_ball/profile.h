/* A profile: lines and circular arcs in a plane, sampled to points with exact normals and arc lengths.
 *
 * The plane has an outward axis (out) and an upward axis (up), both in metres. Walking along the profile, the surface
 * faces to the left: the direction (0, -1) has the normal (1, 0).
 */
#ifndef SHADER_BALL_PROFILE_H
#define SHADER_BALL_PROFILE_H

#include <stddef.h>

typedef struct profile_point {
    double out, up;
    double normal_out, normal_up; /* unit */
    double length;                /* metres along the profile, from its start */
} profile_point;

/* One smooth part of a profile. Parts meet in an edge unless their normals agree there. */
typedef struct profile_part {
    profile_point *points;
    size_t count;
} profile_part;

enum { PROFILE_PART_LIMIT = 16 };

typedef struct profile {
    profile_part parts[PROFILE_PART_LIMIT];
    size_t count;
    double length;
} profile;

/* Appends a straight line. Rows of points lie at most step metres apart. */
void profile_line(profile *p, double from_out, double from_up, double to_out, double to_up, double step);

/* Appends an arc. Angles are radians from the upward axis towards the outward one; an angle that falls makes a hollow.
 * Rows of points lie at most step_rad apart. */
void profile_arc(profile *p, double center_out, double center_up, double radius, double from_rad, double to_rad,
                 double step_rad);

void profile_free(profile *p);

#endif
