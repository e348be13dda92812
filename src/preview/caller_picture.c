/* The pictures of glint_preview.h, and what they would leave out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preview/caller_answer.h"

struct glint_preview_picture {
    preview_picture *picture;
    atomic_bool cancel;
    _Atomic double progress;
};

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

/* The camera is where o->camera will point. */
static bool options_of(const glint_preview_scene *s, const glint_preview_picture_options *from, scene_camera *camera,
                       preview_options *o, report *r)
{
    if (!camera_of(from->camera, camera, r))
        return false;
    *o = (preview_options)PREVIEW_OPTIONS_INIT;
    o->width = from->width;
    o->height = from->height;
    o->tile_x = from->part_left;
    o->tile_y = from->part_top;
    o->tile_width = from->part_width;
    o->tile_height = from->part_height;
    o->spp = from->samples;
    o->bounces = from->bounces;
    o->threads = from->threads;
    o->seed = from->seed;
    o->model = s->shading.model;
    o->camera = camera;
    o->aov = from->passes != 0;
    o->sky = &s->from.world.sky;
    o->transparent = from->transparent != 0;
    o->accuracy = (double)from->accuracy;
    return true;
}

static bool open_picture(glint_preview_picture *p, const glint_preview_scene *s,
                         const glint_preview_picture_options *from, report *r)
{
    scene_camera camera;
    preview_options o;
    if (!options_of(s, from, &camera, &o, r))
        return false;
    o.progress = keep_progress;
    o.user = p;
    o.cancel = &p->cancel;
    return preview_picture_open(s->stage, &o, &p->picture, r);
}

glint_preview_result glint_preview_picture_create(const glint_preview_scene *s,
                                                  const glint_preview_picture_options *options,
                                                  glint_preview_picture **out, char *message, size_t message_size)
{
    report r = { 0 };
    if (out == NULL)
        return answer_wrong(message, message_size, "out is NULL");
    *out = NULL;
    if (s == NULL || options == NULL)
        return answer_wrong(message, message_size, "%s is NULL", s == NULL ? "scene" : "options");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return answer_of(false, &r, message, message_size);
    glint_preview_picture *const p = calloc(1, sizeof *p);
    if (p == NULL)
        return answer_wrong(message, message_size, "no memory for a picture");
    const bool done = open_picture(p, s, options, &r);
    if (done)
        *out = p;
    else
        glint_preview_picture_destroy(p);
    return answer_of(done, &r, message, message_size);
}

int32_t glint_preview_picture_samples(const glint_preview_picture *picture)
{
    return picture != NULL ? preview_picture_samples(picture->picture) : 0;
}

glint_preview_result glint_preview_picture_refine(glint_preview_picture *picture, int32_t samples, char *message,
                                                  size_t message_size)
{
    report r = { 0 };
    if (picture == NULL)
        return answer_wrong(message, message_size, "picture is NULL");
    atomic_store(&picture->progress, 0.0);
    const bool done = preview_picture_refine(picture->picture, samples, NULL, &r);
    return answer_of(done, &r, message, message_size);
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
        return answer_wrong(message, message_size, "%s is NULL", picture == NULL ? "picture" : "values");
    if (pass < 0 || (size_t)pass >= sizeof PASSES / sizeof *PASSES)
        return answer_wrong(message, message_size, "pass is %d; expected %d to %d", pass, GLINT_PREVIEW_COMBINED,
                            GLINT_PREVIEW_DEPTH);
    const image *const film = preview_picture_image(picture->picture);
    const int first = image_channel(film, PASSES[pass].first);
    if (first < 0)
        return answer_wrong(message, message_size, "pass is %d; expected %d, since passes was 0", pass,
                            GLINT_PREVIEW_COMBINED);
    const size_t expected = (size_t)PASSES[pass].count * (size_t)film->width * (size_t)film->height;
    if (value_count != expected)
        return answer_wrong(message, message_size, "value_count is %zu; expected %zu: %d x %d pixels of %d",
                            value_count, expected, film->width, film->height, PASSES[pass].count);
    copy_channels(film, first, PASSES[pass].count, bottom_up != 0, values);
    return answer(GLINT_PREVIEW_OK, "", message, message_size);
}

void glint_preview_picture_destroy(glint_preview_picture *picture)
{
    if (picture == NULL)
        return;
    preview_picture_close(picture->picture);
    free(picture);
}

/* ---- the plan ---- */

/* Text that grows; NULL: there was no memory. */
typedef struct lines {
    char *text;
    size_t length, room;
} lines;

static void add_line(lines *l, const char *line)
{
    const size_t count = strlen(line);
    if (l->text == NULL)
        return;
    if (l->length + count + 1 > l->room) {
        l->room = 2 * (l->length + count + 1);
        char *const grown = realloc(l->text, l->room);
        if (grown == NULL)
            free(l->text);
        l->text = grown;
    }
    if (l->text == NULL)
        return;
    memcpy(&l->text[l->length], line, count + 1);
    l->length += count;
}

/* A field: tabs and the ends of lines are blanks in it. */
static void copy_field(const char *from, char *to, size_t size)
{
    size_t i = 0;
    for (; from[i] != '\0' && i + 1 < size; ++i)
        to[i] = from[i];
    to[i] = '\0';
    for (i = strcspn(to, "\t\r\n"); to[i] != '\0'; i += strcspn(&to[i], "\t\r\n"))
        to[i] = ' ';
}

/* The fields that the header lists. */
static void write_plan(const glint_plan *plan, const scene *s, lines *l)
{
    char line[512], material[128];
    const glint_plan_outcome out = glint_plan_result(plan);
    snprintf(line, sizeof line, "%.9g\t%.9g\t%.9g\t%s\t%u\t%u\n", (double)out.ns_per_sample, (double)out.error,
             (double)out.noise, out.is_met ? "met" : "missed", out.enough_samples, out.samples);
    add_line(l, line);
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); ++i) {
        const glint_decision *const d = glint_plan_decision(plan, i);
        const char *const name = d->material >= 0 ? s->materials[d->material].name : NULL;
        copy_field(name != NULL ? name : "", material, sizeof material);
        snprintf(line, sizeof line, "%s\t%s\t%s\t%s\t%.9g\t%.9g\t%s\n", material, glint_effect_name(d->effect),
                 d->is_on ? "on" : "off", d->choice, (double)d->time_share, (double)d->error, d->reason);
        add_line(l, line);
    }
}

static glint_preview_result tell_plan(const glint_plan *plan, const scene *s, char *text, size_t text_size,
                                      char *message, size_t message_size)
{
    lines l = { .text = calloc(1, 1), .room = 1 };
    write_plan(plan, s, &l);
    if (l.text == NULL)
        return answer_wrong(message, message_size, "no memory for a plan");
    const bool fits = l.length < text_size;
    if (fits)
        memcpy(text, l.text, l.length + 1);
    free(l.text);
    if (!fits)
        return answer_wrong(message, message_size, "text_size is %zu; expected %zu", text_size, l.length + 1);
    return answer(GLINT_PREVIEW_OK, "", message, message_size);
}

glint_preview_result glint_preview_plan(const glint_preview_scene *s, const glint_preview_picture_options *options,
                                        char *text, size_t text_size, char *message, size_t message_size)
{
    report r = { 0 };
    if (s == NULL || options == NULL || text == NULL)
        return answer_wrong(message, message_size, "%s is NULL",
                            s == NULL         ? "scene"
                            : options == NULL ? "options"
                                              : "text");
    scene_camera camera;
    preview_options o;
    glint_plan *plan = NULL;
    if (!caller_check_size("options", options->size, sizeof *options, &r) || !options_of(s, options, &camera, &o, &r) ||
        !preview_stage_plan(s->stage, &o, &plan, &r))
        return answer_of(false, &r, message, message_size);
    const glint_preview_result result = tell_plan(plan, &s->from.scene, text, text_size, message, message_size);
    glint_plan_destroy(plan);
    return result;
}
