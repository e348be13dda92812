/* The study of ways to integrate over a light of real size: its middle as a point and as a cap, the library's
 * integrals, quadrature of growing order, points at random; each against adaptive quadrature in double. */
#include <math.h>
#include <stdlib.h>

#include "study/area_adaptive.h"
#include "study/study.h"
#include "study/ways.h"

extern const unsigned char integrals_gnuplot[];

/* What the truth is known to, relative: below anything that is shown. */
#define TOLERANCE 1e-9

typedef struct measured {
    area_case c;
    glint_surface surface;
    double truth, truth_error;
} measured;

/* Rectangles that light more than a hundred thousandth of a white wall. */
static int find_cases(study_run *run, int wanted, const glint_material *m, measured *cases)
{
    uint64_t random = 71;
    int count = 0;
    while (count < wanted && study_goes_on(run, 0.1 * count / wanted)) {
        measured *const n = &cases[count];
        n->c = area_case_of(&random, 0);
        n->c.lobe.is_beckmann = 0;
        n->c.light.kind = GLINT_AREA_RECTANGLE;
        const area_truth truth = area_adaptive_of(&n->c.lobe, n->c.wo, &n->c.light, TOLERANCE, &n->truth_error);
        n->surface = glint_material_surface(m);
        n->surface.alpha_x = n->surface.alpha_y = (float)n->c.lobe.alpha_x;
        n->truth = truth.specular;
        count += area_is_lit(&truth);
    }
    return count;
}

/* The least that is known of a truth. */
static void check_truth(study_run *run, const measured *cases, int count)
{
    double worst = 0.0;
    for (int i = 0; i < count; i++)
        worst = fmax(worst, cases[i].truth_error);
    study_check(run, worst <= TOLERANCE,
                "the truth of %d rectangles is known to %.1e by its own estimate, at most %.0e", count, worst,
                TOLERANCE);
}

/* Sorted errors of one way, a row for each light. */
static void measure_way(study_run *run, int way, const glint_material *m[2], const measured *cases, int count,
                        double *errors)
{
    uint64_t random = 72;
    for (int i = 0; i < count; i++) {
        errors[i] = fabs(way_integrate(way, m, &cases[i].surface, &cases[i].c, &random) / cases[i].truth - 1.0);
        study_row(run, "%s,%.4f,%.5g,%.6g,%.4g,%.1e", way_names[way], cases[i].c.roughness,
                  (double)cases[i].c.light.solid_angle_sr, cases[i].truth, errors[i], cases[i].truth_error);
    }
    study_sort(errors, count);
}

/* ns a light: the median of rounds in which all ways take turns. */
static void measure_costs(study_run *run, const glint_material *m[2], const measured *cases, int count,
                          double cost[WAYS])
{
    enum { ROUNDS = 7 };
    static double times[WAYS][ROUNDS];
    uint64_t random = 73;
    double kept = 0.0;
    for (int round = 0; round < ROUNDS && study_goes_on(run, 0.5 + 0.5 * round / ROUNDS); round++)
        for (int k = 0; k < WAYS; k++) {
            const double start = study_cpu_s();
            for (int i = 0; i < count; i++)
                kept += way_integrate(k, m, &cases[i].surface, &cases[i].c, &random);
            times[k][round] = (study_cpu_s() - start) * 1e9 / count;
        }
    for (int k = 0; k < WAYS; k++) {
        const double middle = study_median(times[k], ROUNDS);
        /* Sums of radiance are not negative: the condition keeps them from being left out. */
        cost[k] = kept >= 0.0 ? middle : 0.0;
    }
}

/* Half of what lies between the order statistics one standard deviation of their rank around the middle. */
static double bar_of(const double *sorted, int count, double quantile)
{
    const double at = quantile * count, spread = sqrt(count * quantile * (1.0 - quantile));
    const int low = (int)fmax(at - spread, 0.0), high = (int)fmin(at + spread, count - 1.0);
    return 0.5 * (sorted[high] - sorted[low]);
}

static void report_fronts(study_run *run, const double cost[WAYS], const double *errors, int count)
{
    static const study_dial usual = {
        "integrals_front.csv",
        "A light of real size, in the median.",
        "ns a light",
        "cost_ns",
        "median error of the radiance",
        "Take the fast integral; the exact one for anisotropic roughness and references."
    };
    static const study_dial rare = {
        "integrals_worst_front.csv",
        "The same for all but one light in twenty.",
        "ns a light",
        "cost_ns",
        "error that 95 % of the lights stay below",
        "Rules of points miss narrow lobes and the horizon: no number of them here is as safe."
    };
    study_setting median[WAYS], most[WAYS];
    for (int k = 0; k < WAYS; k++) {
        const double *const e = errors + (size_t)k * (size_t)count;
        median[k] = (study_setting){ way_names[k], cost[k], e[count / 2], bar_of(e, count, 0.5), false };
        most[k] = (study_setting){ way_names[k], cost[k], e[count * 95 / 100], bar_of(e, count, 0.95), false };
    }
    const double fast = errors[(size_t)WAY_FAST * (size_t)count + (size_t)count / 2];
    const double point = errors[(size_t)WAY_POINT * (size_t)count + (size_t)count / 2];
    const double exact = errors[(size_t)WAY_EXACT * (size_t)count + (size_t)count * 95 / 100];
    study_check(run, fast < point / 10.0, "the fast integral is %.1e off in the median, a point %.1e", fast, point);
    study_check(run, exact < 0.01, "the exact one is within %.1e for 95 %% of the lights, at most .01", exact);
    const double gauss = errors[(size_t)WAY_GAUSS_16 * (size_t)count + (size_t)count * 95 / 100];
    study_check(run, exact < gauss / 10.0, "256 points of Gauss's rule are %.1e off for 95 %%", gauss);
    study_note(run, "a point takes %.0f ns, the fast integral %.0f, the exact one %.0f, 256 points %.0f",
               cost[WAY_POINT], cost[WAY_FAST], cost[WAY_EXACT], cost[WAY_GAUSS_16]);
    study_front(run, &usual, median, WAYS);
    study_front(run, &rare, most, WAYS);
}

static void measure_all(study_run *run, const glint_material *m[2], int wanted, measured *cases, double *errors)
{
    const int count = find_cases(run, wanted, m[0], cases);
    double cost[WAYS];
    check_truth(run, cases, count);
    study_table(run, "integrals.csv", "way,roughness,solid_angle_sr,radiance,error,truth_error");
    for (int k = 0; k < WAYS && study_goes_on(run, 0.1 + 0.4 * k / WAYS); k++)
        measure_way(run, k, m, cases, count, errors + (size_t)k * (size_t)count);
    study_end_table(run);
    measure_costs(run, m, cases, count, cost);
    if (study_goes_on(run, 1.0))
        report_fronts(run, cost, errors, count);
}

static void measure(study_run *run)
{
    const int wanted = study_is_quick(run) ? 120 : 1000;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_SMOOTH;
    glint_material *const fast = study_material(run, &o);
    o.area_light_method = GLINT_AREA_LIGHT_EXACT;
    glint_material *const exact = study_material(run, &o);
    measured *const cases = calloc((size_t)wanted, sizeof *cases);
    double *const errors = calloc((size_t)wanted * WAYS, sizeof *errors);
    if (!cases || !errors)
        report_error(study_report(run), "integrals: no memory for %d lights", wanted);
    else if (fast && exact)
        measure_all(run, (const glint_material *[2]){ fast, exact }, wanted, cases, errors);
    free(cases);
    free(errors);
    glint_material_destroy(fast);
    glint_material_destroy(exact);
}

static const study_figure figures[] = {
    { "integrals",
      "Cost and error of ways to integrate over a rectangle. Lower left is better; lines join what nothing beats.",
      integrals_gnuplot },
    { NULL, NULL, NULL },
};

extern const study integrals_study;

const study integrals_study = {
    .name = "integrals",
    .title = "Lights of real size: ways to integrate",
    .truth = "adaptive quadrature over directions, in double, written without the library, with an error of its own",
    .choose = "the fast integral; the exact one for references and anisotropic roughness.",
    .share = 0.08,
    .run = measure,
    .figures = figures,
};
