/* Facets: distributions, masking, reflectance, samples. */
#include "naive.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "ndf/fresnel.h"
#include "ndf/ndf.h"

#include "lobe_truth.h"

static void narrow_lobe(void)
{
    const float a = 1e-4F, c = 1.0F, d = f(f(a * a) - 1.0F) * c * c + 1.0F;
    const ndf n = { NDF_GGX, a, a };
    naive_print(&(naive_row){ "GGX of α = 10⁻⁴ at its peak", "D = α² / (π ((α² - 1) cos² + 1)²)",
                              (double)(f(a * a) / (MATH_PI * d * d)), 1.0L / (WIDE_PI * (wide)a * (wide)a),
                              (double)ndf_density(&n, (vec3){ 0.0F, 0.0F, 1.0F }),
                              "sum of squares: (x/α)² + (y/α)² + z²", "13 roundings", "lobe_precision" });
}

static void steep_masking(void)
{
    const float a = 1e-3F;
    const vec3 v = { sinf(0.1F), 0.0F, cosf(0.1F) };
    const float t = v.x / v.z;
    const wide_lobe l = { 1, (wide)a, (wide)a };
    const wide w[3] = { (wide)v.x, 0.0L, (wide)v.z };
    const ndf n = { NDF_GGX, a, a };
    naive_print(&(naive_row){ "masking of α = .001 seen at 6°", "Λ = (√(1 + α² tan²) - 1) / 2, times cos",
                              (double)(0.5F * (sqrtf(f(1.0F + a * a * t * t)) - 1.0F) * v.z), wide_masked(&l, w),
                              (double)ndf_masked(&n, v), "the difference of roots as a quotient", "8 roundings",
                              "lobe_precision" });
}

static void total_area(void)
{
    const float a = 0.1F, x = f(1.0F / a);
    const ndf n = { NDF_BECKMANN, a, a };
    naive_print(&(naive_row){ "facet area over surface area, Beckmann of α = .1", "1 + √π/2 α exp(1/α²) erfc(1/α)",
                              (double)(1.0F + 0.886226925F * a * expf(f(x * x)) * erfcf(x)),
                              wide_total_area(0, (wide)a), (double)ndf_total_area(&n),
                              "erfcx, a fit of exp(x²) erfc(x)", "5.5 roundings", "lobe_precision" });
}

static void thin_dielectric(void)
{
    const float c = 0.0584917F, ior = 1.00011F, sine2 = f(1.0F - c * c);
    const float inner = sqrtf(f(1.0F - f(sine2 / f(ior * ior))));
    const float s = (c - ior * inner) / (c + ior * inner), p = (ior * c - inner) / (ior * c + inner);
    naive_print(&(naive_row){
        "reflectance of a boundary of index 1.00011 at 86.6°", "Snell, then r = (cos - n cos') / (cos + n cos')",
        (double)(0.5F * (s * s + p * p)), wide_fresnel((wide)c, (wide)ior, 0.0L), (double)fresnel_dielectric(c, ior),
        "both differences from n² - 1 = (n - 1)(n + 1)", "16 roundings of the s part", "lobe_precision" });
}

static void shiny_metal(void)
{
    const float c = 0.5F, eta = 1e-3F, k = 3.0F, t0 = f(eta * eta - k * k - (1.0F - c * c));
    const float root = sqrtf(f(t0 * t0 + 4.0F * eta * eta * k * k)), a = sqrtf(f(0.5F * f(root + t0)));
    const float s = (root + c * c - 2.0F * a * c) / (root + c * c + 2.0F * a * c);
    const float s2 = 0.75F, p1 = c * c * root + s2 * s2, p2 = 2.0F * a * c * s2;
    const float naive = 0.5F * (s + s * (p1 - p2) / (p1 + p2));
    naive_print(&(naive_row){ "what a metal of n = .001 + 3 i absorbs at 60°", "1 - F with 2a² = √(t₀² + 4n²k²) + t₀",
                              (double)(1.0F - naive), 1.0L - wide_fresnel((wide)c, (wide)eta, (wide)k),
                              1.0 - (double)fresnel_conductor(c, eta, k), "a² as a quotient where t₀ < 0",
                              "12 roundings of 1, more at a critical angle", "lobe_precision" });
}

static float slope_of(vec3 h)
{
    return sqrtf(h.x * h.x + h.y * h.y) / h.z;
}

static void sampled_peak(void)
{
    const float u = 1e-9F, z = f(f((1.0F - u) * 2.0F) - 1.0F), r = sqrtf(fmaxf(0.0F, f((1.0F - z) * (1.0F + z))));
    const ndf n = { NDF_GGX, 0.5F, 0.5F };
    naive_print(&(naive_row){ "a GGX sample next to the peak: slope over α, u = 10⁻⁹",
                              "z = (1 - u)(1 + v) - v, r = √(1 - z²), slope r / (z + v)", (double)(r / f(z + 1.0F)),
                              sqrtl((wide)u / (1.0L - (wide)u)),
                              2.0 * (double)slope_of(ndf_sample_visible(&n, (vec3){ 0, 0, 1 }, 0.0F, u)),
                              "1 - z and z + v from u, without z", "14 roundings", "lobe_precision" });
}

static void opposite_directions(void)
{
    const float z = 1e-23F, sum = f(z + z), length = sqrtf(f(sum * sum));
    naive_print(&(naive_row){
        "half the length of wo + wi where both graze the ground opposite each other, at cos = 10⁻²³", "√(x² + y² + z²)",
        (double)(0.5F * length), (wide)z, (double)(0.5F * sqrtf(f(sum * 1e30F) * f(sum * 1e30F)) * 1e-30F),
        "scaled first where the square is no number", "3 roundings", "lobe_precision" });
}

/* The usual anisotropic roughness is a mean over the azimuth, which the pole has not. */
static void stretched_peak(void)
{
    const float x = 0.0F, z = 1.0F, alpha_x = 1.0F, alpha_y = 1e-3F;
    const float across = f(x / sqrtf(f(1.0F - z * z))), along = f(1.0F - across * across);
    const float alpha2 = 1.0F / (across * across / (alpha_x * alpha_x) + along / (alpha_y * alpha_y));
    const ndf n = { NDF_GGX, alpha_x, alpha_y };
    naive_print(&(naive_row){ "GGX of α_x = 1, α_y = .001 at its peak", "α by cos φ = x / √(1 - z²), D as above",
                              (double)(1.0F / (MATH_PI * alpha2)), 1.0L / (WIDE_PI * (wide)alpha_x * (wide)alpha_y),
                              (double)ndf_density(&n, (vec3){ x, 0.0F, z }), "slopes over each axis's own α, no angle",
                              "13 roundings", "lobe_precision" });
}

/* f cos of a smooth GGX surface of this roughness, by the library. */
static glint_value reflected(float alpha, const float wo[3], const float wi[3], float solid_angle)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.alpha_x = o.surface.alpha_y = alpha;
    glint_material *const m = material_or_exit(&o);
    const glint_footprint at = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle };
    glint_value v;
    glint_eval_value(m, NULL, &at, wo, wi, &light, &v);
    glint_material_destroy(m);
    return v;
}

static void both_on_the_horizon(void)
{
    const float a = 0.5F, c = 1e-25F, wo[3] = { 1.0F, 0.0F, c }, wi[3] = { -1.0F, 0.0F, c };
    const float tangent = f(1.0F / c), g1 = 2.0F / (1.0F + sqrtf(f(1.0F + a * a * f(tangent * tangent))));
    const float peak = 1.0F / (MATH_PI * a * a), naive = f(peak * g1 * g1) / f(4.0F * c * c) * c;
    const wide_lobe l = { 1, (wide)a, (wide)a };
    /* The half vector is the normal: float does not hold the square of its length, long double does. */
    const wide_geometry g = wide_geometry_of(wo, wi);
    naive_print(&(naive_row){ "viewer and light at a cosine of 10⁻²⁵, opposite each other, α = .5",
                              "D G₁ G₁ / (4 cos cos'), times cos'", (double)naive, wide_reflected(&l, &g),
                              (double)reflected(a, wo, wi, 1e-4F).smooth[0],
                              "G₂ / cos as one quotient without tangents", "64 roundings", "lobe_precision" });
}

static void lit_along_the_ground(void)
{
    const float c = 1.745329e-6F, wo[3] = { 1.0F, 0.0F, c }, wi[3] = { -1.0F, 0.0F, c };
    const float light = 1e-12F, dot = f(-1.0F + f(c * c)), half = sqrtf(f(0.5F * f(1.0F + dot)));
    const float peak = 1.0F / MATH_PI;
    /* α = 1: D_H = 2. */
    naive_print(&(naive_row){
        "chance that a facet is lit by 10⁻¹² sr, viewer and light at 89.9999°, α = 1",
        "D Ω / (4 h·wi D_H), h·wi = √((1 + wo·wi) / 2)", (double)(light * peak / f(4.0F * half * 2.0F)),
        (wide)light / WIDE_PI / (4.0L * (wide)c * 2.0L), (double)reflected(1.0F, wo, wi, light).lit_probability,
        "h·wi as half the length of wo + wi", "47 roundings", "lobe_precision" });
}

static void straight_behind(void)
{
    const float wo[3] = { 0.6F, 0.0F, 0.8F }, wi[3] = { -0.6F, 0.0F, -0.8F };
    const float sum = f(wo[2] + wi[2]), h = f(sum / sqrtf(f(sum * sum)));
    const float d = f(h * h * (0.25F - 1.0F) + 1.0F);
    naive_print(&(naive_row){ "wi = -wo", "h = wo + wi over its length", (double)(0.25F / (MATH_PI * d * d)), 0.0L,
                              (double)reflected(0.5F, wo, wi, 1e-4F).smooth[0],
                              "what is below the horizon ends before anything is divided", "exact", "hard_cases" });
}

void naive_facets(void)
{
    narrow_lobe();
    stretched_peak();
    steep_masking();
    total_area();
    thin_dielectric();
    shiny_metal();
    sampled_peak();
    both_on_the_horizon();
    lit_along_the_ground();
    opposite_directions();
    straight_behind();
}
