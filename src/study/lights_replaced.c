/* A panel that stands on a floor, along the line through its highlight: what becomes of the light and of single glints
 * when the integral of the reflection, that of the facets, or both are taken fast. Fig. 7 of Kneiphof and Klein 2024.
 */
#include <math.h>

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

static void measure_place(study_run *run, const glint_material *const material[2], double roughness, double x,
                          worst_place *worst)
{
    float wo[3] = { (float)(viewer[0] - x), (float)viewer[1], (float)viewer[2] };
    area_unit(wo);
    const glint_area_light panel = panel_from(x);
    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_value v[2];
    for (int method = 0; method < 2; method++)
        glint_eval_area(material[method], NULL, &f, wo, &panel, &v[method]);
    const double radiance = (double)v[0].smooth[0] / (double)v[1].smooth[0];
    const double p = (double)v[0].lit_probability / (double)v[1].lit_probability;
    study_row(run, "%.1f,%.4f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g", roughness, x, (double)v[1].smooth[0],
              (double)v[1].lit_probability, radiance, p, 1.0 / p, radiance / p);
    const double error = fmax(fabs(radiance - 1.0), fabs(radiance / p - 1.0));
    if (error > worst->error)
        *worst = (worst_place){ error, x };
}

static void measure_line(study_run *run, const glint_material *const material[2], double roughness, double step)
{
    worst_place worst = { 0.0, 0.0 };
    int places = 0;
    for (; - 2.5 + places * step <= 1.4; places++)
        measure_place(run, material, roughness, -2.5 + places * step, &worst);
    /* What the fast path is to keep for 95 of 100 lights; these are few and bright. */
    study_check(run, worst.error < 0.04,
                "panel, roughness %.1f, %d places: radiance and the light of a glint within %.4f of the exact ones, at "
                "most .04 (worst at %.2f m)",
                roughness, places, worst.error, worst.x);
}

void lights_measure_replacement(study_run *run, double from, double to)
{
    static const double roughnesses[] = { 0.3, 0.6 };
    const double step = study_is_quick(run) ? 0.25 : 0.02;
    study_table(run, "lights_replaced.csv",
                "roughness,place_m,radiance,p,radiance_fast,p_fast,glint_p_fast,glint_both_fast");
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
