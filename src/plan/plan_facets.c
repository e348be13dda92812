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

static int is_discrete(const glint_material_options *o)
{
    return o && o->model != GLINT_MODEL_SMOOTH;
}

/* Whether the facets of a layer, if it has any, fade into its smooth light. A map's mean is not smooth, and the lobes
 * of rough facets that are visited one by one widen the highlight. */
static int is_fading(const glint_material_options *o)
{
    if (!is_discrete(o))
        return 1;
    return o->model == GLINT_MODEL_COUNTING || o->model == GLINT_MODEL_DICTIONARY ||
           (o->model == GLINT_MODEL_EXPLICIT && !(o->facet_alpha > 0.0F));
}

static int is_drawable(const glint_material_options *o)
{
    return !is_discrete(o) || o->model == GLINT_MODEL_COUNTING;
}

/* Without facets it is the smooth model. A dictionary hides facets behind others in another way. */
static int is_smooth_without(const glint_material_options *o)
{
    return !o || o->model != GLINT_MODEL_DICTIONARY;
}

/* The explicit model knows all of a cap, of which the smooth value takes the middle. A renderer sees a light as a shape
 * where that is off by more than this. */
#define CAP_BIAS 0.01

static double explicit_bias(const glint_plan_material *m)
{
    const int is_explicit = (is_discrete(m->base) && m->base->model == GLINT_MODEL_EXPLICIT) ||
                            (is_discrete(m->coat) && m->coat->model == GLINT_MODEL_EXPLICIT);
    return is_explicit ? CAP_BIAS : 0.0;
}

int plan_fades(const glint_plan *p, uint32_t material)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    return is_fading(m->base) && is_fading(m->coat) && (is_discrete(m->base) || is_discrete(m->coat));
}

int plan_draws(const glint_plan *p, uint32_t material)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    return plan_fades(p, material) && is_drawable(m->base) && is_drawable(m->coat) && !plan_is_surrounded(p, material);
}

int plan_is_surrounded(const glint_plan *p, uint32_t material)
{
    for (uint32_t i = 0; i < plan_pair_count(p, material); i++)
        if (p->summary.lights[plan_pair(p, material, i)->light].kind == GLINT_PLAN_LIGHT_SURROUNDINGS)
            return 1;
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

/* A density whose log4 varies by a deviation d from cell to cell: the mean of 1 / N is exp((d ln 4)^2 / 2) / N. */
static double density_variance(const glint_material_options *o)
{
    const double d = is_discrete(o) && o->model == GLINT_MODEL_DICTIONARY ? (double)o->density_variation : 0.0;
    return exp(0.5 * d * d * 1.3862943611198906 * 1.3862943611198906);
}

/* How much more the facets of a material vary than 1 / (N p). */
static double unevenness(const glint_plan_material *m)
{
    const double base = (1.0 + tint_variance(m->base)) * density_variance(m->base);
    return m->coat ? fmax(base, (1.0 + tint_variance(m->coat)) * density_variance(m->coat)) : base;
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
    float fade;    /* deviation of a pixel, below which facets are left out */
    float drawing; /* deviation that draws may add to a pixel */
    double draw;   /* variance that they do add over 1 / (N p) */
    double bias;   /* of the smooth light */
    double most;   /* a pixel varies as if no more facets were lit, however large the light */
} limits;

static tally tally_pair(const glint_plan_pair *pair, const limits *l)
{
    tally t = { .least = HUGE_VAL };
    for (uint32_t i = 0; i < GLINT_PLAN_BINS; i++) {
        const double share = (double)pair->share[i], rate = (double)pair->rate[i];
        const double lit = fmin(plan_bin_middle(i), l->most);
        if (!(rate > 0.0))
            continue;
        t.least = fmin(t.least, lit * 0.70710678);
        t.most = fmax(t.most, lit * 1.41421356);
        const double deviation = sqrt(l->pixel / lit), shown = (double)fade_share((float)deviation, l->fade);
        t.variance += share * (1.0 - shown) * (1.0 - shown) * (deviation * deviation + l->bias * l->bias);
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

/* The lobes of a dictionary are as wide as if one facet in 64 were lit: model/dictionary.c. */
static double most_lit(const glint_plan_material *m)
{
    const int has_lobes = (is_discrete(m->base) && m->base->model == GLINT_MODEL_DICTIONARY) ||
                          (is_discrete(m->coat) && m->coat->model == GLINT_MODEL_DICTIONARY);
    return has_lobes ? (double)m->facets_per_m2.least * (double)m->footprint_m2.least / 64.0 : HUGE_VAL;
}

/* Facets that one evaluation visits; of other models the cost does not depend on them. The pixel in the middle of what
 * is seen stands for all. */
static float visits(const glint_plan *p, uint32_t material, const glint_material_options *o)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    if (o->model != GLINT_MODEL_EXPLICIT)
        return 1.0F;
    const float middle =
        sqrtf(m->facets_per_m2.least * m->footprint_m2.least) * sqrtf(m->facets_per_m2.most * m->footprint_m2.most);
    return fmaxf(middle / (float)p->summary.tiles_per_pixel, 1.0F);
}

/* A model that counts all or nothing. */
static void decide_whole(glint_plan *p, const glint_plan_pair *pair, const glint_material_options *o)
{
    glint_decision d = {
        GLINT_EFFECT_FACETS, (int32_t)pair->material, (int32_t)pair->light, 1, "", "", 0.0F, 0.0F, 0.0F
    };
    snprintf(d.choice, sizeof(d.choice), "%s", glint_model_name(o->model));
    d.ns_per_sample = pair->seen * plan_costs[cost_of(o)] * visits(p, pair->material, o);
    if (o->model == GLINT_MODEL_EXPLICIT)
        plan_decide(p, d, "under %s: the lobes of rough facets are not their smooth light", light_name(p, pair->light));
    else
        plan_decide(p, d, "under %s: the mean of a map is not a smooth light", light_name(p, pair->light));
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
    if (discrete_layer(m)->model != GLINT_MODEL_COUNTING)
        snprintf(d.choice, sizeof(d.choice), "%s", glint_model_name(discrete_layer(m)->model));
    const double enough = l->fade > 0.0F ? l->pixel / ((double)l->fade * (double)l->fade) : HUGE_VAL;
    const glint_material_options *const o = discrete_layer(m);
    const float kernel = plan_costs[cost_of(o)] * visits(p, pair->material, o) - plan_costs[PLAN_COST_SMOOTH];
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
    glint_decision d = { GLINT_EFFECT_LOOKUPS, (int32_t)material, -1, 1, "all 36", "", 0.0F, 0.0F, 0.0F };
    const glint_plan_material *const m = &p->summary.materials[material];
    const uint32_t spp = p->summary.samples_per_pixel, tiles = p->summary.tiles_per_pixel;
    if (drawn > 0.0) {
        snprintf(d.choice, sizeof(d.choice), "one of 36");
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
    for (uint32_t i = 0; i < plan_pair_count(p, material); i++) {
        const tally t = tally_pair(plan_pair(p, material, i), l);
        if (t.counted + t.drawn > 0.0)
            return 0;
        seen += t.faded > 0.0;
    }
    return seen > 0;
}

void plan_facets(glint_plan *p, uint32_t material, double facets_error, double draws_error)
{
    const glint_plan_material *const m = &p->summary.materials[material];
    const double bias = explicit_bias(m), fading = sqrt(fmax(facets_error * facets_error - bias * bias, 0.0));
    const double spp = p->summary.samples_per_pixel, tiles = p->summary.tiles_per_pixel;
    const int is_even = !is_tinted(m->base) && !is_tinted(m->coat);
    const limits l = { PLAN_PIXEL_VARIANCE * unevenness(m), (float)fading, is_even ? (float)draws_error : 0.0F,
                       PLAN_DRAW_VARIANCE * tiles / spp,    bias,          most_lit(m) };
    double drawn = 0.0;
    decide_colors(p, material);
    if (!is_discrete(m->base) && !is_discrete(m->coat))
        return;
    const int fades = plan_fades(p, material);
    const int is_smooth =
        fades && is_smooth_without(m->base) && is_smooth_without(m->coat) && is_all_smooth(p, material, &l);
    for (uint32_t i = 0; i < plan_pair_count(p, material); i++) {
        const glint_plan_pair *const pair = plan_pair(p, material, i);
        if (!fades) {
            decide_whole(p, pair, discrete_layer(m));
            continue;
        }
        decide_pair(p, pair, &l, is_smooth);
        drawn += tally_pair(pair, &l).drawn;
    }
    if (!fades)
        return;
    if (is_drawable(m->base) && is_drawable(m->coat))
        decide_lookups(p, material, &l, drawn);
    /* A sample of surroundings is not one of many of its kind: it may stand for the whole pixel. */
    const double alike = plan_is_surrounded(p, material) ? 1.0 : tiles;
    plan_material *const to = &p->materials[material];
    to->is_smooth = is_smooth;
    to->smooth_deviation = (float)(fading * sqrt(alike / l.pixel));
    to->draw_deviation = drawn > 0.0 ? (float)(draws_error * sqrt(spp)) : 0.0F;
}
