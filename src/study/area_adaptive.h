/* The truth about a light of real size: what brute force (area_truth.h) adds up on a grid, here by adaptive cubature
 * over the directions that the light fills, with an error of its own.
 *
 * Written without the library: no points, boundaries or slopes of its integrals. A light is a convex set of directions
 * between planes or within a cone, and the horizon. From a point of it, the mirrored view where the light holds that,
 * it reaches so far in every azimuth; over azimuths and angles from the point the integrand has no edge.
 */
#ifndef STUDY_AREA_ADAPTIVE_H
#define STUDY_AREA_ADAPTIVE_H

#include "area_truth.h"

/* Until specular light and facets are known to the tolerance; error: what they are known to, relative. Flat lights
 * shine to both sides, as for brute force; a sun fills half of all directions at most. */
area_truth area_adaptive_of(const area_truth_lobe *lobe, const float wo[3], const glint_area_light *light,
                            double tolerance, double *error);

/* D_H, the area of all facets over that of the surface: facets over it is the chance that one is lit. */
double area_adaptive_total(const area_truth_lobe *lobe);

#endif
