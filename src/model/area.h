/* The smooth reflection of a light of real size, and the chance that a facet reflects it to the viewer.
 *
 * Kneiphof and Klein 2024, Eqs. 3, 12 and 13: the integrals of the lobe and of the facets' distribution over the light.
 */
#ifndef MODEL_AREA_H
#define MODEL_AREA_H

#include "light/area.h"
#include "model/model.h"

typedef struct area_value {
    float specular[3], diffuse[3]; /* integrals of f cos theta_i over the visible part of the light */
    float lit_probability;         /* p, in [0, 1] */
    vec3 h;                        /* mean of the half vectors that lie in the light, by facets */
    float cap;                     /* area of all of these half vectors, seen from above */
} area_value;

/* The light as the point of the query sees it. 0: it sees nothing of it. */
int area_see(const model_query *q, area_light *light);

/* The same light in the frame with these orthonormal axes, for a layer with a normal of its own. */
glint_area_light area_turn(const glint_area_light *from, vec3 x, vec3 y, vec3 z);

/* All zero where the point sees nothing of the light. */
void area_eval(const model_query *q, area_value *value);

/* The same by three methods: few points of a light over which the lobe hardly bends (area_plain.h); points of its parts
 * (area_cells.h); and one for any light. Each returns the share of the result that has to come from those after it. */
float area_eval_plain(const model_query *q, area_value *value);
float area_eval_parts(const model_query *q, const area_light *light, area_value *value);
void area_eval_any(const model_query *q, area_value *value);
void area_mix(area_value *value, const area_value *other, float share);

#endif
