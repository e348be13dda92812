/* A study while it runs: its tables, its sentences, its bounds, and the first thing that went wrong. */
#include "study/outcome.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "io/output_file.h"

struct study_run {
    const study_options *options;
    study_outcome *out;
    output_file *table;
    report *report;
    bool stopped;
};

static bool has_failed(const study_run *run)
{
    return run->report->error[0] != '\0' || run->stopped;
}

static void fail_for_memory(study_run *run)
{
    report_error(run->report, "%s: no memory for the study", run->out->study->name);
}

static char *text_of(const char *format, va_list list) __attribute__((format(printf, 1, 0)));

/* NULL without memory. */
static char *text_of(const char *format, va_list list)
{
    va_list again;
    va_copy(again, list);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *const text = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (text)
        vsnprintf(text, (size_t)length + 1, format, list);
    return text;
}

bool study_is_quick(const study_run *run)
{
    return run->options->quick;
}

bool study_goes_on(study_run *run, double fraction)
{
    const study_options *const o = run->options;
    if (o->is_stopped && o->is_stopped(o->user))
        run->stopped = true;
    if (has_failed(run))
        return false;
    if (o->progress)
        o->progress(fraction, o->user);
    return true;
}

report *study_report(study_run *run)
{
    return run->report;
}

char *study_path(study_run *run, const char *name)
{
    const size_t size = strlen(run->options->folder) + strlen(name) + 2;
    char *const path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", run->options->folder, name);
    else
        fail_for_memory(run);
    return path;
}

/* ---- tables ---- */

static bool remember_table(study_outcome *out, const char *name)
{
    char **const more = realloc(out->tables, (out->table_count + 1) * sizeof *more);
    if (!more)
        return false;
    out->tables = more;
    more[out->table_count] = strdup(name);
    return more[out->table_count] && ++out->table_count;
}

void study_table(study_run *run, const char *name, const char *columns)
{
    if (has_failed(run))
        return;
    char *const path = study_path(run, name);
    if (!path)
        return;
    run->table = output_file_open(path, run->report);
    free(path);
    if (run->table && !remember_table(run->out, name))
        fail_for_memory(run);
    study_row(run, "%s", columns);
}

void study_row(study_run *run, const char *format, ...)
{
    if (has_failed(run) || !run->table)
        return;
    va_list list;
    va_start(list, format);
    char *const text = text_of(format, list);
    va_end(list);
    if (text) {
        output_file_write(run->table, text, strlen(text));
        output_file_write(run->table, "\n", 1);
    } else {
        fail_for_memory(run);
    }
    free(text);
}

void study_end_table(study_run *run)
{
    if (!run->table)
        return;
    if (has_failed(run))
        output_file_abort(run->table);
    else
        output_file_commit(run->table, run->report);
    run->table = NULL;
}

/* ---- what was found ---- */

/* Takes the text over. */
static void add_line(study_run *run, char *text, bool is_check, bool holds)
{
    study_outcome *const out = run->out;
    study_line *const more = realloc(out->lines, (out->line_count + 1) * sizeof *more);
    if (!text || !more) {
        out->lines = more ? more : out->lines;
        free(text);
        fail_for_memory(run);
        return;
    }
    out->lines = more;
    more[out->line_count++] = (study_line){ text, is_check, holds };
}

void study_note(study_run *run, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add_line(run, text_of(format, list), false, true);
    va_end(list);
}

void study_choose(study_run *run, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    free(run->out->choose);
    run->out->choose = text_of(format, list);
    va_end(list);
    if (!run->out->choose)
        fail_for_memory(run);
}

void study_check(study_run *run, bool holds, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add_line(run, text_of(format, list), true, holds);
    va_end(list);
    run->out->checks++;
    run->out->failed += !holds;
}

void outcome_add_front(study_run *run, const study_dial *dial, const study_setting *settings, int count)
{
    study_outcome *const out = run->out;
    study_front_table *const more = realloc(out->fronts, (out->front_count + 1) * sizeof *more);
    study_setting *const copy = malloc((size_t)count * sizeof *copy);
    out->fronts = more ? more : out->fronts;
    if (!more || !copy) {
        free(copy);
        fail_for_memory(run);
        return;
    }
    memcpy(copy, settings, (size_t)count * sizeof *copy);
    more[out->front_count++] = (study_front_table){ *dial, copy, count };
}

glint_material *study_material(study_run *run, const glint_material_options *options)
{
    glint_material *material = NULL;
    char message[256];
    if (glint_material_create(options, &material, message, sizeof message) != GLINT_OK)
        report_error(run->report, "%s: a material of the study: %s", run->out->study->name, message);
    return material;
}

/* ---- one study as a whole ---- */

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

bool study_do(const study *what, const study_options *options, study_outcome *out, report *r)
{
    *out = (study_outcome){ .study = what };
    study_run run = { options, out, NULL, r, false };
    const double start = now_s();
    what->run(&run);
    study_end_table(&run);
    out->elapsed_s = now_s() - start;
    if (has_failed(&run))
        return false;
    for (const study_figure *f = what->figures; f && f->name && !options->no_figures; ++f) {
        if (!study_plot(options->folder, f, r))
            return false;
        out->has_figures = true;
    }
    return true;
}

const char *study_outcome_choose(const study_outcome *outcome)
{
    return outcome->choose ? outcome->choose : outcome->study->choose;
}

void study_outcome_free(study_outcome *outcome)
{
    for (size_t i = 0; i < outcome->line_count; ++i)
        free(outcome->lines[i].text);
    for (size_t i = 0; i < outcome->table_count; ++i)
        free(outcome->tables[i]);
    for (size_t i = 0; i < outcome->front_count; ++i)
        free(outcome->fronts[i].settings);
    free(outcome->fronts);
    free(outcome->choose);
    free(outcome->lines);
    free(outcome->tables);
    *outcome = (study_outcome){ 0 };
}
