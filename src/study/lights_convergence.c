/* How counts tend to the smooth surface: the spread of a pixel over its mean as the density quadruples. Fig. 10 of
 * Kneiphof and Klein 2024. */
#include <math.h>

#include "study/area_cases.h"
#include "study/lights.h"

enum { MOST_PIXELS = 4000 };

/* Of pixels over their mean: the standard deviation, and its own standard error from the fourth moment. */
typedef struct spread {
    double deviation, bar;
} spread;

static spread spread_of(const double *pixel, int count)
{
    double mean = 0.0, square = 0.0, fourth = 0.0;
    for (int i = 0; i < count; i++)
        mean += pixel[i] / count;
    for (int i = 0; i < count; i++) {
        const double d = (pixel[i] - mean) * (pixel[i] - mean);
        square += d / count;
        fourth += d * d / count;
    }
    const double deviation = sqrt(square);
    const double bar = square > 0.0 ? sqrt(fmax(fourth - square * square, 0.0) / count) / (2.0 * deviation) : 0.0;
    return (spread){ deviation, bar };
}

static int pixels_of(study_run *run)
{
    return study_is_quick(run) ? 500 : MOST_PIXELS;
}

/* The spread of pixels under a sun, and p. */
static bool measure_density(study_run *run, double roughness, double radius_rad, double facets, spread *out, double *p)
{
    static double pixel[MOST_PIXELS];
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
    glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
    for (int i = 0; i < pixels_of(run); i++) {
        const glint_footprint f = { 1e-2 * i, 0.0, 1e-3F, 0.0F, 0.0F, 1e-3F, (uint32_t)i };
        glint_eval_area(m, NULL, &f, wo, &sun, &v);
        pixel[i] = (double)(v.rgb[0] / v.smooth[0]);
    }
    glint_material_destroy(m);
    *out = spread_of(pixel, pixels_of(run));
    *p = (double)v.lit_probability;
    return true;
}

/* The largest share that a pixel deviates of its bound, and where. */
typedef struct worst_pixel {
    double share, roughness, radius_deg, facets;
    int settings;
} worst_pixel;

static void measure_light(study_run *run, double roughness, double radius_deg, worst_pixel *worst)
{
    for (double n = 16.0; n < 2e7; n *= study_is_quick(run) ? 64.0 : 4.0) {
        spread s;
        double p;
        if (!measure_density(run, roughness, radius_deg * AREA_PI / 180.0, n, &s, &p))
            return;
        const double binomial = sqrt((1.0 - p) / (n * p));
        study_row(run, "%.1f,%.2f,%.0f,%.5g,%.5g,%.2g,%.5g,%d", roughness, radius_deg, n, p, s.deviation, s.bar,
                  binomial, pixels_of(run));
        if (n * p <= 100.0)
            continue;
        /* The blending of the grids takes half of the variance of a pixel at most, and adds none. */
        const double share = s.deviation / (1.1 * binomial + 1e-4);
        worst->settings++;
        if (share > worst->share)
            *worst = (worst_pixel){ share, roughness, radius_deg, n, worst->settings };
    }
}

void lights_measure_convergence(study_run *run, double from, double to)
{
    static const double radii_deg[] = { 20.0, 3.0, 0.26 };
    static const double roughnesses[] = { 0.1, 0.5, 0.9 };
    worst_pixel worst = { .share = 0.0 };
    study_table(run, "lights_convergence.csv", "roughness,radius_deg,facets,p,deviation,bar,binomial,pixels");
    for (int i = 0; i < 9 && study_goes_on(run, from + (to - from) * i / 9.0); i++)
        measure_light(run, roughnesses[i / 3], radii_deg[i % 3], &worst);
    study_end_table(run);
    study_check(run, worst.share < 1.0,
                "%d settings with more than 100 lit facets: pixels deviate at most %.2f times as much as the binomial "
                "law says, bound 1.1 (worst: roughness %.1f, sun of %.2f degrees, N %g)",
                worst.settings, 1.1 * worst.share, worst.roughness, worst.radius_deg, worst.facets);
}
