/* A few hundred pixels, spread evenly over the picture, with a few samples each.
 *
 * Of every light at the first surface it is noted how many facets it lights in the pixel, and which part of the pixel's
 * light that is; of whole samples, what bounces bring and, in survey_noise.c, how much they differ.
 */
#include "preview/survey.h"

#include <stdlib.h>

#include "preview/choose_lights.h"
#include "preview/direct.h"
#include "preview/hash.h"
#include "preview/sampler.h"
#include "preview/surroundings.h"
#include "preview/survey_noise.h"

/* Samples of a pixel that tell what bounces bring. */
#define SAMPLES 4
/* Pixels are as many as cost no more than one sample in so many, within limits. Taste. */
#define RENDERED_FOR_ONE 200
#define LEAST_PIXELS 256
#define MOST_PIXELS 1600
/* What the plan may choose, of pixels without facets from four on, so that their edges are smooth. A picture of 1280 x
 * 720 pixels at a microsecond a sample takes an hour of one core with the most. Taste. */
#define LEAST_SAMPLES 4
#define MOST_SAMPLES 4096
/* Dimensions of the sampler that a path's first vertex does not use. */
#define DIM_SURVEY 1000000U

typedef struct tally {
    const world *world, *direct; /* direct: without bounces */
    survey *out;
    int light_count; /* surroundings included */
    int pixels;
    double square; /* of the light of pixels, and what facets add to that in the mean */
    double bounced, bounce_rays, sky_rays;
} tally;

static double level(const float rgb[3])
{
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
}

/* ---- whole samples ---- */

/* Returns the light of the pixel; 0: it is black. */
static double look_at_samples(tally *t, int x, int y)
{
    double sum = 0.0, direct = 0.0;
    bool is_surface = false;
    for (uint32_t i = 0; i < SAMPLES; ++i) {
        pixel_sample whole, less;
        ray_counts counts = { 0 }, fewer = { 0 };
        integrate(t->world, x, y, i, &whole, &counts);
        less = whole;
        if (t->world->bounces > 0) {
            integrate(t->direct, x, y, i, &less, &fewer);
        } else {
            fewer = counts;
        }
        t->bounce_rays += (double)(counts.bounce_rays - fewer.bounce_rays) / SAMPLES;
        t->sky_rays += (double)fewer.bounce_rays / SAMPLES;
        sum += level(whole.light.smooth);
        direct += level(less.light.smooth);
        is_surface = is_surface || whole.depth > 0.0F;
    }
    /* Where no light comes straight from a light, bounces bring all that there is, however few of them find it. */
    if (t->world->bounces > 0 && is_surface && !(direct > 0.0))
        t->bounced += 1.0;
    else if (sum > 0.0)
        t->bounced += (sum - direct) * (sum - direct) / (sum * sum);
    return sum / SAMPLES;
}

/* ---- lights at the first surface ---- */

/* The pair of a material and a light, empty when it is seen for the first time. */
static glint_plan_pair *pair_of(tally *t, int material, int index)
{
    uint32_t *const known = &t->out->pair_of[(size_t)material * (size_t)t->light_count + (size_t)index];
    if (*known == 0U) {
        glint_plan_pair *const pair = &t->out->pairs[t->out->summary.pair_count++];
        pair->material = (uint32_t)material;
        pair->light = (uint32_t)index;
        *known = t->out->summary.pair_count;
    }
    return &t->out->pairs[*known - 1U];
}

/* What one light brings there; index light_count of the world: its surroundings. */
static radiance look_at_light(const world *w, int index, bool shadowed, const vertex *v, const sampler *random,
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
    own.unshadowed = !shadowed;
    alone.lights = &own;
    alone.light_count = 1;
    const direct_point point = { v, random, all, &sum, facets, 0 };
    add_direct_light(&alone, &point, DIM_SURVEY, counts);
    return sum;
}

/* In which entry of a pair's shapes an evaluation there belongs; negative: in none. */
static int shape_of(const world *w, int index, const vertex *v)
{
    light_view view;
    if (index == w->light_count)
        return -1;
    const light *const l = &w->lights[index];
    const double error = direct_cap_error(l, &v->point, v->hit.position, &view);
    if (!light_is_area(l) && (!light_see(l, v->hit.position, &view) || !(view.sine > 0.0) || error <= SHADE_CAP_ERROR))
        return -1;
    int k = 0;
    while (k < GLINT_PLAN_SHAPES - 1 && error > ldexp(SHADE_CAP_ERROR, k))
        ++k;
    return k;
}

static void note_shape(tally *t, int entry, glint_plan_pair *pair, float evals, double part, double sparks)
{
    if (entry < 0)
        return;
    t->out->lights[pair->light].kind = GLINT_PLAN_LIGHT_SHAPE;
    pair->shapes[entry].seen += evals;
    pair->shapes[entry].part += (float)part;
    t->out->sparks[(pair - t->out->pairs) * GLINT_PLAN_SHAPES + entry] += sparks;
}

/* Of many lights a render chooses some, and we look at those: as often as it evaluates them, each for those that it
 * stands for. */
static void note_light(tally *t, int index, double probability, const vertex *v, const sampler *random, double pixel)
{
    const world *const w = t->world;
    glint_plan_light *const to = &t->out->lights[index];
    glint_plan_pair *const pair = pair_of(t, v->hit.mesh->material, index);
    direct_facets facets = { 0 }, unused = { 0 };
    ray_counts counts = { 0 }, none = { 0 };
    const radiance seen = look_at_light(w, index, true, v, random, &facets, &counts);
    if (index < w->light_count && counts.shadow_rays > 0) {
        const radiance all = look_at_light(w, index, false, v, random, &unused, &none);
        to->shadow_rays += (uint32_t)counts.shadow_rays;
        to->blocked_rays += level(seen.smooth) < level(all.smooth);
    }
    const double bright = level(seen.smooth), share = bright / pixel, part = share * share / probability;
    const double tiles = (double)w->glint_side * (double)w->glint_side;
    const double lit = (double)facets.count * tiles * (double)facets.lit_probability;
    const double sparks = lit > 0.0 ? bright * bright / (lit * probability) : 0.0;
    const float evals = (float)(counts.glint_evals + counts.smooth_evals);
    t->square += sparks;
    pair->seen += evals;
    note_shape(t, shape_of(w, index, v), pair, evals, part, sparks);
    if (!(facets.count > 0.0F))
        return;
    const uint32_t bin = glint_plan_bin((float)lit);
    pair->share[bin] += (float)part;
    pair->rate[bin] += (float)counts.glint_evals;
}

static void widen(glint_plan_range *range, float x)
{
    range->least = fminf(range->least, x);
    range->most = fmaxf(range->most, x);
}

static void note_surface(tally *t, const vertex *v)
{
    glint_plan_material *const m = &t->out->materials[v->hit.mesh->material];
    const float tiles = (float)(t->world->glint_side * t->world->glint_side);
    m->seen += 1.0F;
    for (int i = 0; i < v->point.layer_count; ++i) {
        const shade_layer *const layer = &v->point.layers[i];
        widen(&m->alpha, layer->surface.alpha_x);
        widen(&m->alpha, layer->surface.alpha_y);
        if (!layer->counts)
            continue;
        const glint_footprint *const f = &layer->footprint;
        widen(&m->facets_per_m2, layer->surface.facets_per_m2);
        widen(&m->footprint_m2, tiles * fabsf(f->dudx * f->dvdy - f->dudy * f->dvdx));
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

static void look_at_pixel(tally *t, int x, int y)
{
    vertex v;
    const double pixel = look_at_samples(t, x, y);
    ++t->pixels;
    t->square += pixel * pixel;
    if (!(pixel > 0.0) || !integrate_first(t->world, x, y, 0, &v))
        return;
    const sampler random = sampler_make(x, y, 0, t->world->seed);
    note_surface(t, &v);
    if (v.point.layer_count == 0)
        return;
    chosen_light lights[MOST_LIGHTS];
    const int count = lights_of_pixel(t->world, &v, &random, lights);
    for (int i = 0; i < count; ++i)
        note_light(t, lights[i].index, (double)lights[i].probability, &v, &random, pixel);
    if (t->light_count > t->world->light_count)
        note_light(t, t->world->light_count, 1.0, &v, &random, pixel);
}

/* ---- the summary ---- */

/* By material, then by light. */
static int compare_pairs(const void *a, const void *b)
{
    const glint_plan_pair *const x = a, *const y = b;
    return x->material != y->material ? (x->material > y->material) - (x->material < y->material)
                                      : (x->light > y->light) - (x->light < y->light);
}

/* Drops pairs under which nothing was evaluated, and turns sums into means. */
static void end_pairs(survey *s, const tally *t)
{
    const float inverse = 1.0F / (float)t->pixels;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s->summary.pair_count; ++i) {
        glint_plan_pair pair = s->pairs[i];
        if (!(pair.seen > 0.0F))
            continue;
        pair.seen *= inverse;
        for (int k = 0; k < GLINT_PLAN_SHAPES; ++k) {
            const double sparks = s->sparks[i * GLINT_PLAN_SHAPES + (uint32_t)k];
            pair.shapes[k].seen *= inverse;
            pair.shapes[k].part *= inverse;
            pair.shapes[k].sparks = t->square > 0.0 ? (float)(sparks / t->square) : 0.0F;
        }
        for (int b = 0; b < GLINT_PLAN_BINS; ++b) {
            pair.share[b] *= inverse;
            pair.rate[b] *= inverse;
        }
        s->pairs[kept++] = pair;
    }
    s->summary.pair_count = kept;
    qsort(s->pairs, kept, sizeof *s->pairs, compare_pairs);
}

/* Fewer samples than there are tiles would show other facets. */
static bool shows_facets(const survey *s)
{
    for (uint32_t i = 0; i < s->summary.pair_count; ++i)
        for (int b = 0; b < GLINT_PLAN_BINS; ++b)
            if (s->pairs[i].rate[b] > 0.0F)
                return true;
    return false;
}

static void end_samples(survey *s, const tally *t, const survey_noise *noise, const preview_options *o)
{
    glint_plan_summary *const to = &s->summary;
    to->samples_per_pixel = (uint32_t)t->world->spp;
    to->tiles_per_pixel = (uint32_t)(t->world->glint_side * t->world->glint_side);
    to->noise = (float)noise->deviation;
    to->noise_samples = noise->samples;
    to->noise_fall = (float)noise->fall;
    to->noise_spread = (float)noise->spread;
    if (o->spp > 0)
        return;
    to->samples_per_pixel = shows_facets(s) ? to->tiles_per_pixel : LEAST_SAMPLES;
    to->most_samples = MOST_SAMPLES;
}

static void end(survey *s, const tally *t, const survey_noise *noise, const preview_options *o)
{
    const world *const w = t->world;
    glint_plan_summary *const to = &s->summary;
    to->materials = s->materials;
    to->lights = s->lights;
    to->pairs = s->pairs;
    to->material_count = (uint32_t)w->shader.scene->material_count;
    to->light_count = (uint32_t)t->light_count;
    to->pixel_count = (uint32_t)t->pixels;
    to->bounces = (uint32_t)w->bounces;
    to->error_budget = (float)o->accuracy;
    if (t->pixels == 0)
        return;
    end_pairs(s, t);
    end_samples(s, t, noise, o);
    to->bounce_rays = (float)fmax(t->bounce_rays / t->pixels, 0.0);
    to->sky_rays = (float)(t->sky_rays / t->pixels);
    to->bounced = (float)sqrt(fmax(t->bounced / t->pixels, 0.0));
    for (uint32_t i = 0; i < to->material_count; ++i)
        s->materials[i].seen /= (float)t->pixels;
}

/* Samples of each pixel by which noise is told. */
static int noise_samples(const preview_options *o)
{
    return o->spp > 0 && o->spp < SURVEY_MOST_SAMPLES ? o->spp : SURVEY_MOST_SAMPLES;
}

/* Columns and rows of pixels to look at. */
static void choose_grid(const world *w, const preview_options *o, int *columns, int *rows)
{
    const double pixels = (double)o->width * o->height, each = 2 * (SAMPLES + noise_samples(o));
    const double wanted = fmin(fmax(pixels * w->spp / RENDERED_FOR_ONE / each, LEAST_PIXELS), MOST_PIXELS);
    *columns = (int)fmin(fmax(sqrt(wanted * o->width / o->height), 1.0), o->width);
    *rows = (int)fmin(fmax(wanted / *columns, 1.0), o->height);
}

/* One in each cell of a grid. */
static survey_place place_in(int column, int row, int columns, int rows, const preview_options *o)
{
    const uint32_t jitter = hash_combine(hash_combine(hash_mix(1U), (uint32_t)column), (uint32_t)row);
    const double u = (column + (double)(jitter >> 16) * 0x1p-16) / columns;
    const double v = (row + (double)(jitter & 0xffffU) * 0x1p-16) / rows;
    return (survey_place){ (int)(u * o->width), (int)(v * o->height) };
}

static bool look(tally *t, const preview_options *o, bool with_noise, int columns, int rows, report *r)
{
    survey_noise noise = { .samples = 1, .fall = 1.0 };
    survey_place *const places = calloc((size_t)columns * (size_t)rows, sizeof *places);
    if (places == NULL)
        return report_error(r, "no memory to look at %d x %d pixels", columns, rows);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            survey_place *const at = &places[y * columns + x];
            *at = place_in(x, y, columns, rows, o);
            look_at_pixel(t, at->x, at->y);
        }
    }
    const double enough = o->spp > 0 ? 0.0 : o->accuracy / 2.0;
    const bool done =
        !with_noise || survey_noise_measure(t->world, places, t->pixels, noise_samples(o), enough, &noise, r);
    free(places);
    if (done)
        end(t->out, t, &noise, o);
    return done;
}

bool survey_make(const world *w, const preview_options *o, bool with_noise, survey *out, report *r)
{
    world direct = *w;
    tally t = { .world = w, .direct = &direct, .out = out, .light_count = w->light_count + survey_has_surroundings(w) };
    int columns, rows;
    choose_grid(w, o, &columns, &rows);
    if (!survey_begin(out, w, o, t.light_count, (size_t)columns * (size_t)rows * (MOST_LIGHTS + 1), r))
        return false;
    direct.bounces = 0;
    direct.emitters = NULL;
    if (look(&t, o, with_noise, columns, rows, r))
        return true;
    survey_free(out);
    return false;
}
