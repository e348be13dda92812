/* A panel that stands on a floor, along the line through its highlight: what becomes of the light and of single glints
 * when the integral of the reflection, that of the facets, or both are taken by the library. Fig. 7 of Kneiphof and
 * Klein 2024.
 */
#include <math.h>

#include "study/area_adaptive.h"
#include "study/area_cases.h"
#include "study/lights.h"

/* Where the viewer and the panel stand on the floor, metres. */
static const double viewer[3] = { -3.0, 0.0, 1.2 };

static glint_area_light panel_from(double x)
{
    return (glint_area_light){ .kind = GLINT_AREA_RECTANGLE,
                               .two_sided = 1U,
                               .center = { (float)(1.5 - x), 0.2F, 0.8F },
                               .half_x = { 0.0F, 0.5F, 0.0F },
                               .half_y = { 0.0F, 0.0F, 0.4F } };
}

/* The largest distance of a quotient from 1, and where. */
typedef struct worst_place {
    double error, x;
} worst_place;

/* By the fast integral and by the exact one, over what they are in truth. */
static void measure_place(study_run *run, const glint_material *const material[2], double roughness, double x,
                          worst_place worst[2])
{
    static const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
    float wo[3] = { (float)(viewer[0] - x), (float)viewer[1], (float)viewer[2] };
    area_unit(wo);
    const glint_area_light panel = panel_from(x);
    const double alpha = (double)(float)(roughness * roughness);
    const area_truth_lobe lobe = { 0, alpha, alpha };
    double known, radiance[2], p[2];
    const area_truth truth = area_adaptive_of(&lobe, wo, &panel, LIGHTS_TOLERANCE, &known);
    const double true_p = truth.facets / area_adaptive_total(&lobe);
    for (int k = 0; k < 2; k++) {
        glint_value v;
        glint_eval_area(material[k], NULL, &pixel, wo, &panel, &v);
        radiance[k] = (double)v.smooth[0] / truth.specular;
        p[k] = (double)v.lit_probability / true_p;
        const double error = fmax(fabs(radiance[k] - 1.0), fabs(radiance[k] / p[k] - 1.0));
        if (error > worst[k].error)
            worst[k] = (worst_place){ error, x };
    }
    study_row(run, "%.1f,%.4f,%.6g,%.6g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.1e", roughness, x, truth.specular, true_p,
              radiance[0], p[0], 1.0 / p[0], radiance[0] / p[0], radiance[1], radiance[1] / p[1], known);
}

static void measure_line(study_run *run, const glint_material *const material[2], double roughness, double step)
{
    worst_place worst[2] = { { 0.0, 0.0 }, { 0.0, 0.0 } };
    int places = 0;
    for (; - 2.5 + places * step <= 1.4; places++)
        measure_place(run, material, roughness, -2.5 + places * step, worst);
    /* What the fast path is to keep for 95 of 100 lights, and the exact one for all; these are few and bright. */
    study_check(run, worst[0].error < 0.04,
                "panel, roughness %.1f, %d places: radiance and the light of a glint within %.4f of the true ones, at "
                "most .04 (worst at %.2f m)",
                roughness, places, worst[0].error, worst[0].x);
    study_check(run, worst[1].error < 0.01, "by the exact integral within %.5f, at most .01 (worst at %.2f m)",
                worst[1].error, worst[1].x);
}

void lights_measure_replacement(study_run *run, double from, double to)
{
    static const double roughnesses[] = { 0.3, 0.6 };
    const double step = study_is_quick(run) ? 0.25 : 0.02;
    study_table(run, "lights_replaced.csv",
                "roughness,place_m,radiance,p,radiance_fast,p_fast,glint_p_fast,glint_both_fast,radiance_exact,"
                "glint_both_exact,truth_error");
    for (int i = 0; i < 2 && study_goes_on(run, from + (to - from) * i / 2.0); i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.surface.alpha_x = o.surface.alpha_y = (float)(roughnesses[i] * roughnesses[i]);
        glint_material *const fast = study_material(run, &o);
        o.area_light_method = GLINT_AREA_LIGHT_EXACT;
        glint_material *const exact = study_material(run, &o);
        if (fast && exact)
            measure_line(run, (const glint_material *const[2]){ fast, exact }, roughnesses[i], step);
        glint_material_destroy(fast);
        glint_material_destroy(exact);
    }
    study_end_table(run);
}
