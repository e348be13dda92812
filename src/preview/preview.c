/* Sets a render up, runs it and takes it down again. */
#include "preview/preview.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "preview/choose_lights.h"
#include "preview/rig.h"
#include "preview/stage.h"
#include "preview/tiles.h"

#define LARGEST_SIDE 65536
#define MOST_SAMPLES 65536
#define MOST_BOUNCES 64
/* A view is looked at with as many where their number is to be planned: the fewest that see all tiles of a pixel. */
#define SAMPLES_TO_PLAN 16

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool check_range(const char *name, int value, int low, int high, report *r)
{
    if (value >= low && value <= high)
        return true;
    return report_error(r, "preview: %s is %d; expected %d to %d", name, value, low, high);
}

bool stage_check_options(const preview_options *o, report *r)
{
    const int last_model = GLINT_MODEL_LAYERED - 1; /* which is made of the others */
    if (o->size != sizeof *o)
        return report_error(r, "preview: the options' size is %zu; expected %zu: start from PREVIEW_OPTIONS_INIT",
                            o->size, sizeof *o);
    if (!check_range("width", o->width, 1, LARGEST_SIDE, r) || !check_range("height", o->height, 1, LARGEST_SIDE, r) ||
        !check_range("spp", o->spp, o->accuracy > 0.0 ? 0 : 1, MOST_SAMPLES, r) ||
        !check_range("bounces", o->bounces, 0, MOST_BOUNCES, r) ||
        !check_range("model", o->model, PREVIEW_MODEL_AUTO, last_model, r) ||
        !check_range("facets", (int)o->facets, PREVIEW_FACETS_OWN, PREVIEW_FACETS_POVRAY, r))
        return false;
    if (!(o->accuracy >= 0.0 && o->accuracy <= 1.0))
        return report_error(r, "preview: accuracy is %g; expected 0 to 1", o->accuracy);
    if (o->threads < 0)
        return report_error(r, "preview: threads is %d; expected 0 (one a core) or more", o->threads);
    if (o->tile_width == 0)
        return true;
    return check_range("tile_x", o->tile_x, 0, o->width - 1, r) &&
           check_range("tile_y", o->tile_y, 0, o->height - 1, r) &&
           check_range("tile_width", o->tile_width, 1, o->width - o->tile_x, r) &&
           check_range("tile_height", o->tile_height, 1, o->height - o->tile_y, r);
}

/* What Embree's filters ask: the opacity of a masked or blended point. */
static float opacity_at(const void *user, const trace_hit *at)
{
    const stage *const st = user;
    return shade_opacity(&st->shader, &st->geometry, at);
}

bool stage_set_environment(stage *st, const preview_options *o, report *r)
{
    const scene_environment *const own = &st->scene->environment;
    preview_environment from = { .map = NULL };
    if (o->environment != NULL) {
        from = *o->environment;
    } else if (own->present && o->sky == NULL) {
        if (!environment_map_from_cube(st->scene, &st->own_map, r))
            return false;
        from = (preview_environment){ .map = &st->own_map, .scale = own->intensity };
        memcpy(from.rotation, own->rotation, sizeof from.rotation);
    } else {
        return true;
    }
    st->has_environment = true;
    return environment_make(&from, &st->environment, r);
}

/* A scene that brings no light, and gets neither sky nor environment, stands in the studio. */
static bool wants_rig(const stage *st, const preview_options *o)
{
    return st->scene->light_count == 0 && o->sky == NULL && !st->has_environment;
}

static bool set_lights(view *v, const stage *st, const preview_options *o, const scene_camera *from_where, report *r)
{
    scene_light rig[RIG_LIGHT_COUNT];
    const bool studio = wants_rig(st, o);
    const int count = studio ? RIG_LIGHT_COUNT : st->scene->light_count;
    const scene_light *const from = studio ? rig : st->scene->lights;
    if (studio)
        rig_lights(from_where, rig);
    v->lights = calloc((size_t)count + ENVIRONMENT_MOST_SUNS, sizeof *v->lights);
    if (v->lights == NULL)
        return report_error(r, "no memory for %d lights", count);
    v->world.lights = v->lights;
    for (int i = 0; i < count; ++i)
        v->lights[v->world.light_count++] = light_make(&from[i]);
    for (int i = 0; i < st->environment.sun_count; ++i)
        v->lights[v->world.light_count++] = light_make(&st->environment.suns[i]);
    if (v->world.light_count <= MOST_LIGHTS)
        return true;
    v->world.light_tree = &v->light_tree;
    return light_tree_make(v->lights, v->world.light_count, &v->light_tree, r);
}

static bool is_blended(const scene *s)
{
    for (int i = 0; i < s->material_count; ++i)
        if (s->materials[i].alpha_mode == SCENE_ALPHA_BLEND)
            return true;
    return false;
}

static bool has_coats(const stage *st)
{
    for (int i = 0; i < st->scene->material_count; ++i)
        if (st->materials.layers[i].coat != NULL)
            return true;
    return false;
}

static void set_sky(world *w, const stage *st, const preview_options *o)
{
    w->has_sky = o->sky != NULL || wants_rig(st, o) || w->environment != NULL;
    w->sky_seen = w->has_sky && !o->transparent;
    if (w->has_sky)
        w->sky = o->sky != NULL ? *o->sky : rig_sky();
}

bool stage_set_up(stage *st, const scene *s, const preview_options *o, double samples, preview_statistics *statistics,
                  report *r)
{
    *st = (stage){ .scene = s };
    const double start = now_s();
    if (!textures_open(s, &st->textures, r))
        return false;
    const double loaded = now_s();
    st->shader = (shader){ s, &st->materials, st->textures, NULL };
    if (!shader_open(&st->shader, r) || !stage_set_environment(st, o, r) ||
        !materials_make(s, o, NULL, &st->materials, r) || !geometry_make(s, &st->geometry, r) ||
        !trace_build(&st->geometry, trace_trees_for(&st->geometry, samples), opacity_at, st, &st->trace, r) ||
        !emitters_make(&st->geometry, &st->emitters, r))
        return false;
    statistics->load_s = loaded - start;
    statistics->build_s = now_s() - loaded;
    return true;
}

void stage_take_down(stage *st)
{
    trace_free(st->trace);
    geometry_free(&st->geometry);
    if (st->materials.scene != NULL)
        materials_free(&st->materials);
    shader_close(&st->shader);
    textures_close(st->textures);
    emitters_free(&st->emitters);
    environment_free(&st->environment);
    environment_map_free(&st->own_map);
}

static scene_camera chosen_camera(const scene *s, const preview_options *o)
{
    if (o->camera != NULL)
        return *o->camera;
    return s->camera_count > 0 ? s->cameras[0] : preview_framed_camera(s, o->width, o->height);
}

bool view_set_up(view *v, const stage *st, const preview_options *o, report *r)
{
    const scene_camera from_where = chosen_camera(st->scene, o);
    *v = (view){ .world = { .kernels = kernels_of_machine(KERNELS_WIDEST),
                            .geometry = &st->geometry,
                            .trace = st->trace,
                            .camera = &v->camera,
                            .shader = st->shader,
                            .environment = st->has_environment ? &st->environment : NULL,
                            .is_blended = is_blended(st->scene),
                            .has_coats = has_coats(st),
                            .bounces = o->bounces,
                            .seed = o->seed } };
    world_take_samples(&v->world, o->spp > 0 ? o->spp : SAMPLES_TO_PLAN, o->model);
    if (st->emitters.count > 0 && o->bounces > 0)
        v->world.emitters = &st->emitters;
    set_sky(&v->world, st, o);
    return camera_make(&from_where, o->width, o->height, &v->camera, r) && set_lights(v, st, o, &from_where, r) &&
           (!(o->accuracy > 0.0) || planned_make(&v->planned, o, &v->world, o->spp == 0 || o->planned != NULL, r));
}

void view_take_down(view *v)
{
    free(v->lights);
    light_tree_free(&v->light_tree);
    planned_free(&v->planned);
}

bool view_plan(const stage *st, const preview_options *o, glint_plan **plan, report *r)
{
    view v = { 0 };
    /* As it is before anything is left out. */
    preview_options all = *o;
    all.accuracy = 0.0;
    const bool ok = view_set_up(&v, st, &all, r) && planned_make(&v.planned, o, &v.world, true, r);
    *plan = NULL;
    if (ok) {
        *plan = v.planned.plan;
        v.planned.plan = NULL;
    }
    view_take_down(&v);
    return ok;
}

static unsigned default_facet_limit(void)
{
    const glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    return o.facet_limit;
}

void stage_count(const ray_counts *counts, preview_statistics *statistics)
{
    statistics->camera_rays = counts->camera_rays;
    statistics->shadow_rays = counts->shadow_rays;
    statistics->bounce_rays = counts->bounce_rays;
    statistics->glint_evals = counts->glint_evals;
    statistics->smooth_evals = counts->smooth_evals;
}

bool stage_check_counts(const stage *st, const ray_counts *counts, report *r)
{
    if (counts->over_limit == 0)
        return true;
    return report_error(
        r,
        "%s: the explicit model visits every facet under a sample, and %llu samples see too many, up to "
        "%.3g; expected at most %u: use more samples a pixel, a closer view or the counting model",
        st->scene->path != NULL ? st->scene->path : "scene", (unsigned long long)counts->over_limit,
        (double)counts->most_facets, default_facet_limit());
}

static bool render(const stage *st, const world *w, const preview_options *o, image *out,
                   preview_statistics *statistics, report *r)
{
    if (!film_of_options(o, out, r))
        return false;
    const tiles_job job = { .world = w, .options = o, .samples = w->spp, .film = out };
    ray_counts counts = { 0 };
    const double start = now_s();
    const bool finished = tiles_render(&job, &counts, r);
    statistics->render_s = now_s() - start;
    stage_count(&counts, statistics);
    statistics->samples = w->spp;
    if (finished && stage_check_counts(st, &counts, r))
        return true;
    image_free(out);
    return false;
}

/* Of the whole picture, whichever tile of it is wanted: tiles shall fit together. Where the plan is to choose their
 * number, it may choose any. */
static double samples_of_picture(const preview_options *o)
{
    return o->spp > 0 ? (double)o->width * (double)o->height * (double)o->spp : (double)INFINITY;
}

bool preview_render(const scene *s, const preview_options *options, image *out, preview_statistics *statistics,
                    report *r)
{
    preview_statistics own = { 0 };
    stage st = { 0 };
    view v = { 0 };
    *out = (image){ 0 };
    bool ok = stage_check_options(options, r);
    ok = ok && stage_set_up(&st, s, options, samples_of_picture(options), &own, r) && view_set_up(&v, &st, options, r);
    if (ok && options->planned != NULL)
        options->planned(v.planned.plan, options->user);
    ok = ok && render(&st, &v.world, options, out, &own, r);
    view_take_down(&v);
    stage_take_down(&st);
    if (statistics != NULL)
        *statistics = own;
    return ok;
}

bool preview_plan(const scene *s, const preview_options *options, glint_plan **plan, report *r)
{
    preview_statistics unused = { 0 };
    stage st = { 0 };
    *plan = NULL;
    const bool ok = stage_check_options(options, r) &&
                    stage_set_up(&st, s, options, samples_of_picture(options), &unused, r) &&
                    view_plan(&st, options, plan, r);
    stage_take_down(&st);
    return ok;
}
