/* A summary of a scene and an error become decisions, each with a reason, a cost and an error.
 *
 * What the decisions leave out has independent causes, so variances add up to the square of the budget. What can be
 * left out whole is decided first; single facets and draws, which can be left out by degrees, share what remains.
 */
#include "plan/plan.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* log2 of the lit facets of the lower end of the first bin. */
#define FIRST_BIN (-16)

static const char *const effect_names[] = {
    [GLINT_EFFECT_SURFACES] = "surfaces", [GLINT_EFFECT_FACETS] = "facets",
    [GLINT_EFFECT_LOOKUPS] = "look-ups",  [GLINT_EFFECT_COLORS] = "facet colors",
    [GLINT_EFFECT_LAYERS] = "layers",     [GLINT_EFFECT_ANISOTROPY] = "anisotropy",
    [GLINT_EFFECT_TEXTURES] = "textures", [GLINT_EFFECT_NORMAL_MAPS] = "normal maps",
    [GLINT_EFFECT_ALPHA] = "alpha",       [GLINT_EFFECT_LIGHT] = "light",
    [GLINT_EFFECT_SHADOWS] = "shadows",   [GLINT_EFFECT_BOUNCES] = "bounces",
    [GLINT_EFFECT_SAMPLES] = "samples",
};
enum { EFFECT_COUNT = sizeof(effect_names) / sizeof(effect_names[0]) };

const char *glint_effect_name(glint_effect effect)
{
    return (uint32_t)effect < EFFECT_COUNT ? effect_names[effect] : NULL;
}

uint32_t glint_plan_bin(float lit_facets)
{
    int exponent;
    if (!(lit_facets > 0.0F))
        return 0;
    frexpf(lit_facets, &exponent); /* lit_facets in [2^(exponent - 1), 2^exponent) */
    const int bin = exponent - 1 - FIRST_BIN;
    return bin < 0 ? 0U : bin < GLINT_PLAN_BINS ? (uint32_t)bin : GLINT_PLAN_BINS - 1U;
}

double plan_bin_middle(uint32_t bin)
{
    return ldexp(1.41421356, (int)bin + FIRST_BIN);
}

double plan_left(const glint_plan *p, int n)
{
    const double spent = p->variance + (p->is_strict ? p->excess : 0.0);
    return sqrt(fmax(p->budget * p->budget - spent, 0.0) / n);
}

glint_decision *plan_decide(glint_plan *p, glint_decision d, const char *reason, ...)
{
    glint_decision *const to = &p->decisions[p->count < p->capacity ? p->count++ : p->capacity - 1];
    va_list list;
    va_start(list, reason);
    *to = d;
    vsnprintf(to->reason, sizeof(to->reason), reason, list);
    va_end(list);
    p->outcome.ns_per_sample += d.ns_per_sample;
    p->variance += (double)d.error * (double)d.error;
    return to;
}

/* ---- set-up ---- */

static void *allocate_default(size_t byte_count, void *user)
{
    (void)user;
    return malloc(byte_count);
}

static void release_default(void *memory, void *user)
{
    (void)user;
    free(memory);
}

typedef struct complaint {
    char *message;
    size_t size;
    glint_result result;
} complaint;

static void complain(complaint *c, glint_result result, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void complain(complaint *c, glint_result result, const char *format, ...)
{
    va_list list;
    if (c->result != GLINT_OK)
        return;
    c->result = result;
    va_start(list, format);
    if (c->message && c->size > 0)
        vsnprintf(c->message, c->size, format, list);
    va_end(list);
}

/* low <= x <= high, and no NaN. */
static void check(complaint *c, const char *name, float x, float low, float high)
{
    if (!(x >= low && x <= high))
        complain(c, GLINT_ERROR_RANGE, "%s is %g, expected %g to %g", name, (double)x, (double)low, (double)high);
}

static void check_pair(complaint *c, const glint_plan_summary *s, uint32_t index)
{
    const glint_plan_pair *const pair = &s->pairs[index];
    if (pair->material >= s->material_count)
        complain(c, GLINT_ERROR_RANGE, "pairs[%u].material is %u, expected less than %u", index, pair->material,
                 s->material_count);
    if (pair->light >= s->light_count)
        complain(c, GLINT_ERROR_RANGE, "pairs[%u].light is %u, expected less than %u", index, pair->light,
                 s->light_count);
    check(c, "pairs[].seen", pair->seen, 0.0F, 1e9F);
    check(c, "pairs[].shadow_rays", pair->shadow_rays, 0.0F, 1e9F);
    for (int i = 0; i < GLINT_PLAN_SHAPES; i++) {
        check(c, "pairs[].shapes[].seen", pair->shapes[i].seen, 0.0F, 1e9F);
        check(c, "pairs[].shapes[].part", pair->shapes[i].part, 0.0F, 1e9F);
        check(c, "pairs[].shapes[].sparks", pair->shapes[i].sparks, 0.0F, 1e20F);
        check(c, "pairs[].shapes[].cap", pair->shapes[i].cap, 0.0F, 1e20F);
        check(c, "pairs[].shapes[].last_cap", pair->shapes[i].last_cap, 0.0F, 1e20F);
        check(c, "pairs[].shapes[].last_sparks", pair->shapes[i].last_sparks, 0.0F, 1e20F);
    }
    for (int i = 0; i < GLINT_PLAN_BINS; i++) {
        check(c, "pairs[].share[]", pair->share[i], 0.0F, 1e9F);
        check(c, "pairs[].rate[]", pair->rate[i], 0.0F, 1e9F);
    }
}

static void check_summary(complaint *c, const glint_plan_summary *s)
{
    /* An older client knows fewer members, a newer one more; neither is cut short without a word. */
    if (s->size != sizeof(*s)) {
        complain(c, GLINT_ERROR_ARGUMENT, "size is %zu, expected %zu (set it with GLINT_PLAN_SUMMARY_INIT)", s->size,
                 sizeof(*s));
        return;
    }
    if ((s->material_count > 0 && !s->materials) || (s->light_count > 0 && !s->lights) ||
        (s->pair_count > 0 && !s->pairs)) {
        complain(c, GLINT_ERROR_ARGUMENT, "materials, lights or pairs is NULL, expected an array");
        return;
    }
    if (s->samples_per_pixel < 1 || s->tiles_per_pixel < 1)
        complain(c, GLINT_ERROR_RANGE, "samples_per_pixel is %u and tiles_per_pixel %u, expected 1 or more",
                 s->samples_per_pixel, s->tiles_per_pixel);
    if (s->noise_samples < 1)
        complain(c, GLINT_ERROR_RANGE, "noise_samples is 0, expected 1 or more");
    if (s->most_samples > 0 && s->most_samples < s->samples_per_pixel)
        complain(c, GLINT_ERROR_RANGE, "most_samples is %u, expected 0 or samples_per_pixel, %u, or more",
                 s->most_samples, s->samples_per_pixel);
    check(c, "error_budget", s->error_budget, 0.0F, 1.0F);
    check(c, "bounce_rays", s->bounce_rays, 0.0F, 1e9F);
    check(c, "sky_rays", s->sky_rays, 0.0F, 1e9F);
    check(c, "bounced", s->bounced, 0.0F, 1e9F);
    check(c, "noise", s->noise, 0.0F, 1e9F);
    check(c, "noise_fall", s->noise_fall, 1.0F, 3.0F);
    check(c, "noise_spread", s->noise_spread, 0.0F, 1e9F);
    check(c, "contrast", s->contrast, 1.0F, 1e20F);
    if (!s->allocator.allocate != !s->allocator.release)
        complain(c, GLINT_ERROR_ARGUMENT, "allocator has only one of allocate and release, expected both or neither");
    for (uint32_t i = 0; i < s->material_count; i++) {
        if (!s->materials[i].base)
            complain(c, GLINT_ERROR_ARGUMENT, "materials[%u].base is NULL, expected its options", i);
        check(c, "materials[].seen", s->materials[i].seen, 0.0F, 1.0F);
    }
    for (uint32_t i = 0; i < s->pair_count && c->result == GLINT_OK; i++)
        check_pair(c, s, i);
}

/* What a material can say at most: its look-ups, colours, layers, anisotropy, textures, normal maps and alpha. */
enum { MOST_PER_MATERIAL = 7, MOST_PER_PAIR = 5, MOST_PER_LIGHT = 2, MOST_OF_ALL = 3 };

static glint_plan *make(const glint_plan_summary *s)
{
    glint_allocator a = s->allocator;
    if (!a.allocate)
        a = (glint_allocator){ allocate_default, release_default, NULL };
    const size_t materials = s->material_count, lights = s->light_count;
    const size_t decisions =
        materials * MOST_PER_MATERIAL + s->pair_count * MOST_PER_PAIR + lights * MOST_PER_LIGHT + MOST_OF_ALL;
    /* One piece: the plan, then its arrays, those with pointers or larger members first. */
    const size_t size = sizeof(glint_plan) + materials * sizeof(plan_material) + decisions * sizeof(glint_decision) +
                        2 * lights * sizeof(float) + (materials + 1 + s->pair_count) * sizeof(uint32_t);
    glint_plan *const p = a.allocate(size, a.user);
    if (!p)
        return NULL;
    memset(p, 0, size);
    p->summary = *s;
    p->fewest = s->samples_per_pixel;
    p->allocator = a;
    p->materials = (plan_material *)(p + 1);
    p->decisions = (glint_decision *)(p->materials + materials);
    p->light_seen = (float *)(p->decisions + decisions);
    p->light_shadows = p->light_seen + lights;
    p->first_pair = (uint32_t *)(p->light_shadows + lights);
    p->pairs = p->first_pair + materials + 1;
    p->capacity = (uint32_t)decisions;
    return p;
}

/* Puts the pairs in the order of their materials: counts, adds up, and fills each material's part from its end. */
static void sort_pairs(glint_plan *p)
{
    const glint_plan_summary *const s = &p->summary;
    for (uint32_t i = 0; i < s->pair_count; i++) {
        p->first_pair[s->pairs[i].material]++;
        p->light_seen[s->pairs[i].light] += s->pairs[i].seen;
        p->light_shadows[s->pairs[i].light] += s->pairs[i].is_clear ? 0.0F : s->pairs[i].shadow_rays;
    }
    uint32_t sum = 0;
    for (uint32_t m = 0; m <= s->material_count; m++)
        sum = p->first_pair[m] += sum;
    for (uint32_t i = s->pair_count; i-- > 0;)
        p->pairs[--p->first_pair[s->pairs[i].material]] = i;
}

/* Materials whose facets can be left out by degrees. */
static void decide_facets(glint_plan *p)
{
    int draws = 0;
    for (uint32_t m = 0; m < p->summary.material_count; m++)
        draws += plan_draws(p, m);
    const int can_draw = draws > 0 && p->summary.samples_per_pixel > p->summary.tiles_per_pixel;
    const double each = plan_left(p, can_draw ? 2 : 1);
    for (uint32_t m = 0; m < p->summary.material_count; m++)
        plan_facets(p, m, each, can_draw && plan_draws(p, m) ? each : 0.0);
}

static void decide_by(glint_plan *p, uint32_t samples, double budget, int is_strict)
{
    p->summary.samples_per_pixel = samples;
    p->budget = budget;
    p->is_strict = is_strict;
    p->variance = p->excess = 0.0;
    p->count = 0;
    p->outcome = (glint_plan_outcome){ 0 };
    memset(p->materials, 0, p->summary.material_count * sizeof(plan_material));
    plan_surfaces(p);
    plan_bounces(p);
    plan_lights(p);
    plan_shadows(p);
    decide_facets(p);
    plan_samples(p);
}

/* Of a few sparks on black, facets that flip are far more of the picture's mean than of its root mean square. Where
 * that can be kept within the budget as well it is, unless it takes so many times as long. Taste. */
#define STRICT_PRICE 1.25

static void decide(glint_plan *p, uint32_t samples, double budget)
{
    decide_by(p, samples, budget, 0);
    if (!((double)p->outcome.error_of_mean > budget))
        return;
    const double most = STRICT_PRICE * (double)p->outcome.ns_per_sample;
    decide_by(p, samples, budget, 1);
    if ((double)p->outcome.ns_per_sample > most)
        decide_by(p, samples, budget, 0);
}

static void share_out_time(glint_plan *p)
{
    for (uint32_t i = 0; i < p->count; i++)
        p->decisions[i].time_share = p->decisions[i].ns_per_sample / fmaxf(p->outcome.ns_per_sample, 1e-9F);
}

glint_result glint_plan_create(const glint_plan_summary *summary, glint_plan **plan, char *message, size_t message_size)
{
    complaint c = { message, message_size, GLINT_OK };
    if (message && message_size > 0)
        message[0] = '\0';
    if (!plan)
        return GLINT_ERROR_ARGUMENT;
    *plan = NULL;
    if (!summary) {
        complain(&c, GLINT_ERROR_ARGUMENT, "summary is NULL");
        return c.result;
    }
    check_summary(&c, summary);
    if (c.result != GLINT_OK)
        return c.result;
    glint_plan *const p = make(summary);
    if (!p) {
        complain(&c, GLINT_ERROR_MEMORY, "there is not enough memory for a plan of %u materials and %u lights",
                 summary->material_count, summary->light_count);
        return c.result;
    }
    sort_pairs(p);
    if (p->summary.most_samples > 0)
        plan_choose_samples(p, decide);
    else
        decide(p, p->summary.samples_per_pixel, (double)p->summary.error_budget);
    share_out_time(p);
    *plan = p;
    return GLINT_OK;
}

void glint_plan_destroy(glint_plan *plan)
{
    if (plan) {
        const glint_allocator a = plan->allocator;
        a.release(plan, a.user);
    }
}

/* ---- what it says ---- */

uint32_t glint_plan_decision_count(const glint_plan *plan)
{
    return plan->count;
}

const glint_decision *glint_plan_decision(const glint_plan *plan, uint32_t index)
{
    return index < plan->count ? &plan->decisions[index] : NULL;
}

glint_plan_outcome glint_plan_result(const glint_plan *plan)
{
    return plan->outcome;
}

void glint_plan_cut(const glint_plan *plan, uint32_t material, glint_material_options *options)
{
    if (material >= plan->summary.material_count)
        return;
    const plan_material *const m = &plan->materials[material];
    if (m->is_smooth)
        options->model = GLINT_MODEL_SMOOTH;
    options->smooth_deviation = m->smooth_deviation;
    options->draw_deviation = m->draw_deviation;
    options->area_light_method = m->method;
}
