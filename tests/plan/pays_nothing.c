/* Renders a scene that uses no effect, for tests/plan/pays_nothing.sh to count the instructions of counted().
 *
 * kind      smooth, flakes; or an effect, see effects.h; or one of the library, see library.h, which is only printed
 * renderer  whole: the previewer; bare: see bare.h; both: both, and an error where a pixel differs
 *           print: the previewer, and a hash of what comes of it
 *           planned, smooth: the previewer from set-up to picture, with a budget; as --model auto and --model smooth
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bare.h"
#include "effects.h"
#include "library.h"
#include "preview/film.h"
#include "preview/stage.h"
#include "preview/tiles.h"
#include "scenes.h"

static int fail(const char *why)
{
    fprintf(stderr, "pays_nothing: %s\n", why);
    return 1;
}

static scene plain_scene(const char *kind)
{
    static const float from[2][3] = { { 0.2F, 1.0F, 0.3F }, { -0.5F, 1.0F, 0.1F } };
    scene s = scenes_empty();
    scene_material flakes = scenes_flakes(0.6F, 1e7F), metal = scenes_matte(0.5F);
    metal.metallic = 1.0F;
    const int material = scenes_add_material(&s, strcmp(kind, "flakes") == 0 ? &flakes : &metal);
    scenes_add_instance(&s, scenes_add_square(&s, material, 0.3F), NULL, 0);
    for (int i = 0; i < 2; ++i)
        scenes_add_light(&s, SCENE_LIGHT_POINT, from[i], 1.0F);
    return s;
}

static preview_options plain_options(const scene_camera *from)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = o.height = 24;
    o.spp = 4;
    o.bounces = 0;
    o.threads = 1;
    o.camera = from;
    return o;
}

/* What there is to count: one of the three. */
typedef struct work {
    const scene *s; /* from set-up to picture, with these options */
    preview_options o;
    const tiles_job *job; /* the picture alone */
    const world *bare;    /* the same by the bare renderer */
    image *film;
    ray_counts *counts;
} work;

static __attribute__((noinline)) bool counted(const work *w, report *r)
{
    if (w->s != NULL)
        return preview_render(w->s, &w->o, w->film, NULL, r);
    if (w->job != NULL)
        return tiles_render(w->job, w->counts, r);
    bare_render(w->bare, w->film);
    return true;
}

static int render_planned(const scene *s, preview_options o, int model, report *r)
{
    image picture;
    o.model = model;
    o.accuracy = 0.02;
    if (!counted(&(work){ .s = s, .o = o, .film = &picture }, r))
        return fail(r->error);
    image_free(&picture);
    return 0;
}

static int render_apart(const scene *s, const preview_options *o, const char *renderer, report *r)
{
    static stage st;
    static view v;
    image whole = { 0 }, bare = { 0 };
    preview_statistics unused;
    ray_counts counts = { 0 };
    const bool both = strcmp(renderer, "both") == 0;
    if (!stage_set_up(&st, s, o, (double)INFINITY, &unused, r) || !view_set_up(&v, &st, o, r) ||
        !film_of_options(o, &whole, r) || !film_of_options(o, &bare, r))
        return fail(r->error);
    const tiles_job job = { .world = &v.world, .options = o, .samples = o->spp, .film = &whole };
    if (strcmp(renderer, "bare") != 0)
        (void)counted(&(work){ .job = &job, .counts = &counts }, r);
    if (both || strcmp(renderer, "bare") == 0)
        (void)counted(&(work){ .bare = &v.world, .film = &bare }, r);
    const size_t size = (size_t)(o->width * o->height * bare.channel_count) * sizeof *bare.pixels;
    const bool same = !both || memcmp(whole.pixels, bare.pixels, size) == 0;
    const bool lit = !both || whole.pixels[(size_t)(o->width * o->height / 2 * whole.channel_count)] > 0.0F;
    if (strcmp(renderer, "print") == 0)
        printf("%08x\n", library_hash(whole.pixels, size,
                                      library_hash(&counts.over_limit, sizeof counts.over_limit, LIBRARY_FIRST_HASH)));
    image_free(&whole);
    image_free(&bare);
    view_take_down(&v);
    stage_take_down(&st);
    return same && lit ? 0 : fail("the bare renderer makes other pixels, or black ones");
}

__attribute__((visibility("default"))) int pays_nothing(const char *kind, const char *renderer);

int pays_nothing(const char *kind, const char *renderer)
{
    static const float eye[3] = { 0.0F, 1.0F, 0.7F }, target[3] = { 0.0F, 0.0F, 0.0F };
    report r = { 0 };
    const scene_camera from = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 0.12F);
    preview_options o = plain_options(&from);
    scene s;
    int code;
    const uint32_t of_library = library_use(kind);
    if (of_library != 0U) {
        printf("%08x\n", of_library);
        return 0;
    }
    if (!effects_use(kind, &s, &o))
        s = plain_scene(kind);
    if (strcmp(renderer, "planned") == 0)
        code = render_planned(&s, o, PREVIEW_MODEL_AUTO, &r);
    else if (strcmp(renderer, "smooth") == 0)
        code = render_planned(&s, o, GLINT_MODEL_SMOOTH, &r);
    else
        code = render_apart(&s, &o, renderer, &r);
    scene_free(&s);
    return code;
}
