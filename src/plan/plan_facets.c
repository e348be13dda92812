/* Which facets are counted, and how: from how many are lit in the pixels that were looked at.
 *
 * A pixel in which N p facets are lit varies by 1.1 / (N p) at most, times 1 + s^2 where their tints vary by s^2. Below
 * the budget nobody sees it: the count fades out to the smooth light (math/fade.h), at every point by itself. A draw of
 * one realisation adds 9 / (N p) of a tile to one sample, and a pixel is the mean of many.
 */
#include "plan/plan.h"

#include <math.h>
#include <stdio.h>

#include "math/fade.h"

static int is_counting(const glint_material_options *o)
{
    return o && o->model == GLINT_MODEL_COUNTING;
}

static int is_discrete(const glint_material_options *o)
{
    return o && o->model != GLINT_MODEL_SMOOTH;
}

int plan_counts(const glint_plan *p, uint32_t material)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    const int others =
        (is_discrete(m->base) && !is_counting(m->base)) || (is_discrete(m->coat) && !is_counting(m->coat));
    return !others && (is_counting(m->base) || is_counting(m->coat));
}

int plan_is_surrounded(const glint_plan *p, uint32_t material)
{
    for (uint32_t i = 0; i < p->summary.pair_count; i++) {
        const glint_plan_pair *const pair = &p->summary.pairs[i];
        if (pair->material == material && p->summary.lights[pair->light].kind == GLINT_PLAN_LIGHT_SURROUNDINGS)
            return 1;
    }
    return 0;
}

/* ---- colours ---- */

static int is_tinted(const glint_material_options *o)
{
    return is_discrete(o) && (o->color_count > 0 || o->color_variation > 0.0F);
}

/* s^2: of the channel that varies most. A table over its mean, a hue 1 + v cos. */
static double tint_variance(const glint_material_options *o)
{
    double most = 0.0;
    if (!is_tinted(o))
        return 0.0;
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, square = 0.0;
        for (uint32_t i = 0; i < o->color_count; i++) {
            sum += (double)o->colors[i][c];
            square += (double)o->colors[i][c] * (double)o->colors[i][c];
        }
        if (sum > 0.0)
            most = fmax(most, square * o->color_count / (sum * sum) - 1.0);
    }
    const double v = (double)o->color_variation;
    return (1.0 + most) * (1.0 + 0.5 * v * v) - 1.0;
}

static double material_tint_variance(const glint_plan_material *m)
{
    const double base = tint_variance(m->base);
    return m->coat ? fmax(base, tint_variance(m->coat)) : base;
}

static void decide_colors(glint_plan *p, uint32_t material)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    const glint_material_options *const o = is_tinted(m->base) ? m->base : m->coat;
    const glint_decision d = { GLINT_EFFECT_COLORS, (int32_t)material, -1, 0, "one color", "", 0.0F, 0.0F, 0.0F };
    if (!is_discrete(m->base) && !is_discrete(m->coat))
        return;
    if (!is_tinted(o)) {
        plan_decide(p, d, "all its facets have the base color");
        return;
    }
    glint_decision *const on =
        plan_decide(p, d, "%u colors, hues vary by %.3g", o->color_count, (double)o->color_variation);
    on->is_on = 1;
    snprintf(on->choice, sizeof(on->choice), "tinted");
}

/* ---- counts ---- */

/* One pair of material and light, bin by bin. */
typedef struct tally {
    double variance;              /* that is left out, and that draws add */
    double counted, drawn, faded; /* evaluations per sample */
    double least, most;           /* lit facets of a pixel, where any are seen */
} tally;

/* How a pixel's deviations become those of a tile and of a sample. */
typedef struct limits {
    double pixel;  /* variance of a pixel over 1 / (N p) */
    float fade;    /* deviation of a pixel, from which facets are left out */
    float drawing; /* deviation that draws may add to a pixel */
    double draw;   /* variance that they do add over 1 / (N p) */
} limits;

static tally tally_pair(const glint_plan_pair *pair, const limits *l)
{
    tally t = { .least = HUGE_VAL };
    for (uint32_t i = 0; i < GLINT_PLAN_BINS; i++) {
        const double share = (double)pair->share[i], rate = (double)pair->rate[i], lit = plan_bin_middle(i);
        if (!(rate > 0.0))
            continue;
        t.least = fmin(t.least, lit * 0.70710678);
        t.most = fmax(t.most, lit * 1.41421356);
        const double deviation = sqrt(l->pixel / lit), shown = (double)fade_share((float)deviation, l->fade);
        t.variance += share * (1.0 - shown) * (1.0 - shown) * deviation * deviation;
        if (!(shown > 0.0)) {
            t.faded += rate;
        } else if (l->draw / lit < (double)l->drawing * (double)l->drawing) {
            t.drawn += rate;
            t.variance += share * shown * shown * l->draw / lit;
        } else {
            t.counted += rate;
        }
    }
    return t;
}

static plan_cost cost_of(const glint_material_options *o)
{
    switch (o->model) {
    case GLINT_MODEL_DICTIONARY:
        return PLAN_COST_DICTIONARY;
    case GLINT_MODEL_EXAMPLE:
        return PLAN_COST_EXAMPLE;
    case GLINT_MODEL_EXPLICIT:
        return PLAN_COST_EXPLICIT_FACET;
    default:
        return is_tinted(o) ? PLAN_COST_COUNTED_COLORS : PLAN_COST_COUNTED;
    }
}

static const glint_material_options *discrete_layer(const glint_plan_material *m)
{
    return is_discrete(m->base) ? m->base : m->coat;
}

static const char *light_name(const glint_plan *p, uint32_t light)
{
    const char *const name = p->summary.lights[light].name;
    return name ? name : "a light";
}

/* A model that counts all or nothing. */
static void decide_whole(glint_plan *p, const glint_plan_pair *pair, const glint_material_options *o)
{
    glint_decision d = {
        GLINT_EFFECT_FACETS, (int32_t)pair->material, (int32_t)pair->light, 1, "", "", 0.0F, 0.0F, 0.0F
    };
    const double each = o->model == GLINT_MODEL_EXPLICIT
                            ? (double)p->summary.materials[pair->material].facets_per_m2.most *
                                  (double)p->summary.materials[pair->material].footprint_m2.most /
                                  p->summary.samples_per_pixel
                            : 1.0;
    snprintf(d.choice, sizeof(d.choice), "%s", glint_model_name(o->model));
    d.ns_per_sample = pair->seen * plan_costs[cost_of(o)] * (float)fmax(each, 1.0);
    plan_decide(p, d, "under %s: what the %s model shows is taken whole", light_name(p, pair->light),
                glint_model_name(o->model));
}

static void decide_pair(glint_plan *p, const glint_plan_pair *pair, const limits *l, int is_smooth)
{
    const glint_plan_material *const m = &p->summary.materials[pair->material];
    const tally t = tally_pair(pair, l);
    glint_decision d = {
        GLINT_EFFECT_FACETS,    (int32_t)pair->material, (int32_t)pair->light, 1, "counted", "", 0.0F, 0.0F,
        (float)sqrt(t.variance)
    };
    if (!(t.counted + t.drawn + t.faded > 0.0)) {
        d.is_on = 0;
        snprintf(d.choice, sizeof(d.choice), "unseen");
        plan_decide(p, d, "%s lights none of its facets in what the camera sees", light_name(p, pair->light));
        return;
    }
    const double enough = l->fade > 0.0F ? l->pixel / ((double)l->fade * (double)l->fade) : HUGE_VAL;
    const float kernel = plan_costs[cost_of(discrete_layer(m))] - plan_costs[PLAN_COST_SMOOTH];
    d.ns_per_sample =
        (float)t.counted * kernel + (float)t.drawn * (plan_costs[PLAN_COST_DRAWN] - plan_costs[PLAN_COST_SMOOTH]) +
        (is_smooth ? 0.0F : (float)t.faded * (plan_costs[PLAN_COST_FADED] - plan_costs[PLAN_COST_SMOOTH]));
    if (!(t.counted + t.drawn > 0.0)) {
        d.is_on = 0;
        snprintf(d.choice, sizeof(d.choice), "smooth");
        plan_decide(p, d, "%s lights %.2g facets of a pixel or more; from %.2g on their sum is smooth",
                    light_name(p, pair->light), t.least, enough);
    } else if (t.faded > 0.0) {
        plan_decide(p, d, "%s lights %.2g to %.2g facets of a pixel; above %.2g they fade into the smooth light",
                    light_name(p, pair->light), t.least, t.most, enough);
    } else {
        plan_decide(p, d, "%s lights only %.2g to %.2g facets of a pixel: they show one by one",
                    light_name(p, pair->light), t.least, t.most);
    }
}

static void decide_lookups(glint_plan *p, uint32_t material, const limits *l, double drawn)
{
    glint_decision d = { GLINT_EFFECT_LOOKUPS, (int32_t)material, -1, 1, "all 48", "", 0.0F, 0.0F, 0.0F };
    const glint_plan_material *const m = &p->summary.materials[material];
    const uint32_t spp = p->summary.samples_per_pixel, tiles = p->summary.tiles_per_pixel;
    if (drawn > 0.0) {
        snprintf(d.choice, sizeof(d.choice), "one of 48");
        plan_decide(p, d, "%u samples a pixel level out single draws where it shows %.2g lit facets or more", spp,
                    l->draw / ((double)l->drawing * (double)l->drawing));
    } else if (is_tinted(m->base) || is_tinted(m->coat)) {
        plan_decide(p, d, "facets of different colors are looked up whole");
    } else if (plan_is_surrounded(p, material)) {
        plan_decide(p, d, "surroundings light it, of which each sample sees another part");
    } else if (!(p->summary.error_budget > 0.0F)) {
        plan_decide(p, d, "nothing may be left out");
    } else {
        plan_decide(p, d, "%u samples for %u tiles a pixel are too few to level out single draws", spp, tiles);
    }
}

static int is_all_smooth(const glint_plan *p, uint32_t material, const limits *l)
{
    int seen = 0;
    for (uint32_t i = 0; i < p->summary.pair_count; i++) {
        const glint_plan_pair *const pair = &p->summary.pairs[i];
        if (pair->material != material)
            continue;
        const tally t = tally_pair(pair, l);
        if (t.counted + t.drawn > 0.0)
            return 0;
        seen += t.faded > 0.0;
    }
    return seen > 0;
}

void plan_facets(glint_plan *p, uint32_t material, double facets_error, double draws_error)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    const double tints = material_tint_variance(m), spp = p->summary.samples_per_pixel;
    const double tiles = p->summary.tiles_per_pixel;
    const limits l = { PLAN_PIXEL_VARIANCE * (1.0 + tints), (float)facets_error,
                       tints > 0.0 ? 0.0F : (float)draws_error, PLAN_DRAW_VARIANCE * tiles / spp };
    double drawn = 0.0;
    decide_colors(p, material);
    if (!is_discrete(m->base) && !is_discrete(m->coat))
        return;
    const int counts = plan_counts(p, material), is_smooth = counts && is_all_smooth(p, material, &l);
    for (uint32_t i = 0; i < p->summary.pair_count; i++) {
        const glint_plan_pair *const pair = &p->summary.pairs[i];
        if (pair->material != material)
            continue;
        if (!counts) {
            decide_whole(p, pair, discrete_layer(m));
            continue;
        }
        decide_pair(p, pair, &l, is_smooth);
        drawn += tally_pair(pair, &l).drawn;
    }
    if (!counts)
        return;
    decide_lookups(p, material, &l, drawn);
    /* A sample of surroundings is not one of many of its kind: it may stand for the whole pixel. */
    const double alike = plan_is_surrounded(p, material) ? 1.0 : tiles;
    plan_material *const to = &p->materials[material];
    to->is_smooth = is_smooth;
    to->smooth_deviation = (float)(facets_error * sqrt(alike / l.pixel));
    to->draw_deviation = drawn > 0.0 ? (float)(draws_error * sqrt(spp)) : 0.0F;
}
