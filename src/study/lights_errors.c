/* Random lights: the fast integral against the exact one. */
#include <math.h>
#include <stdlib.h>

#include "study/area_cases.h"
#include "study/lights.h"

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* What one light is by both methods. */
typedef struct light_pair {
    glint_value fast, exact;
    float base; /* what a white diffuse surface would show */
} light_pair;

static bool measure_light(study_run *run, const area_case *c, light_pair *pair)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)c->lobe.alpha_x;
    glint_material *const fast = study_material(run, &o);
    o.area_light_method = GLINT_AREA_LIGHT_EXACT;
    glint_material *const exact = study_material(run, &o);
    if (fast && exact) {
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        glint_surface white = o.surface;
        white.diffuse[0] = 1.0F;
        white.f0[0] = white.f90[0] = 0.0F;
        glint_value base;
        glint_eval_area(fast, NULL, &f, c->wo, &c->light, &pair->fast);
        glint_eval_area(exact, NULL, &f, c->wo, &c->light, &pair->exact);
        glint_eval_area(fast, &white, &f, c->wo, &c->light, &base);
        pair->base = base.smooth[0];
    }
    glint_material_destroy(fast);
    glint_material_destroy(exact);
    return fast && exact;
}

/* Sorts the errors and holds them to what issue and documentation promise. */
static void judge(study_run *run, const char *name, double *error, int count)
{
    if (count == 0)
        return;
    qsort(error, (size_t)count, sizeof(double), compare_doubles);
    const double median = error[count / 2], most = error[count * 95 / 100];
    study_note(run, "%s, %d lights: radiance within %.4f in the median, %.4f for 95 %%, %.4f for 99 %%, %.4f at worst",
               name, count, median, most, error[count * 99 / 100], error[count - 1]);
    study_check(run, median < 0.02, "%s: median error %.4f, at most .02", name, median);
    study_check(run, most < 0.04, "%s: error of 95 %% of the lights %.4f, at most .04", name, most);
}

static void measure_all(study_run *run, int count, double *error[2], double from, double to)
{
    int used[2] = { 0, 0 };
    double fast[2] = { 0.0, 0.0 }, exact[2] = { 0.0, 0.0 };
    uint64_t random = 41;
    study_table(run, "lights_error.csv",
                "distribution,roughness,view_deg,solid_angle_sr,radiance,radiance_error,p,p_error");
    for (int i = 0; i < count && study_goes_on(run, from + (to - from) * i / count); i++) {
        const area_case c = area_case_of(&random, 0);
        light_pair l;
        /* Darker than 1e-5 of a white wall is nothing to speak of errors. */
        if (!measure_light(run, &c, &l) || !(l.exact.smooth[0] > 1e-5F * l.base))
            continue;
        const int k = c.lobe.is_beckmann;
        const double radiance = (double)l.fast.smooth[0] / (double)l.exact.smooth[0] - 1.0;
        const double p = (double)l.fast.lit_probability / (double)l.exact.lit_probability - 1.0;
        error[k][used[k]++] = fabs(radiance);
        fast[k] += (double)l.fast.smooth[0];
        exact[k] += (double)l.exact.smooth[0];
        study_row(run, "%s,%.4f,%.2f,%.5g,%.6g,%.3e,%.6g,%.3e", k ? "Beckmann" : "GGX", c.roughness,
                  c.view * 180.0 / AREA_PI, (double)c.light.solid_angle_sr, (double)l.exact.smooth[0], radiance,
                  (double)l.exact.lit_probability, p);
    }
    study_end_table(run);
    for (int k = 0; k < 2; k++) {
        const char *const name = k ? "Beckmann" : "GGX";
        judge(run, name, error[k], used[k]);
        if (exact[k] > 0.0)
            study_note(run, "%s, the light of all lights: %+.4f", name, fast[k] / exact[k] - 1.0);
    }
}

void lights_measure_errors(study_run *run, double from, double to)
{
    const int count = study_is_quick(run) ? 800 : 20000;
    double *const error = malloc(2 * (size_t)count * sizeof(double));
    if (error)
        measure_all(run, count, (double *[2]){ error, error + count }, from, to);
    else
        report_error(study_report(run), "lights: no memory for %d errors", count);
    free(error);
}
