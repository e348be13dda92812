/* The material of a random light's case. */
#ifndef TESTS_AREA_MATERIAL_H
#define TESTS_AREA_MATERIAL_H

#include "configurations.h"

#include "area_cases.h"

static inline glint_material *material_of(const area_case *c, glint_model model, glint_area_light_method method)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = (float)c->lobe.alpha_x;
    o.surface.alpha_y = (float)c->lobe.alpha_y;
    o.area_light_method = method;
    return create(&o);
}

#endif
