/* The cone of directions over an ellipse, in the frame of its own axes, cut at the horizon. */
#ifndef LIGHT_CONIC_H
#define LIGHT_CONIC_H

#include "math/vec3d.h"

enum { CONIC_ARCS = 4 };

/* Its rim is axis_z + a cos t axis_x + b sin t axis_y. */
typedef struct conic {
    vec3d axis_x, axis_y, axis_z;   /* orthonormal */
    double a, b;                    /* a >= b > 0: tangents of the half angles */
    int is_cut;                     /* by the horizon: the rim is one arc, closed by a straight line */
    double node[CONIC_ARCS + 1][2]; /* cos t and sin t of the ends of the arcs above the horizon, counter-clockwise */
} conic;

/* The cone over center + x half_x + y half_y, x^2 + y^2 <= 1. 0: it has no inside. */
int conic_make(conic *c, vec3d center, vec3d half_x, vec3d half_y);

/* Finds the part above the plane z = 0. 0: there is none. */
int conic_cut(conic *c);

/* Integral of the direction over the part above the horizon. */
vec3d conic_moment(const conic *c);

#endif
