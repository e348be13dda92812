/* What glint render was asked for and what it did. */
#ifndef CLI_RENDER_H
#define CLI_RENDER_H

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/progress.h"
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
    int64_t frames[2];                                        /* first and last; -1: the scene at rest */
    double fps;                                               /* NAN: not given */
    const char *animation;                                    /* NULL: all of the file */
    bool overwrite;
    bool aov, json;
    bool all; /* glint plan: every decision */
} render_values;

/* How far the frames of a command are. */
typedef struct render_course {
    int64_t done, count;
    double start_s; /* of the clock */
} render_course;

/* Of one picture. */
typedef struct render_record {
    const char *file;
    const render_values *values;
    int64_t frame;               /* -1: none, the scene at rest */
    const render_course *course; /* NULL: this picture is all */
    const scene *scene;          /* while it is rendered, and so are the report and the bar */
    report *report;
    progress bar;
    document *plan; /* with --json; NULL: nothing was planned */
    bool unmet;     /* the plan does not keep the accuracy that was asked for */
    bool quiet;     /* which has been said of an earlier frame */
    double read_s, write_s, total_s;
    preview_statistics statistics;
} render_record;

/* ---- render.c ---- */

/* Renders what the options say, shows the progress and keeps the plan. False after an error, and after an
 * interruption, which leaves the report as it was. */
bool render_picture(render_record *record, const scene *s, preview_options *options, image *picture, report *r);

/* ---- render_frames.c ---- */

/* The pictures of --frames; returns an exit code. */
int render_frames(const char *path, const render_values *values);

/* ---- render_frame_name.c ---- */

/* The name of a frame's picture, to be freed; NULL without memory. The last #### in the name of the file become the
 * number, as many digits at least; without any it stands before the extension, with four. */
char *render_frame_name(const char *output, int64_t frame);
/* When a frame is: in single precision, as keys are, so that one that lies on a key meets it. */
double render_frame_time_s(const render_values *v, int64_t frame);

/* ---- render_scene.c: what glint plan does as well ---- */

/* The options of glint render; behind the first few, which are about its output, those of glint plan; the last are
 * plan's alone. */
enum { RENDER_RULE_COUNT = 25, RENDER_OWN_RULES = 9, PLAN_OWN_RULES = 1 };
extern const argument_rule render_rules[RENDER_RULE_COUNT + PLAN_OWN_RULES];
render_values render_defaults(void);
#define RENDER_FPS 24.0 /* of film, and of Blender */
double render_accuracy(const render_values *v);
/* NAN is what was not given. */
double render_number_or(double given, double otherwise);

bool render_read_scene(const char *path, const render_values *v, scene *s, report *r);
/* The scene that has just been read gets the materials of the command line. */
bool render_dress_scene(const render_values *v, scene *s, report *r);
/* *camera is NULL where none is asked for. */
bool render_pick_camera(const scene *s, const char *wanted, const scene_camera **camera, report *r);
/* 0: the plan chooses. */
int render_samples(const render_values *v);

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
/* Warns where the plan does not meet its budget, and returns whether it does not. */
bool plan_warn(const glint_plan *plan, double budget, report *r);

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
/* Whether the picture is there, rendered as the record asks. One that was rendered otherwise is an error. */
bool render_is_finished(const render_record *record, bool *finished, report *r);
bool render_writes_png(const render_values *v);

/* ---- render_record.c ---- */

/* The choices of --facets, in the order of preview_facets. */
const char *render_facets_name(int index);

/* Writes the picture with its metadata. */
bool render_write(const render_record *record, const image *picture, report *r);

/* The document of --json; takes the warnings. */
int render_print_document(const render_record *record, document *warnings);
/* What it says of one frame, and of all; takes the frames and the warnings. */
document *render_frame_document(const render_record *record, bool skipped);
int render_print_frames(const render_record *all, document *frames, int64_t rendered, int64_t skipped,
                        document *warnings);
/* One line for people. */
void render_print_line(const render_record *record);

#endif
