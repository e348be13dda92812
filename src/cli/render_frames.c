/* glint render --frames: poses the scene for one frame after another and renders what is not there yet.
 *
 * A frame depends on its number and the command line alone, not on the range that it is rendered in. So what the file
 * leaves to us stands still, and is placed by times that no range chooses: the view of a file without cameras by the
 * whole animation, lights that are not the file's by the animation's first moment. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/interrupt.h"
#include "cli/render.h"
#include "io/output_file.h"
#include "io/scene_motion.h"
#include "preview/rig.h"

/* How many moments of an animation are looked at to find what it reaches (taste). */
enum { MOMENTS = 64 };

typedef struct frames {
    const char *file;
    const render_values *values;
    report report; /* says each warning once, to the command's */
    report *to;
    char **said;
    size_t said_count;
    scene scene;
    scene_motion *motion;
    bool own_lights; /* the scene's lights are ours and stand still */
    bool has_lights; /* at some time */
    render_light light;
    preview_sky sky;
    scene_camera framed; /* where the file has no camera */
    preview_options options;
    render_course course;
    progress bar;
    document *list; /* with --json */
    int64_t rendered, skipped, older, unmet;
    double read_s;
} frames;

/* ---- warnings ---- */

static void warn_once(const char *text, void *user)
{
    frames *f = user;
    for (size_t i = 0; i < f->said_count; ++i)
        if (strcmp(f->said[i], text) == 0)
            return;
    char **grown = realloc(f->said, (f->said_count + 1) * sizeof *grown);
    if (grown) {
        f->said = grown;
        f->said[f->said_count] = strdup(text);
        f->said_count += f->said[f->said_count] != NULL;
    }
    report_warning(f->to, "%s", text);
}

/* ---- the scene ---- */

/* The file's lights are those of the pose, ours stay. */
static bool pose(frames *f, double time_s)
{
    scene *s = &f->scene, mine = { 0 };
    if (f->own_lights) {
        mine = (scene){ .lights = s->lights, .light_count = s->light_count };
        s->lights = NULL;
        s->light_count = 0;
    }
    const bool done = scene_motion_pose(f->motion, time_s, s, &f->report);
    if (f->own_lights) {
        scene files = { .lights = s->lights, .light_count = s->light_count };
        s->lights = mine.lights;
        s->light_count = mine.light_count;
        scene_free(&files);
    }
    return done;
}

/* What the scene reaches while it moves; leaves it in its first moment. */
static bool survey(frames *f, scene *reach)
{
    const double end_s = scene_motion_end_s(f->motion);
    for (int i = MOMENTS; i >= 0; --i) {
        if (!pose(f, end_s * i / MOMENTS))
            return false;
        const scene *s = &f->scene;
        f->has_lights = f->has_lights || s->light_count > 0;
        if (s->instance_count == 0)
            continue;
        const bool first = reach->instance_count == 0;
        reach->instance_count = 1;
        for (int k = 0; k < 3; ++k) {
            reach->bounds_min[k] = first ? s->bounds_min[k] : fminf(reach->bounds_min[k], s->bounds_min[k]);
            reach->bounds_max[k] = first ? s->bounds_max[k] : fmaxf(reach->bounds_max[k], s->bounds_max[k]);
        }
    }
    return true;
}

/* The studio of a scene without light, as its first moment is seen. */
static bool set_rig(frames *f, const scene_camera *view)
{
    scene_camera seen = *view;
    scene lit = { .cameras = &seen, .camera_count = 1 };
    if (!preview_add_lookdev_rig(&lit, &f->report)) {
        lit.cameras = NULL;
        lit.camera_count = 0;
        scene_free(&lit);
        return false;
    }
    free(f->scene.lights);
    f->scene.lights = lit.lights;
    f->scene.light_count = lit.light_count;
    f->sky = rig_sky();
    f->options.sky = &f->sky;
    return true;
}

/* View, lights and options, as far as they are the same in all frames. */
static bool set_up(frames *f)
{
    scene *s = &f->scene;
    scene reach = { .bounds_min = { 1.0F }, .bounds_max = { -1.0F } };
    if (!pose(f, 0.0))
        return false;
    f->has_lights = s->light_count > 0;
    if ((s->camera_count == 0 || !f->has_lights) && !survey(f, &reach))
        return false;
    if (s->camera_count == 0) {
        memcpy(s->bounds_min, reach.bounds_min, sizeof reach.bounds_min);
        memcpy(s->bounds_max, reach.bounds_max, sizeof reach.bounds_max);
        f->framed = preview_framed_camera(s, (int)f->values->size[0], (int)f->values->size[1]);
    }
    if (!render_options(f->values, s, &f->light, &f->options, &f->report))
        return false;
    const scene_camera *view = f->options.camera ? f->options.camera : s->camera_count > 0 ? s->cameras : &f->framed;
    f->own_lights = f->values->light_set != 0;
    if (f->own_lights || f->has_lights || f->options.environment || s->environment.present)
        return true;
    f->own_lights = set_rig(f, view);
    return f->own_lights;
}

/* A scene whose lights are all gone for a while is dark, and not in the studio. */
static preview_options options_of_pose(const frames *f)
{
    static const preview_sky black = { { 0 }, { 0 }, { 0 } };
    preview_options o = f->options;
    if (f->has_lights && !f->own_lights && f->scene.light_count == 0 && !o.environment &&
        !f->scene.environment.present) {
        o.sky = &black;
        o.transparent = true;
    }
    return o;
}

static void warn_of_the_end(frames *f)
{
    const double end_s = scene_motion_end_s(f->motion);
    const int64_t last = f->values->frames[1];
    if (end_s > 0.0 && last > 0 && render_frame_time_s(f->values, last - 1) >= end_s)
        report_warning(&f->report, "%s: the animation ends at %g s, frame %.0f; frames behind it all show its end",
                       f->file, end_s, ceil(end_s * render_number_or(f->values->fps, RENDER_FPS) - 1e-3));
}

static bool read_scene(frames *f)
{
    const scene_file_options options = { .variant = f->values->variant };
    const double start_s = clock_s();
    const bool done = scene_motion_open(f->file, &options, f->values->animation, &f->scene, &f->motion, &f->report) &&
                      render_dress_scene(f->values, &f->scene, &f->report) && set_up(f);
    f->read_s = clock_s() - start_s;
    if (done)
        warn_of_the_end(f);
    return done && !atomic_load(interrupt_watch());
}

/* ---- one frame ---- */

/* The command line of a frame: that of the command with a name of its own. */
static bool name_frame(const frames *f, int64_t number, render_values *one, char **name, report *r)
{
    *one = *f->values;
    *name = render_frame_name(f->values->output, number);
    one->output = *name;
    return *name ? true : report_error(r, "%s: out of memory", f->values->output);
}

static bool is_finished(const frames *f, const render_record *record, bool *finished, report *r)
{
    *finished = false;
    return f->values->overwrite || render_is_finished(record, finished, r);
}

static bool render_frame(frames *f, render_record *record)
{
    image picture = { 0 };
    /* A finished frame may have vanished meanwhile. */
    bool done = (f->motion || read_scene(f)) && pose(f, render_frame_time_s(f->values, record->frame));
    preview_options options = options_of_pose(f);
    if (f->scene.camera_count == 0)
        options.camera = &f->framed;
    else
        done = done && render_pick_camera(&f->scene, f->values->camera, &options.camera, &f->report);
    record->bar = f->bar;
    done = done && render_picture(record, &f->scene, &options, &picture, &f->report);
    f->bar = record->bar;
    const double write_start_s = clock_s();
    done = done && render_write(record, &picture, &f->report);
    image_free(&picture);
    record->write_s = clock_s() - write_start_s;
    return done;
}

/* A line for people as soon as it is true: who drives the command reads them as progress. */
static void say_frame(frames *f, const render_record *record, bool skipped)
{
    if (f->list) {
        document_append(f->list, render_frame_document(record, skipped));
        return;
    }
    progress_end(&f->bar);
    if (skipped)
        printf("%s: finished before\n", record->values->output);
    else
        render_print_line(record);
    fflush(stdout);
}

static bool make_frame(frames *f, int64_t number)
{
    const double start_s = clock_s();
    render_values one;
    char *name;
    if (!name_frame(f, number, &one, &name, &f->report))
        return false;
    render_record record = {
        .file = f->file, .values = &one, .frame = number, .course = &f->course, .quiet = f->unmet > 0
    };
    bool skipped;
    bool done = is_finished(f, &record, &skipped, &f->report) && (skipped || render_frame(f, &record));
    record.total_s = clock_s() - start_s;
    if (done) {
        say_frame(f, &record, skipped);
        *(skipped ? &f->skipped : &f->rendered) += 1;
        f->unmet += record.unmet;
    } else {
        document_free(record.plan);
    }
    free(name);
    return done;
}

/* ---- all frames ---- */

static bool is_older(const char *path, const struct stat *than)
{
    struct stat own;
    return stat(path, &own) == 0 &&
           (own.st_mtim.tv_sec < than->st_mtim.tv_sec ||
            (own.st_mtim.tv_sec == than->st_mtim.tv_sec && own.st_mtim.tv_nsec < than->st_mtim.tv_nsec));
}

/* Before any work: what is there must be finished frames of this command, and the first of the others must be
 * writable. *missing says how many these are. */
static bool look_around(frames *f, int64_t *missing)
{
    struct stat scene_file;
    const bool known = stat(f->file, &scene_file) == 0;
    *missing = 0;
    for (int64_t n = f->values->frames[0]; n <= f->values->frames[1]; ++n) {
        render_values one;
        char *name;
        if (!name_frame(f, n, &one, &name, &f->report))
            return false;
        const render_record record = { .file = f->file, .values = &one, .frame = n };
        bool finished;
        bool good = is_finished(f, &record, &finished, &f->report);
        f->older += good && finished && known && is_older(name, &scene_file);
        if (good && !finished && (*missing)++ == 0)
            good = output_file_check(name, &f->report);
        free(name);
        if (!good)
            return false;
    }
    return true;
}

static void warn_of_older(frames *f)
{
    if (f->older > 0)
        report_warning(&f->report,
                       "%s: is newer than %" PRId64 " finished frame%s, left as %s; --overwrite renders "
                       "%s again",
                       f->file, f->older, f->older == 1 ? "" : "s", f->older == 1 ? "it is" : "they are",
                       f->older == 1 ? "it" : "them");
}

static bool make_frames(frames *f)
{
    const int64_t first = f->values->frames[0], last = f->values->frames[1];
    int64_t missing;
    interrupt_watch();
    if (!look_around(f, &missing))
        return false;
    warn_of_older(f);
    /* A scene that is not there is an error even where nothing is left to do. */
    if ((missing > 0 || access(f->file, R_OK) != 0) && !read_scene(f))
        return false;
    f->course = (render_course){ .count = missing > 0 ? missing : 1, .start_s = clock_s() };
    f->bar = progress_begin(stderr);
    bool done = true;
    for (int64_t n = first; done && n <= last; ++n) {
        done = make_frame(f, n);
        f->course.done = f->rendered;
    }
    progress_end(&f->bar);
    if (f->unmet > 1)
        report_warning(&f->report, "--accuracy %g is not met in %" PRId64 " frames", f->values->accuracy, f->unmet);
    return done;
}

static void take_down(frames *f)
{
    render_light_end(&f->light);
    scene_motion_close(f->motion);
    scene_free(&f->scene);
    document_free(f->list);
    for (size_t i = 0; i < f->said_count; ++i)
        free(f->said[i]);
    free(f->said);
}

/* Returns an exit code. */
static int close_up(frames *f, messages *m, double start_s)
{
    const int64_t count = f->values->frames[1] - f->values->frames[0] + 1;
    if (f->values->json) {
        const render_record all = {
            .file = f->file, .values = f->values, .frame = -1, .read_s = f->read_s, .total_s = clock_s() - start_s
        };
        const int code = render_print_frames(&all, f->list, f->rendered, f->skipped, m->warnings);
        f->list = NULL;
        m->warnings = NULL;
        return code;
    }
    if (count > 1)
        printf("%" PRId64 " frames, %" PRId64 " of them finished before, %.1f s\n", count, f->skipped,
               clock_s() - start_s);
    messages_end(m);
    return COMMAND_DONE;
}

int render_frames(const char *path, const render_values *values)
{
    messages m;
    messages_begin(&m, values->json);
    const double start_s = clock_s();
    frames f = { .file = path, .values = values, .to = &m.report };
    f.report = (report){ .warn = warn_once, .user = &f };
    f.list = values->json ? document_array() : NULL;
    int code;
    if (make_frames(&f)) {
        code = close_up(&f, &m, start_s);
    } else if (f.report.error[0] || interrupt_exit_code() == 0) {
        report_error(&m.report, "%s", f.report.error);
        code = messages_fail(&m);
    } else {
        report_error(&m.report, "%s: interrupted; %" PRId64 " of its frames are finished, and the same command goes on",
                     path, f.rendered + f.skipped);
        messages_fail(&m);
        code = interrupt_exit_code();
    }
    take_down(&f);
    return code;
}
