/* A light of real size for a model that knows only single directions: points of the light, and directions of the model,
 * weighted by multiple importance. */
#ifndef MODEL_AREA_POINTS_H
#define MODEL_AREA_POINTS_H

#include "model/model.h"

/* Fills value->rgb and value->smooth with the integral over q->area_light of the model's own eval, with the solid angle
 * of a light's share for each point, and the facets' number and probability of the whole light. */
void area_points_eval(const model_query *q, glint_value *value);

#endif
