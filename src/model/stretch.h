/* Elongated facets: the surface is shrunk along the tangent and stretched across it, so that area and density stay. */
#ifndef MODEL_STRETCH_H
#define MODEL_STRETCH_H

#include "glint.h"
#include "math/vec3.h"

/* The footprint on the surface where facets are as long as wide. elongation >= 1, length over width. */
static inline glint_footprint stretch_footprint(const glint_footprint *f, float elongation)
{
    const float stretch = sqrtf(elongation), shrink = 1.0F / stretch;
    return (glint_footprint){ f->u * (double)shrink, f->v * (double)stretch, f->dudx * shrink, f->dudy * shrink,
                              f->dvdx * stretch,     f->dvdy * stretch,      f->seed,          f->draw };
}

#endif
