/* Many lights as a binary tree whose nodes bound what their lights can bring to a point. */
#ifndef PREVIEW_LIGHT_TREE_H
#define PREVIEW_LIGHT_TREE_H

#include "preview/light.h"
#include "scene/report.h"

/* Lights first to first + count - 1 of the tree's order. Directional lights have nodes of their own, with directions
 * in the place of positions. */
typedef struct light_node {
    vec3 middle, half;         /* a box around the lights, shapes included */
    vec3 axis;                 /* unit: every light shines only where the direction to it lies in a cone around this */
    double cone_cos, cone_sin; /* of the cone's half angle, which is at most pi */
    double reach;              /* the largest radius of its bulbs; of directional lights, the sine of it */
    double range;              /* metres, beyond which none of them shines */
    double power;              /* what they send, all together, per steradian; directional: their irradiance */
    int first, count;
    int children; /* the first of two that are neighbours; 0: one light */
    bool is_distant;
} light_node;

typedef struct light_tree {
    light_node *nodes; /* the roots first */
    int root_count;    /* 2 where some lights are directional and some are not; 0: all are black */
    int *order;
    double *power_before; /* of a place in the order: the sum of what comes before it; one entry more than lights */
    int light_count;
} light_tree;

bool light_tree_make(const light *lights, int count, light_tree *out, report *r);
void light_tree_free(light_tree *t);

#endif
