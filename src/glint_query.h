/* What a call of evaluation brings, checked, so that models can trust it. */
#ifndef GLINT_QUERY_H
#define GLINT_QUERY_H

#include "math/effects.h"
#include "math/float_bits.h"
#include "model/model.h"

/* What a query points to once it has been checked. */
typedef struct checked {
    glint_surface surface;
    glint_coat coat;
} checked;

/* Interpolated directions are a little off; anything further off is a mistake and gives zero. */
#define MOST_COMPONENT 1.01F
#define MOST_OFF 0.02F /* of the square of the length, from one */

/* Lengths of a footprint's sides and its place, m. */
#define MOST_SIDE 1e6F
#define MOST_PLACE 1e12

static inline int is_unit(vec3 v)
{
    return is_below(v.x, MOST_COMPONENT) && is_below(v.y, MOST_COMPONENT) && is_below(v.z, MOST_COMPONENT) &&
           is_below(vec3_dot(v, v) - 1.0F, MOST_OFF);
}

static inline int is_usable(const glint_footprint *f)
{
    return is_below(f->dudx, MOST_SIDE) && is_below(f->dudy, MOST_SIDE) && is_below(f->dvdx, MOST_SIDE) &&
           is_below(f->dvdy, MOST_SIDE) && is_below_d(f->u, MOST_PLACE) && is_below_d(f->v, MOST_PLACE);
}

static inline float query_solid_angle(float sr)
{
    return clamp_to(sr, 0.0F, 6.28318531F);
}

/* A layered material has no horizon of its own. */
static inline int query_has_horizon(const glint_material *material)
{
    return !LIBRARY_LAYERS || !material->base;
}

/* Fills all of *q but directions and light. False: the coat has no direction. */
int query_fill(model_query *q, checked *c, const glint_material *material, const glint_surface *surface,
               const glint_footprint *footprint);

/* The same and wo. False: there is nothing to see from there. */
int query_begin(model_query *q, checked *c, const glint_material *material, const glint_surface *surface,
                const glint_footprint *footprint, const float wo[3]);

/* The light's side. False: wi is not lit. */
int query_light(model_query *q, const float wi[3], float solid_angle_sr);

/* What goes out: models' own sums may round below zero, or overflow. */
static inline float value_finite(float x)
{
    return clamp_to(x, 0.0F, 3e38F);
}

void value_make_finite(glint_value *value);

#endif
