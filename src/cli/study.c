/* glint study: what accuracy costs and how far off it is, as tables, figures and one page. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "study/study.h"

typedef struct study_values {
    const char *output;
    bool chosen[STUDY_COUNT];
    bool quick, json;
} study_values;

#define AT(member) offsetof(study_values, member)

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "DIR",
      .help = "folder for report.html, tables and figures; study",
      .kind = ARGUMENT_TEXT,
      .target = AT(output) },
    { .name = "law",
      .help = "the binomial law",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_LAW * sizeof(bool) },
    { .name = "lights",
      .help = "lights of real size: errors",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_LIGHTS * sizeof(bool) },
    { .name = "integrals",
      .help = "lights of real size: ways to integrate",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_INTEGRALS * sizeof(bool) },
    { .name = "look-ups",
      .help = "how many of the 36 counts are looked up",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_LOOK_UPS * sizeof(bool) },
    { .name = "models",
      .help = "models against every facet",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_MODELS * sizeof(bool) },
    { .name = "images",
      .help = "whole images: error against seconds",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_IMAGES * sizeof(bool) },
    { .name = "arithmetic",
      .help = "float against double, exact bits against fused",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_ARITHMETIC * sizeof(bool) },
    { .name = "memory",
      .help = "bytes of tables and maps",
      .kind = ARGUMENT_FLAG,
      .target = AT(chosen) + STUDY_MEMORY * sizeof(bool) },
    { .name = "quick",
      .help = "measure as much as a test has the time for",
      .kind = ARGUMENT_FLAG,
      .target = AT(quick) },
    { .name = "json", .help = "print one JSON document", .kind = ARGUMENT_FLAG, .target = AT(json) },
};

static const argument_syntax syntax = {
    .command = "glint study",
    .operands = "",
    .summary = "Measures what accuracy costs: those studies that are named, or all.",
    .operands_min = 0,
    .operands_max = 0,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* Studies that have been run, and the one that runs. */
typedef struct study_series {
    study_outcome outcomes[STUDY_COUNT];
    size_t count;
    double done, now, asked; /* shares of the time: of those before, of this one, of all that are asked for */
    progress bar;
    double start_s;
    const atomic_bool *interrupted;
} study_series;

static bool is_stopped(void *user)
{
    const study_series *const s = user;
    return atomic_load(s->interrupted);
}

static void show_progress(double fraction, void *user)
{
    study_series *const s = user;
    const double done = (s->done + fraction * s->now) / s->asked, elapsed_s = clock_s() - s->start_s;
    progress_update(done, elapsed_s, done > 0.0 ? elapsed_s * (1.0 / done - 1.0) : -1.0, &s->bar);
}

static bool is_chosen(const study_values *v, int i)
{
    bool any = false;
    for (int k = 0; k < STUDY_COUNT; ++k)
        any = any || v->chosen[k];
    return v->chosen[i] || !any;
}

static bool make_folder(const char *path, report *r)
{
    struct stat there;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &there) == 0 && S_ISDIR(there.st_mode)))
        return true;
    return report_error(r, "--output: %s cannot be a folder: %s", path, strerror(errno));
}

/* Runs what was asked for and writes the page. False after an error or an interruption. */
static bool measure(const study_values *v, study_series *s, report *r)
{
    study_options options = {
        .folder = v->output, .quick = v->quick, .is_stopped = is_stopped, .progress = show_progress, .user = s
    };
    if (!make_folder(v->output, r))
        return false;
    if (!study_can_plot()) {
        report_warning(r, "gnuplot was not found: there will be tables and no figures");
        options.no_figures = true;
    }
    for (int i = 0; i < STUDY_COUNT; ++i)
        s->asked += is_chosen(v, i) ? studies[i]->share : 0.0;
    s->bar = progress_begin(stderr);
    s->start_s = clock_s();
    bool done = true;
    for (int i = 0; i < STUDY_COUNT && done; ++i) {
        if (!is_chosen(v, i))
            continue;
        s->now = studies[i]->share;
        done = study_do(studies[i], &options, &s->outcomes[s->count], r);
        s->done += s->now;
        s->count++;
    }
    progress_end(&s->bar);
    return done && study_write_page(&options, s->outcomes, s->count, r);
}

static bool all_hold(const study_series *s)
{
    int failed = 0;
    for (size_t i = 0; i < s->count; ++i)
        failed += s->outcomes[i].failed;
    return failed == 0;
}

/* A dial: its table, what to choose, and every setting by its cost. */
static document *document_of_front(const study_front_table *t)
{
    document *const d = document_object(), *const settings = document_array();
    document_set_text(d, "table", t->dial.table);
    document_set_text(d, "cost", t->dial.cost);
    document_set_text(d, "error", t->dial.error);
    document_set_text(d, "choose", t->dial.choose);
    for (int i = 0; i < t->count; ++i) {
        document *const s = document_object();
        document_set_text(s, "name", t->settings[i].name);
        document_set_number(s, "cost", t->settings[i].cost);
        document_set_number(s, "error", t->settings[i].error);
        document_set_number(s, "error_bar", t->settings[i].bar);
        document_set_boolean(s, "on_front", t->settings[i].on_front);
        document_append(settings, s);
    }
    document_set(d, "settings", settings);
    return d;
}

static document *document_of(const study_outcome *o)
{
    document *const d = document_object(), *const notes = document_array(), *const checks = document_array(),
                    *const tables = document_array(), *const figures = document_array(),
                    *const fronts = document_array();
    for (size_t i = 0; i < o->front_count; ++i)
        document_append(fronts, document_of_front(&o->fronts[i]));
    document_set_text(d, "name", o->study->name);
    document_set_text(d, "title", o->study->title);
    document_set_text(d, "truth", o->study->truth);
    document_set_text(d, "choose", study_outcome_choose(o));
    document_set_number(d, "elapsed_s", o->elapsed_s);
    for (size_t i = 0; i < o->line_count; ++i) {
        if (!o->lines[i].is_check) {
            document_append_text(notes, o->lines[i].text);
            continue;
        }
        document *const check = document_object();
        document_set_text(check, "text", o->lines[i].text);
        document_set_boolean(check, "holds", o->lines[i].holds);
        document_append(checks, check);
    }
    for (size_t i = 0; i < o->table_count; ++i)
        document_append_text(tables, o->tables[i]);
    for (const study_figure *f = o->study->figures; f && f->name && o->has_figures; ++f)
        document_append_text(figures, f->name);
    document_set(d, "notes", notes);
    document_set(d, "checks", checks);
    document_set(d, "tables", tables);
    document_set(d, "figures", figures);
    document_set(d, "fronts", fronts);
    return d;
}

/* Takes the warnings over. */
static int print_json(const study_values *v, const study_series *s, document *warnings)
{
    document *const d = document_object(), *const all = document_array();
    document_set_text(d, "folder", v->output);
    document_set_boolean(d, "quick", v->quick);
    document_set_boolean(d, "holds", all_hold(s));
    for (size_t i = 0; i < s->count; ++i)
        document_append(all, document_of(&s->outcomes[i]));
    document_set(d, "studies", all);
    document_set(d, "warnings", warnings);
    return print_document(d);
}

static void print_lines(const study_values *v, const study_series *s)
{
    for (size_t i = 0; i < s->count; ++i) {
        const study_outcome *const o = &s->outcomes[i];
        printf("%s: %s, against %s\n", o->study->name, o->study->title, o->study->truth);
        printf("  choose %s\n", study_outcome_choose(o));
        for (size_t k = 0; k < o->line_count; ++k)
            if (!o->lines[k].is_check || !o->lines[k].holds)
                printf("  %s%s\n", o->lines[k].is_check ? "beyond its bound: " : "", o->lines[k].text);
        printf("  %d bounds, %d do not hold; %.1f s\n", o->checks, o->failed, o->elapsed_s);
    }
    printf("%s/report.html\n", v->output);
}

static int run(const study_values *v)
{
    messages m;
    study_series s = { .interrupted = interrupt_watch() };
    messages_begin(&m, v->json);
    int code = COMMAND_DONE;
    if (measure(v, &s, &m.report)) {
        if (v->json) {
            code = print_json(v, &s, m.warnings);
            m.warnings = NULL;
        } else {
            print_lines(v, &s);
        }
        if (code == COMMAND_DONE && !all_hold(&s))
            code = COMMAND_BAD_INPUT;
    } else if (m.report.error[0] != '\0') {
        code = messages_fail(&m);
    } else {
        fputs("glint: interrupted; the tables that were finished are there\n", stderr);
        code = interrupt_exit_code();
    }
    messages_end(&m);
    for (size_t i = 0; i < s.count; ++i)
        study_outcome_free(&s.outcomes[i]);
    return code;
}

int command_study(int argc, char **argv)
{
    study_values values = { .output = "study" };
    switch (arguments_parse(&syntax, argc, argv, &values, NULL)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    return run(&values);
}
