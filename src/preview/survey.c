/* A few hundred pixels, spread evenly over the picture, with a few samples each.
 *
 * Of every light at the first surface it is noted how many facets it lights in the pixel, and which part of the pixel's
 * light that is; of whole samples, how much they differ and what bounces bring.
 */
#include "preview/survey.h"

#include <stdio.h>
#include <stdlib.h>

#include "preview/choose_lights.h"
#include "preview/direct.h"
#include "preview/hash.h"
#include "preview/sampler.h"
#include "preview/surroundings.h"
#include "scene/surface.h"

/* Samples of a pixel: enough for a variance. */
#define SAMPLES 4
/* Pixels are as many as cost no more than one sample in so many, within limits. Taste. */
#define RENDERED_FOR_ONE 800
#define LEAST_PIXELS 100
#define MOST_PIXELS 900
/* Dimensions of the sampler that a path's first vertex does not use. */
#define DIM_SURVEY 1000000U

typedef struct tally {
    const world *world, *direct; /* direct: without bounces */
    survey *out;
    int light_count; /* surroundings included */
    int pixels;
    double noise, bounced, bounce_rays, sky_rays;
} tally;

static double level(const float rgb[3])
{
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
}

/* ---- whole samples ---- */

/* Returns the light of the pixel; 0: it is black. */
static double look_at_samples(tally *t, int x, int y)
{
    double sum = 0.0, square = 0.0, direct = 0.0;
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
        square += level(whole.light.smooth) * level(whole.light.smooth);
        direct += level(less.light.smooth);
        is_surface = is_surface || whole.depth > 0.0F;
    }
    /* Where no light comes straight from a light, bounces bring all that there is, however few of them find it. */
    if (t->world->bounces > 0 && is_surface && !(direct > 0.0))
        t->bounced += 1.0;
    else if (sum > 0.0)
        t->bounced += (sum - direct) * (sum - direct) / (sum * sum);
    const double mean = sum / SAMPLES;
    if (mean > 0.0)
        t->noise += fmax(square - sum * mean, 0.0) / (SAMPLES - 1) / (mean * mean);
    return mean;
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
    add_direct_light(&alone, &v->hit, &v->point, random, DIM_SURVEY, all, &sum, facets, counts);
    return sum;
}

/* Where its shape is told, and how its light is found follows from that. */
static bool is_shape(const world *w, int index, const vertex *v)
{
    light_view view;
    return index < w->light_count && light_see(&w->lights[index], v->hit.position, &view) && view.sine > 0.0 &&
           shade_tells_shape(&v->point, view.wi, view.sine);
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
    if (is_shape(w, index, v))
        to->kind = GLINT_PLAN_LIGHT_SHAPE;
    const double evals = (double)(counts.glint_evals + counts.smooth_evals);
    pair->seen += (float)evals;
    if (!(facets.count > 0.0F))
        return;
    const double tiles = (double)w->glint_side * (double)w->glint_side, share = level(seen.smooth) / pixel;
    const uint32_t bin = glint_plan_bin((float)((double)facets.count * tiles * (double)facets.lit_probability));
    pair->share[bin] += (float)(share * share / probability);
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

static uint32_t count_textures(const scene_material *m, uint32_t *normal_maps)
{
    const scene_texture *list[SCENE_MATERIAL_TEXTURES];
    uint32_t count = 0;
    scene_material_textures(m, list);
    for (int i = 0; i < SCENE_MATERIAL_TEXTURES; ++i) {
        const bool is_normal = list[i] == &m->normal_texture || list[i] == &m->clearcoat_normal_texture;
        const bool is_example = list[i] == &m->glint.example_texture || list[i] == &m->coat_glint.example_texture;
        if (list[i]->image == SCENE_NONE || is_example)
            continue;
        *normal_maps += is_normal;
        count += !is_normal;
    }
    return count;
}

static void begin_materials(survey *out, const scene *s, const preview_options *o)
{
    for (int i = 0; i < s->material_count; ++i) {
        const scene_material *const from = &s->materials[i];
        glint_material_options *const base = &out->options[2 * i], *const coat = base + 1;
        *base = scene_base_options(from, materials_model(s, i, SCENE_LAYER_BASE, o->model));
        *coat = scene_coat_options(from, materials_model(s, i, SCENE_LAYER_CLEARCOAT, o->model));
        glint_plan_material *const m = &out->materials[i];
        *m = (glint_plan_material){ .name = from->name,
                                    .base = base,
                                    .coat = from->clearcoat > 0.0F ? coat : NULL,
                                    .is_cut_out = from->alpha_mode != SCENE_ALPHA_OPAQUE };
        m->texture_count = count_textures(from, &m->normal_map_count);
        m->alpha.least = m->facets_per_m2.least = m->footprint_m2.least = HUGE_VALF;
    }
}

static void begin_lights(survey *out, const world *w)
{
    const scene *const s = w->shader.scene;
    for (int i = 0; i < w->light_count; ++i) {
        char *const name = out->light_names[i].text;
        const size_t size = sizeof out->light_names[i].text;
        if (i < s->light_count && s->lights[i].name != NULL && s->lights[i].name[0] != '\0')
            snprintf(name, size, "light '%s'", s->lights[i].name);
        else
            snprintf(name, size, "light %d", i);
        out->lights[i] =
            (glint_plan_light){ .name = name,
                                .kind = light_is_area(&w->lights[i]) ? GLINT_PLAN_LIGHT_SHAPE : GLINT_PLAN_LIGHT_CAP };
    }
}

static bool has_surroundings(const world *w)
{
    return w->environment != NULL || w->emitters != NULL;
}

static void begin_surroundings(survey *out, const world *w)
{
    if (!has_surroundings(w))
        return;
    survey_name *const name = &out->light_names[w->light_count];
    snprintf(name->text, sizeof name->text, "%s", w->environment != NULL ? "the environment" : "what glows");
    out->lights[w->light_count] =
        (glint_plan_light){ .name = name->text,
                            .kind = GLINT_PLAN_LIGHT_SURROUNDINGS,
                            .patch_count = w->environment != NULL ? (uint32_t)w->environment->patch_count
                                                                  : (uint32_t)w->emitters->count };
}

/* most_pairs: that can be seen. */
static bool begin(survey *out, const world *w, const preview_options *o, int light_count, size_t most_pairs, report *r)
{
    const scene *const s = w->shader.scene;
    const size_t material_count = (size_t)s->material_count + 1U, lights = (size_t)light_count + 1U;
    *out = (survey){ .summary = GLINT_PLAN_SUMMARY_INIT };
    out->options = calloc(2 * material_count, sizeof *out->options);
    out->materials = calloc(material_count, sizeof *out->materials);
    out->lights = calloc(lights, sizeof *out->lights);
    out->light_names = calloc(lights, sizeof *out->light_names);
    out->pairs = calloc(most_pairs, sizeof *out->pairs);
    out->pair_of = calloc(material_count * lights, sizeof *out->pair_of);
    if (out->options == NULL || out->materials == NULL || out->lights == NULL || out->light_names == NULL ||
        out->pairs == NULL || out->pair_of == NULL) {
        survey_free(out);
        return report_error(r, "no memory to look at %zu materials under %zu lights", material_count, lights);
    }
    begin_materials(out, s, o);
    begin_lights(out, w);
    begin_surroundings(out, w);
    return true;
}

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
        for (int b = 0; b < GLINT_PLAN_BINS; ++b) {
            pair.share[b] *= inverse;
            pair.rate[b] *= inverse;
        }
        s->pairs[kept++] = pair;
    }
    s->summary.pair_count = kept;
    qsort(s->pairs, kept, sizeof *s->pairs, compare_pairs);
}

static void end(survey *s, const tally *t, const preview_options *o)
{
    const world *const w = t->world;
    glint_plan_summary *const to = &s->summary;
    to->materials = s->materials;
    to->lights = s->lights;
    to->pairs = s->pairs;
    to->material_count = (uint32_t)w->shader.scene->material_count;
    to->light_count = (uint32_t)t->light_count;
    to->samples_per_pixel = (uint32_t)w->spp;
    to->tiles_per_pixel = (uint32_t)(w->glint_side * w->glint_side);
    to->pixel_count = (uint32_t)t->pixels;
    to->bounces = (uint32_t)w->bounces;
    to->error_budget = (float)o->accuracy;
    if (t->pixels == 0)
        return;
    end_pairs(s, t);
    to->bounce_rays = (float)fmax(t->bounce_rays / t->pixels, 0.0);
    to->sky_rays = (float)(t->sky_rays / t->pixels);
    to->bounced = (float)sqrt(fmax(t->bounced / t->pixels, 0.0));
    to->noise = (float)sqrt(t->noise / t->pixels);
    for (uint32_t i = 0; i < to->material_count; ++i)
        s->materials[i].seen /= (float)t->pixels;
}

/* Columns and rows of pixels to look at. */
static void choose_grid(const preview_options *o, int *columns, int *rows)
{
    const double pixels = (double)o->width * o->height;
    const double wanted = fmin(fmax(pixels * o->spp / RENDERED_FOR_ONE / (2 * SAMPLES), LEAST_PIXELS), MOST_PIXELS);
    *columns = (int)fmin(fmax(sqrt(wanted * o->width / o->height), 1.0), o->width);
    *rows = (int)fmin(fmax(wanted / *columns, 1.0), o->height);
}

bool survey_make(const world *w, const preview_options *o, survey *out, report *r)
{
    world direct = *w;
    tally t = { .world = w, .direct = &direct, .out = out, .light_count = w->light_count + has_surroundings(w) };
    int columns, rows;
    choose_grid(o, &columns, &rows);
    if (!begin(out, w, o, t.light_count, (size_t)columns * (size_t)rows * (MOST_LIGHTS + 1), r))
        return false;
    direct.bounces = 0;
    direct.emitters = NULL;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const uint32_t jitter = hash_combine(hash_combine(hash_mix(1U), (uint32_t)x), (uint32_t)y);
            const double u = (x + (double)(jitter >> 16) * 0x1p-16) / columns;
            const double v = (y + (double)(jitter & 0xffffU) * 0x1p-16) / rows;
            look_at_pixel(&t, (int)(u * o->width), (int)(v * o->height));
        }
    }
    end(out, &t, o);
    return true;
}

void survey_free(survey *s)
{
    free(s->options);
    free(s->materials);
    free(s->lights);
    free(s->light_names);
    free(s->pairs);
    free(s->pair_of);
    *s = (survey){ 0 };
}
