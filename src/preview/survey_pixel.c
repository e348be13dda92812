/* A pixel with a few samples: whole, for what bounces bring to it, and light by light at its first surface. */
#include "preview/survey_pixel.h"

#include "preview/direct.h"
#include "preview/sampler.h"
#include "preview/surroundings.h"
#include "preview/survey.h"

/* Dimensions of the sampler that a path's first vertex does not use. */
#define DIM_SURVEY 1000000U

/* ---- whole samples ---- */

static void look_at_samples(const world *w, const world *direct, int x, int y, survey_pixel *out)
{
    double sum = 0.0, straight = 0.0;
    bool is_surface = false;
    for (uint32_t i = 0; i < SURVEY_SAMPLES; ++i) {
        pixel_sample whole, less;
        ray_counts counts = { 0 }, fewer = { 0 };
        integrate(w, x, y, i, &whole, &counts);
        less = whole;
        if (w->bounces > 0) {
            integrate(direct, x, y, i, &less, &fewer);
        } else {
            fewer = counts;
        }
        out->bounce_rays += (double)(counts.bounce_rays - fewer.bounce_rays) / SURVEY_SAMPLES;
        out->sky_rays += (double)fewer.bounce_rays / SURVEY_SAMPLES;
        sum += survey_level(whole.light.smooth);
        straight += survey_level(less.light.smooth);
        is_surface = is_surface || whole.depth > 0.0F;
    }
    /* Where no light comes straight from a light, bounces bring all that there is, however few of them find it. */
    if (w->bounces > 0 && is_surface && !(straight > 0.0))
        out->bounced = 1.0;
    else if (sum > 0.0)
        out->bounced = (sum - straight) * (sum - straight) / (sum * sum);
    out->level = sum / SURVEY_SAMPLES;
}

/* ---- lights at the first surface ---- */

/* How a light is looked at. */
typedef struct looking {
    bool shadowed, as_cap; /* as_cap: wherever it can be one */
} looking;

/* What one light brings there; index light_count of the world: its surroundings. */
static radiance look_at_light(const world *w, int index, looking how, const vertex *v, const sampler *random,
                              direct_facets *facets, ray_counts *counts)
{
    static const float all[3] = { 1.0F, 1.0F, 1.0F };
    radiance sum = { 0 };
    if (index == w->light_count) {
        add_glow(w, &v->hit, &v->point, random, DIM_SURVEY, all, &sum, facets, counts);
        add_surroundings(w, &v->hit, &v->point, random, DIM_SURVEY + 1U, all, &sum, facets, counts);
        return sum;
    }
    light own = w->lights[index];
    world alone = *w;
    own.unshadowed = !how.shadowed;
    alone.lights = &own;
    alone.light_count = 1;
    alone.cap_error = how.as_cap ? (double)INFINITY : 0.0;
    const direct_point point = { v, random, all, &sum, facets, 0 };
    add_direct_light(&alone, &point, DIM_SURVEY, counts);
    return sum;
}

/* In which entry of a pair's shapes an evaluation there belongs, and what it would be as a cap. */
static void note_shape(const world *w, const vertex *v, const sampler *random, survey_light *to)
{
    light_view view;
    direct_facets facets = { 0 };
    ray_counts none = { 0 };
    to->shape = -1;
    if (to->index == w->light_count)
        return;
    const light *const l = &w->lights[to->index];
    const double error = direct_cap_error(l, &v->point, v->hit.position, &view);
    if (!light_is_area(l) && (!light_see(l, v->hit.position, &view) || !(view.sine > 0.0) || error <= SHADE_CAP_ERROR))
        return;
    to->shape = 0;
    while (to->shape < GLINT_PLAN_SHAPES - 1 && error > ldexp(SHADE_CAP_ERROR, to->shape))
        ++to->shape;
    if (to->shape == GLINT_PLAN_SHAPES - 1 || !(to->level > 0.0))
        return;
    const radiance cap =
        look_at_light(w, to->index, (looking){ .shadowed = true, .as_cap = true }, v, random, &facets, &none);
    to->cap_off = survey_level(cap.smooth) / to->level - 1.0;
    to->cap_share = direct_cap_share(error, ldexp(SHADE_CAP_ERROR, to->shape));
}

/* The point with what its single facets reflect and nothing else: neither what is smooth in another layer nor what is
 * diffuse, which may be many orders brighter where hardly a facet is lit. (A coat then takes nothing of its base, which
 * is a few percent more than there is.) */
static vertex facets_alone(const vertex *v)
{
    vertex alone = *v;
    for (int i = 0; i < alone.point.layer_count; ++i) {
        shade_layer *const layer = &alone.point.layers[i];
        glint_surface *const s = &layer->surface;
        layer->is_own = false;
        for (int c = 0; c < 3; ++c) {
            s->diffuse[c] = 0.0F;
            s->f0[c] = layer->counts ? s->f0[c] : 0.0F;
            s->f90[c] = layer->counts ? s->f90[c] : 0.0F;
        }
    }
    return alone;
}

/* Of many lights a render chooses some, and we look at those: as often as it evaluates them, each for those that it
 * stands for. */
static survey_light note_light(const world *w, chosen_light chosen, const vertex *v, const sampler *random)
{
    direct_facets facets = { 0 }, unused = { 0 };
    ray_counts counts = { 0 }, none = { 0 };
    const radiance seen = look_at_light(w, chosen.index, (looking){ .shadowed = true }, v, random, &facets, &counts);
    survey_light note = { .index = chosen.index,
                          .probability = (double)chosen.probability,
                          .level = survey_level(seen.smooth),
                          .glint_evals = counts.glint_evals,
                          .smooth_evals = counts.smooth_evals };
    if (chosen.index < w->light_count && counts.shadow_rays > 0) {
        const radiance all = look_at_light(w, chosen.index, (looking){ .shadowed = false }, v, random, &unused, &none);
        note.shadow_rays = counts.shadow_rays;
        note.is_blocked = note.level < survey_level(all.smooth);
    }
    note_shape(w, v, random, &note);
    const double tiles = (double)w->glint_side * (double)w->glint_side;
    note.counts = facets.count > 0.0F;
    note.lit = (double)facets.count * tiles * (double)facets.lit_probability;
    if (note.lit > 0.0) {
        const vertex alone = facets_alone(v);
        const radiance shown =
            look_at_light(w, chosen.index, (looking){ .shadowed = true }, &alone, random, &unused, &none);
        note.facet_level = survey_level(shown.smooth);
    }
    return note;
}

static void widen(glint_plan_range *range, float x)
{
    range->least = fminf(range->least, x);
    range->most = fmaxf(range->most, x);
}

static void note_surface(const world *w, const vertex *v, survey_pixel *out)
{
    const float tiles = (float)(w->glint_side * w->glint_side);
    out->material = v->hit.mesh->material;
    for (int i = 0; i < v->point.layer_count; ++i) {
        const shade_layer *const layer = &v->point.layers[i];
        widen(&out->alpha, layer->surface.alpha_x);
        widen(&out->alpha, layer->surface.alpha_y);
        if (!layer->counts)
            continue;
        const glint_footprint *const f = &layer->footprint;
        widen(&out->facets_per_m2, layer->surface.facets_per_m2);
        widen(&out->footprint_m2, tiles * fabsf(f->dudx * f->dvdy - f->dudy * f->dvdx));
    }
}

static int lights_of_pixel(const world *w, const vertex *v, const sampler *random, chosen_light lights[MOST_LIGHTS])
{
    if (w->light_count > MOST_LIGHTS)
        return lights_choose(w->light_tree, &v->point, v->hit.position, random, DIM_SURVEY + 2U, lights);
    for (int i = 0; i < w->light_count; ++i)
        lights[i] = (chosen_light){ i, 1.0F };
    return w->light_count;
}

void survey_pixel_look(const world *w, const world *direct, int x, int y, survey_pixel *out)
{
    vertex v;
    chosen_light lights[MOST_LIGHTS];
    *out = (survey_pixel){ .material = -1 };
    out->alpha.least = out->facets_per_m2.least = out->footprint_m2.least = HUGE_VALF;
    look_at_samples(w, direct, x, y, out);
    if (!(out->level > 0.0) || !integrate_first(w, x, y, 0, &v))
        return;
    const sampler random = sampler_make(x, y, 0, w->seed);
    note_surface(w, &v, out);
    if (v.point.layer_count == 0)
        return;
    const int count = lights_of_pixel(w, &v, &random, lights);
    for (int i = 0; i < count; ++i)
        out->lights[out->light_count++] = note_light(w, lights[i], &v, &random);
    if (survey_has_surroundings(w))
        out->lights[out->light_count++] = note_light(w, (chosen_light){ w->light_count, 1.0F }, &v, &random);
}
