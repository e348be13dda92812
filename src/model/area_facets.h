/* What a light of real size makes of the facets: two ways to integrate it, one exact and one fast. */
#ifndef MODEL_AREA_FACETS_H
#define MODEL_AREA_FACETS_H

#include "light/area.h"
#include "model/model.h"

typedef struct area_facets {
    double specular[3]; /* integral of F G2 D / (4 cos_o) over the light, without coverage */
    double facets;      /* integral of D over the half vectors that lie in the light */
    double projected;   /* of D (n.h) */
    double x, y;        /* of D h */
    double cap;         /* area of these half vectors, seen from above */
} area_facets;

/* Adaptive quadrature; docs/lights.md states its error. */
void area_facets_exact(const model_query *q, const area_light *light, area_facets *value);

/* Linearly transformed cosines. For round roughness only. */
void area_facets_fast(const model_query *q, const area_light *light, area_facets *value);

#endif
