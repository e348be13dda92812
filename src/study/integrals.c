/* The study of ways to integrate over a light of real size: a point in its middle, transformed cosines, the boundary
 * integral, points on a grid and points at random; each against brute force. */
#include <math.h>
#include <stdlib.h>

#include "study/area_cases.h"
#include "study/study.h"

extern const unsigned char integrals_gnuplot[];

enum { POINT, FAST, EXACT, GRID_2, GRID_4, GRID_8, GRID_16, RANDOM_4, RANDOM_16, RANDOM_64, RANDOM_256, METHODS };

static const struct {
    const char *name;
    int points; /* along a side of a grid, or in all, where they are at random */
} methods[METHODS] = {
    [POINT] = { "point (cap)", 1 },     [FAST] = { "fast (LTC)", 0 },         [EXACT] = { "exact", 0 },
    [GRID_2] = { "grid 2 x 2", 2 },     [GRID_4] = { "grid 4 x 4", 4 },       [GRID_8] = { "grid 8 x 8", 8 },
    [GRID_16] = { "grid 16 x 16", 16 }, [RANDOM_4] = { "4 random", 4 },       [RANDOM_16] = { "16 random", 16 },
    [RANDOM_64] = { "64 random", 64 },  [RANDOM_256] = { "256 random", 256 },
};

/* What a point (x, y) in [-1, 1]^2 of a rectangle adds, times 4 for the whole. */
static double sample_light(const glint_material *m, const glint_surface *s, const float wo[3],
                           const glint_area_light *l, double x, double y)
{
    double p[3], length2 = 0.0, facing = 0.0;
    for (int k = 0; k < 3; k++) {
        p[k] = (double)l->center[k] + x * (double)l->half_x[k] + y * (double)l->half_y[k];
        length2 += p[k] * p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        facing += p[k] * ((double)l->half_x[a] * (double)l->half_y[b] - (double)l->half_x[b] * (double)l->half_y[a]);
    }
    const double length = sqrt(length2);
    const float wi[3] = { (float)(p[0] / length), (float)(p[1] / length), (float)(p[2] / length) };
    float rgb[3];
    glint_eval(m, s, NULL, wo, wi, NULL, rgb);
    return 4.0 * (double)rgb[0] * fabs(facing) / (length2 * length);
}

static double integrate(int method, const glint_material *m[2], const glint_surface *s, const area_case *c,
                        uint64_t *random)
{
    const int n = methods[method].points;
    double sum = 0.0;
    if (method == FAST || method == EXACT) {
        glint_value v;
        glint_eval_area(m[method == EXACT], s, NULL, c->wo, &c->light, &v);
        return (double)v.smooth[0];
    }
    if (method >= RANDOM_4) {
        for (int i = 0; i < n; i++) {
            const double x = random_between(random, -1.0, 1.0);
            sum += sample_light(m[0], s, c->wo, &c->light, x, random_between(random, -1.0, 1.0));
        }
        return sum / n;
    }
    for (int row = 0; row < n; row++)
        for (int column = 0; column < n; column++)
            sum += sample_light(m[0], s, c->wo, &c->light, (2.0 * column + 1.0) / n - 1.0, (2.0 * row + 1.0) / n - 1.0);
    return sum / (n * n);
}

typedef struct measured {
    area_case c;
    glint_surface surface;
    double truth;
} measured;

/* Rectangles that light more than a hundred thousandth of a white wall. */
static int find_cases(study_run *run, int wanted, const glint_material *m, measured *cases)
{
    const int side = study_is_quick(run) ? 300 : 800;
    uint64_t random = 71;
    int count = 0;
    while (count < wanted && study_goes_on(run, 0.6 * count / wanted)) {
        measured *const n = &cases[count];
        n->c = area_case_of(&random, 0);
        n->c.lobe.is_beckmann = 0;
        n->c.light.kind = GLINT_AREA_RECTANGLE;
        const area_truth truth = area_truth_of(&n->c.lobe, n->c.wo, &n->c.light, side);
        n->surface = glint_material_surface(m);
        n->surface.alpha_x = n->surface.alpha_y = (float)n->c.lobe.alpha_x;
        n->truth = truth.specular;
        count += area_is_lit(&truth);
    }
    return count;
}

/* Sorted errors of one method, a row for each light. */
static void measure_method(study_run *run, int method, const glint_material *m[2], const measured *cases, int count,
                           double *errors)
{
    uint64_t random = 72;
    for (int i = 0; i < count; i++) {
        errors[i] = fabs(integrate(method, m, &cases[i].surface, &cases[i].c, &random) / cases[i].truth - 1.0);
        study_row(run, "%s,%.4f,%.5g,%.6g,%.4g", methods[method].name, cases[i].c.roughness,
                  (double)cases[i].c.light.solid_angle_sr, cases[i].truth, errors[i]);
    }
    study_sort(errors, count);
}

/* ns a light: the median of rounds in which all methods take turns. */
static void measure_costs(study_run *run, const glint_material *m[2], const measured *cases, int count,
                          double cost[METHODS])
{
    enum { ROUNDS = 7 };
    static double times[METHODS][ROUNDS];
    uint64_t random = 73;
    double kept = 0.0;
    for (int round = 0; round < ROUNDS && study_goes_on(run, 0.8 + 0.2 * round / ROUNDS); round++)
        for (int k = 0; k < METHODS; k++) {
            const double start = study_cpu_s();
            for (int i = 0; i < count; i++)
                kept += integrate(k, m, &cases[i].surface, &cases[i].c, &random);
            times[k][round] = (study_cpu_s() - start) * 1e9 / count;
        }
    for (int k = 0; k < METHODS; k++) {
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

static void report_fronts(study_run *run, const double cost[METHODS], const double *errors, int count)
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
        "Points, on a grid or at random, miss narrow lobes: no number of them here is as safe."
    };
    study_setting median[METHODS], most[METHODS];
    for (int k = 0; k < METHODS; k++) {
        const double *const e = errors + (size_t)k * (size_t)count;
        median[k] = (study_setting){ methods[k].name, cost[k], e[count / 2], bar_of(e, count, 0.5), false };
        most[k] = (study_setting){ methods[k].name, cost[k], e[count * 95 / 100], bar_of(e, count, 0.95), false };
    }
    const double fast = errors[(size_t)FAST * (size_t)count + (size_t)count / 2];
    const double point = errors[(size_t)POINT * (size_t)count + (size_t)count / 2];
    const double exact = errors[(size_t)EXACT * (size_t)count + (size_t)count * 95 / 100];
    study_check(run, fast < point / 10.0, "the fast integral is %.1e off in the median, a point %.1e", fast, point);
    study_check(run, exact < 0.01, "the exact one is within %.1e for 95 %% of the lights, at most .01", exact);
    const double grid = errors[(size_t)GRID_16 * (size_t)count + (size_t)count / 2];
    study_check(run, fast < grid / 10.0, "256 points on a grid are %.1e off in the median", grid);
    study_note(run, "a point takes %.0f ns, the fast integral %.0f, the exact one %.0f, 256 points %.0f", cost[POINT],
               cost[FAST], cost[EXACT], cost[GRID_16]);
    study_front(run, &usual, median, METHODS);
    study_front(run, &rare, most, METHODS);
}

static void measure_all(study_run *run, const glint_material *m[2], int wanted, measured *cases, double *errors)
{
    const int count = find_cases(run, wanted, m[0], cases);
    double cost[METHODS];
    study_table(run, "integrals.csv", "method,roughness,solid_angle_sr,radiance,error");
    for (int k = 0; k < METHODS && study_goes_on(run, 0.6 + 0.2 * k / METHODS); k++)
        measure_method(run, k, m, cases, count, errors + (size_t)k * (size_t)count);
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
    double *const errors = calloc((size_t)wanted * METHODS, sizeof *errors);
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
    .truth = "brute force on a fine grid of the light, in double, written without the library",
    .choose = "the fast integral; the exact one for references and anisotropic roughness.",
    .share = 0.08,
    .run = measure,
    .figures = figures,
};
