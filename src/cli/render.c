/* glint render: a glTF scene becomes a picture. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render.h"
#include "io/output_file.h"
#include "io/scene_file.h"

/* An image dimension fits OpenEXR and PNG readers, and width * height * channels fits 64 bits. */
#define SIZE_MAX_PX 65536

/* Two percent of a pixel: what an eye sees in a smooth gradient, and nowhere else. The founder's choice. */
#define ACCURACY_DEFAULT 0.02

#define AT(member) offsetof(render_values, member)

static const char *on_or_off(int index)
{
    return index == 0 ? "on" : index == 1 ? "off" : NULL;
}

/* In the order of preview_facets. */
const char *render_facets_name(int index)
{
    static const char *const names[] = { "own", "cycles", "povray", NULL };
    return names[index];
}

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "OUT.exr|.png",
      .help = "the picture to write; required",
      .kind = ARGUMENT_TEXT,
      .target = AT(output) },
    { .name = "camera",
      .value = "NAME|N",
      .help = "which camera of the file; N counts from 0",
      .kind = ARGUMENT_TEXT,
      .target = AT(camera) },
    { .name = "size",
      .value = "WxH",
      .help = "pixels; 1280x720",
      .kind = ARGUMENT_INTEGERS,
      .count = 2,
      .separator = 'x',
      .min = 1,
      .max = SIZE_MAX_PX,
      .target = AT(size) },
    { .name = "spp",
      .value = "N",
      .help = "samples per pixel; 16",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 1,
      .max = 65536,
      .target = AT(spp) },
    { .name = "accuracy",
      .value = "X",
      .help = "error that may be left for speed, relative; 0 leaves out nothing; 0.02",
      .kind = ARGUMENT_NUMBER,
      .min = 0,
      .max = 1,
      .target = AT(accuracy) },
    { .name = "model",
      .help = "auto is counting where a material has glints",
      .kind = ARGUMENT_CHOICE,
      .choice = arguments_model_choice,
      .target = AT(model) },
    { .name = "facets",
      .help = "own: of equal area; or those that another renderer draws",
      .kind = ARGUMENT_CHOICE,
      .choice = render_facets_name,
      .target = AT(facets) },
    { .name = "material",
      .value = "NAME=PRESET",
      .help = "replace a material of the file, or all (*); repeatable",
      .kind = ARGUMENT_ASSIGNMENT,
      .target = AT(materials) },
    { .name = "variant",
      .value = "NAME",
      .help = "a variant of the file (KHR_materials_variants)",
      .kind = ARGUMENT_TEXT,
      .target = AT(variant) },
    { .name = "light-set",
      .help = "lights in place of the file's: soft boxes, a sun in its sky ...",
      .kind = ARGUMENT_CHOICE,
      .choice = render_light_set,
      .target = AT(light_set) },
    { .name = "environment",
      .value = "MAP.hdr|.exr",
      .help = "light from all around: a latitude-longitude map",
      .kind = ARGUMENT_TEXT,
      .target = AT(environment) },
    { .name = "environment-rotation",
      .value = "DEG",
      .help = "turns the map, counter-clockwise seen from above; 0",
      .kind = ARGUMENT_NUMBER,
      .min = -36000,
      .max = 36000,
      .target = AT(environment_rotation_deg) },
    { .name = "environment-exposure",
      .value = "EV",
      .help = "multiplies the map's light by 2^EV; 0",
      .kind = ARGUMENT_NUMBER,
      .min = -64,
      .max = 64,
      .target = AT(environment_exposure_ev) },
    { .name = "environment-background",
      .help = "whether the camera sees what is around; off leaves alpha 0; on",
      .kind = ARGUMENT_CHOICE,
      .choice = on_or_off,
      .target = AT(environment_background) },
    { .name = "bounces",
      .value = "N",
      .help = "bounces of indirect light; 1",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 0,
      .max = 64,
      .target = AT(bounces) },
    { .name = "seed",
      .value = "N",
      .help = "of the sampling; 0",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 0,
      .max = 4294967295.0,
      .target = AT(seed) },
    { .name = "threads",
      .value = "N",
      .help = "0 is one a core, which is the default",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 0,
      .max = 1024,
      .target = AT(threads) },
    { .name = "tile",
      .value = "X,Y,W,H",
      .help = "render only this part, in pixels from the upper left",
      .kind = ARGUMENT_INTEGERS,
      .count = 4,
      .separator = ',',
      .min = 0,
      .max = SIZE_MAX_PX,
      .target = AT(tile) },
    { .name = "aov",
      .help = "add smooth.RGB, glints.N, glints.p, normal, albedo, depth (EXR)",
      .kind = ARGUMENT_FLAG,
      .target = AT(aov) },
    { .name = "exposure",
      .value = "EV",
      .help = "multiply by 2^EV before the view transform (PNG); 0",
      .kind = ARGUMENT_NUMBER,
      .min = -64,
      .max = 64,
      .target = AT(exposure_ev) },
    { .name = "json", .help = "print one JSON document about the render", .kind = ARGUMENT_FLAG, .target = AT(json) },
};

static const argument_syntax syntax = {
    .command = "glint render",
    .operands = "SCENE -o OUT",
    .summary = "Renders a glTF scene (.gltf, .glb) to scene-linear OpenEXR or to PNG.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

static bool ends_in(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);
    return length > tail && strcasecmp(path + length - tail, extension) == 0;
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
    if (render_light_check(&syntax, v) != COMMAND_DONE)
        return COMMAND_WRONG_USAGE;
    const int64_t *t = v->tile;
    const bool given = t[0] || t[1] || t[2] || t[3];
    if (given && (t[2] < 1 || t[3] < 1 || t[0] + t[2] > v->size[0] || t[1] + t[3] > v->size[1]))
        return arguments_wrong(&syntax, "--tile '%lld,%lld,%lld,%lld': expected a part of the %lldx%lld pixels",
                               (long long)t[0], (long long)t[1], (long long)t[2], (long long)t[3],
                               (long long)v->size[0], (long long)v->size[1]);
    return COMMAND_DONE;
}

static bool refuse_camera(const scene *s, const char *wanted, report *r)
{
    char names[512] = "";
    size_t used = 0;
    for (int i = 0; i < s->camera_count && used < sizeof names; ++i)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%d '%s'", i == 0 ? "" : ", ", i,
                                 s->cameras[i].name ? s->cameras[i].name : "");
    if (s->camera_count == 0)
        return report_error(r, "%s: --camera '%s': the file has no camera", s->path, wanted);
    return report_error(r, "%s: --camera '%s' is unknown; there are: %s", s->path, wanted, names);
}

/* A name first, a number only where no camera is called so. */
static bool pick_camera(const scene *s, const char *wanted, const scene_camera **camera, report *r)
{
    *camera = NULL;
    if (!wanted)
        return true;
    for (int i = 0; i < s->camera_count; ++i) {
        if (s->cameras[i].name && strcmp(s->cameras[i].name, wanted) == 0) {
            *camera = &s->cameras[i];
            return true;
        }
    }
    if (*wanted == '\0' || strlen(wanted) > 9 || wanted[strspn(wanted, "0123456789")] != '\0' ||
        atoi(wanted) >= s->camera_count)
        return refuse_camera(s, wanted, r);
    *camera = &s->cameras[atoi(wanted)];
    return true;
}

static bool read_scene(const char *path, const render_values *v, scene *s, report *r)
{
    const scene_file_options options = { .variant = v->variant };
    if (!scene_file_read(path, &options, s, r))
        return false;
    for (size_t i = 0; i < v->materials.count; ++i)
        if (!preset_apply(s, v->materials.items[i].name, v->materials.items[i].value, r))
            return false;
    return true;
}

static bool render_scene(scene *s, render_record *record, const atomic_bool *cancel, image *picture, report *r)
{
    const render_values *v = record->values;
    progress bar = progress_begin(stderr);
    preview_options options = PREVIEW_OPTIONS_INIT;
    options.width = (int)v->size[0];
    options.height = (int)v->size[1];
    options.tile_x = (int)v->tile[0];
    options.tile_y = (int)v->tile[1];
    options.tile_width = (int)v->tile[2];
    options.tile_height = (int)v->tile[3];
    options.spp = (int)v->spp;
    options.accuracy = v->accuracy;
    options.bounces = (int)v->bounces;
    options.threads = (int)v->threads;
    options.seed = (uint32_t)v->seed;
    options.model = v->model + PREVIEW_MODEL_AUTO;
    options.facets = (preview_facets)v->facets;
    options.aov = v->aov;
    options.progress = progress_update;
    options.user = &bar;
    options.cancel = cancel;
    options.transparent = v->environment_background == 1;
    render_light light = { 0 };
    const bool done = pick_camera(s, v->camera, &options.camera, r) && render_light_begin(v, s, &light, &options, r) &&
                      preview_render(s, &options, picture, &record->statistics, r);
    progress_end(&bar);
    render_light_end(&light);
    return done && !atomic_load(cancel);
}

/* From the file to the picture. False after an error, and after an interruption, which leaves the report empty. */
static bool produce(render_record *record, const atomic_bool *cancel, report *r)
{
    const double start_s = clock_s();
    if (!output_file_check(record->values->output, r))
        return false;
    scene s = { 0 };
    image picture = { 0 };
    bool done = read_scene(record->file, record->values, &s, r) && !atomic_load(cancel);
    record->read_s = clock_s() - start_s;
    done = done && render_scene(&s, record, cancel, &picture, r);
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
    render_record record = { .file = path, .values = values };
    if (produce(&record, interrupt_watch(), &m.report)) {
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
    render_values values = { .size = { 1280, 720 },
                             .spp = 16,
                             .accuracy = ACCURACY_DEFAULT,
                             .bounces = 1,
                             .exposure_ev = (double)NAN,
                             .environment_rotation_deg = (double)NAN,
                             .environment_exposure_ev = (double)NAN };
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
            code = render(path, &values);
        break;
    }
    assignments_free(&values.materials);
    return code;
}
