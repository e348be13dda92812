/* Whole pictures under error budgets from 0.002 to 0.5, with 1 to 256 samples: what is left out against the budget and
 * against what was foreseen, and the time that it saves. */
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "plan_cases.h"
#include "study.h"

static const double BUDGETS[] = { 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002 };
static const int SAMPLES[] = { 1, 4, 16, 64, 256 };
enum { BUDGET_COUNT = sizeof(BUDGETS) / sizeof(BUDGETS[0]), SAMPLES_COUNT = sizeof(SAMPLES) / sizeof(SAMPLES[0]) };

static glint_plan_outcome foreseen;

static void note_outcome(const glint_plan *plan, void *user)
{
    (void)user;
    foreseen = glint_plan_result(plan);
}

static double cpu_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static image render(const scene *s, preview_options o, double accuracy, int spp, double *seconds)
{
    image picture;
    report r = { 0 };
    const double start = cpu_s();
    o.accuracy = accuracy;
    o.spp = spp;
    o.threads = 1;
    o.planned = accuracy > 0.0 ? note_outcome : NULL;
    if (!preview_render(s, &o, &picture, NULL, &r)) {
        fprintf(stderr, "plan: %s\n", r.error);
        exit(1);
    }
    *seconds = cpu_s() - start;
    return picture;
}

/* Small budgets take exact integrals over lights, no budget the fit: the reference is whichever a picture comes from.
 */
static void measure(study *s, FILE *csv, int index, const scene *from, const preview_options *o, int spp)
{
    double all_s, exact_s, less_s;
    image all = render(from, *o, 0.0, spp, &all_s), exact = render(from, *o, 1e-6, spp, &exact_s);
    for (int b = 0; b < BUDGET_COUNT; b += s->is_short ? 3 : 1) {
        image less = render(from, *o, BUDGETS[b], spp, &less_s);
        const double error = fmin(plan_case_error(&less, &all), plan_case_error(&less, &exact));
        fprintf(csv, "%s,%d,%g,%g,%g,%g,%u,%g,%g\n", plan_case_name(index), spp, BUDGETS[b], error,
                (double)foreseen.error, (double)foreseen.noise, foreseen.is_met, all_s, less_s);
        study_check(s, error <= BUDGETS[b], "%s, %d samples: error %.4f, budget %g", plan_case_name(index), spp, error,
                    BUDGETS[b]);
        image_free(&less);
    }
    image_free(&all);
    image_free(&exact);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    FILE *const csv = study_open(&s, "plan.csv");
    fprintf(csv, "scene,samples,budget,error,foreseen,noise,met,seconds_all,seconds_planned\n");
    for (int i = 0; i < plan_case_count(); i++) {
        scene_camera from;
        preview_options o;
        scene made = plan_case(i, &from, &o);
        for (int k = 0; k < SAMPLES_COUNT; k += s.is_short ? 2 : 1)
            if (!s.is_short || SAMPLES[k] <= 16)
                measure(&s, csv, i, &made, &o, SAMPLES[k]);
        scene_free(&made);
    }
    study_close(csv);
    return study_end(&s);
}
