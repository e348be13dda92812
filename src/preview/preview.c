/* Sets a render up, runs it and takes it down again. */
#include "preview/preview.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "preview/integrator.h"
#include "preview/rig.h"
#include "preview/tiles.h"

#define LARGEST_SIDE 65536
#define MOST_SAMPLES 65536
#define MOST_BOUNCES 64

/* Everything that a render owns. */
typedef struct stage {
    const scene *scene;
    geometry geometry;
    trace_scene *trace;
    materials materials;
    textures *textures;
    camera camera;
    light *lights;
    environment_map own_map; /* of the scene's image-based light */
    environment environment;
    world world;
} stage;

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

static bool check_options(const preview_options *o, report *r)
{
    const int last_model = GLINT_MODEL_LAYERED - 1; /* which is made of the others */
    if (o->size != sizeof *o)
        return report_error(r, "preview: the options' size is %zu; expected %zu: start from PREVIEW_OPTIONS_INIT",
                            o->size, sizeof *o);
    if (!check_range("width", o->width, 1, LARGEST_SIDE, r) || !check_range("height", o->height, 1, LARGEST_SIDE, r) ||
        !check_range("spp", o->spp, 1, MOST_SAMPLES, r) || !check_range("bounces", o->bounces, 0, MOST_BOUNCES, r) ||
        !check_range("model", o->model, PREVIEW_MODEL_AUTO, last_model, r) ||
        !check_range("facets", (int)o->facets, PREVIEW_FACETS_OWN, PREVIEW_FACETS_POVRAY, r))
        return false;
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
    return shade_opacity(&st->world.shader, &st->geometry, at);
}

static bool set_environment(stage *st, const preview_options *o, report *r)
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
    st->world.environment = &st->environment;
    return environment_make(&from, &st->environment, r);
}

/* A scene that brings no light, and gets neither sky nor environment, stands in the studio. */
static bool wants_rig(const stage *st, const preview_options *o)
{
    return st->scene->light_count == 0 && o->sky == NULL && st->world.environment == NULL;
}

static bool set_lights(stage *st, const preview_options *o, const scene_camera *view, report *r)
{
    scene_light rig[RIG_LIGHT_COUNT];
    const bool studio = wants_rig(st, o);
    const int count = studio ? RIG_LIGHT_COUNT : st->scene->light_count;
    const scene_light *const from = studio ? rig : st->scene->lights;
    if (studio)
        rig_lights(view, rig);
    st->lights = calloc((size_t)count + ENVIRONMENT_MOST_SUNS, sizeof *st->lights);
    if (st->lights == NULL)
        return report_error(r, "no memory for %d lights", count);
    st->world.lights = st->lights;
    for (int i = 0; i < count; ++i) {
        if (from[i].kind == SCENE_LIGHT_RECT || from[i].kind == SCENE_LIGHT_DISK)
            report_warning(r, "light \"%s\": area lights are not rendered", from[i].name);
        else
            st->lights[st->world.light_count++] = light_make(&from[i]);
    }
    for (int i = 0; i < st->environment.sun_count; ++i)
        st->lights[st->world.light_count++] = light_make(&st->environment.suns[i]);
    return true;
}

static void set_sky(stage *st, const preview_options *o)
{
    world *const w = &st->world;
    w->has_sky = o->sky != NULL || wants_rig(st, o) || w->environment != NULL;
    w->sky_seen = w->has_sky && !o->transparent;
    if (w->has_sky)
        w->sky = o->sky != NULL ? *o->sky : rig_sky();
}

static bool set_up(stage *st, const preview_options *o, preview_statistics *statistics, report *r)
{
    const scene *const s = st->scene;
    const double start = now_s();
    if (!textures_open(s, &st->textures, r))
        return false;
    const double loaded = now_s();
    scene_camera view;
    if (o->camera != NULL)
        view = *o->camera;
    else
        view = s->camera_count > 0 ? s->cameras[0] : preview_framed_camera(s, o->width, o->height);

    st->world = (world){ .geometry = &st->geometry,
                         .camera = &st->camera,
                         .shader = { s, &st->materials, st->textures },
                         .bounces = o->bounces,
                         .spp = o->spp,
                         .seed = o->seed };
    if (!set_environment(st, o, r))
        return false;
    set_sky(st, o);
    if (!camera_make(&view, o->width, o->height, &st->camera, r) || !set_lights(st, o, &view, r) ||
        !materials_make(s, o->model, o->facets, &st->materials, r) || !geometry_make(s, &st->geometry, r) ||
        !trace_build(&st->geometry, opacity_at, st, &st->trace, r))
        return false;
    st->world.trace = st->trace;
    statistics->load_s = loaded - start;
    statistics->build_s = now_s() - loaded;
    return true;
}

static void take_down(stage *st)
{
    trace_free(st->trace);
    geometry_free(&st->geometry);
    if (st->materials.scene != NULL)
        materials_free(&st->materials);
    textures_close(st->textures);
    environment_free(&st->environment);
    environment_map_free(&st->own_map);
    free(st->lights);
}

static unsigned default_facet_limit(void)
{
    const glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    return o.facet_limit;
}

static bool render(const stage *st, const preview_options *o, image *out, preview_statistics *statistics, report *r)
{
    const bool whole = o->tile_width == 0;
    if (!film_make(out, whole ? o->width : o->tile_width, whole ? o->height : o->tile_height, o->aov, r))
        return false;
    const tiles_job job = {
        .world = &st->world, .options = o, .left = whole ? 0 : o->tile_x, .top = whole ? 0 : o->tile_y, .film = out
    };
    ray_counts counts = { 0 };
    const double start = now_s();
    const bool finished = tiles_render(&job, &counts);
    statistics->render_s = now_s() - start;
    statistics->camera_rays = counts.camera_rays;
    statistics->shadow_rays = counts.shadow_rays;
    statistics->bounce_rays = counts.bounce_rays;
    statistics->glint_evals = counts.glint_evals;
    statistics->smooth_evals = counts.smooth_evals;
    if (finished && counts.over_limit == 0)
        return true;
    image_free(out);
    if (!finished)
        return false;
    return report_error(
        r,
        "%s: the explicit model visits every facet under a sample, and %llu samples see too many, up to "
        "%.3g; expected at most %u: use more samples a pixel, a closer view or the counting model",
        st->scene->path != NULL ? st->scene->path : "scene", (unsigned long long)counts.over_limit,
        (double)counts.most_facets, default_facet_limit());
}

bool preview_render(const scene *s, const preview_options *options, image *out, preview_statistics *statistics,
                    report *r)
{
    preview_statistics own = { 0 };
    stage st = { .scene = s };
    *out = (image){ 0 };
    bool ok = check_options(options, r);
    ok = ok && set_up(&st, options, &own, r);
    ok = ok && render(&st, options, out, &own, r);
    take_down(&st);
    if (statistics != NULL)
        *statistics = own;
    return ok;
}
