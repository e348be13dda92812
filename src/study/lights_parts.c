/* Rectangles in K x K parts: the sum over the parts against the true whole. Appendix C of Kneiphof and Klein 2024. */
#include <math.h>

#include "study/area_adaptive.h"
#include "study/area_cases.h"
#include "study/lights.h"

/* Part k of a rectangle in side x side parts. */
static glint_area_light part_of(const glint_area_light *whole, int side, int k)
{
    glint_area_light l = *whole;
    const int column = k % side, row = k / side;
    const float x = (float)((2.0 * column + 1.0) / side - 1.0), y = (float)((2.0 * row + 1.0) / side - 1.0);
    for (int a = 0; a < 3; a++) {
        l.center[a] += x * whole->half_x[a] + y * whole->half_y[a];
        l.half_x[a] /= (float)side;
        l.half_y[a] /= (float)side;
    }
    return l;
}

/* Relative errors of the sums. False: the light is too dark to speak of them. */
static bool measure_rectangle(study_run *run, const area_case *c, int method, int side, double *radiance, double *p)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    double known, sum = 0.0, sum_p = 0.0;
    const area_truth whole = area_adaptive_of(&c->lobe, c->wo, &c->light, LIGHTS_TOLERANCE, &known);
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)c->lobe.alpha_x;
    o.area_light_method = (glint_area_light_method)method;
    glint_material *const m = area_is_lit(&whole) ? study_material(run, &o) : NULL;
    if (!m)
        return false;
    for (int k = 0; k < side * side; k++) {
        static const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
        const glint_area_light part = part_of(&c->light, side, k);
        glint_value one;
        glint_eval_area(m, NULL, &pixel, c->wo, &part, &one);
        sum += (double)one.smooth[0];
        sum_p += (double)one.lit_probability;
    }
    glint_material_destroy(m);
    *radiance = fabs(sum / whole.specular - 1.0);
    *p = fabs(sum_p * area_adaptive_total(&c->lobe) / whole.facets - 1.0);
    return true;
}

/* The largest error of a sum of radiances. */
static double measure_side(study_run *run, int method, int side)
{
    const int count = study_is_quick(run) ? 20 : 300;
    double worst = 0.0, worst_p = 0.0;
    moments error = { 0 };
    uint64_t random = 42;
    for (int i = 0; i < count; i++) {
        area_case c = area_case_of(&random, 0);
        c.light.kind = GLINT_AREA_RECTANGLE;
        double radiance, p;
        if (!measure_rectangle(run, &c, method, side, &radiance, &p))
            continue;
        moments_add(&error, radiance);
        worst = fmax(worst, radiance);
        worst_p = fmax(worst_p, p);
    }
    study_row(run, "%d,%s,%.3e,%.1e,%.3e,%.3e,%.0f", side * side, method ? "exact" : "fast", error.mean,
              moments_standard_error(&error), worst, worst_p, error.count);
    return worst;
}

void lights_measure_parts(study_run *run, double from, double to)
{
    int done = 0;
    double worst[2] = { 0.0, 0.0 };
    study_table(run, "lights_parts.csv", "parts,method,mean_error,mean_bar,worst_error,worst_p_error,rectangles");
    for (int method = 0; method < 2; method++)
        for (int side = 1; side <= 16 && study_goes_on(run, from + (to - from) * done / 10.0); side *= 2, done++)
            worst[method] = fmax(worst[method], measure_side(run, method, side));
    study_end_table(run);
    study_note(run, "Fast, 1 to 256 parts: at most %.3f off the whole", worst[0]);
    study_check(run, worst[1] < 0.01, "exact, 1 to 256 parts: at most %.4f off the whole, bound .01", worst[1]);
}
