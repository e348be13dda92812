/* How many samples a pixel takes: the noise that each number leaves, and the cheapest number for which that noise and
 * what is left out stay within the budget together. */
#include "plan/plan.h"

#include <math.h>
#include <stdio.h>

/* Of well spread samples of an edge noise^2 falls as samples^-1.5 (Mitchell 1996), of rare light as samples^-1. What
 * falls faster among few samples is gone among many: no more is believed of numbers that were not looked at. */
#define MOST_FALL_BEYOND 1.5

double plan_noise_variance(const glint_plan *p, double samples)
{
    const glint_plan_summary *const s = &p->summary;
    const double ratio = samples / s->noise_samples, fall = (double)s->noise_fall;
    return (double)s->noise * (double)s->noise * pow(ratio, -(ratio > 1.0 ? fmin(fall, MOST_FALL_BEYOND) : fall));
}

/* The inverse: samples that leave this variance; 0 where no number does. */
static uint32_t enough_for(const glint_plan *p, double variance)
{
    const glint_plan_summary *const s = &p->summary;
    const double known = (double)s->noise * (double)s->noise, fall = (double)s->noise_fall;
    if (!(variance > 0.0))
        return 0U;
    const double ratio = pow(known / variance, 1.0 / (known > variance ? fmin(fall, MOST_FALL_BEYOND) : fall));
    const double enough = ceil(ratio * s->noise_samples);
    return enough < 4e9 ? (uint32_t)fmax(enough, 1.0) : 0U;
}

/* Only of powers of two each tile of a pixel gets as many samples. */
static uint32_t fewest_samples(const glint_plan *p)
{
    uint32_t n = 1;
    while (n < p->fewest && n <= p->summary.most_samples / 2)
        n *= 2;
    return n;
}

/* What noise leaves of the budget is for what can be left out, so fewer samples pay where little can be, and more where
 * more noise stands in the way of a dear integral. Each number is tried. */
void plan_choose_samples(glint_plan *p, plan_decider *decide)
{
    const double budget = (double)p->summary.error_budget, spread = (double)p->summary.noise_spread;
    uint32_t best = 0, last = fewest_samples(p);
    double cheapest = HUGE_VAL, best_left = budget;
    for (uint64_t n = last; n <= p->summary.most_samples; n *= 2) {
        const double left = budget * budget - plan_noise_variance(p, (double)n) * (1.0 + spread);
        last = (uint32_t)n;
        if (!(left >= 0.0))
            continue;
        decide(p, last, sqrt(left));
        const double cost = (double)n * (double)p->outcome.ns_per_sample;
        if (!(cost < cheapest))
            continue;
        cheapest = cost;
        best = last;
        best_left = sqrt(left);
    }
    decide(p, best > 0 ? best : last, best_left);
}

static void explain(glint_plan *p, const glint_decision *d, double noise)
{
    const uint32_t samples = p->summary.samples_per_pixel, enough = p->outcome.enough_samples;
    const double budget = (double)p->summary.error_budget;
    const int is_chosen = p->summary.most_samples > 0;
    if (p->outcome.is_met && is_chosen && samples > fewest_samples(p))
        plan_decide(p, *d, "they leave noise of about %.2g, within the budget of %g; %u would leave %.2g", noise,
                    budget, samples / 2, sqrt(plan_noise_variance(p, 0.5 * samples)));
    else if (p->outcome.is_met)
        plan_decide(p, *d, "they leave noise of about %.2g, within the budget of %g", noise, budget);
    else if (enough > samples)
        plan_decide(p, *d, "%sthey leave noise of about %.2g: a budget of %g takes about %u",
                    is_chosen ? "the most that is chosen; " : "", noise, budget, enough);
    else
        plan_decide(p, *d, "they leave noise of about %.2g: a budget of %g cannot be met", noise, budget);
}

void plan_samples(glint_plan *p)
{
    const uint32_t samples = p->summary.samples_per_pixel;
    const double budget = (double)p->summary.error_budget, noise = plan_noise_variance(p, samples);
    const double left = budget * budget - p->variance;
    glint_plan_outcome *const o = &p->outcome;
    o->error = (float)sqrt(p->variance);
    o->error_of_mean = (float)sqrt(p->variance + p->excess);
    o->noise = (float)sqrt(noise);
    o->samples = samples;
    o->is_met = left >= noise;
    o->enough_samples = enough_for(p, left);
    glint_decision d = { GLINT_EFFECT_SAMPLES, -1, -1, 1, "", "", 0.0F, 0.0F, 0.0F };
    snprintf(d.choice, sizeof(d.choice), "%u", samples);
    explain(p, &d, sqrt(noise));
}
