/* Ways to integrate over a rectangle of real size, from a point in its middle to hundreds at random. */
#ifndef STUDY_WAYS_H
#define STUDY_WAYS_H

#include "study/area_cases.h"

typedef enum integral_way {
    WAY_POINT,
    WAY_CAP,
    WAY_FAST,
    WAY_EXACT,
    WAY_GAUSS_2,
    WAY_GAUSS_4,
    WAY_GAUSS_8,
    WAY_GAUSS_16,
    WAY_RANDOM_4,
    WAY_RANDOM_16,
    WAY_RANDOM_64,
    WAY_RANDOM_256,
    WAYS
} integral_way;

extern const char *const way_names[WAYS];

/* m: of the fast integral and of the exact one, both without facets. */
double way_integrate(integral_way w, const glint_material *const m[2], const glint_surface *s, const area_case *c,
                     uint64_t *random);

#endif
