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

/* ---- lights ---- */

static float seen_of(const glint_plan *p, uint32_t light)
{
    float seen = 0.0F;
    for (uint32_t i = 0; i < p->summary.pair_count; i++)
        seen += p->summary.pairs[i].light == light ? p->summary.pairs[i].seen : 0.0F;
    return seen;
}

/* No survey proves that there are none: a pixel whose shadow is missed is brighter than it should be by any factor. */
static void decide_shadows(glint_plan *p, uint32_t index)
{
    const glint_plan_light *const l = &p->summary.lights[index];
    const float rays = (float)l->shadow_rays / fmaxf((float)p->summary.pixel_count, 1.0F);
    const glint_decision d = {
        GLINT_EFFECT_SHADOWS, -1, (int32_t)index, 1, "traced", "", rays * plan_costs[PLAN_COST_SHADOW_RAY], 0.0F, 0.0F
    };
    plan_decide(p, d, "%u of %u rays to %s were blocked", l->blocked_rays, l->shadow_rays,
                l->name ? l->name : "a light");
}

/* All materials find the light of shapes in the same way. */
static glint_area_light_method choose_method(const glint_plan *p, double *error)
{
    *error = 0.0;
    for (uint32_t m = 0; m < p->summary.material_count; m++) {
        const glint_material_options *const layers[2] = { p->summary.materials[m].base, p->summary.materials[m].coat };
        for (int i = 0; i < 2; i++)
            if (layers[i] && p->summary.materials[m].seen > 0.0F)
                *error = fmax(*error, (double)plan_ltc_errors[layers[i]->distribution == GLINT_DISTRIBUTION_BECKMANN]);
    }
    return *error < plan_left(p, 2) ? GLINT_AREA_LIGHT_FAST : GLINT_AREA_LIGHT_EXACT;
}

static void decide_light(glint_plan *p, uint32_t index, glint_area_light_method method, double ltc_error, float *spent)
{
    const glint_plan_light *const l = &p->summary.lights[index];
    const char *const name = l->name ? l->name : "a light";
    const float seen = seen_of(p, index);
    glint_decision d = {
        GLINT_EFFECT_LIGHT, -1, (int32_t)index, 1, "cap", "", seen * plan_costs[PLAN_COST_SMOOTH], 0.0F, 0.0F
    };
    if (l->kind == GLINT_PLAN_LIGHT_SURROUNDINGS) {
        snprintf(d.choice, sizeof(d.choice), "sampled");
        if (l->patch_count > 0)
            plan_decide(p, d, "%s is cut into %u patches of even light", name, l->patch_count);
        else
            plan_decide(p, d, "%s is sampled by its light", name);
    } else if (l->kind == GLINT_PLAN_LIGHT_CAP) {
        plan_decide(p, d, "%s is small and round: one direction stands for it", name);
    } else if (method == GLINT_AREA_LIGHT_FAST) {
        snprintf(d.choice, sizeof(d.choice), "LTC");
        d.ns_per_sample = seen * plan_costs[PLAN_COST_LTC];
        d.error = (float)sqrt(fmax(ltc_error * ltc_error - (double)*spent * (double)*spent, 0.0));
        *spent = (float)ltc_error;
        plan_decide(p, d, "the shape of %s by a fit that is off by %.2g", name, ltc_error);
    } else {
        snprintf(d.choice, sizeof(d.choice), "quadrature");
        d.ns_per_sample = seen * plan_costs[PLAN_COST_QUADRATURE];
        plan_decide(p, d, "the fit of the shape of %s is off by %.2g, and %.2g may be", name, ltc_error,
                    plan_left(p, 2));
    }
}

void plan_lights(glint_plan *p)
{
    double ltc_error;
    const glint_area_light_method method = choose_method(p, &ltc_error);
    float spent = 0.0F;
    for (uint32_t m = 0; m < p->summary.material_count; m++)
        p->materials[m].method = method;
    for (uint32_t i = 0; i < p->summary.light_count; i++)
        decide_light(p, i, method, ltc_error, &spent);
    for (uint32_t i = 0; i < p->summary.light_count; i++)
        if (p->summary.lights[i].shadow_rays > 0)
            decide_shadows(p, i);
}

/* ---- the whole ---- */

void plan_samples(glint_plan *p)
{
    const glint_plan_summary *const s = &p->summary;
    const double budget = (double)s->error_budget, noise = (double)s->noise / sqrt(s->samples_per_pixel);
    const double left = budget * budget - p->variance;
    glint_plan_outcome *const o = &p->outcome;
    o->error = (float)sqrt(p->variance);
    o->noise = (float)noise;
    o->is_met = left >= noise * noise;
    const double enough = left > 0.0 ? ceil((double)s->noise * (double)s->noise / left) : 0.0;
    o->enough_samples = enough < 4e9 ? (uint32_t)enough : 0U;
    glint_decision d = { GLINT_EFFECT_SAMPLES, -1, -1, 1, "", "", 0.0F, 0.0F, 0.0F };
    snprintf(d.choice, sizeof(d.choice), "%u", s->samples_per_pixel);
    if (o->is_met)
        plan_decide(p, d, "they leave noise of about %.2g, within the budget of %g", noise, budget);
    else if (o->enough_samples > s->samples_per_pixel)
        plan_decide(p, d, "they leave noise of about %.2g: a budget of %g takes about %u", noise, budget,
                    o->enough_samples);
    else
        plan_decide(p, d, "they leave noise of about %.2g: a budget of %g cannot be met", noise, budget);
}
