/* How counts tend to the smooth surface: the spread of a pixel over its mean as the density quadruples. Fig. 10 of
 * Kneiphof and Klein 2024. */
#include <math.h>

#include "study/area_cases.h"
#include "study/lights.h"

/* The spread of pixels under a sun, and p. */
static bool measure_density(study_run *run, double roughness, double radius_rad, double facets, moments *spread,
                            double *p)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.alpha_x = o.surface.alpha_y = (float)(roughness * roughness);
    o.surface.facets_per_m2 = (float)(facets * 1e6);
    glint_material *const m = study_material(run, &o);
    if (!m)
        return false;
    const double versine = 1.0 - cos(radius_rad);
    const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                   .solid_angle_sr = (float)(2.0 * AREA_PI * versine),
                                   .center = { 0.1F, 0.0F, 1.0F } };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    const int pixels = study_is_quick(run) ? 500 : 4000;
    glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
    for (int i = 0; i < pixels; i++) {
        const glint_footprint f = { 1e-2 * i, 0.0, 1e-3F, 0.0F, 0.0F, 1e-3F, (uint32_t)i };
        glint_eval_area(m, NULL, &f, wo, &sun, &v);
        moments_add(spread, (double)(v.rgb[0] / v.smooth[0]));
    }
    glint_material_destroy(m);
    *p = (double)v.lit_probability;
    return true;
}

static void measure_light(study_run *run, double roughness, double radius_deg)
{
    for (double n = 16.0; n < 2e7; n *= study_is_quick(run) ? 64.0 : 4.0) {
        moments spread = { 0 };
        double p;
        if (!measure_density(run, roughness, radius_deg * AREA_PI / 180.0, n, &spread, &p))
            return;
        const double binomial = sqrt((1.0 - p) / (n * p)), deviation = sqrt(moments_variance(&spread));
        study_row(run, "%.1f,%.2f,%.0f,%.5g,%.5g,%.5g", roughness, radius_deg, n, p, deviation, binomial);
        /* The blending of the grids takes half of the variance of a pixel at most. */
        if (n * p > 100.0)
            study_check(run, deviation < 1.1 * binomial + 1e-4, "N %g, p %g: deviation %g, binomial %g", n, p,
                        deviation, binomial);
    }
}

void lights_measure_convergence(study_run *run, double from, double to)
{
    static const double radii_deg[] = { 20.0, 3.0, 0.26 };
    static const double roughnesses[] = { 0.1, 0.5, 0.9 };
    study_table(run, "lights_convergence.csv", "roughness,radius_deg,facets,p,deviation,binomial");
    for (int i = 0; i < 9 && study_goes_on(run, from + (to - from) * i / 9.0); i++)
        measure_light(run, roughnesses[i / 3], radii_deg[i % 3]);
    study_end_table(run);
}
