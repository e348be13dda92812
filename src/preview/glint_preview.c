/* The handles of glint_preview.h around a stage and its pictures. */
#include "preview/glint_preview.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preview/caller_scene.h"

struct glint_preview_scene {
    caller_scene from;
    preview_stage *stage;
    int model;
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

static preview_options stage_options(const glint_preview_scene *s, int model)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.model = model;
    o.sky = &s->from.world.sky;
    if (s->from.world.map.rgb != NULL)
        o.environment = &s->from.world.environment;
    return o;
}

static bool make_scene(glint_preview_scene *s, const glint_preview_scene_options *o, report *r)
{
    if (!caller_scene_make(o, &s->from, r))
        return false;
    s->model = o->model;
    s->from.warnings.now = CALLER_LOOK;
    const preview_options stage = stage_options(s, s->model);
    return preview_stage_open(&s->from.scene, &stage, &s->stage, r);
}

glint_preview_result glint_preview_scene_create(const glint_preview_scene_options *options, glint_preview_scene **out,
                                                char *message, size_t message_size)
{
    report r = { .warn = caller_warnings_keep };
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
    r.user = &s->from.warnings;
    const bool done = make_scene(s, options, &r);
    caller_warnings_join(&s->from.warnings);
    if (done)
        *out = s;
    else
        glint_preview_scene_destroy(s);
    return result_of(done, &r, message, message_size);
}

/* The warnings of what has changed. */
static void move_warnings(caller_warnings *to, caller_warnings *from, int parts)
{
    if ((parts & GLINT_PREVIEW_MATERIALS) != 0)
        caller_warnings_move(to, from, CALLER_LOOK);
    if ((parts & GLINT_PREVIEW_LIGHTS) != 0)
        caller_warnings_move(to, from, CALLER_LIGHTS);
    if ((parts & GLINT_PREVIEW_WORLD) != 0)
        caller_warnings_move(to, from, CALLER_WORLD);
    caller_warnings_join(to);
}

/* The stage sees the scene with its new parts; what they replaced is in parked, until it is clear who stays. */
static bool change_stage(glint_preview_scene *s, caller_scene *parked, int parts, int model, report *r)
{
    caller_scene_swap(&s->from, parked, parts);
    const preview_change change = { .before = (parts & GLINT_PREVIEW_MATERIALS) != 0 ? parked->scene.materials : NULL,
                                    .images = (parts & GLINT_PREVIEW_IMAGES) != 0,
                                    .environment = (parts & GLINT_PREVIEW_WORLD) != 0 };
    const preview_options stage = stage_options(s, model);
    parked->warnings.now = CALLER_LOOK;
    if (!preview_stage_change(s->stage, &change, &stage, r)) {
        caller_scene_swap(&s->from, parked, parts);
        return false;
    }
    s->model = model;
    move_warnings(&s->from.warnings, &parked->warnings, parts);
    return true;
}

static glint_preview_result change_scene(glint_preview_scene *s, const glint_preview_scene_options *o, int parts,
                                         caller_scene *next, char *message, size_t message_size)
{
    report r = { .warn = caller_warnings_keep, .user = &next->warnings };
    const int model = (parts & GLINT_PREVIEW_MATERIALS) != 0 ? o->model : s->model;
    if (!caller_scene_make_parts(o, parts, &s->from.scene, next, &r))
        return result_of(false, &r, message, message_size);
    if ((parts & GLINT_PREVIEW_MATERIALS) != 0 && !caller_scene_same_meshes(&s->from.scene, &next->scene))
        return say(GLINT_PREVIEW_OTHER_MESHES, "the materials ask for other meshes", message, message_size);
    return result_of(change_stage(s, next, parts, model, &r), &r, message, message_size);
}

glint_preview_result glint_preview_scene_change(glint_preview_scene *s, int32_t parts,
                                                const glint_preview_scene_options *options, char *message,
                                                size_t message_size)
{
    report r = { 0 };
    if (s == NULL || options == NULL)
        return wrong(message, message_size, "%s is NULL", s == NULL ? "scene" : "options");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return result_of(false, &r, message, message_size);
    if ((parts & ~CALLER_LOOKS) != 0)
        return wrong(message, message_size, "parts is %d; expected a sum of 1, 2, 4 and 8", parts);
    if ((parts & GLINT_PREVIEW_IMAGES) != 0 && (parts & GLINT_PREVIEW_MATERIALS) == 0)
        return wrong(message, message_size, "parts is %d: found images, expected the materials with them", parts);
    caller_scene next;
    const glint_preview_result result = change_scene(s, options, parts, &next, message, message_size);
    caller_scene_free(&next);
    return result;
}

const char *glint_preview_scene_warnings(const glint_preview_scene *s)
{
    return s != NULL && s->from.warnings.all != NULL ? s->from.warnings.all : "";
}

void glint_preview_scene_destroy(glint_preview_scene *s)
{
    if (s == NULL)
        return;
    preview_stage_close(s->stage);
    caller_scene_free(&s->from);
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
    o.sky = &s->from.world.sky;
    o.transparent = from->transparent != 0;
    o.accuracy = (double)from->accuracy;
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
