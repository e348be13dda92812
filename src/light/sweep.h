/* Integrals over a light of a density that is a stretched GGX or Gaussian lobe times something smooth: by the light's
 * boundary alone.
 *
 * A direction w becomes the slope (X, Y) / Z of map (w + offset). In these slopes the lobe is round and of width one,
 * and u = 1 - v^2 (GGX: v = Z / |(X, Y, Z)|; Gaussian: v = exp(-slope^2 / 2)) is its distribution function: with the
 * azimuth t of (X, Y) an area element of the lobe is du dt / (2 pi). By Green's theorem the integral of a smooth g over
 * the light is the integral along its boundary of dt * (integral of g v dv from v to v0) / pi, where v0 is 1 for a
 * light around the lobe's peak, and anything constant for another. However sharp the lobe, what is left to integrate is
 * smooth, except where the boundary passes the peak: there the boundary is divided until the angles add up.
 */
#ifndef LIGHT_SWEEP_H
#define LIGHT_SWEEP_H

#include "light/area.h"

typedef struct sweep_map {
    vec3d row[3]; /* X, Y and Z of a direction */
    vec3d offset; /* added to the unit direction first */
    int is_gaussian;
} sweep_map;

/* One node of the quadrature along the boundary. */
typedef struct sweep_node {
    double cosine, sine; /* of the azimuth */
    double v;            /* in [0, 1] */
    double turn;         /* dt times the node's weight */
    double twist;        /* (h x h').z / |h|^2, h = w + offset, times the weight: twice the area of h seen from above */
} sweep_node;

/* v of one direction, of any length. */
double sweep_level(const sweep_map *map, vec3d direction);

/* Calls visit for every node. The sense of rotation is the light's own: take sums by their size. */
void sweep_each(const area_light *light, const sweep_map *map, void (*visit)(const sweep_node *node, void *user),
                void *user);

/* Mass of the lobe itself over the light, in [0, 1]; peak: the direction where it is greatest. */
double sweep_mass(const area_light *light, const sweep_map *map, vec3d peak);

#endif
