/* A few hundred pixels, spread evenly over the picture, with a few samples each.
 *
 * Threads look at them (survey_pixel.c), and here what they saw is added up, pixel by pixel in the order of the grid,
 * so that a plan does not depend on their number. Of every light at the first surface it is noted how many facets it
 * lights in the pixel, and which part of the pixel's light that is; of whole samples, what bounces bring and, in
 * survey_noise.c, how much they differ.
 */
#include "preview/survey.h"

#include <stdlib.h>

#include "preview/hash.h"
#include "preview/survey_noise.h"
#include "preview/survey_pixel.h"
#include "preview/threads.h"

/* Pixels are as many as cost no more than one sample in so many, within limits. Taste. */
#define RENDERED_FOR_ONE 200
#define LEAST_PIXELS 256
#define MOST_PIXELS 1600
/* What the plan may choose, of pixels without facets from four on, so that their edges are smooth. A picture of 1280 x
 * 720 pixels at a microsecond a sample takes an hour of one core with the most. Taste. */
#define LEAST_SAMPLES 4
#define MOST_SAMPLES 4096
/* What a plan takes. */
#define MOST_CONTRAST 1e20

typedef struct tally {
    const world *world;
    const uint8_t *sights;
    survey *out;
    int light_count; /* surroundings included */
    int pixels;
    double sum, square; /* of the light of pixels; square: and what facets add to that in the mean */
    double bounced, bounce_rays, sky_rays;
} tally;

/* ---- adding up ---- */

/* The pair of a material and a light, empty when it is seen for the first time. */
static glint_plan_pair *pair_of(tally *t, int material, int index)
{
    uint32_t *const known = &t->out->pair_of[(size_t)material * (size_t)t->light_count + (size_t)index];
    if (*known == 0U) {
        glint_plan_pair *const pair = &t->out->pairs[t->out->summary.pair_count++];
        pair->material = (uint32_t)material;
        pair->light = (uint32_t)index;
        pair->is_clear = index < t->world->light_count &&
                         t->sights[(size_t)material * (size_t)t->world->light_count + (size_t)index] != CLEAR_UNKNOWN;
        *known = t->out->summary.pair_count;
    }
    return &t->out->pairs[*known - 1U];
}

/* What caps are off is the mean over samples that take them and samples that do not, and so is what they turn on and
 * off: of n samples of which each takes one with the chance c the square of the share is c^2 + c (1 - c) / n. */
static void add_shape(tally *t, const survey_light *l, glint_plan_pair *pair, float evals, double part, double sparks)
{
    if (l->shape < 0)
        return;
    glint_plan_shape *const to = &pair->shapes[l->shape];
    survey_sparks *const all = &t->out->sparks[(pair - t->out->pairs) * GLINT_PLAN_SHAPES + l->shape];
    const double square = l->cap_off * l->cap_off * part, chance = l->cap_share;
    const double share = chance * (chance + (1.0 - chance) / t->world->spp);
    t->out->lights[pair->light].kind = GLINT_PLAN_LIGHT_SHAPE;
    to->seen += evals;
    to->part += (float)part;
    to->cap += (float)square;
    to->last_cap += (float)(share * square);
    all->whole += sparks;
    all->last += share * sparks;
}

static void add_light(tally *t, const survey_pixel *from, const survey_light *l)
{
    glint_plan_light *const to = &t->out->lights[l->index];
    glint_plan_pair *const pair = pair_of(t, from->material, l->index);
    const double share = l->level / from->level, part = share * share / l->probability;
    const double sparks = l->lit > 0.0 ? l->facet_level * l->facet_level / (l->lit * l->probability) : 0.0;
    const float evals = (float)(l->glint_evals + l->smooth_evals);
    to->shadow_rays += (uint32_t)l->shadow_rays;
    to->blocked_rays += l->is_blocked;
    t->square += sparks;
    pair->seen += evals;
    pair->shadow_rays += (float)l->shadow_rays;
    add_shape(t, l, pair, evals, part, sparks);
    if (!l->counts)
        return;
    const uint32_t bin = glint_plan_bin((float)l->lit);
    pair->share[bin] += (float)part;
    pair->rate[bin] += (float)l->glint_evals;
}

static void join(glint_plan_range *all, glint_plan_range one)
{
    all->least = fminf(all->least, one.least);
    all->most = fmaxf(all->most, one.most);
}

static void add_pixel(tally *t, const survey_pixel *from)
{
    ++t->pixels;
    t->sum += from->level;
    t->square += from->level * from->level;
    t->bounced += from->bounced;
    t->bounce_rays += from->bounce_rays;
    t->sky_rays += from->sky_rays;
    if (from->material < 0)
        return;
    glint_plan_material *const m = &t->out->materials[from->material];
    m->seen += 1.0F;
    join(&m->alpha, from->alpha);
    join(&m->facets_per_m2, from->facets_per_m2);
    join(&m->footprint_m2, from->footprint_m2);
    for (int i = 0; i < from->light_count; ++i)
        add_light(t, from, &from->lights[i]);
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
        pair.shadow_rays *= inverse;
        for (int k = 0; k < GLINT_PLAN_SHAPES; ++k) {
            const survey_sparks *const sparks = &s->sparks[i * GLINT_PLAN_SHAPES + (uint32_t)k];
            glint_plan_shape *const to = &pair.shapes[k];
            to->seen *= inverse;
            to->part *= inverse;
            to->cap *= inverse;
            to->last_cap *= inverse;
            to->sparks = t->square > 0.0 ? (float)(sparks->whole / t->square) : 0.0F;
            to->last_sparks = t->square > 0.0 ? (float)(sparks->last / t->square) : 0.0F;
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
    if (t->sum > 0.0)
        to->contrast = (float)fmin(fmax(t->square * t->pixels / (t->sum * t->sum), 1.0), MOST_CONTRAST);
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
    const double pixels = (double)o->width * o->height, each = 2 * (SURVEY_SAMPLES + noise_samples(o));
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

/* What the threads read, and where each pixel goes. */
typedef struct task {
    const world *whole, *direct; /* direct: without bounces */
    const survey_place *places;
    survey_pixel *pixels;
} task;

static void look_at_one(void *user, int index)
{
    const task *const t = user;
    survey_pixel_look(t->whole, t->direct, t->places[index].x, t->places[index].y, &t->pixels[index]);
}

static void look_at_all(tally *t, const preview_options *o, const survey_place *places, survey_pixel *pixels, int count)
{
    world direct = *t->world;
    direct.bounces = 0;
    direct.emitters = NULL;
    task shared = { .whole = t->world, .direct = &direct, .places = places, .pixels = pixels };
    threads_each(o->threads, count, look_at_one, &shared);
    for (int i = 0; i < count; ++i)
        add_pixel(t, &pixels[i]);
}

static bool look(tally *t, const preview_options *o, bool with_noise, int columns, int rows, report *r)
{
    survey_noise noise = { .samples = 1, .fall = 1.0 };
    const int count = columns * rows;
    survey_place *const places = calloc((size_t)count, sizeof *places);
    survey_pixel *const pixels = calloc((size_t)count, sizeof *pixels);
    bool done = places != NULL && pixels != NULL;
    if (!done)
        report_error(r, "no memory to look at %d x %d pixels", columns, rows);
    for (int i = 0; done && i < count; ++i)
        places[i] = place_in(i % columns, i / columns, columns, rows, o);
    if (done)
        look_at_all(t, o, places, pixels, count);
    const survey_noise_limits limits = { .samples = noise_samples(o),
                                         .enough = o->spp > 0 ? 0.0 : o->accuracy / 2.0,
                                         .threads = o->threads };
    done = done && (!with_noise || survey_noise_measure(t->world, places, count, &limits, &noise, r));
    free(places);
    free(pixels);
    if (done)
        end(t->out, t, &noise, o);
    return done;
}

bool survey_make(const world *w, const uint8_t *sights, const preview_options *o, bool with_noise, survey *out,
                 report *r)
{
    tally t = { .world = w, .sights = sights, .out = out, .light_count = w->light_count + survey_has_surroundings(w) };
    int columns, rows;
    choose_grid(w, o, &columns, &rows);
    if (!survey_begin(out, w, o, t.light_count, (size_t)columns * (size_t)rows * (MOST_LIGHTS + 1), r))
        return false;
    if (look(&t, o, with_noise, columns, rows, r))
        return true;
    survey_free(out);
    return false;
}
