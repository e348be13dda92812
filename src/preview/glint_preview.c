/* The handles of glint_preview.h around a stage and its pictures. */
#include "preview/glint_preview.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preview/caller_scene.h"

struct glint_preview_scene {
    scene scene;
    caller_world world;
    preview_stage *stage;
    char *warnings;
    size_t warnings_length;
};

struct glint_preview_picture {
    preview_picture *picture;
    atomic_bool cancel;
    _Atomic double progress;
    int samples;
};

uint32_t glint_preview_abi(void)
{
    return GLINT_PREVIEW_ABI;
}

const char *glint_preview_version(void)
{
    return glint_version();
}

size_t glint_preview_size_of(const char *name)
{
    static const struct {
        const char *name;
        size_t size;
    } structs[] = {
        { "glint_preview_image", sizeof(glint_preview_image) },
        { "glint_preview_mesh", sizeof(glint_preview_mesh) },
        { "glint_preview_light", sizeof(glint_preview_light) },
        { "glint_preview_world", sizeof(glint_preview_world) },
        { "glint_preview_scene_options", sizeof(glint_preview_scene_options) },
        { "glint_preview_camera", sizeof(glint_preview_camera) },
        { "glint_preview_picture_options", sizeof(glint_preview_picture_options) },
    };
    for (size_t i = 0; name != NULL && i < sizeof structs / sizeof *structs; ++i) {
        if (strcmp(structs[i].name, name) == 0)
            return structs[i].size;
    }
    return 0;
}

/* ---- results ---- */

static glint_preview_result say(glint_preview_result result, const char *text, char *message, size_t message_size)
{
    if (message != NULL && message_size > 0)
        snprintf(message, message_size, "%s", text);
    return result;
}

/* What went wrong without an error was cancelled. */
static glint_preview_result result_of(bool done, const report *r, char *message, size_t message_size)
{
    if (done)
        return say(GLINT_PREVIEW_OK, "", message, message_size);
    if (r->error[0] == '\0')
        return say(GLINT_PREVIEW_CANCELLED, "cancelled", message, message_size);
    return say(GLINT_PREVIEW_BAD_INPUT, r->error, message, message_size);
}

static glint_preview_result wrong(char *message, size_t message_size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static glint_preview_result wrong(char *message, size_t message_size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (message != NULL && message_size > 0)
        vsnprintf(message, message_size, format, arguments);
    va_end(arguments);
    return GLINT_PREVIEW_BAD_INPUT;
}

/* ---- scenes ---- */

/* A warning that memory has no room for is lost. */
static void keep_warning(const char *text, void *user)
{
    glint_preview_scene *const s = user;
    const size_t length = strlen(text);
    char *const grown = realloc(s->warnings, s->warnings_length + length + 2);
    if (grown == NULL)
        return;
    s->warnings = grown;
    snprintf(&grown[s->warnings_length], length + 2, "%s\n", text);
    s->warnings_length += length + 1;
}

static bool make_scene(glint_preview_scene *s, const glint_preview_scene_options *o, report *r)
{
    preview_options stage = PREVIEW_OPTIONS_INIT;
    stage.model = o->model;
    /* A viewport has no plan. The fit is off by a hundredth, and the first picture is there in a third of the time. */
    stage.area_lights = GLINT_AREA_LIGHT_FAST;
    if (!caller_scene_make(o, &s->scene, &s->world, r))
        return false;
    stage.sky = &s->world.sky;
    if (s->world.map.rgb != NULL)
        stage.environment = &s->world.environment;
    return preview_stage_open(&s->scene, &stage, &s->stage, r);
}

glint_preview_result glint_preview_scene_create(const glint_preview_scene_options *options, glint_preview_scene **out,
                                                char *message, size_t message_size)
{
    report r = { .warn = keep_warning };
    if (out == NULL)
        return wrong(message, message_size, "out is NULL");
    *out = NULL;
    if (options == NULL)
        return wrong(message, message_size, "options is NULL");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return result_of(false, &r, message, message_size);
    glint_preview_scene *const s = calloc(1, sizeof *s);
    if (s == NULL)
        return wrong(message, message_size, "no memory for a scene");
    r.user = s;
    const bool done = make_scene(s, options, &r);
    if (done)
        *out = s;
    else
        glint_preview_scene_destroy(s);
    return result_of(done, &r, message, message_size);
}

const char *glint_preview_scene_warnings(const glint_preview_scene *s)
{
    return s != NULL && s->warnings != NULL ? s->warnings : "";
}

void glint_preview_scene_destroy(glint_preview_scene *s)
{
    if (s == NULL)
        return;
    preview_stage_close(s->stage);
    caller_scene_free(&s->scene, &s->world);
    free(s->warnings);
    free(s);
}

/* ---- pictures ---- */

static bool camera_of(const glint_preview_camera *from, scene_camera *to, report *r)
{
    if (from == NULL)
        return report_error(r, "camera: found none, expected one");
    const float numbers[6] = { from->left, from->right, from->bottom, from->top, from->near_m, from->far_m };
    if (!caller_check_size("camera", from->size, sizeof *from, r) ||
        !caller_check_finite("camera", "left, right, bottom, top, near_m, far_m", numbers, 6, r) ||
        !caller_check_finite("camera", "to_world", from->to_world, 16, r))
        return false;
    if (from->projection != GLINT_PREVIEW_PERSPECTIVE && from->projection != GLINT_PREVIEW_ORTHOGRAPHIC)
        return report_error(r, "camera: projection is %d; expected %d or %d", from->projection,
                            GLINT_PREVIEW_PERSPECTIVE, GLINT_PREVIEW_ORTHOGRAPHIC);
    if (!(from->left < from->right) || !(from->bottom < from->top))
        return report_error(r,
                            "camera: found a picture from %g to %g and %g to %g, expected left below right and "
                            "bottom below top",
                            (double)from->left, (double)from->right, (double)from->bottom, (double)from->top);
    if (from->near_m < 0.0F || from->far_m < 0.0F || (from->far_m > 0.0F && from->far_m <= from->near_m))
        return report_error(r, "camera: near_m is %g and far_m %g; expected neither negative, and far_m beyond near_m",
                            (double)from->near_m, (double)from->far_m);
    *to = (scene_camera){ .projection =
                              from->projection == GLINT_PREVIEW_PERSPECTIVE ? SCENE_PERSPECTIVE : SCENE_ORTHOGRAPHIC,
                          .znear = from->near_m,
                          .zfar = from->far_m,
                          .window = { from->left, from->right, from->bottom, from->top } };
    memcpy(to->to_world, from->to_world, sizeof to->to_world);
    return true;
}

static void keep_progress(double fraction, double elapsed_s, double left_s, void *user)
{
    (void)elapsed_s;
    (void)left_s;
    atomic_store(&((glint_preview_picture *)user)->progress, fraction);
}

static bool open_picture(glint_preview_picture *p, const glint_preview_scene *s,
                         const glint_preview_picture_options *from, report *r)
{
    scene_camera camera;
    if (!camera_of(from->camera, &camera, r))
        return false;
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = from->width;
    o.height = from->height;
    o.tile_x = from->part_left;
    o.tile_y = from->part_top;
    o.tile_width = from->part_width;
    o.tile_height = from->part_height;
    o.spp = from->samples;
    o.bounces = from->bounces;
    o.threads = from->threads;
    o.seed = from->seed;
    o.camera = &camera;
    o.aov = from->passes != 0;
    o.progress = keep_progress;
    o.user = p;
    o.cancel = &p->cancel;
    o.sky = &s->world.sky;
    o.transparent = from->transparent != 0;
    p->samples = from->samples;
    return preview_picture_open(s->stage, &o, &p->picture, r);
}

glint_preview_result glint_preview_picture_create(const glint_preview_scene *s,
                                                  const glint_preview_picture_options *options,
                                                  glint_preview_picture **out, char *message, size_t message_size)
{
    report r = { 0 };
    if (out == NULL)
        return wrong(message, message_size, "out is NULL");
    *out = NULL;
    if (s == NULL || options == NULL)
        return wrong(message, message_size, "%s is NULL", s == NULL ? "scene" : "options");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return result_of(false, &r, message, message_size);
    glint_preview_picture *const p = calloc(1, sizeof *p);
    if (p == NULL)
        return wrong(message, message_size, "no memory for a picture");
    const bool done = open_picture(p, s, options, &r);
    if (done)
        *out = p;
    else
        glint_preview_picture_destroy(p);
    return result_of(done, &r, message, message_size);
}

glint_preview_result glint_preview_picture_refine(glint_preview_picture *picture, int32_t samples, char *message,
                                                  size_t message_size)
{
    report r = { 0 };
    if (picture == NULL)
        return wrong(message, message_size, "picture is NULL");
    atomic_store(&picture->progress, 0.0);
    const bool done = preview_picture_refine(picture->picture, samples, NULL, &r);
    return result_of(done, &r, message, message_size);
}

void glint_preview_picture_cancel(glint_preview_picture *picture, int32_t cancel)
{
    if (picture != NULL)
        atomic_store(&picture->cancel, cancel != 0);
}

double glint_preview_picture_progress(const glint_preview_picture *picture)
{
    return picture != NULL ? atomic_load(&picture->progress) : 0.0;
}

/* Where the channels of a pass begin in the film, and how many there are. */
static const struct {
    const char *first;
    int count;
} PASSES[] = { { "R", 4 },        { "smooth.R", 3 }, { "glints.N", 1 }, { "glints.p", 1 },
               { "normal.X", 3 }, { "albedo.R", 3 }, { "depth.Z", 1 } };

static void copy_channels(const image *film, int first, int count, bool bottom_up, float *values)
{
    for (int y = 0; y < film->height; ++y) {
        const int row = bottom_up ? film->height - 1 - y : y;
        const float *from = &film->pixels[(size_t)row * (size_t)film->width * (size_t)film->channel_count];
        for (int x = 0; x < film->width; ++x, from += film->channel_count)
            for (int c = 0; c < count; ++c)
                *values++ = from[first + c];
    }
}

glint_preview_result glint_preview_picture_read(const glint_preview_picture *picture, int32_t pass, int32_t bottom_up,
                                                float *values, size_t value_count, char *message, size_t message_size)
{
    if (picture == NULL || values == NULL)
        return wrong(message, message_size, "%s is NULL", picture == NULL ? "picture" : "values");
    if (pass < 0 || (size_t)pass >= sizeof PASSES / sizeof *PASSES)
        return wrong(message, message_size, "pass is %d; expected %d to %d", pass, GLINT_PREVIEW_COMBINED,
                     GLINT_PREVIEW_DEPTH);
    const image *const film = preview_picture_image(picture->picture);
    const int first = image_channel(film, PASSES[pass].first);
    if (first < 0)
        return wrong(message, message_size, "pass is %d; expected %d, since passes was 0", pass,
                     GLINT_PREVIEW_COMBINED);
    const size_t expected = (size_t)PASSES[pass].count * (size_t)film->width * (size_t)film->height;
    if (value_count != expected)
        return wrong(message, message_size, "value_count is %zu; expected %zu: %d x %d pixels of %d", value_count,
                     expected, film->width, film->height, PASSES[pass].count);
    copy_channels(film, first, PASSES[pass].count, bottom_up != 0, values);
    return say(GLINT_PREVIEW_OK, "", message, message_size);
}

void glint_preview_picture_destroy(glint_preview_picture *picture)
{
    if (picture == NULL)
        return;
    preview_picture_close(picture->picture);
    free(picture);
}
