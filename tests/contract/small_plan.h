/* The smallest scene that can be planned: one material under one light. */
#ifndef TESTS_SMALL_PLAN_H
#define TESTS_SMALL_PLAN_H

#include "glint.h"

typedef struct small_scene {
    glint_material_options options;
    glint_plan_material material;
    glint_plan_light light;
    glint_plan_pair pair;
    glint_plan_summary summary;
} small_scene;

/* N p facets lit in every pixel, and a budget of 0.02. The scene points into itself. */
void small_plan_fill(small_scene *s, float lit_facets, uint32_t samples);

/* Fails the test where there is none. */
glint_plan *small_plan_of(const small_scene *s);
/* The first decision about an effect. */
const glint_decision *small_plan_find(const glint_plan *plan, glint_effect effect);

#endif
