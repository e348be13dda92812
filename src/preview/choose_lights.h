/* A few lights that stand for many at a point. */
#ifndef PREVIEW_CHOOSE_LIGHTS_H
#define PREVIEW_CHOOSE_LIGHTS_H

#include "preview/light_tree.h"
#include "preview/sampler.h"
#include "preview/shade.h"

/* So many lights a point are evaluated one by one; of more, so many are chosen. */
#define MOST_LIGHTS 16

typedef struct chosen_light {
    int index;
    float probability; /* (0, 1], with which it was chosen. Its light over this has the mean of the light itself */
} chosen_light;

/* At most MOST_LIGHTS, none twice. A light that is never chosen does not light the point. dimension: the first of
 * MOST_LIGHTS / 2 of the sampler's that are free. */
int lights_choose(const light_tree *t, const shade_point *p, vec3 position, const sampler *random, uint32_t dimension,
                  chosen_light chosen[MOST_LIGHTS]);

#endif
