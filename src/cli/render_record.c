/* What a render leaves besides its pixels: metadata in the picture, a JSON document or a line on standard output. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/resource.h>

#include "cli/render.h"

/* Of this process, so far. Linux counts in KiB. */
static uint64_t peak_memory_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024U : 0U;
}

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

static double number_or(double given, double otherwise)
{
    return isnan(given) ? otherwise : given;
}

static bool write_exr(const render_record *record, const image *picture, report *r)
{
    const render_values *v = record->values;
    char *materials = join_materials(&v->materials);
    if (!materials)
        return report_error(r, "%s: out of memory", v->output);
    char size[48], tile[96], spp[24], seed[24], bounces[24];
    snprintf(size, sizeof size, "%" PRId64 "x%" PRId64, v->size[0], v->size[1]);
    const bool whole = v->tile[2] == 0;
    snprintf(tile, sizeof tile, "%" PRId64 ",%" PRId64 ",%" PRId64 ",%" PRId64, v->tile[0], v->tile[1],
             whole ? v->size[0] : v->tile[2], whole ? v->size[1] : v->tile[3]);
    snprintf(spp, sizeof spp, "%d", record->statistics.samples);
    snprintf(seed, sizeof seed, "%" PRId64, v->seed);
    snprintf(bounces, sizeof bounces, "%" PRId64, v->bounces);
    char rotation[32], exposure[32], accuracy[32];
    snprintf(accuracy, sizeof accuracy, "%.9g", render_accuracy(v));
    snprintf(rotation, sizeof rotation, "%.9g", number_or(v->environment_rotation_deg, 0.0));
    snprintf(exposure, sizeof exposure, "%.9g", number_or(v->environment_exposure_ev, 0.0));
    const image_text metadata[] = {
        { "glint:version", glint_version() },
        { "glint:model", arguments_model_choice(v->model) },
        { "glint:facets", render_facets_name(v->facets) },
        { "glint:size", size },
        { "glint:tile", tile },
        { "glint:spp", spp },
        { "glint:accuracy", accuracy },
        { "glint:seed", seed },
        { "glint:bounces", bounces },
        { "glint:camera", v->camera ? v->camera : "" },
        { "glint:variant", v->variant ? v->variant : "" },
        { "glint:materials", materials },
        { "glint:light-set", render_light_set(v->light_set) },
        { "glint:environment", v->environment ? v->environment : "" },
        { "glint:environment-rotation", rotation },
        { "glint:environment-exposure", exposure },
        { "glint:environment-background", v->environment_background == 1 ? "off" : "on" },
    };
    const bool done = image_write_exr(v->output, picture, metadata, sizeof metadata / sizeof metadata[0], r);
    free(materials);
    return done;
}

bool render_write(const render_record *record, const image *picture, report *r)
{
    const render_values *v = record->values;
    const char *extension = strrchr(v->output, '.');
    if (strcasecmp(extension, ".exr") == 0)
        return write_exr(record, picture, r);
    return image_write_png(v->output, picture, isnan(v->exposure_ev) ? 0.0F : (float)v->exposure_ev, r);
}

static document *seconds_of(const render_record *record)
{
    document *d = document_object();
    document_set_number(d, "read", record->read_s);
    document_set_number(d, "load", record->statistics.load_s);
    document_set_number(d, "build", record->statistics.build_s);
    document_set_number(d, "render", record->statistics.render_s);
    document_set_number(d, "write", record->write_s);
    document_set_number(d, "total", record->total_s);
    return d;
}

static document *integers(const int64_t *values, int count)
{
    document *d = document_array();
    for (int i = 0; i < count; ++i)
        document_append_integer(d, (uint64_t)values[i]);
    return d;
}

int render_print_document(const render_record *record, document *warnings)
{
    const render_values *v = record->values;
    const preview_statistics *s = &record->statistics;
    document *d = document_object(), *rays = document_object(), *evals = document_object();
    document_set_text(d, "file", record->file);
    document_set_text(d, "output", v->output);
    document_set(d, "size", integers(v->size, 2));
    if (v->tile[2] > 0)
        document_set(d, "tile", integers(v->tile, 4));
    document_set_integer(d, "spp", (uint64_t)s->samples);
    document_set_number(d, "accuracy", render_accuracy(v));
    document_set_text(d, "model", arguments_model_choice(v->model));
    document_set_text(d, "facets", render_facets_name(v->facets));
    document_set_integer(d, "seed", (uint64_t)v->seed);
    document_set_integer(d, "bounces", (uint64_t)v->bounces);
    document_set_text(d, "light_set", render_light_set(v->light_set));
    if (v->environment) {
        document_set_text(d, "environment", v->environment);
        document_set_number(d, "environment_rotation_deg", number_or(v->environment_rotation_deg, 0.0));
        document_set_number(d, "environment_exposure_ev", number_or(v->environment_exposure_ev, 0.0));
    }
    document_set(d, "seconds", seconds_of(record));
    document_set_integer(rays, "camera", s->camera_rays);
    document_set_integer(rays, "shadow", s->shadow_rays);
    document_set_integer(rays, "bounce", s->bounce_rays);
    document_set(d, "rays", rays);
    document_set_integer(evals, "glint", s->glint_evals);
    document_set_integer(evals, "smooth", s->smooth_evals);
    document_set(d, "evals", evals);
    if (record->plan)
        document_set(d, "plan", record->plan);
    document_set_integer(d, "peak_memory_bytes", peak_memory_bytes());
    document_set(d, "warnings", warnings);
    return print_document(d);
}

void render_print_line(const render_record *record)
{
    const render_values *v = record->values;
    printf("%s: %" PRId64 "x%" PRId64 ", %d spp, %.1f s, %.0f MiB\n", v->output, v->size[0], v->size[1],
           record->statistics.samples, record->total_s, (double)peak_memory_bytes() / (1024.0 * 1024.0));
}
