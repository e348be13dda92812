/* What the pixels of a render depend on, as texts in its picture: they tell a finished frame from one that was rendered
 * otherwise. No time, no place, no number of threads: the same command gives the same bytes anywhere. */
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "cli/render.h"

/* "NAME=PRESET, NAME=PRESET"; NULL without memory. */
static char *join_materials(const assignments *a)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < a->count; ++i)
        fprintf(out, "%s%s=%s", i == 0 ? "" : ", ", a->items[i].name, a->items[i].value);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

static void add(render_metadata *m, const char *key, const char *value)
{
    m->items[m->count++] = (image_text){ key, value };
}

static void add_format(render_metadata *m, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void add_format(render_metadata *m, const char *key, const char *format, ...)
{
    char *to = m->numbers + m->used;
    va_list list;
    va_start(list, format);
    m->used += (size_t)vsnprintf(to, sizeof m->numbers - m->used, format, list) + 1;
    va_end(list);
    add(m, key, to);
}

static void add_light(render_metadata *m, const render_values *v)
{
    add(m, "glint:light-set", render_light_set(v->light_set));
    add(m, "glint:environment", v->environment ? v->environment : "");
    add_format(m, "glint:environment-rotation", "%.9g", render_number_or(v->environment_rotation_deg, 0.0));
    add_format(m, "glint:environment-exposure", "%.9g", render_number_or(v->environment_exposure_ev, 0.0));
    add(m, "glint:environment-background", v->environment_background == 1 ? "off" : "on");
}

static void add_place(render_metadata *m, const render_values *v)
{
    const bool whole = v->tile[2] == 0;
    add_format(m, "glint:size", "%" PRId64 "x%" PRId64, v->size[0], v->size[1]);
    add_format(m, "glint:tile", "%" PRId64 ",%" PRId64 ",%" PRId64 ",%" PRId64, v->tile[0], v->tile[1],
               whole ? v->size[0] : v->tile[2], whole ? v->size[1] : v->tile[3]);
}

static void add_frame(render_metadata *m, const render_record *record)
{
    add_format(m, "glint:frame", "%" PRId64, record->frame);
    add_format(m, "glint:fps", "%.9g", render_number_or(record->values->fps, RENDER_FPS));
    add(m, "glint:animation", record->values->animation ? record->values->animation : "");
}

bool render_writes_png(const render_values *v)
{
    const char *extension = strrchr(v->output, '.');
    return extension && strcasecmp(extension, ".png") == 0;
}

bool render_metadata_make(const render_record *record, int samples, render_metadata *out, report *r)
{
    const render_values *v = record->values;
    *out = (render_metadata){ .materials = join_materials(&v->materials) };
    if (!out->materials)
        return report_error(r, "%s: out of memory", v->output);
    add(out, "glint:version", glint_version());
    add(out, "glint:model", arguments_model_choice(v->model));
    add(out, "glint:facets", render_facets_name(v->facets));
    add_place(out, v);
    if (samples > 0)
        add_format(out, "glint:spp", "%d", samples);
    add_format(out, "glint:accuracy", "%.9g", render_accuracy(v));
    add_format(out, "glint:seed", "%" PRId64, v->seed);
    add_format(out, "glint:bounces", "%" PRId64, v->bounces);
    add(out, "glint:camera", v->camera ? v->camera : "");
    add(out, "glint:variant", v->variant ? v->variant : "");
    add(out, "glint:materials", out->materials);
    add_light(out, v);
    if (render_writes_png(v))
        add_format(out, "glint:exposure", "%.9g", render_number_or(v->exposure_ev, 0.0));
    else
        add(out, "glint:aov", v->aov ? "on" : "off");
    if (record->frame >= 0)
        add_frame(out, record);
    return true;
}

void render_metadata_free(render_metadata *m)
{
    free(m->materials);
}

/* ---- the other way: is this the picture that would be rendered? ---- */

typedef struct finding {
    const char *path;
    const render_metadata *expected;
    size_t found;
    report *r;
    bool good;
} finding;

static void compare(const image_text *text, void *user)
{
    finding *f = user;
    for (size_t i = 0; i < f->expected->count && f->good; ++i) {
        const image_text *expected = &f->expected->items[i];
        if (strcmp(expected->key, text->key) != 0)
            continue;
        ++f->found;
        if (strcmp(expected->value, text->value) != 0)
            f->good =
                report_error(f->r, "%s: was rendered with %s \"%s\", expected \"%s\"; --overwrite renders it again",
                             f->path, text->key, text->value, expected->value);
    }
}

static bool look_into(const char *path, const render_metadata *expected, report *r)
{
    report said = { 0 };
    finding f = { .path = path, .expected = expected, .r = r, .good = true };
    if (!image_read_metadata(path, compare, &f, &said))
        return report_error(r, "%s; --overwrite renders it again", said.error);
    if (f.good && f.found < expected->count)
        return report_error(r, "%s: is there and no frame that this glint has rendered; --overwrite replaces it", path);
    return f.good;
}

bool render_is_finished(const render_record *record, bool *finished, report *r)
{
    const char *path = record->values->output;
    render_metadata expected;
    *finished = false;
    if (access(path, F_OK) != 0)
        return true;
    if (!render_metadata_make(record, render_samples(record->values), &expected, r))
        return false;
    *finished = look_into(path, &expected, r);
    render_metadata_free(&expected);
    return *finished;
}
