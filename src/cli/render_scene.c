/* What glint render and glint plan share: their options, the scene that they read, and the light and the camera that
 * they look at it with. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/render.h"
#include "io/scene_file.h"

/* An image dimension fits OpenEXR and PNG readers, and width * height * channels fits 64 bits. */
#define SIZE_MAX_PX 65536

/* Two percent of a pixel: what an eye sees in a smooth gradient, and nowhere else. The founder's choice. */
#define ACCURACY_DEFAULT 0.02
/* A quick look: the fewest that show the facets that any number shows. */
#define SAMPLES_DEFAULT 16

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

const argument_rule render_rules[RENDER_RULE_COUNT + PLAN_OWN_RULES] = {
    { .name = "output",
      .letter = 'o',
      .value = "OUT.exr|.png",
      .help = "the picture to write; required",
      .kind = ARGUMENT_TEXT,
      .target = AT(output) },
    { .name = "tile",
      .value = "X,Y,W,H",
      .help = "render only this part, in pixels from the upper left",
      .kind = ARGUMENT_INTEGERS,
      .count = 4,
      .separator = ',',
      .min = 0,
      .max = SIZE_MAX_PX,
      .target = AT(tile) },
    { .name = "frames",
      .value = "A-B",
      .help = "frames of the file's animation: OUT.0001.exr ...; finished ones are left",
      .kind = ARGUMENT_RANGE,
      .min = 0,
      .max = 9999999,
      .target = AT(frames) },
    { .name = "fps",
      .value = "N",
      .help = "frame F shows the time F / N seconds; 24",
      .kind = ARGUMENT_NUMBER,
      .min = 0.001,
      .max = 100000,
      .target = AT(fps) },
    { .name = "animation",
      .value = "NAME|N",
      .help = "which animation of the file; N counts from 0; all together",
      .kind = ARGUMENT_TEXT,
      .target = AT(animation) },
    { .name = "overwrite",
      .help = "render frames that are there already, too",
      .kind = ARGUMENT_FLAG,
      .target = AT(overwrite) },
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
    { .name = "threads",
      .value = "N",
      .help = "0 is one a core, which is the default",
      .kind = ARGUMENT_INTEGERS,
      .count = 1,
      .min = 0,
      .max = 1024,
      .target = AT(threads) },
    /* From here on they are those of glint plan, too. */
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
      .help = "samples per pixel; as many as an --accuracy that is given takes, else 16",
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
      .help = "auto is what each material asks for: example, dictionary, counting or smooth",
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
    { .name = "json", .help = "print one JSON document about the render", .kind = ARGUMENT_FLAG, .target = AT(json) },
    { .name = "all", .help = "every decision in a row of its own", .kind = ARGUMENT_FLAG, .target = AT(all) },
};

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
bool render_pick_camera(const scene *s, const char *wanted, const scene_camera **camera, report *r)
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

bool render_read_scene(const char *path, const render_values *v, scene *s, report *r)
{
    const scene_file_options options = { .variant = v->variant };
    return scene_file_read(path, &options, s, r) && render_dress_scene(v, s, r);
}

bool render_dress_scene(const render_values *v, scene *s, report *r)
{
    for (size_t i = 0; i < v->materials.count; ++i)
        if (!preset_apply(s, v->materials.items[i].name, v->materials.items[i].value, r))
            return false;
    if (s->instance_count == 0)
        report_warning(r, "%s: nothing to see: no triangles", s->path);
    return true;
}

render_values render_defaults(void)
{
    return (render_values){ .size = { 1280, 720 },
                            .frames = { -1, -1 },
                            .fps = (double)NAN,
                            .accuracy = (double)NAN,
                            .bounces = 1,
                            .exposure_ev = (double)NAN,
                            .environment_rotation_deg = (double)NAN,
                            .environment_exposure_ev = (double)NAN };
}

double render_number_or(double given, double otherwise)
{
    return isnan(given) ? otherwise : given;
}

double render_accuracy(const render_values *v)
{
    return render_number_or(v->accuracy, ACCURACY_DEFAULT);
}

/* Who asks for an accuracy and for no number of samples wants as many as it takes: 0, the plan chooses. */
int render_samples(const render_values *v)
{
    if (v->spp > 0)
        return (int)v->spp;
    return !isnan(v->accuracy) && v->accuracy > 0.0 ? 0 : SAMPLES_DEFAULT;
}

bool render_options(const render_values *v, scene *s, render_light *light, preview_options *options, report *r)
{
    *options = (preview_options)PREVIEW_OPTIONS_INIT;
    options->width = (int)v->size[0];
    options->height = (int)v->size[1];
    options->tile_x = (int)v->tile[0];
    options->tile_y = (int)v->tile[1];
    options->tile_width = (int)v->tile[2];
    options->tile_height = (int)v->tile[3];
    options->spp = render_samples(v);
    options->accuracy = render_accuracy(v);
    options->bounces = (int)v->bounces;
    options->threads = (int)v->threads;
    options->seed = (uint32_t)v->seed;
    options->model = v->model + PREVIEW_MODEL_AUTO;
    options->facets = (preview_facets)v->facets;
    options->aov = v->aov;
    options->transparent = v->environment_background == 1;
    return render_pick_camera(s, v->camera, &options->camera, r) && render_light_begin(v, s, light, options, r);
}
