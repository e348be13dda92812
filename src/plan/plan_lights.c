/* How the light of each shape is found on each material: as if all of it came from its middle or by a fit, where what
 * that is off by fits the budget, and by an exact integral else. Where few points of a light know its integral, both
 * are those points.
 *
 * What is off by an error e is off by e of the light. It also turns facets on and off: of the N p that are lit e N p on
 * average, each of which is 1 / (N p) of the light, so that it varies by e / (N p) more. Of few lit facets that is far
 * more than e^2.
 */
#include "plan/plan.h"

#include <math.h>
#include <stdio.h>

static int is_shape(const glint_plan *p, const glint_plan_pair *pair)
{
    return p->summary.lights[pair->light].kind == GLINT_PLAN_LIGHT_SHAPE;
}

/* The fit knows round roughness; what is brushed is integrated whatever the plan says. */
static int is_stretched(const glint_plan_material *m)
{
    return m->base->surface.alpha_x != m->base->surface.alpha_y ||
           (m->coat && m->coat->surface.alpha_x != m->coat->surface.alpha_y);
}

/* The larger of both layers'. */
static double worse(const float errors[2], const glint_plan_material *m)
{
    const double base = (double)errors[m->base->distribution == GLINT_DISTRIBUTION_BECKMANN];
    return m->coat ? fmax(base, (double)errors[m->coat->distribution == GLINT_DISTRIBUTION_BECKMANN]) : base;
}

/* What light that is off by an error, of part of the picture, and lit facets of which a share is turned on or off come
 * to: over the picture's root mean square, and how much more the facets are over its mean. */
typedef struct loss {
    double variance, excess;
} loss;

static loss loss_of(const glint_plan *p, double variance, double flips, double sparks)
{
    return (loss){ variance + flips * sparks, flips * sparks * ((double)p->summary.contrast - 1.0) };
}

/* What counts against the budget. */
static double charge(const glint_plan *p, loss l)
{
    return l.variance + (p->is_strict ? l.excess : 0.0);
}

/* Lights of which a cap is off by up to .16 bend the lobe by less than half, of which a few points leave no more than
 * this of light and facets (PLAIN_COARSE in model/area_plain.h); those of the exact integral next to nothing. */
#define POINTS_ERROR 2e-5
enum { FIT_ENTRY = GLINT_PLAN_SHAPES - 1 };

/* What shapes come to that are neither caps nor left to the fit. */
static glint_plan_shape left_to_points(const glint_plan *p, const glint_plan_pair *pair)
{
    glint_plan_shape sum = { 0.0F };
    for (int k = p->caps; k < FIT_ENTRY; k++) {
        sum.seen += pair->shapes[k].seen;
        sum.part += pair->shapes[k].part;
        sum.sparks += pair->shapes[k].sparks;
    }
    return sum;
}

static loss loss_of_points(const glint_plan *p, const glint_plan_pair *pair)
{
    const glint_plan_shape s = left_to_points(p, pair);
    return loss_of(p, POINTS_ERROR * POINTS_ERROR * (double)s.part, POINTS_ERROR, (double)s.sparks);
}

static loss loss_of_fit(const glint_plan *p, const glint_plan_pair *pair)
{
    const glint_plan_material *const m = &p->summary.materials[pair->material];
    const glint_plan_shape *const s = &pair->shapes[FIT_ENTRY];
    const double error = worse(plan_ltc_errors, m);
    return loss_of(p, error * error * (double)s->part, worse(plan_ltc_flips, m), (double)s->sparks);
}

/* ---- caps ---- */

/* The most that the caps of an entry are off. */
static double cap_error(int entry)
{
    return ldexp(0.01, entry);
}

/* What they are off was measured; a cap that is off by e at most is off by no more in the facets that it lights. */
static loss loss_of_caps(const glint_plan *p, const glint_plan_pair *pair)
{
    loss sum = { 0.0, 0.0 };
    for (int k = 0; k < p->caps; k++) {
        const glint_plan_shape *const s = &pair->shapes[k];
        const int is_last = k == p->caps - 1;
        const loss one = loss_of(p, (double)(is_last ? s->last_cap : s->cap), cap_error(k),
                                 (double)(is_last ? s->last_sparks : s->sparks));
        sum.variance += one.variance;
        sum.excess += one.excess;
    }
    return sum;
}

/* Round lights are caps in many places whatever the plan says; what is left by rounding is none. */
static float seen_as_caps(const glint_plan *p, const glint_plan_pair *pair)
{
    const float seen = pair->seen - left_to_points(p, pair).seen - pair->shapes[FIT_ENTRY].seen;
    return seen > 1e-5F * pair->seen ? seen : 0.0F;
}

/* ---- the fit ---- */

/* What the fit would add to the picture, material by material, and for how many evaluations. */
static void add_up_fits(glint_plan *p)
{
    for (uint32_t i = 0; i < p->summary.pair_count; i++) {
        const glint_plan_pair *const pair = &p->summary.pairs[i];
        if (!is_shape(p, pair))
            continue;
        p->materials[pair->material].fit_variance +=
            charge(p, loss_of_fit(p, pair)) + charge(p, loss_of_points(p, pair));
        p->materials[pair->material].fit_evaluations += (double)pair->shapes[FIT_ENTRY].seen;
    }
}

/* The material that the fit suits best: which adds the least for the time that it saves. NULL: none that fits. */
static plan_material *best_for_fit(glint_plan *p, double most_variance)
{
    plan_material *best = NULL;
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < p->summary.material_count; i++) {
        plan_material *const m = &p->materials[i];
        const double price = m->fit_variance / m->fit_evaluations;
        if (m->method == GLINT_AREA_LIGHT_FAST || !(m->fit_evaluations > 0.0) || !(m->fit_variance < most_variance) ||
            !(price < least) || is_stretched(&p->summary.materials[i]))
            continue;
        least = price;
        best = m;
    }
    return best;
}

/* One after the other, while all of them fit three quarters of what may be left out. Taste: in most pictures nothing
 * else saves as much. */
static void choose_methods(glint_plan *p)
{
    double left = 0.75 * plan_left(p, 1) * plan_left(p, 1);
    p->caps = 0;
    for (uint32_t i = 0; i < p->summary.material_count; i++)
        p->materials[i].method = GLINT_AREA_LIGHT_EXACT;
    add_up_fits(p);
    for (plan_material *m; (m = best_for_fit(p, left)) != NULL;) {
        m->method = GLINT_AREA_LIGHT_FAST;
        left -= m->fit_variance;
    }
}

/* ---- which caps ---- */

/* As many entries as together take half of what the fits have left. */
static void choose_caps(glint_plan *p)
{
    double most = plan_left(p, 1) * plan_left(p, 1);
    for (uint32_t i = 0; i < p->summary.material_count; i++)
        most -= p->materials[i].method == GLINT_AREA_LIGHT_FAST ? p->materials[i].fit_variance : 0.0;
    for (p->caps = GLINT_PLAN_SHAPES - 1; p->caps > 0; p->caps--) {
        double variance = 0.0;
        float seen = 0.0F;
        for (uint32_t i = 0; i < p->summary.pair_count; i++) {
            variance += charge(p, loss_of_caps(p, &p->summary.pairs[i]));
            seen += p->summary.pairs[i].shapes[p->caps - 1].seen;
        }
        if (variance < 0.5 * most && seen > 0.0F)
            break;
    }
    p->outcome.cap_error = p->caps > 0 ? (float)cap_error(p->caps - 1) : 0.0F;
}

/* ---- what is said ---- */

static void decide_caps(glint_plan *p, const glint_plan_pair *pair)
{
    glint_decision d = {
        GLINT_EFFECT_LIGHT, (int32_t)pair->material, (int32_t)pair->light, 1, "cap", "", 0.0F, 0.0F, 0.0F
    };
    const float seen = seen_as_caps(p, pair);
    if (!(seen > 0.0F))
        return;
    const loss l = loss_of_caps(p, pair);
    p->excess += l.excess;
    d.ns_per_sample = seen * plan_costs[PLAN_COST_SMOOTH];
    d.error = (float)sqrt(l.variance);
    plan_decide(p, d, "the middle of %s stands for its shape where that is off by %.2g or less",
                plan_light_name(&p->summary.lights[pair->light]), p->caps > 0 ? cap_error(p->caps - 1) : cap_error(0));
}

static void decide_points(glint_plan *p, const glint_plan_pair *pair)
{
    glint_decision d = {
        GLINT_EFFECT_LIGHT, (int32_t)pair->material, (int32_t)pair->light, 1, "points", "", 0.0F, 0.0F, 0.0F
    };
    const float seen = left_to_points(p, pair).seen;
    const int is_fast = p->materials[pair->material].method == GLINT_AREA_LIGHT_FAST;
    const loss l = is_fast ? loss_of_points(p, pair) : (loss){ 0.0, 0.0 };
    if (!(seen > 0.0F))
        return;
    p->excess += l.excess;
    d.ns_per_sample = seen * plan_costs[PLAN_COST_POINTS];
    d.error = (float)sqrt(l.variance);
    plan_decide(p, d, "%s is so small that a few points of it know its integral",
                plan_light_name(&p->summary.lights[pair->light]));
}

static void decide_shape(glint_plan *p, const glint_plan_pair *pair)
{
    const glint_plan_material *const m = &p->summary.materials[pair->material];
    const char *const name = plan_light_name(&p->summary.lights[pair->light]);
    const loss l = loss_of_fit(p, pair);
    const double error = sqrt(l.variance);
    const float seen = pair->shapes[FIT_ENTRY].seen;
    glint_decision d = {
        GLINT_EFFECT_LIGHT, (int32_t)pair->material, (int32_t)pair->light, 1, "quadrature", "", 0.0F, 0.0F, 0.0F
    };
    if (!(seen > 0.0F))
        return;
    d.ns_per_sample = seen * plan_costs[PLAN_COST_QUADRATURE];
    if (is_stretched(m)) {
        plan_decide(p, d, "%s shows its shape on a brushed surface, which no fit knows", name);
    } else if (p->materials[pair->material].method == GLINT_AREA_LIGHT_FAST) {
        snprintf(d.choice, sizeof(d.choice), "LTC");
        d.ns_per_sample = seen * plan_costs[PLAN_COST_LTC];
        d.error = (float)error;
        p->excess += l.excess;
        plan_decide(p, d, "the shape of %s by a fit: %.2g of a pixel, and of the facets that it turns on or off", name,
                    error);
    } else {
        plan_decide(p, d, "a fit of the shape of %s, and the facets that it turns on or off, would be off by %.2g%s",
                    name, sqrt(charge(p, l)), p->is_strict ? " of the mean" : "");
    }
}

/* Where it shows its shape decisions are about each material. */
static void decide_light(glint_plan *p, uint32_t index)
{
    const glint_plan_light *const l = &p->summary.lights[index];
    glint_decision d = { GLINT_EFFECT_LIGHT, -1, (int32_t)index, 1, "cap", "", 0.0F, 0.0F, 0.0F };
    if (l->kind == GLINT_PLAN_LIGHT_SHAPE)
        return;
    d.ns_per_sample = p->light_seen[index] * plan_costs[PLAN_COST_SMOOTH];
    if (l->kind == GLINT_PLAN_LIGHT_CAP) {
        plan_decide(p, d, "%s is small and round: one direction stands for it", plan_light_name(l));
        return;
    }
    snprintf(d.choice, sizeof(d.choice), "sampled");
    if (l->patch_count > 0)
        plan_decide(p, d, "%s is cut into %u patches of even light", plan_light_name(l), l->patch_count);
    else
        plan_decide(p, d, "%s is sampled by its light", plan_light_name(l));
}

void plan_lights(glint_plan *p)
{
    choose_methods(p);
    choose_caps(p);
    for (uint32_t i = 0; i < p->summary.light_count; i++)
        decide_light(p, i);
    for (uint32_t i = 0; i < p->summary.pair_count; i++)
        if (is_shape(p, &p->summary.pairs[i])) {
            decide_caps(p, &p->summary.pairs[i]);
            decide_points(p, &p->summary.pairs[i]);
            decide_shape(p, &p->summary.pairs[i]);
        }
}
