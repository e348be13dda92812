/* glint_export_povray: a glTF scene becomes a folder that stock POV-Ray 3.7 renders. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exporters/export_call.h"
#include "exporters/povray/povray.h"
#include "io/scene_file.h"

extern const unsigned char glint_inc[];

/* Where scenes of POV-Ray are at their best: some ten units across. */
#define BEST_RADIUS 10.0

static void measure(povray *p)
{
    const scene *s = p->scene;
    const bool empty = !(s->bounds_min[0] <= s->bounds_max[0]);
    const vec low = empty ? (vec){ 0 } : vec_of(s->bounds_min), high = empty ? (vec){ 0 } : vec_of(s->bounds_max);
    p->centre = vec_scale(vec_add(low, high), 0.5);
    p->radius = 0.5 * vec_length(vec_sub(high, low));
    if (!(p->radius > 0.0))
        p->radius = 1.0;
    p->unit = pow(10.0, fmin(fmax(round(log10(BEST_RADIUS / p->radius)), -12.0), 12.0));
}

static bool name_materials(povray *p)
{
    const scene *s = p->scene;
    p->material_name = calloc((size_t)s->material_count + 1, sizeof *p->material_name);
    p->image_used = calloc((size_t)s->image_count + 1, sizeof *p->image_used);
    if (!p->material_name || !p->image_used)
        return report_error(p->report, "%s: out of memory", p->options->input);
    for (int i = 0; i < s->material_count; ++i)
        name_identifier(p->material_name[i], "Material", i, s->materials[i].name);
    return true;
}

static void begin_file(text *t, const povray *p, const char *ending, const char *what)
{
    text_print(t,
               "/*\n *  Persistence of Vision Raytracer %s file\n *\n *  File: %s%s\n *  Vers: 3.7\n *  Desc: %s\n"
               " *  Auth: glint export povray, libglint %d.%d.%d\n */\n#version 3.7;\n\n",
               strcmp(ending, ".pov") == 0 ? "scene" : "include", p->file, ending, what, GLINT_VERSION_MAJOR,
               GLINT_VERSION_MINOR, GLINT_VERSION_PATCH);
}

static void write_scene(povray *p, text *out)
{
    begin_file(out, p, ".pov", "a scene with glints; metres and handedness are those of glTF, scaled");
    text_print(out, "#include \"glint.inc\"\n#include \"%s_materials.inc\"\n\n", p->file);
    text_print(out, "// One metre is %.9g units.\n", p->unit);
    text_print(out,
               "global_settings {\n  assumed_gamma 1.0\n  max_trace_level 4\n  adc_bailout 1e-3\n"
               "  ambient_light color rgb %s\n}\n\n",
               p->studio ? "<0.22, 0.235, 0.26>" : "0");
    eye_write(p, out);
    lights_write(p, out);
    text_add(out, p->objects.bytes ? p->objects.bytes : "", p->objects.length);
}

static void write_ini(const povray *p, text *out)
{
    text_print(
        out,
        "; Render with: povray %s.ini\n"
        "; Every pixel gets its samples (+A0.0): antialiasing that starts where neighbours differ misses flakes\n"
        "; between them, and most of the light with them. Samples are averaged as light, not as 8-bit values.\n"
        "Input_File_Name=%s.pov\nOutput_File_Name=%s.exr\nOutput_File_Type=E\nWidth=%d\nHeight=%d\n"
        "Antialias=On\nAntialias_Threshold=0.0\nSampling_Method=1\nAntialias_Depth=4\nAntialias_Gamma=1.0\n"
        "Jitter=Off\nDisplay=Off\nVerbose=Off\n"
        "; Work_Threads=4 sets the number of threads; without it POV-Ray takes all cores.\n",
        p->file, p->file, p->file, p->options->width, p->options->height);
}

static bool put_bytes(folder *f, const povray *p, const char *name, const void *bytes, size_t count)
{
    if (p->options->wrote)
        p->options->wrote(name, p->options->listener.user);
    return folder_write(f, name, bytes, count, p->report);
}

static bool put(folder *f, const povray *p, const char *ending, const text *t, report *r)
{
    char name[2 * NAME_LENGTH];
    snprintf(name, sizeof name, "%s%s", p->file, ending);
    if (t->failed)
        return report_error(r, "%s: out of memory", p->options->input);
    return put_bytes(f, p, name, t->bytes ? t->bytes : "", t->length);
}

static bool write_folder(const povray *p, const text *scene_text, const text *ini)
{
    folder f = { 0 };
    report *r = p->report;
    const size_t size = strlen((const char *)glint_inc);
    bool done = folder_open(&f, p->options->output, r) && put_bytes(&f, p, "glint.inc", glint_inc, size) &&
                textures_write(p, &f) && put(&f, p, "_materials.inc", &p->materials, r) &&
                put(&f, p, ".pov", scene_text, r) && put(&f, p, ".ini", ini, r) && folder_commit(&f, r);
    folder_close(&f);
    return done;
}

/* Those that something wears: warnings about others would only be in the way. */
static void write_materials(povray *p)
{
    const scene *s = p->scene;
    begin_file(&p->materials, p, "_materials.inc", "materials; each is a macro of parameters and a texture");
    for (int m = 0; m < s->material_count; ++m) {
        bool worn = false;
        for (int i = 0; i < s->instance_count && !worn; ++i)
            worn = s->meshes[s->instances[i].mesh].material == m;
        if (!worn)
            continue;
        material_warn(p, m);
        material_write(p, m);
    }
}

static bool export_scene(povray *p)
{
    text scene_text = { 0 }, ini = { 0 };
    measure(p);
    name_file(p->file, p->options->input);
    scene_light studio[STUDIO_LIGHTS];
    bool done = name_materials(p) && eye_choose(p);
    if (done) {
        p->lights = p->scene->lights;
        p->light_count = p->scene->light_count;
        p->studio = p->light_count == 0;
        if (p->studio) {
            notes_add(p->notes, NULL, "there are no lights; a studio with three lights and a sky is added");
            studio_lights(p, studio);
            p->lights = studio;
            p->light_count = STUDIO_LIGHTS;
        }
        write_materials(p);
        objects_write(p);
        write_scene(p, &scene_text);
        write_ini(p, &ini);
        scene_text.failed = scene_text.failed || p->objects.failed;
        done = write_folder(p, &scene_text, &ini);
    }
    text_free(&scene_text);
    text_free(&ini);
    text_free(&p->materials);
    text_free(&p->objects);
    free(p->material_name);
    free(p->image_used);
    return done;
}

static bool read_and_export(const glint_export_povray_options *o, notes *n, report *r)
{
    const scene_file_options reading = { 0 };
    scene s = { 0 };
    textures *maps = NULL;
    bool done = scene_file_read(o->input, &reading, &s, r);
    for (size_t i = 0; done && i < o->material_count; ++i)
        done = preset_apply(&s, o->materials[i].name, o->materials[i].value, r);
    done = done && textures_open(&s, &maps, r);
    if (done) {
        povray p = { .scene = &s, .options = o, .textures = maps, .report = r, .notes = n };
        done = export_scene(&p);
    }
    textures_close(maps);
    scene_free(&s);
    return done;
}

glint_export_result glint_export_povray(const glint_export_povray_options *options, char *message, size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input || !options->output)
        return export_wrong_usage("the options need a size, an input and an output", message, message_size);
    if (options->width < 1 || options->height < 1 || options->width > 65536 || options->height > 65536)
        return export_wrong_usage("width and height: expected 1 to 65536", message, message_size);
    if ((int)options->form < GLINT_EXPORT_POVRAY_AUTO || (int)options->form > GLINT_EXPORT_POVRAY_MESH)
        return export_wrong_usage("form: expected one of glint_export_povray_form", message, message_size);
    report r = export_report(&options->listener);
    /* Numbers with a point, whatever the caller's language. */
    const locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c == (locale_t)0)
        return export_result(&r, report_error(&r, "%s: out of memory", options->input), message, message_size);
    const locale_t before = uselocale(c);
    notes n;
    notes_begin(&n, options->input, &r);
    const bool done = read_and_export(options, &n, &r);
    notes_end(&n);
    uselocale(before);
    freelocale(c);
    return export_result(&r, done, message, message_size);
}
