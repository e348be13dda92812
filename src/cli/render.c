/* glint render: a glTF scene becomes a picture. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/interrupt.h"
#include "cli/render.h"
#include "io/output_file.h"

static const argument_syntax syntax = {
    .command = "glint render",
    .operands = "SCENE -o OUT",
    .summary = "Renders a glTF scene (.gltf, .glb) to scene-linear OpenEXR or to PNG.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = render_rules,
    .rule_count = RENDER_RULE_COUNT,
};

static bool ends_in(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);
    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

static int check_frames(const render_values *v)
{
    if (v->frames[0] >= 0)
        return COMMAND_DONE;
    if (!isnan(v->fps))
        return arguments_wrong(&syntax, "--fps: there are no --frames to time");
    if (v->animation)
        return arguments_wrong(&syntax, "--animation: there are no --frames to show it");
    if (v->overwrite)
        return arguments_wrong(&syntax,
                               "--overwrite: there are no --frames to keep; a single picture is always replaced");
    return COMMAND_DONE;
}

/* What the table cannot say because it concerns two options. Returns an exit code. */
static int check_usage(const render_values *v)
{
    if (!v->output)
        return arguments_wrong(&syntax, "-o OUT is missing");
    const bool png = ends_in(v->output, ".png");
    if (!png && !ends_in(v->output, ".exr"))
        return arguments_wrong(&syntax, "-o '%s': expected a name that ends in .exr or .png", v->output);
    if (png && v->aov)
        return arguments_wrong(&syntax, "--aov: a PNG holds no further channels; write an .exr");
    if (!png && !isnan(v->exposure_ev))
        return arguments_wrong(&syntax, "--exposure: an EXR is scene-linear; the exposure is for a .png");
    if (check_frames(v) != COMMAND_DONE || render_light_check(&syntax, v) != COMMAND_DONE)
        return COMMAND_WRONG_USAGE;
    const int64_t *t = v->tile;
    const bool given = t[0] || t[1] || t[2] || t[3];
    if (given && (t[2] < 1 || t[3] < 1 || t[0] + t[2] > v->size[0] || t[1] + t[3] > v->size[1]))
        return arguments_wrong(&syntax, "--tile '%lld,%lld,%lld,%lld': expected a part of the %lldx%lld pixels",
                               (long long)t[0], (long long)t[1], (long long)t[2], (long long)t[3],
                               (long long)v->size[0], (long long)v->size[1]);
    return COMMAND_DONE;
}

/* Of all frames, where there are several: what is left is as fast as what was. */
static void watch_progress(double fraction, double elapsed_s, double left_s, void *user)
{
    render_record *const record = user;
    const render_course *const course = record->course;
    if (course) {
        fraction = ((double)course->done + fraction) / (double)course->count;
        elapsed_s = clock_s() - course->start_s;
        left_s = fraction > 0.0 ? elapsed_s / fraction - elapsed_s : -1.0;
    }
    progress_update(fraction, elapsed_s, left_s, &record->bar);
}

/* The plan's decisions as a document, or a warning where its budget cannot be met. */
static void take_plan(const glint_plan *plan, void *user)
{
    render_record *const record = user;
    if (plan == NULL)
        return;
    if (record->values->json)
        record->plan = plan_document(plan, record->scene);
    report silent = { 0 };
    if (!isnan(record->values->accuracy))
        record->unmet = plan_warn(plan, record->values->accuracy, record->quiet ? &silent : record->report);
}

bool render_picture(render_record *record, const scene *s, preview_options *options, image *picture, report *r)
{
    const atomic_bool *const cancel = interrupt_watch();
    record->scene = s;
    record->report = r;
    options->progress = watch_progress;
    options->planned = NULL;
    if (record->values->json || !isnan(record->values->accuracy))
        options->planned = take_plan; /* else what it says of noise is not measured */
    options->user = record;
    options->cancel = cancel;
    return preview_render(s, options, picture, &record->statistics, r) && !atomic_load(cancel);
}

static bool render_scene(scene *s, render_record *record, image *picture, report *r)
{
    preview_options options;
    render_light light = { 0 };
    record->bar = progress_begin(stderr);
    const bool done =
        render_options(record->values, s, &light, &options, r) && render_picture(record, s, &options, picture, r);
    progress_end(&record->bar);
    render_light_end(&light);
    return done;
}

/* From the file to the picture. False after an error, and after an interruption, which leaves the report empty. */
static bool produce(render_record *record, report *r)
{
    const double start_s = clock_s();
    const atomic_bool *const cancel = interrupt_watch();
    if (!output_file_check(record->values->output, r))
        return false;
    scene s = { 0 };
    image picture = { 0 };
    bool done = render_read_scene(record->file, record->values, &s, r) && !atomic_load(cancel);
    record->read_s = clock_s() - start_s;
    done = done && render_scene(&s, record, &picture, r);
    scene_free(&s);
    const double write_start_s = clock_s();
    done = done && render_write(record, &picture, r);
    image_free(&picture);
    record->write_s = clock_s() - write_start_s;
    record->total_s = clock_s() - start_s;
    return done;
}

static int render(const char *path, const render_values *values)
{
    messages m;
    messages_begin(&m, values->json);
    render_record record = { .file = path, .values = values, .frame = -1 };
    if (produce(&record, &m.report)) {
        if (values->json) {
            const int code = render_print_document(&record, m.warnings);
            m.warnings = NULL;
            return code;
        }
        render_print_line(&record);
        messages_end(&m);
        return COMMAND_DONE;
    }
    if (m.report.error[0] || interrupt_exit_code() == 0)
        return messages_fail(&m);
    report_error(&m.report, "%s: interrupted; '%s' is as it was", path, values->output);
    messages_fail(&m);
    return interrupt_exit_code();
}

int command_render(int argc, char **argv)
{
    render_values values = render_defaults();
    const char *path;
    int code = COMMAND_DONE;
    switch (arguments_parse(&syntax, argc, argv, &values, &path)) {
    case ARGUMENTS_HELP:
        break;
    case ARGUMENTS_WRONG:
        code = COMMAND_WRONG_USAGE;
        break;
    case ARGUMENTS_OK:
        code = check_usage(&values);
        if (code == COMMAND_DONE)
            code = values.frames[0] < 0 ? render(path, &values) : render_frames(path, &values);
        break;
    }
    assignments_free(&values.materials);
    return code;
}
