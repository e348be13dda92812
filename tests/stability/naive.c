/* Prints the table of docs/stability.md: for each hard case what the formula that one would write down first gives in
 * float, what is true (in long double, or known), and what the library gives. page.sh holds the page to it. */
#include <float.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define GLINT_LANES 1
#include "footprint/coverage.h"
#include "footprint/grid.h"
#include "light/area.h"
#include "math/binomial.h"
#include "math/real.h"
#include "ndf/fresnel.h"
#include "ndf/ndf.h"

#include "lobe_truth.h"

/* What the optimiser may not compute at a higher precision, or not at all. */
static float f(float x)
{
    volatile float v = x;
    return v;
}

/* In place of a number: any that a weight may be. */
#define ANY_WEIGHT (-(wide)INFINITY)

static void number(char *text, size_t size, double x)
{
    if (isnan(x))
        snprintf(text, size, "NaN");
    else if (x == -(double)INFINITY)
        snprintf(text, size, "0 to 1");
    else if (isinf(x))
        snprintf(text, size, "infinite");
    else
        snprintf(text, size, "%.6g", x);
}

/* One row. formula, done, bound and test are Markdown. */
static void row(const char *what, const char *formula, double naive, wide truth, double ours, const char *done,
                const char *bound, const char *test)
{
    char number_of[3][32];
    number(number_of[0], sizeof(number_of[0]), naive);
    number(number_of[1], sizeof(number_of[1]), (double)truth);
    number(number_of[2], sizeof(number_of[2]), ours);
    printf("| %s | %s | **%s** | %s | %s | %s | %s | `%s` |\n", what, formula, number_of[0], number_of[1], number_of[2],
           done, bound, test);
}

static void section(const char *title)
{
    printf("\n### %s\n\n| Case | Formula that one writes first | It gives | True | libglint | What is done | Error "
           "bound | "
           "Test |\n|---|---|---|---|---|---|---|---|\n",
           title);
}

/* ---- facets ---- */

static void narrow_lobe(void)
{
    const float a = 1e-4F, c = 1.0F, d = f(f(a * a) - 1.0F) * c * c + 1.0F;
    const ndf n = { NDF_GGX, a, a };
    row("GGX of α = 10⁻⁴ at its peak", "D = α² / (π ((α² - 1) cos² + 1)²)", (double)(f(a * a) / (MATH_PI * d * d)),
        1.0L / (WIDE_PI * (wide)a * (wide)a), (double)ndf_density(&n, (vec3){ 0.0F, 0.0F, 1.0F }),
        "sum of squares: (x/α)² + (y/α)² + z²", "13 roundings", "lobe_precision");
}

static void steep_masking(void)
{
    const float a = 1e-3F;
    const vec3 v = { sinf(0.1F), 0.0F, cosf(0.1F) };
    const float t = v.x / v.z;
    const wide_lobe l = { 1, (wide)a, (wide)a };
    const wide w[3] = { (wide)v.x, 0.0L, (wide)v.z };
    const ndf n = { NDF_GGX, a, a };
    row("masking of α = .001 seen at 6°", "Λ = (√(1 + α² tan²) - 1) / 2, times cos",
        (double)(0.5F * (sqrtf(f(1.0F + a * a * t * t)) - 1.0F) * v.z), wide_masked(&l, w), (double)ndf_masked(&n, v),
        "the difference of roots as a quotient", "8 roundings", "lobe_precision");
}

static void total_area(void)
{
    const float a = 0.1F, x = f(1.0F / a);
    const ndf n = { NDF_BECKMANN, a, a };
    row("facet area over surface area, Beckmann of α = .1", "1 + √π/2 α exp(1/α²) erfc(1/α)",
        (double)(1.0F + 0.886226925F * a * expf(f(x * x)) * erfcf(x)), wide_total_area(0, (wide)a),
        (double)ndf_total_area(&n), "erfcx, a fit of exp(x²) erfc(x)", "5.5 roundings", "lobe_precision");
}

static void thin_dielectric(void)
{
    const float c = 0.0584917F, ior = 1.00011F, sine2 = f(1.0F - c * c);
    const float inner = sqrtf(f(1.0F - f(sine2 / f(ior * ior))));
    const float s = (c - ior * inner) / (c + ior * inner), p = (ior * c - inner) / (ior * c + inner);
    row("reflectance of a boundary of index 1.00011 at 86.6°", "Snell, then r = (cos - n cos') / (cos + n cos')",
        (double)(0.5F * (s * s + p * p)), wide_fresnel((wide)c, (wide)ior, 0.0L), (double)fresnel_dielectric(c, ior),
        "both differences from n² - 1 = (n - 1)(n + 1)", "16 roundings of the s part", "lobe_precision");
}

static void shiny_metal(void)
{
    const float c = 0.5F, eta = 1e-3F, k = 3.0F, t0 = f(eta * eta - k * k - (1.0F - c * c));
    const float root = sqrtf(f(t0 * t0 + 4.0F * eta * eta * k * k)), a = sqrtf(f(0.5F * f(root + t0)));
    const float s = (root + c * c - 2.0F * a * c) / (root + c * c + 2.0F * a * c);
    const float s2 = 0.75F, p1 = c * c * root + s2 * s2, p2 = 2.0F * a * c * s2;
    const float naive = 0.5F * (s + s * (p1 - p2) / (p1 + p2));
    row("what a metal of n = .001 + 3 i absorbs at 60°", "1 - F with 2a² = √(t₀² + 4n²k²) + t₀", (double)(1.0F - naive),
        1.0L - wide_fresnel((wide)c, (wide)eta, (wide)k), 1.0 - (double)fresnel_conductor(c, eta, k),
        "a² as a quotient where t₀ < 0", "12 roundings of 1, more at a critical angle", "lobe_precision");
}

static float slope_of(vec3 h)
{
    return sqrtf(h.x * h.x + h.y * h.y) / h.z;
}

static void sampled_peak(void)
{
    const float u = 1e-9F, z = f(f((1.0F - u) * 2.0F) - 1.0F), r = sqrtf(fmaxf(0.0F, f((1.0F - z) * (1.0F + z))));
    const ndf n = { NDF_GGX, 0.5F, 0.5F };
    row("a GGX sample next to the peak: slope over α, u = 10⁻⁹",
        "z = (1 - u)(1 + v) - v, r = √(1 - z²), slope r / (z + v)", (double)(r / f(z + 1.0F)),
        sqrtl((wide)u / (1.0L - (wide)u)), 2.0 * (double)slope_of(ndf_sample_visible(&n, (vec3){ 0, 0, 1 }, 0.0F, u)),
        "1 - z and z + v from u, without z", "14 roundings", "lobe_precision");
}

static void opposite_directions(void)
{
    const float z = 1e-23F, sum = f(z + z), length = sqrtf(f(sum * sum));
    row("half the length of wo + wi where both graze the ground opposite each other, at cos = 10⁻²³", "√(x² + y² + z²)",
        (double)(0.5F * length), (wide)z, (double)(0.5F * sqrtf(f(sum * 1e30F) * f(sum * 1e30F)) * 1e-30F),
        "scaled first where the square is no number", "3 roundings", "lobe_precision");
}

/* ---- counts ---- */

/* The chance of one count or more, as the sampler has it: thresholds for all of 2^16 dithers. */
static double any_lit(float trials, float p)
{
    const binomial_chance c = binomial_chance_of(p);
    float em1, mass;
    exp_both(floorf(trials) * c.log_miss, &em1, &mass);
    const float survival = -em1 + (trials - floorf(trials)) * p * mass;
    double sum = 0.0;
    for (int k = 0; k < 65536; k++)
        sum += ((double)binomial_threshold(survival * BINOMIAL_SCALE + (float)k * 0x1p-16F) + 2147483648.0) * 0x1p-32;
    return sum / 65536.0;
}

static void any_of_many(float trials, float p, const char *what)
{
    row(what, "1 - (1 - p)^N", (double)(1.0F - powf(f(1.0F - p), trials)), -expm1l((wide)trials * log1pl(-(wide)p)),
        any_lit(trials, p), "-expm1(N log(1 - p)), both kept exact near 0", "4 roundings, and 2⁻³¹", "elementary");
}

static void rare_count(void)
{
    row("a chance of 10⁻¹²", "u < p with a uniform of 24 bits", 0x1p-24, 1e-12L, any_lit(1.0F, 1e-12F),
        "threshold of 31 bits, rounded by 16 random ones", "2⁻⁴⁷ = 7·10⁻¹⁵; below N p = 3·10⁻¹⁰ nothing is counted",
        "counting_edges");
}

static void no_variance(void)
{
    const float n = 1e9F, p = f(1.0F + FLT_EPSILON);
    const binomial_chance c = binomial_chance_of(1.0F);
    vint uniform[12] = { 12345 };
    const vfloat weight[12] = { 1.0F };
    row("p = 1 + 2⁻²³, as D Ω / D_H may round to: 10⁹ facets, all lit", "N p + √(N p (1 - p)) z",
        (double)(n * p + sqrtf(f(n * p * (1.0F - p))) * 0.5F), 1e9L,
        (double)binomial_weighted_sum(n, &c, uniform, weight, 0.0F, NULL, (binomial_many){ 12, 1.0F }),
        "p at most 1; from there the lobe is smooth", "exact", "counting_edges");
}

/* ---- places ---- */

static void long_footprint(void)
{
    /* 1 m by 1 micrometre, a sixth of a turn around. */
    const float j[4] = { 0.5F, -0.866025404e-6F, 0.866025404F, 0.5e-6F };
    const float turned[4] = { j[0] * 0.6F - j[1] * 0.8F, j[0] * 0.8F + j[1] * 0.6F, j[2] * 0.6F - j[3] * 0.8F,
                              j[2] * 0.8F + j[3] * 0.6F };
    const wide exact = fabsl((wide)turned[0] * (wide)turned[3] - (wide)turned[1] * (wide)turned[2]);
    row("area of a footprint a million times as long as wide, m²", "dudx dvdy - dudy dvdx",
        (double)fabsf(f(turned[0] * turned[3]) - f(turned[1] * turned[2])), exact,
        (double)grid_area(turned[0], turned[1], turned[2], turned[3]), "both products exact, in double",
        "1 rounding; N 2", "counting_edges");
}

static void far_cell(void)
{
    const double u = 1e6 + 0.00037, cells = 1024.0;
    const float far = f((float)u * (float)cells);
    vuint low;
    row("place within a cell of 1 mm, 1000 km from the origin", "u / side - ⌊u / side⌋ in float",
        (double)(far - floorf(far)), (wide)u * (wide)cells - floorl((wide)u * (wide)cells),
        (double)grid_fraction(u * cells, &low), "the cell's number as an integer, the rest in double",
        "3·2⁻⁵³ of the distance in cells, and 2 roundings", "counting_edges");
}

static void no_cell(void)
{
    /* Just below a power of two, so that the sum has half of the digits that x has. */
    const double x = 0x1p58 - 96.0, nearest = (x + 6755399441055744.0) - 6755399441055744.0;
    vuint low;
    row("weight of a cell that has no number any more, 2⁵⁸ cells out", "x - ⌊x⌋ with ⌊x⌋ by adding 1.5·2⁵²",
        x - (x < nearest ? nearest - 1.0 : nearest), ANY_WEIGHT, (double)grid_fraction(x, &low),
        "kept in [0, 1]: weights add up to 1, and the mean stays", "mean exact", "counting_edges");
}

static void add_share(int64_t x, int64_t y, double share, void *user)
{
    (void)x;
    (void)y;
    *(double *)user += share;
}

static void small_pixel(void)
{
    const double u = 123456789.25, v = 987654321.75, s = 1e-3;
    const coverage_pixel p = { u, v, s, 0.0, 0.0, s };
    const double x[4] = { u - 0.5 * s, u + 0.5 * s, u + 0.5 * s, u - 0.5 * s };
    const double y[4] = { v - 0.5 * s, v - 0.5 * s, v + 0.5 * s, v + 0.5 * s };
    volatile double sum = 0.0;
    for (int i = 0; i < 4; i++)
        sum += x[i] * y[(i + 1) % 4] - x[(i + 1) % 4] * y[i];
    double whole = 0.0;
    coverage_each(&p, add_share, &whole);
    row("share of a pixel of 10⁻³ cells that its cells hold, 10⁹ cells out", "shoelace formula, in double, over s²",
        0.5 * sum / (s * s), 1.0L, whole, "corners from the pixel's own cell, a fan of differences",
        "8 double roundings of outline² / area", "area_precision");
}

/* ---- lights ---- */

/* A square of directions of this half side, overhead; the sum of its sides' normals by products of whole directions. */
static double square_by_products(double half)
{
    const vec3d corner[4] = { { 0.3 + half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 - half, 1.0 },
                              { 0.3 + half, 0.4 - half, 1.0 } };
    vec3d sum = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < 4; i++)
        sum = vec3d_mad(sum, vec3d_cross(vec3d_normalize(corner[i]), vec3d_normalize(corner[(i + 1) % 4])), 0.5);
    return vec3d_length(sum);
}

static void tiny_square(void)
{
    const double half = 1e-8;
    area_light l;
    const vec3d corner[4] = { { 0.3 + half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 + half, 1.0 },
                              { 0.3 - half, 0.4 - half, 1.0 },
                              { 0.3 + half, 0.4 - half, 1.0 } };
    area_make_polygon(&l, corner, 4, 1);
    area_measure(&l);
    /* Flat as far as double can tell: its area by cos / distance^2. */
    const wide distance2 = 1.25L;
    row("solid angle of a square of 2·10⁻⁸ radians, sr", "Lambert's sum of a x b, in double", square_by_products(half),
        4.0L * (wide)half * (wide)half / (distance2 * sqrtl(distance2)), vec3d_length(l.moment), "a x (b - a)",
        "double roundings of the outline: 10⁻⁸ of this one", "area_precision");
}

static void short_side(void)
{
    const float a[3] = { 0.6F, 0.0F, 0.8F }, x = 2e-5F;
    const float b[3] = { 0.6F * cosf(x), 0.6F * sinf(x), 0.8F };
    const float dot = f(f(a[0] * b[0]) + f(a[1] * b[1]) + f(a[2] * b[2]));
    const wide exact = 0.6L * (wide)x;
    const vec3d p = vec3d_from(a), q = vec3d_from(b);
    row("angle of a light's side of 1.2·10⁻⁵ radians", "acos(a·b)", (double)acosf(dot), exact,
        real_atan2(vec3d_length(vec3d_cross(p, vec3d_sub(q, p))), vec3d_dot(p, q)),
        "atan2 of the length of a x (b - a) and a·b, in double", "16 double roundings", "area_precision");
}

static void tiny_sun(void)
{
    const float solid_angle = 1e-9F, cosine = f(1.0F - f(solid_angle / 6.28318531F));
    const double versine = (double)solid_angle / (2.0 * REAL_PI);
    area_light l;
    area_make_round(&l, (vec3d){ 0.0, 0.0, 1.0 }, sqrt(versine * (2.0 - versine)), 1.0 - versine);
    area_measure(&l);
    const wide v = (wide)solid_angle / (2.0L * WIDE_PI);
    row("form factor of a sun of 10⁻⁹ sr overhead, times π", "π sin² with cos = 1 - Ω / 2π",
        (double)(MATH_PI * f(1.0F - cosine * cosine)), WIDE_PI * v * (2.0L - v), l.moment.z,
        "sin² = v (2 - v), v = Ω / 2π, in double", "480 double roundings", "area_precision");
}

static void long_ellipse(void)
{
    /* Half axes 1e-2 and 1e-9 radians, turned by a third of a right angle. */
    const double a = 1e-2, b = 1e-9, c = 0.8660254037844387, s = 0.5;
    const double uu = a * a * c * c + b * b * s * s, vv = a * a * s * s + b * b * c * c, uv = (a * a - b * b) * c * s;
    const double sum = 0.5 * (uu + vv), root = sqrt(0.25 * (uu - vv) * (uu - vv) + uv * uv);
    area_light l;
    area_make_ellipse(&l, (vec3d){ 0.0, 0.0, 1.0 }, (vec3d){ a * c, a * s, 0.0 }, (vec3d){ -b * s, b * c, 0.0 }, 1);
    area_measure(&l);
    row("width over length of an ellipse of 10⁻² by 10⁻⁹ radians", "smaller eigenvalue: trace / 2 - √…, in double",
        sqrt(fmax(sum - root, 0.0) / (sum + root)), (wide)b / (wide)a, l.kind == AREA_CONIC ? l.cone.b / l.cone.a : 0.0,
        "determinant as squares of areas, over the larger eigenvalue", "480 double roundings, and (4·2⁻⁵³ / b)²",
        "area_precision");
}

int main(void)
{
    section("Facets");
    narrow_lobe();
    steep_masking();
    total_area();
    thin_dielectric();
    shiny_metal();
    sampled_peak();
    opposite_directions();
    section("Counts");
    any_of_many(1e9F, 1e-9F, "one or more of 10⁹ facets, p = 10⁻⁹");
    any_of_many(3e7F, 1.0F / 3e7F, "one or more of 3·10⁷ facets, p = 1 / N");
    rare_count();
    no_variance();
    section("Places");
    long_footprint();
    far_cell();
    no_cell();
    small_pixel();
    section("Lights");
    tiny_square();
    short_side();
    tiny_sun();
    long_ellipse();
    return 0;
}
