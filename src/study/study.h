/* THE CONTRACT of a study: what it must do so that `glint study` can run it, draw its figures and report on it.
 *
 * A study measures what accuracy costs and how far the library is from a truth that was not computed by it. It is one
 * file that ends in `const study NAME_study`, one row in the table of studies.c with its number here, and one rule in
 * cli/study.c. Its figures are gnuplot scripts NAME.gnuplot beside it, listed in CMakeLists.txt. They run in the folder
 * of the tables, after style.gnuplot.
 *
 * Nothing below fails by its return value alone: the first failure is remembered, what follows does nothing, and
 * study_goes_on says so. A study asks it in its outer loop.
 */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include <stdbool.h>
#include <stddef.h>

#include "glint.h"
#include "scene/report.h"

/* One study while it runs. */
typedef struct study_run study_run;

typedef struct study_figure {
    const char *name;            /* of NAME.svg and NAME.png; NULL ends a list */
    const char *caption;         /* what to see in it; its truth, sample sizes and bars stand in the figure itself */
    const unsigned char *script; /* NAME.gnuplot, made into text by the build */
} study_figure;

typedef struct study {
    const char *name;   /* of the option: glint study --NAME */
    const char *title;  /* what it measures */
    const char *truth;  /* what it holds that against */
    const char *choose; /* what to take, in one sentence, where study_choose does not say it */
    double share;       /* of the time of all studies, for the progress that is shown: measured once, and roughly */
    void (*run)(study_run *run);
    const study_figure *figures; /* NULL: none */
} study;

/* ---- what a study calls ---- */

/* Whether to measure only as much as a test has the time for: --quick. */
bool study_is_quick(const study_run *run);
/* fraction: of this study, done. False when something failed, or the user wants to stop: return then. */
bool study_goes_on(study_run *run, double fraction);

/* Begins FOLDER/NAME with a line of column names between commas. One table at a time. */
void study_table(study_run *run, const char *name, const char *columns);
/* One line of it, without its end. */
void study_row(study_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));
void study_end_table(study_run *run);

/* A sentence for the report. */
void study_note(study_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A bound, and the sentence that says what was found. Never about a time, which is noise on a busy machine. */
void study_check(study_run *run, bool holds, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* What to take, where only the measured numbers say it: in place of the study's own sentence. */
void study_choose(study_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* ---- dials: what a setting costs and how far off it is ---- */

typedef struct study_setting {
    const char *name; /* kept by the caller until the study ends */
    double cost, error;
    double bar;    /* of the error: one standard deviation of its estimate */
    bool on_front; /* out: no other setting costs less and is nearer */
} study_setting;

typedef struct study_dial {
    const char *table;       /* NAME.csv */
    const char *title;       /* of the table in the report */
    const char *cost, *unit; /* "ns a draw", and the column "cost_ns" */
    const char *error;       /* what the error is */
    const char *choose;      /* which setting to take, in one sentence */
} study_dial;

/* Marks the front, writes the table, and shows it in the report. */
void study_front(study_run *run, const study_dial *dial, study_setting *settings, int count);

/* Seconds of processor time of all threads. Another program beside stretches them all the same, by what it takes of
 * caches and cores: ways that are compared take turns, their median round counts, and no bound is set to a time. */
double study_cpu_s(void);
/* Sorts them; the second returns the one in the middle. */
void study_sort(double *values, int count);
double study_median(double *values, int count);

/* glint_material_create; NULL is a failure. */
glint_material *study_material(study_run *run, const glint_material_options *options);

/* A path in the folder, for files that are no tables; free it. NULL is a failure. */
char *study_path(study_run *run, const char *name);
report *study_report(study_run *run);

/* ---- what the command calls ---- */

enum {
    STUDY_LAW,
    STUDY_LIGHTS,
    STUDY_INTEGRALS,
    STUDY_LOOK_UPS,
    STUDY_MODELS,
    STUDY_IMAGES,
    STUDY_ARITHMETIC,
    STUDY_MEMORY,
    STUDY_COUNT
};

extern const study *const studies[STUDY_COUNT];

typedef struct study_options {
    const char *folder; /* exists */
    bool quick;
    bool no_figures;                               /* tables only */
    bool (*is_stopped)(void *user);                /* NULL: never */
    void (*progress)(double fraction, void *user); /* NULL: nobody looks */
    void *user;
} study_options;

typedef struct study_line {
    char *text;
    bool is_check, holds;
} study_line;

/* A dial as the report shows it. */
typedef struct study_front_table {
    study_dial dial;
    study_setting *settings; /* by cost */
    int count;
} study_front_table;

/* What a study found. */
typedef struct study_outcome {
    const study *study;
    char *choose; /* NULL: what the study says */
    double elapsed_s;
    int checks, failed;
    study_line *lines;
    size_t line_count;
    char **tables; /* names of files in the folder */
    size_t table_count;
    study_front_table *fronts;
    size_t front_count;
    bool has_figures;
} study_outcome;

/* Runs one study and draws its figures. False: something failed, or it was stopped (then there is no error). */
bool study_do(const study *what, const study_options *options, study_outcome *out, report *r);
void study_outcome_free(study_outcome *outcome);
const char *study_outcome_choose(const study_outcome *outcome);

/* Writes FOLDER/report.html, which holds the figures that lie beside it. */
bool study_write_page(const study_options *options, const study_outcome *outcomes, size_t count, report *r);

/* Whether there is gnuplot. */
bool study_can_plot(void);
/* FOLDER/NAME.svg and .png. */
bool study_plot(const char *folder, const study_figure *figure, report *r);

#endif
