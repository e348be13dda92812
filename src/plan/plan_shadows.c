/* Which shadows are traced: all but those that cannot be.
 *
 * A survey cannot tell that there are none: a shadow that it has missed would make a dark pixel brighter by any factor.
 * The shape of a scene can: where nothing fits between a material and a light, no ray has to say so, and the picture
 * does not change.
 */
#include "plan/plan.h"

static void leave_out(glint_plan *p, const glint_plan_pair *pair)
{
    const glint_decision d = {
        GLINT_EFFECT_SHADOWS, (int32_t)pair->material, (int32_t)pair->light, 0, "none", "", 0.0F, 0.0F, 0.0F
    };
    plan_decide(p, d, "nothing can come between it and %s", plan_light_name(&p->summary.lights[pair->light]));
}

static void trace(glint_plan *p, uint32_t light, float rays)
{
    const glint_plan_light *const l = &p->summary.lights[light];
    const glint_decision d = {
        GLINT_EFFECT_SHADOWS, -1, (int32_t)light, 1, "traced", "", rays * plan_costs[PLAN_COST_SHADOW_RAY], 0.0F, 0.0F
    };
    plan_decide(p, d, "%u of %u rays to %s were blocked", l->blocked_rays, l->shadow_rays, plan_light_name(l));
}

void plan_shadows(glint_plan *p)
{
    for (uint32_t i = 0; i < p->summary.pair_count; i++)
        if (p->summary.pairs[i].is_clear)
            leave_out(p, &p->summary.pairs[i]);
    for (uint32_t i = 0; i < p->summary.light_count; i++)
        if (p->light_shadows[i] > 0.0F)
            trace(p, i, p->light_shadows[i]);
}
