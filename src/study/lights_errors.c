/* Random lights: both integrals of the library against adaptive quadrature. */
#include <math.h>
#include <stdlib.h>

#include "study/area_adaptive.h"
#include "study/area_cases.h"
#include "study/lights.h"

enum { FAST, EXACT, INTEGRALS };

static const char *const integral_names[INTEGRALS] = { "fast", "exact" };

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* What one light is, and how far each integral is off. */
typedef struct light_error {
    area_truth truth;
    double p, known, radiance_off[INTEGRALS], p_off[INTEGRALS];
} light_error;

static bool measure_light(study_run *run, const area_case *c, light_error *e)
{
    static const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)c->lobe.alpha_x;
    e->truth = area_adaptive_of(&c->lobe, c->wo, &c->light, LIGHTS_TOLERANCE, &e->known);
    e->p = e->truth.facets / area_adaptive_total(&c->lobe);
    /* Darker than 1e-5 of a white wall is nothing to speak of errors. */
    if (!area_is_lit(&e->truth))
        return false;
    for (int k = 0; k < INTEGRALS; k++) {
        o.area_light_method = k == EXACT ? GLINT_AREA_LIGHT_EXACT : GLINT_AREA_LIGHT_FAST;
        glint_material *const m = study_material(run, &o);
        glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
        if (!m)
            return false;
        glint_eval_area(m, NULL, &pixel, c->wo, &c->light, &v);
        e->radiance_off[k] = (double)v.smooth[0] / e->truth.specular - 1.0;
        e->p_off[k] = (double)v.lit_probability / e->p - 1.0;
        glint_material_destroy(m);
    }
    return true;
}

/* The lights of one distribution. */
typedef struct light_errors {
    double *off[INTEGRALS]; /* one after the other, not negative */
    double sum[INTEGRALS], whole, known;
    int count;
} light_errors;

static void add_light(light_errors *all, const light_error *e)
{
    for (int k = 0; k < INTEGRALS; k++) {
        all->off[k][all->count] = fabs(e->radiance_off[k]);
        all->sum[k] += e->radiance_off[k] * e->truth.specular;
    }
    all->whole += e->truth.specular;
    all->known = fmax(all->known, e->known);
    all->count++;
}

static void say(study_run *run, const char *name, int integral, const light_errors *all)
{
    double *const off = all->off[integral];
    const int count = all->count;
    qsort(off, (size_t)count, sizeof(double), compare_doubles);
    study_note(
        run,
        "%s, the %s integral over %d lights: radiance within %.1e in the median, %.4f for 95 %%, %.4f for 99 %%, "
        "%.4f at worst; the light of all lights: %+.1e",
        name, integral_names[integral], count, off[count / 2], off[count * 95 / 100], off[count * 99 / 100],
        off[count - 1], all->sum[integral] / all->whole);
}

/* Holds them to what issue and documentation promise. */
static void judge(study_run *run, const char *name, const light_errors *all)
{
    if (all->count == 0)
        return;
    study_check(run, all->known <= LIGHTS_TOLERANCE,
                "%s: the truth of %d lights is known to %.1e by its own estimate, at most %.0e", name, all->count,
                all->known, LIGHTS_TOLERANCE);
    for (int k = 0; k < INTEGRALS; k++)
        say(run, name, k, all);
    const double median = all->off[FAST][all->count / 2], most = all->off[FAST][all->count * 95 / 100];
    study_check(run, median < 0.02, "%s: median error of the fast integral %.1e, at most .02", name, median);
    study_check(run, most < 0.04, "%s: error of 95 %% of the lights %.4f, at most .04", name, most);
    const double nearly_all = all->off[EXACT][all->count * 99 / 100];
    study_check(run, nearly_all < 0.01, "%s: error of 99 %% of the lights by the exact integral %.4f, at most .01",
                name, nearly_all);
}

static void measure_all(study_run *run, int count, light_errors all[2], double from, double to)
{
    uint64_t random = 41;
    study_table(run, "lights_error.csv",
                "distribution,roughness,view_deg,solid_angle_sr,radiance,fast_error,p,fast_p_error,exact_error,"
                "exact_p_error,truth_error");
    for (int i = 0; i < count && study_goes_on(run, from + (to - from) * i / count); i++) {
        const area_case c = area_case_of(&random, 0);
        light_error e;
        if (!measure_light(run, &c, &e))
            continue;
        add_light(&all[c.lobe.is_beckmann], &e);
        study_row(run, "%s,%.4f,%.2f,%.5g,%.6g,%.3e,%.6g,%.3e,%.3e,%.3e,%.1e", c.lobe.is_beckmann ? "Beckmann" : "GGX",
                  c.roughness, c.view * 180.0 / AREA_PI, e.truth.solid_angle, e.truth.specular, e.radiance_off[FAST],
                  e.p, e.p_off[FAST], e.radiance_off[EXACT], e.p_off[EXACT], e.known);
    }
    study_end_table(run);
    judge(run, "GGX", &all[0]);
    judge(run, "Beckmann", &all[1]);
}

void lights_measure_errors(study_run *run, double from, double to)
{
    const int count = study_is_quick(run) ? 800 : 20000;
    double *const error = malloc(4 * (size_t)count * sizeof(double));
    if (error)
        measure_all(run, count,
                    (light_errors[2]){ { .off = { error, error + count } },
                                       { .off = { error + 2 * count, error + 3 * count } } },
                    from, to);
    else
        report_error(study_report(run), "lights: no memory for %d errors", count);
    free(error);
}
