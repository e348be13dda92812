/* Everything but facets: what the scene does not have is off, what brings nothing is left out, the rest has its cost.
 */
#include "plan/plan.h"

#include <math.h>
#include <stdio.h>

/* Of n trials without a hit the true rate is below 3 / n with 95 % of confidence. */
#define RULE_OF_THREE 3.0

static glint_decision of_material(glint_effect effect, uint32_t material, const char *choice)
{
    glint_decision d = { effect, (int32_t)material, -1, 0, "", "", 0.0F, 0.0F, 0.0F };
    snprintf(d.choice, sizeof(d.choice), "%s", choice);
    return d;
}

static glint_decision switched_on(glint_decision d, const char *choice, float ns)
{
    snprintf(d.choice, sizeof(d.choice), "%s", choice);
    d.is_on = 1;
    d.ns_per_sample = ns;
    return d;
}

static void decide_layers(glint_plan *p, uint32_t index, const glint_plan_material *m)
{
    const glint_decision off = of_material(GLINT_EFFECT_LAYERS, index, "one");
    if (m->coat)
        plan_decide(p, switched_on(off, "two", m->seen * plan_costs[PLAN_COST_COAT]),
                    "a clear coat lies over its base");
    else
        plan_decide(p, off, "it has no clear coat");
}

static void decide_anisotropy(glint_plan *p, uint32_t index, const glint_plan_material *m)
{
    const glint_decision off = of_material(GLINT_EFFECT_ANISOTROPY, index, "round");
    const float x = m->base->surface.alpha_x, y = m->base->surface.alpha_y;
    if (x != y)
        plan_decide(p, switched_on(off, "stretched", m->seen * plan_costs[PLAN_COST_ANISOTROPY]),
                    "highlights are %.3g times as long as wide", (double)(fmaxf(x, y) / fminf(x, y)));
    else
        plan_decide(p, off, "its roughness is %.3g along and across", (double)x);
}

static void decide_textures(glint_plan *p, uint32_t index, const glint_plan_material *m)
{
    const glint_decision off = of_material(GLINT_EFFECT_TEXTURES, index, "constant");
    const glint_decision flat = of_material(GLINT_EFFECT_NORMAL_MAPS, index, "none");
    if (m->texture_count > 0)
        plan_decide(p, switched_on(off, "looked up", m->seen * (float)m->texture_count * plan_costs[PLAN_COST_TEXTURE]),
                    "%u textures; alpha is %.3g to %.3g", m->texture_count, (double)m->alpha.least,
                    (double)m->alpha.most);
    else
        plan_decide(p, off, "it has no textures");
    if (m->normal_map_count > 0)
        plan_decide(
            p, switched_on(flat, "looked up", m->seen * (float)m->normal_map_count * plan_costs[PLAN_COST_NORMAL_MAP]),
            "%u normal maps", m->normal_map_count);
    else
        plan_decide(p, flat, "it has no normal map");
}

static void decide_alpha(glint_plan *p, uint32_t index, const glint_plan_material *m)
{
    const glint_decision off = of_material(GLINT_EFFECT_ALPHA, index, "solid");
    if (m->is_cut_out)
        plan_decide(p, switched_on(off, "see-through", m->seen * plan_costs[PLAN_COST_ALPHA]),
                    "rays may pass it: each looks its opacity up");
    else
        plan_decide(p, off, "it is opaque");
}

void plan_surfaces(glint_plan *p)
{
    const glint_decision d = {
        GLINT_EFFECT_SURFACES, -1, -1, 1, "traced", "", plan_costs[PLAN_COST_CAMERA_RAY], 0.0F, 0.0F
    };
    plan_decide(p, d, "%u samples a pixel; %u pixels were looked at to plan them", p->summary.samples_per_pixel,
                p->summary.pixel_count);
    for (uint32_t i = 0; i < p->summary.material_count; i++) {
        const glint_plan_material *const m = &p->summary.materials[i];
        decide_layers(p, i, m);
        decide_anisotropy(p, i, m);
        decide_textures(p, i, m);
        decide_alpha(p, i, m);
    }
}

void plan_bounces(glint_plan *p)
{
    const glint_plan_summary *const s = &p->summary;
    glint_decision d = { GLINT_EFFECT_BOUNCES, -1, -1, 0, "none", "", 0.0F, 0.0F, 0.0F };
    const float ns = s->bounce_rays * plan_costs[PLAN_COST_BOUNCE_RAY];
    p->outcome.bounces = s->bounces;
    if (s->bounces == 0) {
        plan_decide(p, d, "none are asked for");
        return;
    }
    /* What is not seen in n pixels may still be in 3 / n of them, and make all of their light. */
    const double hidden = s->pixel_count > 0 ? RULE_OF_THREE / s->pixel_count : 1.0;
    const double error = sqrt((double)s->bounced * (double)s->bounced + hidden * (double)s->bounced);
    if (error < plan_left(p, 3)) {
        p->outcome.bounces = 0;
        d.error = (float)error;
        plan_decide(p, d, "light from other surfaces is %.2g of a pixel", (double)s->bounced);
        return;
    }
    char text[24];
    snprintf(text, sizeof(text), "%u", s->bounces);
    plan_decide(p, switched_on(d, text, ns), "light from other surfaces is %.2g of a pixel", (double)s->bounced);
}
