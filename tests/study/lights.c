/* Lights of real size: where the fast integral is off and by how much, parts of a light against the whole (Appendix C
 * and Fig. 9 of Kneiphof and Klein 2024), and how counts converge to the smooth surface (Fig. 10).
 *
 * The columns of lights_error.csv with only one of radiance and p taken by transformed cosines are Fig. 7's successive
 * replacements: either error alone is what the replacement of that integral adds.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "area_cases.h"
#include "study.h"

static glint_material *material_of(const area_case *c, glint_area_light_method method)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)c->lobe.alpha_x;
    o.area_light_method = method;
    return study_material(&o);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Random lights, fast against exact. */
static void write_errors(study *s)
{
    const int count = s->is_short ? 800 : 20000;
    double *error[2] = { malloc((size_t)count * sizeof(double)), malloc((size_t)count * sizeof(double)) };
    int used[2] = { 0, 0 };
    FILE *out = study_open(s, "lights_error.csv");
    fprintf(out, "distribution,roughness,view_deg,solid_angle_sr,radiance,radiance_error,p,p_error\n");
    uint64_t random = 41;
    for (int i = 0; i < count; i++) {
        const area_case c = area_case_of(&random, 0);
        glint_material *fast = material_of(&c, GLINT_AREA_LIGHT_FAST), *exact = material_of(&c, GLINT_AREA_LIGHT_EXACT);
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        glint_surface white = glint_material_surface(fast);
        white.diffuse[0] = 1.0F;
        white.f0[0] = white.f90[0] = 0.0F;
        glint_value v, t, base;
        glint_eval_area(fast, NULL, &f, c.wo, &c.light, &v);
        glint_eval_area(exact, NULL, &f, c.wo, &c.light, &t);
        glint_eval_area(fast, &white, &f, c.wo, &c.light, &base);
        glint_material_destroy(fast);
        glint_material_destroy(exact);
        /* Darker than 1e-5 of a white wall is nothing to speak of errors. */
        if (!(t.smooth[0] > 1e-5F * base.smooth[0]))
            continue;
        const int k = c.lobe.is_beckmann;
        const double radiance = (double)v.smooth[0] / (double)t.smooth[0] - 1.0;
        const double p = (double)v.lit_probability / (double)t.lit_probability - 1.0;
        error[k][used[k]++] = fabs(radiance);
        fprintf(out, "%s,%.4f,%.2f,%.5g,%.6g,%.3e,%.6g,%.3e\n", k ? "Beckmann" : "GGX", c.roughness,
                c.view * 180.0 / AREA_PI, (double)c.light.solid_angle_sr, (double)t.smooth[0], radiance,
                (double)t.lit_probability, p);
    }
    study_close(out);
    for (int k = 0; k < 2; k++) {
        const char *name = k ? "Beckmann" : "GGX";
        qsort(error[k], (size_t)used[k], sizeof(double), compare_doubles);
        const double median = error[k][used[k] / 2], most = error[k][used[k] * 95 / 100];
        printf("%s, %d lights: radiance within %.4f in the median, %.4f for 95 %%, %.4f for 99 %%, %.4f at worst\n",
               name, used[k], median, most, error[k][used[k] * 99 / 100], error[k][used[k] - 1]);
        study_check(s, median < 0.02, "%s: median error %.4f", name, median);
        study_check(s, most < 0.04, "%s: error of 95 %% %.4f", name, most);
        free(error[k]);
    }
}

/* A rectangle in K x K parts: sums over the whole. */
static void write_parts(study *s)
{
    const int count = s->is_short ? 20 : 300;
    FILE *out = study_open(s, "lights_parts.csv");
    fprintf(out, "parts,method,mean_error,worst_error,worst_p_error\n");
    for (int method = 0; method < 2; method++)
        for (int side = 2; side <= 16; side *= 2) {
            double worst = 0.0, worst_p = 0.0, sum_error = 0.0;
            int used = 0;
            uint64_t random = 42;
            for (int i = 0; i < count; i++) {
                area_case c = area_case_of(&random, 0);
                c.light.kind = GLINT_AREA_RECTANGLE;
                glint_material *m = material_of(&c, (glint_area_light_method)method);
                const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
                glint_value whole, one;
                glint_eval_area(m, NULL, &f, c.wo, &c.light, &whole);
                double sum = 0.0, p = 0.0;
                for (int k = 0; k < side * side && whole.smooth[0] > 1e-6F; k++) {
                    glint_area_light l = c.light;
                    const float x = (float)((2.0 * (k % side) + 1.0) / side - 1.0);
                    const int row = k / side;
                    const float y = (float)((2.0 * row + 1.0) / side - 1.0);
                    for (int a = 0; a < 3; a++) {
                        l.center[a] += x * c.light.half_x[a] + y * c.light.half_y[a];
                        l.half_x[a] /= (float)side;
                        l.half_y[a] /= (float)side;
                    }
                    glint_eval_area(m, NULL, &f, c.wo, &l, &one);
                    sum += (double)one.smooth[0];
                    p += (double)one.lit_probability;
                }
                glint_material_destroy(m);
                if (!(whole.smooth[0] > 1e-6F))
                    continue;
                const double error = fabs(sum / (double)whole.smooth[0] - 1.0);
                used++;
                sum_error += error;
                worst = fmax(worst, error);
                worst_p = fmax(worst_p, fabs(p / (double)whole.lit_probability - 1.0));
            }
            fprintf(out, "%d,%s,%.3e,%.3e,%.3e\n", side * side, method ? "exact" : "fast", sum_error / used, worst,
                    worst_p);
            if (method)
                study_check(s, worst < 0.01, "exact, %d parts: %.4f off the whole", side * side, worst);
        }
    study_close(out);
}

/* Spread of the count over its mean, as the density quadruples. */
static void write_convergence(study *s)
{
    static const double radii_deg[] = { 20.0, 3.0, 0.26 };
    static const double roughnesses[] = { 0.1, 0.5, 0.9 };
    const int pixels = s->is_short ? 500 : 4000;
    FILE *out = study_open(s, "lights_convergence.csv");
    fprintf(out, "roughness,radius_deg,facets,p,deviation,binomial\n");
    for (int a = 0; a < 3; a++)
        for (int r = 0; r < 3; r++)
            for (double n = 16.0; n < 2e7; n *= s->is_short ? 64.0 : 4.0) {
                glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
                o.surface.alpha_x = o.surface.alpha_y = (float)(roughnesses[a] * roughnesses[a]);
                o.surface.facets_per_m2 = (float)(n * 1e6);
                glint_material *m = study_material(&o);
                const double versine = 1.0 - cos(radii_deg[r] * AREA_PI / 180.0);
                const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                               .solid_angle_sr = (float)(2.0 * AREA_PI * versine),
                                               .center = { 0.1F, 0.0F, 1.0F } };
                const float wo[3] = { 0.0F, 0.0F, 1.0F };
                moments x = { 0 };
                glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
                for (int i = 0; i < pixels; i++) {
                    const glint_footprint f = { 1e-2 * i, 0.0, 1e-3F, 0.0F, 0.0F, 1e-3F, (uint32_t)i };
                    glint_eval_area(m, NULL, &f, wo, &sun, &v);
                    moments_add(&x, (double)(v.rgb[0] / v.smooth[0]));
                }
                glint_material_destroy(m);
                const double p = (double)v.lit_probability;
                const double binomial = sqrt((1.0 - p) / (n * p)), deviation = sqrt(moments_variance(&x));
                fprintf(out, "%.1f,%.2f,%.0f,%.5g,%.5g,%.5g\n", roughnesses[a], radii_deg[r], n, p, deviation,
                        binomial);
                /* The blending of the grids takes half of the variance of a pixel at most. */
                if (n * p > 100.0)
                    study_check(s, deviation < 1.1 * binomial + 1e-4, "N %g, p %g: deviation %g, binomial %g", n, p,
                                deviation, binomial);
            }
    study_close(out);
}

int main(int argc, char **argv)
{
    study s = study_start(argc, argv);
    write_errors(&s);
    write_parts(&s);
    write_convergence(&s);
    return study_end(&s);
}
