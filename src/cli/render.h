/* What glint render was asked for and what it did. */
#ifndef CLI_RENDER_H
#define CLI_RENDER_H

#include "cli/arguments.h"
#include "cli/command.h"
#include "preview/preview.h"

typedef struct render_values {
    const char *output, *camera, *variant;
    assignments materials;
    int64_t size[2], tile[4];            /* tile: x, y, width, height; width 0: the whole picture */
    int64_t spp, threads, seed, bounces; /* spp 0: not given */
    double accuracy;                     /* NAN: not given */
    int model;                           /* see arguments_model_choice */
    int facets;                          /* a preview_facets */
    double exposure_ev;                  /* NAN: not given */
    const char *environment;
    double environment_rotation_deg, environment_exposure_ev; /* NAN: not given */
    int environment_background;                               /* 0 on, 1 off */
    int light_set;                                            /* 0: the file's own lights; then preview's sets */
    bool aov, json;
    bool all; /* glint plan: every decision */
} render_values;

typedef struct render_record {
    const char *file;
    const render_values *values;
    const scene *scene; /* while it is rendered, and so is the report */
    report *report;
    document *plan; /* with --json; NULL: nothing was planned */
    double read_s, write_s, total_s;
    preview_statistics statistics;
} render_record;

/* ---- render_scene.c: what glint plan does as well ---- */

/* The options of glint render; behind the first few, which are about its output, those of glint plan; the last are
 * plan's alone. */
enum { RENDER_RULE_COUNT = 21, RENDER_OWN_RULES = 5, PLAN_OWN_RULES = 1 };
extern const argument_rule render_rules[RENDER_RULE_COUNT + PLAN_OWN_RULES];
render_values render_defaults(void);
double render_accuracy(const render_values *v);
/* NAN is what was not given. */
double render_number_or(double given, double otherwise);

bool render_read_scene(const char *path, const render_values *v, scene *s, report *r);

/* ---- render_light.c: light that the command line brings ---- */

/* What the renderer's options point to. */
typedef struct render_light {
    environment_map map;
    preview_environment environment;
    preview_sky sky;
} render_light;

/* Exit code of wrong usage for options that mean nothing without another. */
int render_light_check(const argument_syntax *syntax, const render_values *v);
/* "file", then preview's sets. */
const char *render_light_set(int index);
/* Reads the environment, replaces the lights of the scene, and points options to both. The camera is in the options. */
bool render_light_begin(const render_values *v, scene *s, render_light *light, preview_options *options, report *r);
void render_light_end(render_light *light);

/* Turns the command line into the renderer's options, which then point to the scene and to *light; render_light_end
 * frees that, whether this succeeds or not. */
bool render_options(const render_values *v, scene *s, render_light *light, preview_options *options, report *r);

/* ---- plan.c ---- */

/* All decisions and what they come to. */
document *plan_document(const glint_plan *plan, const scene *s);
/* Warns where the plan does not meet its budget. */
void plan_warn(const glint_plan *plan, double budget, report *r);

/* ---- render_metadata.c ---- */

/* Texts that a picture carries; numbers holds those that are. */
typedef struct render_metadata {
    image_text items[24];
    size_t count, used;
    char numbers[512];
    char *materials;
} render_metadata;

/* samples 0: the plan has not chosen them yet, and nothing is said of them. */
bool render_metadata_make(const render_record *record, int samples, render_metadata *out, report *r);
void render_metadata_free(render_metadata *m);
bool render_writes_png(const render_values *v);

/* ---- render_record.c ---- */

/* The choices of --facets, in the order of preview_facets. */
const char *render_facets_name(int index);

/* Writes the picture with its metadata. */
bool render_write(const render_record *record, const image *picture, report *r);

/* The document of --json; takes the warnings. */
int render_print_document(const render_record *record, document *warnings);
/* One line for people. */
void render_print_line(const render_record *record);

#endif
