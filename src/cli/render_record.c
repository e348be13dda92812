/* What a render leaves: its picture, and a JSON document or a line on standard output. */
#include <inttypes.h>
#include <sys/resource.h>

#include "cli/render.h"

/* Of this process, so far. Linux counts in KiB. */
static uint64_t peak_memory_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024U : 0U;
}

/* A tile says where it lies. */
static image placed(const image *picture, const render_values *v)
{
    image i = *picture;
    if (v->tile[2] > 0) {
        i.x = (int)v->tile[0];
        i.y = (int)v->tile[1];
        i.full_width = (int)v->size[0];
        i.full_height = (int)v->size[1];
    }
    return i;
}

bool render_write(const render_record *record, const image *picture, report *r)
{
    const render_values *v = record->values;
    const image i = placed(picture, v);
    render_metadata metadata;
    if (!render_metadata_make(record, record->statistics.samples, &metadata, r))
        return false;
    const bool done = render_writes_png(v)
                          ? image_write_png_with_metadata(v->output, &i, (float)render_number_or(v->exposure_ev, 0.0),
                                                          metadata.items, metadata.count, r)
                          : image_write_exr(v->output, &i, metadata.items, metadata.count, r);
    render_metadata_free(&metadata);
    return done;
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

/* What every picture of the command shares. */
static document *settings_document(const render_record *record)
{
    const render_values *v = record->values;
    document *d = document_object();
    document_set_text(d, "file", record->file);
    document_set_text(d, "output", v->output);
    document_set(d, "size", integers(v->size, 2));
    if (v->tile[2] > 0)
        document_set(d, "tile", integers(v->tile, 4));
    document_set_number(d, "accuracy", render_accuracy(v));
    document_set_text(d, "model", arguments_model_choice(v->model));
    document_set_text(d, "facets", render_facets_name(v->facets));
    document_set_integer(d, "seed", (uint64_t)v->seed);
    document_set_integer(d, "bounces", (uint64_t)v->bounces);
    document_set_text(d, "light_set", render_light_set(v->light_set));
    if (v->environment) {
        document_set_text(d, "environment", v->environment);
        document_set_number(d, "environment_rotation_deg", render_number_or(v->environment_rotation_deg, 0.0));
        document_set_number(d, "environment_exposure_ev", render_number_or(v->environment_exposure_ev, 0.0));
    }
    return d;
}

/* Takes the plan. */
static void set_outcome(document *d, const render_record *record)
{
    const preview_statistics *s = &record->statistics;
    document *rays = document_object(), *evals = document_object();
    document_set_integer(d, "spp", (uint64_t)s->samples);
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
}

int render_print_document(const render_record *record, document *warnings)
{
    document *d = settings_document(record);
    set_outcome(d, record);
    document_set_integer(d, "peak_memory_bytes", peak_memory_bytes());
    document_set(d, "warnings", warnings);
    return print_document(d);
}

document *render_frame_document(const render_record *record, bool skipped)
{
    document *d = document_object();
    document_set_integer(d, "frame", (uint64_t)record->frame);
    document_set_number(d, "time_s", render_frame_time_s(record->values, record->frame));
    document_set_text(d, "output", record->values->output);
    document_set_boolean(d, "skipped", skipped);
    if (!skipped)
        set_outcome(d, record);
    return d;
}

int render_print_frames(const render_record *all, document *frames, int64_t rendered, int64_t skipped,
                        document *warnings)
{
    document *d = settings_document(all), *seconds = document_object();
    document_set_number(d, "fps", render_number_or(all->values->fps, RENDER_FPS));
    if (all->values->animation)
        document_set_text(d, "animation", all->values->animation);
    document_set(d, "frames", frames);
    document_set_integer(d, "rendered", (uint64_t)rendered);
    document_set_integer(d, "skipped", (uint64_t)skipped);
    document_set_number(seconds, "read", all->read_s);
    document_set_number(seconds, "total", all->total_s);
    document_set(d, "seconds", seconds);
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
