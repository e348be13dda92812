/* One facet of the explicit surface under a light of real size. */
#ifndef MODEL_EXPLICIT_AREA_H
#define MODEL_EXPLICIT_AREA_H

#include "light/area.h"
#include "model/model.h"

/* What one facet with normal h sends to the viewer of a light of radiance one, times the surface's area over the
 * facet's: F G2 (h.wo) / cos_o where its mirrored view lies in the light. Of a rough facet: the part of its lobe that
 * lies there. Without coverage. */
void explicit_area_facet(const model_query *q, const area_light *light, vec3 h, float rgb[3]);

#endif
