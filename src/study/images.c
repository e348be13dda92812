/* The study of whole pictures: error against seconds, for samples per pixel and for the budget of --accuracy, on four
 * scenes. */
#include "study/images.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preview/preview.h"
#include "study/study.h"

extern const unsigned char images_samples_gnuplot[], images_accuracy_gnuplot[];

static const int samples_of[] = { 1, 4, 16, 64, 256, 1024 };
static const double accuracies[] = { 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002 };
enum { MOST_ROUNDS = 3 };
enum { SAMPLES = sizeof samples_of / sizeof samples_of[0], ACCURACIES = sizeof accuracies / sizeof accuracies[0] };

/* How large, and how long. */
typedef struct size_of_study {
    int width, height;
    int most;               /* samples, of those above */
    int truth_spp;          /* each of two references */
    int budget_spp, rounds; /* of budgets */
} size_of_study;

static size_of_study size_for(bool quick)
{
    return quick ? (size_of_study){ 48, 36, 4, 256, 64, 1 }
                 : (size_of_study){ 64, 48, SAMPLES, 1024, 256, MOST_ROUNDS };
}

/* How many samples a pixel are done of all that the study takes, over its pictures. */
typedef struct images_progress {
    study_run *run;
    double done, now, all; /* now: of the picture that is being rendered */
    atomic_bool stopped;
} images_progress;

static images_progress progress;

static void begin_progress(study_run *run, const size_of_study *size)
{
    double all = 2.0 * size->truth_spp + (1.0 + (ACCURACIES + 1.0) * size->rounds) * size->budget_spp;
    for (int i = 0; i < size->most; i++)
        all += samples_of[i];
    progress = (images_progress){ .run = run, .all = IMAGES_SCENES * all };
}

static bool stopped(study_run *run)
{
    return !study_goes_on(run, fmin(progress.done / progress.all, 1.0));
}

/* Of one picture: the user may stop the study within it. */
static void note_progress(double fraction, double elapsed_s, double left_s, void *user)
{
    (void)elapsed_s;
    (void)left_s;
    images_progress *const p = user;
    if (!study_goes_on(p->run, fmin((p->done + fraction * p->now) / p->all, 1.0)))
        atomic_store(&p->stopped, true);
}

/* Seconds of processor time, or a negative number after a failure. */
static double render(study_run *run, const scene *s, const size_of_study *size, int spp, double accuracy, uint32_t seed,
                     image *out)
{
    progress.now = spp;
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = size->width;
    o.height = size->height;
    o.spp = spp;
    o.bounces = 0;
    o.accuracy = accuracy;
    o.seed = seed;
    o.progress = note_progress;
    o.user = &progress;
    o.cancel = &progress.stopped;
    const double start = study_cpu_s();
    if (!preview_render(s, &o, out, NULL, study_report(run)))
        return -1.0;
    progress.done += spp;
    return study_cpu_s() - start;
}

/* What an error is held against: the mean light of a picture; or its root mean square, as the plan does, since the
 * mean of a few sparks on black says little about any of them. */
typedef enum norm { OVER_MEAN, OVER_ROOT_MEAN_SQUARE } norm;

/* Root mean square of the difference of luminances over a norm of b, and a standard error by its pixels. */
static double difference(const image *a, const image *b, norm over, double *bar)
{
    double square = 0.0, fourth = 0.0, mean = 0.0, light_square = 0.0;
    const int count = a->width * a->height, channels = a->channel_count;
    for (int i = 0; i < count; i++) {
        double d = 0.0, light = 0.0;
        for (int c = 0; c < 3; c++) {
            const float *const p = &a->pixels[i * channels + c], *const q = &b->pixels[i * channels + c];
            d += ((double)*p - (double)*q) / 3.0;
            light += (double)*q / 3.0;
        }
        mean += light / count;
        light_square += light * light / count;
        square += d * d / count;
        fourth += d * d * d * d / count;
    }
    const double rms = sqrt(square), whole = over == OVER_MEAN ? mean : sqrt(light_square);
    *bar = rms > 0.0 ? sqrt(fmax(fourth - square * square, 0.0) / count) / (2.0 * rms * whole) : 0.0;
    return rms / whole;
}

/* a becomes the mean of a and b. */
static void average(image *a, const image *b)
{
    for (int i = 0; i < a->width * a->height * a->channel_count; i++)
        a->pixels[i] = 0.5F * (a->pixels[i] + b->pixels[i]);
}

/* The mean of two long renders with other samples, and how far it is from what more would give. */
static bool find_truth(study_run *run, const scene *s, const size_of_study *size, image *truth, double *noise)
{
    image second;
    double bar;
    if (render(run, s, size, size->truth_spp, 0.0, 11U, truth) < 0.0)
        return false;
    if (render(run, s, size, size->truth_spp, 0.0, 12U, &second) < 0.0) {
        image_free(truth);
        return false;
    }
    *noise = 0.5 * difference(truth, &second, OVER_MEAN, &bar);
    average(truth, &second);
    image_free(&second);
    return true;
}

typedef struct picture_error {
    double cost_s, error, bar;
} picture_error;

static bool measure_picture(study_run *run, const scene *s, const size_of_study *size, int spp, double accuracy,
                            const image *truth, norm over, picture_error *out)
{
    image picture;
    out->cost_s = render(run, s, size, spp, accuracy, 1U, &picture);
    if (out->cost_s < 0.0)
        return false;
    out->error = difference(&picture, truth, over, &out->bar);
    image_free(&picture);
    return true;
}

/* Samples against the truth. */
static void measure_samples(study_run *run, int which, const scene *s, const size_of_study *size,
                            picture_error found[SAMPLES])
{
    image truth;
    double noise;
    if (!find_truth(run, s, size, &truth, &noise))
        return;
    for (int i = 0; i < size->most; i++) {
        if (!measure_picture(run, s, size, samples_of[i], 0.0, &truth, OVER_MEAN, &found[i]))
            break;
        found[i].bar = hypot(found[i].bar, noise);
        study_row(run, "%s,%d,%.5g,%.5g,%.2g,%d,%d", images_names[which], samples_of[i], found[i].cost_s,
                  found[i].error, found[i].bar, size->width * size->height, 2 * size->truth_spp);
    }
    image_free(&truth);
}

/* All budgets in turns, and none, against one picture of everything; the time is the median of their rounds. False
 * after a failure. */
static bool take_turns(study_run *run, const scene *s, const size_of_study *size, const image *whole,
                       picture_error found[ACCURACIES + 1])
{
    double times[ACCURACIES + 1][MOST_ROUNDS];
    for (int round = 0; round < size->rounds; round++)
        for (int i = 0; i <= ACCURACIES; i++) {
            const double accuracy = i < ACCURACIES ? accuracies[i] : 0.0;
            if (!measure_picture(run, s, size, size->budget_spp, accuracy, whole, OVER_ROOT_MEAN_SQUARE, &found[i]))
                return false;
            times[i][round] = found[i].cost_s;
        }
    for (int i = 0; i <= ACCURACIES; i++)
        found[i].cost_s = study_median(times[i], size->rounds);
    return true;
}

/* What budgets leave out of the same samples without one. */
static void measure_accuracies(study_run *run, int which, const scene *s, const size_of_study *size,
                               picture_error found[ACCURACIES + 1])
{
    image whole;
    if (render(run, s, size, size->budget_spp, 0.0, 1U, &whole) < 0.0)
        return;
    if (take_turns(run, s, size, &whole, found))
        for (int i = ACCURACIES; i >= 0; i--)
            study_row(run, "%s,%g,%.5g,%.5g,%.2g,%d", images_names[which], i < ACCURACIES ? accuracies[i] : 0.0,
                      found[i].cost_s, found[i].error, found[i].bar, size->budget_spp);
    image_free(&whole);
}

static void over_scenes(study_run *run, const size_of_study *size, picture_error (*samples)[SAMPLES],
                        picture_error (*budgets)[ACCURACIES + 1])
{
    for (int k = 0; k < IMAGES_SCENES; k++) {
        scene s;
        if (stopped(run))
            return;
        if (images_make(k, &s, study_report(run))) {
            if (samples)
                measure_samples(run, k, &s, size, samples[k]);
            else
                measure_accuracies(run, k, &s, size, budgets[k]);
        }
        scene_free(&s);
    }
}

static void check_samples(study_run *run, const size_of_study *size, picture_error (*found)[SAMPLES])
{
    static char names[IMAGES_SCENES][SAMPLES][48];
    const int last = size->most - 1;
    for (int k = 0; k < IMAGES_SCENES; k++)
        study_check(run, found[k][last].error < found[k][1].error / 2.0,
                    "%s: the error is %.2f of the mean light with 4 samples a pixel, %.3f with %d", images_names[k],
                    found[k][1].error, found[k][last].error, samples_of[last]);
    study_setting settings[SAMPLES];
    for (int i = 0; i < size->most; i++) {
        snprintf(names[0][i], sizeof names[0][i], "%d sample%s", samples_of[i], samples_of[i] == 1 ? "" : "s");
        settings[i] = (study_setting){ names[0][i], found[IMAGES_AREA][i].cost_s, found[IMAGES_AREA][i].error,
                                       found[IMAGES_AREA][i].bar, false };
    }
    static const study_dial dial = { "images_samples_front.csv",
                                     "Samples of the ball under a lamp.",
                                     "seconds of one core",
                                     "cost_s",
                                     "root mean square error over the mean",
                                     "16 samples for a look, 64 for a picture, 256 for a reference." };
    study_front(run, &dial, settings, size->most);
}

/* What is certainly left out, by three standard errors, over what may be. */
static double share_of_budget(const picture_error *e, int accuracy)
{
    return (e->error - 3.0 * e->bar) / accuracies[accuracy];
}

static void check_accuracies(study_run *run, picture_error (*found)[ACCURACIES + 1])
{
    static char names[ACCURACIES + 1][32];
    for (int k = 0; k < IMAGES_SCENES; k++) {
        int worst = 0;
        double share = 0.0;
        for (int i = 0; i < ACCURACIES; i++) {
            share = fmax(share, share_of_budget(&found[k][i], i));
            if (found[k][i].error / accuracies[i] > found[k][worst].error / accuracies[worst])
                worst = i;
        }
        study_check(run, share <= 1.0, "%s: --accuracy %g leaves out most for its budget, %.4f ± %.4f of the picture",
                    images_names[k], accuracies[worst], found[k][worst].error, found[k][worst].bar);
    }
    study_setting settings[ACCURACIES + 1];
    for (int i = 0; i <= ACCURACIES; i++) {
        snprintf(names[i], sizeof names[i], "--accuracy %g", i < ACCURACIES ? accuracies[i] : 0.0);
        settings[i] = (study_setting){ names[i], found[IMAGES_AREA][i].cost_s, found[IMAGES_AREA][i].error,
                                       found[IMAGES_AREA][i].bar, false };
    }
    static const study_dial dial = {
        "images_accuracy_front.csv",
        "Budgets for the ball under a lamp.",
        "seconds of one core",
        "cost_s",
        "what was left out, over the root mean square of the picture",
        "Take --accuracy .02 or more but for references: the picture then takes a fraction of the time."
    };
    study_front(run, &dial, settings, ACCURACIES + 1);
}

static void measure(study_run *run)
{
    static picture_error samples[IMAGES_SCENES][SAMPLES], budgets[IMAGES_SCENES][ACCURACIES + 1];
    const size_of_study size = size_for(study_is_quick(run));
    begin_progress(run, &size);
    study_table(run, "images_samples.csv", "scene,samples,cost_s,error,error_bar,pixels,truth_samples");
    over_scenes(run, &size, samples, NULL);
    study_end_table(run);
    study_table(run, "images_accuracy.csv", "scene,accuracy,cost_s,left_out,bar,samples");
    over_scenes(run, &size, NULL, budgets);
    study_end_table(run);
    if (stopped(run))
        return;
    study_note(run,
               "near-sparse: a plane near by, black but for a few sparks, under a lamp; far-dense: one that runs to "
               "the horizon with millions of flakes, under the sun; area-lit: a ball under a square lamp; layered: a "
               "ball with glints below and in its coat, under it");
    check_samples(run, &size, samples);
    check_accuracies(run, budgets);
}

static const study_figure figures[] = {
    { "images_samples", "Error against seconds as samples are added, on four scenes.", images_samples_gnuplot },
    { "images_accuracy", "What --accuracy leaves out of a picture, and the time that it saves.",
      images_accuracy_gnuplot },
    { NULL, NULL, NULL },
};

extern const study images_study;

const study images_study = {
    .name = "images",
    .title = "Whole images: samples and budgets",
    .truth = "the mean of two long renders of everything; for budgets the same samples without one",
    .choose =
        "16 samples for a look, 64 for a picture, 256 for a reference, and --accuracy .02 for all but references.",
    .share = 0.68,
    .run = measure,
    .figures = figures,
};
