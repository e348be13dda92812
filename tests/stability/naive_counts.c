/* Counts: what is rare, certain, or not there. */
#include "naive.h"

#include <float.h>

#define GLINT_LANES 1
#include "math/binomial.h"

/* The chance of one count or more, as the sampler has it: thresholds for all of 2^16 dithers. */
static double any_lit(float trials, float p)
{
    const binomial_chance c = binomial_chance_of(p);
    float missing, mass;
    exp2_both(floorf(trials) * c.log_miss, BINOMIAL_SCALE_LOG2, &missing, &mass);
    const float survival = missing + (trials - floorf(trials)) * p * mass;
    double sum = 0.0;
    for (int k = 0; k < 65536; k++)
        sum += ((double)binomial_threshold(survival + (float)k * 0x1p-16F) + 2147483648.0) * 0x1p-32;
    return sum / 65536.0;
}

static void any_of_many(float trials, float p, const char *what)
{
    naive_print(&(naive_row){ what, "1 - (1 - p)^N", (double)(1.0F - powf(f(1.0F - p), trials)),
                              -expm1l((wide)trials * log1pl(-(wide)p)), any_lit(trials, p),
                              "-expm1(N log(1 - p)), both kept exact near 0", "4 roundings, and 2⁻³¹", "elementary" });
}

static void rare_count(void)
{
    naive_print(&(naive_row){ "a chance of 10⁻¹²", "u < p with a uniform of 24 bits", 0x1p-24, 1e-12L,
                              any_lit(1.0F, 1e-12F), "threshold of 31 bits, rounded by 16 random ones",
                              "2⁻⁴⁷ = 7·10⁻¹⁵; below N p = 3·10⁻¹⁰ nothing is counted", "counting_edges" });
}

static void no_variance(void)
{
    const float n = 1e9F, p = f(1.0F + FLT_EPSILON);
    const binomial_chance c = binomial_chance_of(1.0F);
    vint uniform[12] = { 12345 };
    const vfloat weight[12] = { 1.0F };
    naive_print(
        &(naive_row){ "p = 1 + 2⁻²³, as D Ω / D_H may round to: 10⁹ facets, all lit", "N p + √(N p (1 - p)) z",
                      (double)(n * p + sqrtf(f(n * p * (1.0F - p))) * 0.5F), 1e9L,
                      (double)binomial_weighted_sum(n, &c, uniform, weight, 0.0F, NULL, (binomial_many){ 12, 1.0F }),
                      "p at most 1; from there the lobe is smooth", "exact", "hard_cases" });
}

/* The library's own pixel: colour over the smooth one. */
static double pixel_over_smooth(float density, const glint_footprint *at)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.facets_per_m2 = density;
    glint_material *const m = material_or_exit(&o);
    const float wo[3] = { 0.0F, 0.6F, 0.8F }, wi[3] = { 0.0F, -0.6F, 0.8F };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    glint_value v;
    glint_eval_value(m, NULL, at, wo, wi, &light, &v);
    glint_material_destroy(m);
    return (double)(v.rgb[0] / v.smooth[0]);
}

static void nothing_to_count(void)
{
    const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const float n = f(0.0F), p = f(0.01F), count = f(n * p);
    naive_print(&(naive_row){ "no facets: a density texture says 0", "b(N, p) / (N p)", (double)(count / f(n * p)),
                              1.0L, pixel_over_smooth(0.0F, &pixel), "smooth where N p is below 3·10⁻¹⁰", "exact",
                              "counting_edges" });
}

/* What a count that draws whole trials makes of a part of one. */
static void part_of_a_facet(void)
{
    const float n = 1e-6F, p = 1.0F - 0x1p-24F;
    naive_print(&(naive_row){ "mean of a count of N = 10⁻⁶, p = 1 - 2⁻²⁴", "b(⌊N⌋, p)", (double)(floorf(n) * p),
                              (wide)n * (wide)p, any_lit(n, p), "one trial more, with the chance of the fraction",
                              "2⁻⁴⁷ + 6 roundings", "counting_edges" });
}

static void degenerate_pixels(void)
{
    const glint_footprint rank_one = { .dudx = 1e-3F, .dudy = 1e-3F, .dvdx = 1e-3F, .dvdy = 1e-3F };
    const glint_footprint broken = { .dudx = NAN, .dvdy = 1e-3F };
    const float area = fabsf(f(1e-3F * 1e-3F) - f(1e-3F * 1e-3F)), facets = f(1e6F * area);
    naive_print(&(naive_row){ "footprint of no area, or of rank one", "N = ρ A, then b(N, p) / (N p)",
                              (double)(f(facets * 0.01F) / f(facets * 0.01F)), 1.0L, pixel_over_smooth(1e6F, &rank_one),
                              "smooth where N p is below 3·10⁻¹⁰", "exact", "counting_edges" });
    naive_print(&(naive_row){ "footprint with a derivative that is NaN or infinite", "N = ρ A, then b(N, p) / (N p)",
                              (double)(1e6F * fabsf(f(NAN) * 1e-3F)), 1.0L, pixel_over_smooth(1e6F, &broken),
                              "smooth where N is no finite number", "exact", "hard_cases" });
}

void naive_counts(void)
{
    any_of_many(1e9F, 1e-9F, "one or more of 10⁹ facets, p = 10⁻⁹");
    any_of_many(3e7F, 1.0F / 3e7F, "one or more of 3·10⁷ facets, p = 1 / N");
    any_of_many(1e18F, 1e-30F, "one or more of 10¹⁸ facets, p = 10⁻³⁰");
    rare_count();
    part_of_a_facet();
    no_variance();
    nothing_to_count();
    degenerate_pixels();
}
