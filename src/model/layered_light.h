/* A light of real size as the coat of a layered material sees it: turned into the frame of the coat. */
#ifndef MODEL_LAYERED_LIGHT_H
#define MODEL_LAYERED_LIGHT_H

#include "model/model.h"

/* The axes of the coat in the frame that the light is given in. */
typedef struct coat_frame {
    vec3 x, y, z;
} coat_frame;

static inline vec3 coat_frame_in(const coat_frame *f, vec3 v)
{
    return (vec3){ vec3_dot(v, f->x), vec3_dot(v, f->y), vec3_dot(v, f->z) };
}

/* The same light in the frame of the coat. 0: it has numbers that are none, and nothing is seen of it. */
int coat_light_turn(const coat_frame *f, const glint_area_light *from, glint_area_light *to);

enum { COAT_LIGHT_POINTS = GLINT_MAX_CORNERS + 1 };

/* Cosines with the coat's normal of a few points of a turned light: its middle and points all around its rim. Returns
 * how many. */
int coat_light_cosines(const glint_area_light *light, float cosine[COAT_LIGHT_POINTS]);

#endif
