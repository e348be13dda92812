/* A summary of one material under one light, and what is decided about it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "small_plan.h"

void small_plan_fill(small_scene *s, float lit_facets, uint32_t samples)
{
    s->options = (glint_material_options)GLINT_MATERIAL_OPTIONS_INIT;
    s->material = (glint_plan_material){ .name = "flakes", .base = &s->options, .seen = 1.0F };
    s->light = (glint_plan_light){ .name = "the lamp", .shadow_rays = 400, .blocked_rays = 30 };
    s->pair = (glint_plan_pair){ .seen = 1.0F, .shadow_rays = 1.0F };
    s->pair.share[glint_plan_bin(lit_facets)] = 1.0F;
    s->pair.rate[glint_plan_bin(lit_facets)] = 1.0F;
    s->summary = (glint_plan_summary)GLINT_PLAN_SUMMARY_INIT;
    s->summary.materials = &s->material;
    s->summary.lights = &s->light;
    s->summary.pairs = &s->pair;
    s->summary.material_count = s->summary.light_count = s->summary.pair_count = 1;
    s->summary.samples_per_pixel = samples;
    s->summary.pixel_count = 400;
}

glint_plan *small_plan_of(const small_scene *s)
{
    glint_plan *plan;
    char message[256];
    if (glint_plan_create(&s->summary, &plan, message, sizeof message) != GLINT_OK)
        fail_msg("%s", message);
    return plan;
}

const glint_decision *small_plan_find(const glint_plan *plan, glint_effect effect)
{
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); i++)
        if (glint_plan_decision(plan, i)->effect == effect)
            return glint_plan_decision(plan, i);
    fail_msg("no decision about %s", glint_effect_name(effect));
    return NULL;
}
