/* Distributions, masking and Fresnel against their definitions in double precision. */
#include <complex.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define GLINT_LANES 1
#include "ndf/fresnel.h"
#include "ndf/ndf.h"
#include "statistics.h"

#define PI 3.14159265358979323846

/* Slope densities: P22(x, y) of roughness one; D(h) = P22(slopes / alpha) / (alpha_x alpha_y cos^4). */
static double exact_density(const ndf *n, vec3 h)
{
    const double ax = (double)n->alpha_x, ay = (double)n->alpha_y, z = (double)h.z;
    const double x = (double)h.x / z / ax, y = (double)h.y / z / ay;
    const double s = x * x + y * y;
    const double p22 = n->kind == NDF_GGX ? 1.0 / (PI * (1.0 + s) * (1.0 + s)) : exp(-s) / PI;
    return p22 / (ax * ay * z * z * z * z);
}

static double exact_lambda(const ndf *n, vec3 v)
{
    const double x = (double)n->alpha_x * (double)v.x, y = (double)n->alpha_y * (double)v.y;
    const double a = (double)v.z / sqrt(x * x + y * y);
    if (n->kind == NDF_GGX)
        return 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    return 0.5 * (exp(-a * a) / (a * sqrt(PI)) - erfc(a));
}

static vec3 direction(double theta, double phi)
{
    return (vec3){ (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)), (float)cos(theta) };
}

static ndf random_ndf(uint64_t *random)
{
    return (ndf){ random_bits(random) & 1 ? NDF_GGX : NDF_BECKMANN, (float)random_log_between(random, 1e-3, 1.0),
                  (float)random_log_between(random, 1e-3, 1.0) };
}

static void density_agrees_with_slope_density(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 200000; i++) {
        const ndf n = random_ndf(&random);
        /* Slopes up to a few times the roughness, where the density is not negligible. */
        const double r = random_between(&random, 0.0, 3.0), phi = random_between(&random, 0.0, 2.0 * PI);
        const vec3 h =
            vec3_normalize((vec3){ (float)(r * cos(phi)) * n.alpha_x, (float)(r * sin(phi)) * n.alpha_y, 1.0F });
        const double exact = exact_density(&n, h);
        /* Beckmann: an error of e in the exponent, which is at most 9, is a relative error of 9 e. */
        assert_true(fabs((double)ndf_density(&n, h) / exact - 1.0) < 4e-6);
    }
}

static void masking_agrees_with_lambda(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int i = 0; i < 200000; i++) {
        const ndf n = random_ndf(&random);
        const double grazing = random_log_between(&random, 1e-6, 1.57);
        const vec3 o = direction(PI / 2.0 - grazing, random_between(&random, 0.0, 6.3));
        const vec3 w = direction(PI / 2.0 - random_log_between(&random, 1e-6, 1.57), random_between(&random, 0.0, 6.3));
        const double g2 = 1.0 / (1.0 + exact_lambda(&n, o) + exact_lambda(&n, w));
        const double got = (double)ndf_masking_over_cosine(&n, o, w) * (double)o.z;
        assert_true(fabs(got / g2 - 1.0) < 5e-6);
    }
}

/* Mean of sqrt(1 + slope^2) over the slopes: the area of facets per area of surface, by quadrature in polar slopes. */
static double exact_total_area(const ndf *n)
{
    enum { RADII = 4000, TURNS = 256 };
    double sum = 0.0;
    for (int i = 0; i < RADII; i++) {
        const double u = (i + 0.5) / RADII;
        /* Radius by inversion: u = distribution of r for roughness one; w^4 spacing resolves GGX's long tail. */
        const double v = 1.0 - u * u * u * u;
        const double weight = 4.0 * u * u * u / RADII;
        const double r = n->kind == NDF_GGX ? sqrt(v / (1.0 - v)) : sqrt(-log1p(-v));
        for (int k = 0; k < TURNS; k++) {
            const double phi = 2.0 * PI * (k + 0.5) / TURNS;
            const double x = r * (double)n->alpha_x * cos(phi), y = r * (double)n->alpha_y * sin(phi);
            sum += weight * sqrt(1.0 + x * x + y * y) / TURNS;
        }
    }
    return sum;
}

static void total_area_agrees_with_quadrature(void **state)
{
    (void)state;
    /* shared numbers of the specification */
    static const double alpha[] = { 0.1, 0.25, 0.5, 0.81, 1.0 };
    static const double ggx[] = { 1.030083, 1.133194, 1.380173, 1.752068, 2.0 };
    static const double beckmann[] = { 1.004975, 1.030353, 1.113169, 1.266371, 1.378936 };
    for (int i = 0; i < 5; i++) {
        const ndf g = { NDF_GGX, (float)alpha[i], (float)alpha[i] },
                  b = { NDF_BECKMANN, (float)alpha[i], (float)alpha[i] };
        assert_true(fabs((double)ndf_total_area(&g) - ggx[i]) < 2e-6);
        assert_true(fabs((double)ndf_total_area(&b) - beckmann[i]) < 2e-6);
    }
    static const float pairs[][2] = {
        { 0.5F, 0.5F }, { 0.4F, 0.1F }, { 1.0F, 1e-3F }, { 0.03F, 0.9F }, { 0.1F, 1e-4F }
    };
    for (size_t i = 0; i < sizeof(pairs) / sizeof(pairs[0]); i++)
        for (int kind = 0; kind < 2; kind++) {
            const ndf n = { kind ? NDF_BECKMANN : NDF_GGX, pairs[i][0], pairs[i][1] };
            const double exact = exact_total_area(&n);
            assert_true(fabs((double)ndf_total_area(&n) / exact - 1.0) < 1e-4);
        }
}

static void smallest_roughness_stays_finite(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        const ndf n = { kind ? NDF_BECKMANN : NDF_GGX, 1e-4F, 1e-4F };
        assert_true(fabs((double)ndf_total_area(&n) - 1.0) < 1e-6);
        assert_true(fabs((double)ndf_density(&n, (vec3){ 0, 0, 1 }) * PI * 1e-8 - 1.0) < 1e-5);
        for (double z = 1e-30; z < 1.0; z *= 10.0) {
            const vec3 v = { sqrtf(1.0F - (float)(z * z)), 0.0F, (float)z };
            assert_true(isfinite(ndf_masking_over_cosine(&n, v, v)) && isfinite(ndf_density(&n, v)));
        }
    }
}

/* Visible normals against G1 D (wo.h) / cos, in cells of equal slope radius and azimuth. */
static void visible_normals_have_their_density(void **state)
{
    (void)state;
    static const double theta[] = { 0.0, 0.5, 1.0, 1.4, 1.55 };
    static const float alphas[][2] = { { 0.3F, 0.3F }, { 0.6F, 0.1F }, { 0.02F, 0.05F } };
    enum { RADIAL = 12, AZIMUTH = 16, SAMPLES = 400000, FINE = 24 };
    uint64_t random = 9;
    double worst = 1.0;
    for (int kind = 0; kind < 2; kind++)
        for (size_t a = 0; a < 3; a++)
            for (size_t t = 0; t < 5; t++) {
                const ndf n = { kind ? NDF_BECKMANN : NDF_GGX, alphas[a][0], alphas[a][1] };
                const vec3 wo = direction(theta[t], 0.7);
                double expected[RADIAL * AZIMUTH] = { 0 }, seen[RADIAL * AZIMUTH] = { 0 };
                const double g1_over_cos = 1.0 / ((double)wo.z * (1.0 + (theta[t] > 0.0 ? exact_lambda(&n, wo) : 0.0)));
                /* Cell of a normal: azimuth, and w with 1 - (1 - w)^2 the distribution function of the slope's radius,
                 * at roughness one. In w the mean of GGX's unbounded slopes is an integral of a smooth function. */
                for (int i = 0; i < RADIAL * FINE; i++)
                    for (int k = 0; k < AZIMUTH * FINE; k++) {
                        const double w = (i + 0.5) / (RADIAL * FINE), phi = 2.0 * PI * (k + 0.5) / (AZIMUTH * FINE);
                        const double v = 1.0 - (1.0 - w) * (1.0 - w);
                        const double r = kind ? sqrt(-log1p(-v)) : sqrt(v / (1.0 - v));
                        const double x = r * cos(phi) * (double)n.alpha_x, y = r * sin(phi) * (double)n.alpha_y;
                        /* G1 D (wo.h) / cos_o dh = G1 / cos_o (wo.h / cos_h) P22 dslope, and P22 dslope = dv dphi / 2
                         * pi */
                        const double dot = (double)wo.z + (double)wo.x * x + (double)wo.y * y;
                        expected[(i / FINE) * AZIMUTH + k / FINE] +=
                            fmax(0.0, dot) * g1_over_cos * 2.0 * (1.0 - w) / (RADIAL * FINE * AZIMUTH * FINE) * SAMPLES;
                    }
                for (int i = 0; i < SAMPLES; i++) {
                    const vec3 h = ndf_sample_visible(&n, wo, (float)random_uniform(&random) * 0.99999994F,
                                                      (float)random_uniform(&random) * 0.99999994F);
                    const double x = (double)(h.x / h.z / n.alpha_x), y = (double)(h.y / h.z / n.alpha_y);
                    const double s = x * x + y * y;
                    const double w = 1.0 - (kind ? exp(-0.5 * s) : 1.0 / sqrt(1.0 + s));
                    const double phi = atan2(y, x) / (2.0 * PI);
                    const int row = (int)fmin(w * RADIAL, RADIAL - 1);
                    const int column = (int)fmin((phi < 0.0 ? phi + 1.0 : phi) * AZIMUTH, AZIMUTH - 1);
                    seen[row * AZIMUTH + column] += 1.0;
                }
                double chi2 = 0.0, cells = 0.0, rest_seen = 0.0, rest_expected = 0.0;
                for (int i = 0; i < RADIAL * AZIMUTH; i++)
                    if (expected[i] >= 10.0) {
                        chi2 += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
                        cells += 1.0;
                    } else {
                        rest_seen += seen[i];
                        rest_expected += expected[i];
                    }
                if (rest_expected >= 10.0)
                    chi2 += (rest_seen - rest_expected) * (rest_seen - rest_expected) / rest_expected;
                const double tail = chi_square_tail(chi2, cells);
                if (tail < 0.001 / 30.0)
                    printf("kind %d alpha %g %g theta %g: chi^2 %.1f on %.0f cells, p %.2e\n", kind, (double)n.alpha_x,
                           (double)n.alpha_y, theta[t], chi2, cells, tail);
                worst = fmin(worst, tail);
            }
    assert_true(worst > 0.001 / 30.0); /* significance .001 over 30 tests */
}

static void fresnel_agrees_with_complex_arithmetic(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int i = 0; i < 100000; i++) {
        const double c = random_uniform(&random);
        const int metal = i & 1;
        const float eta = (float)random_between(&random, metal ? 0.05 : 1.01, 4.0);
        const float k = metal ? (float)random_between(&random, 0.0, 8.0) : 0.0F;
        const double complex m = (double)eta + (double)k * (double complex)_Complex_I;
        const double cosine = (double)(float)c;
        const double complex inner = csqrt(m * m - (1.0 - cosine * cosine));
        const double complex s = (cosine - inner) / (cosine + inner);
        const double complex p = (m * m * cosine - inner) / (m * m * cosine + inner);
        const double exact = 0.5 * (creal(s * conj(s)) + creal(p * conj(p)));
        const double got =
            metal ? (double)fresnel_conductor((float)c, eta, k) : (double)fresnel_dielectric((float)c, eta);
        assert_true(fabs(got - exact) < 3e-6);
    }
    assert_true(fresnel_schlick(1.0F, 0.04F, 1.0F) == 0.04F && fresnel_schlick(0.0F, 0.04F, 1.0F) == 1.0F);
}

/* Of a circle of radius s around a point at distance d from the middle of the unit disk, the part within the disk. */
static double part_within(double s, double d)
{
    if (s <= 1.0 - d)
        return 1.0;
    if (s >= 1.0 + d || s <= d - 1.0)
        return 0.0;
    return acos(fmax(-1.0, fmin(1.0, (d * d + s * s - 1.0) / (2.0 * d * s)))) / PI;
}

/* (integral of l)^2 / integral of l^2 for the unit disk, l the mass within it of a lobe around each point of the plane:
 * by radius of the lobe, in equal shares of its mass, and by distance from the middle. */
static double exact_lit_solid_angle(ndf_kind kind, double alpha)
{
    enum { SHARES = 700, STEPS = 900 };
    double whole = 0.0, squared = 0.0;
    for (int i = 0; i < STEPS; i++) {
        const double u = (i + 0.5) / STEPS, wide = 1.0 + alpha, d = wide * u / (1.0 - u);
        const double ring = 2.0 * PI * d * wide / ((1.0 - u) * (1.0 - u)) / STEPS;
        double mass = 0.0;
        for (int k = 0; k < SHARES; k++) {
            const double share = (k + 0.5) / SHARES;
            const double s2 = kind == NDF_GGX ? share / (1.0 - share) : -log1p(-share);
            mass += part_within(alpha * sqrt(s2), d) / SHARES;
        }
        whole += mass * ring;
        squared += mass * mass * ring;
    }
    return whole * whole / squared;
}

/* The quadrature itself is good to 1e-3 where the lobe's shares are coarser than the disk, far better elsewhere. */
static void lit_solid_angle_agrees_with_quadrature(void **state)
{
    (void)state;
    static const double alphas[] = { 0.01, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.5, 5.0 };
    for (int kind = NDF_GGX; kind <= NDF_BECKMANN; kind++)
        for (size_t i = 0; i < sizeof(alphas) / sizeof(alphas[0]); i++) {
            /* The unit disk scaled to a radius of .02. */
            const double r = 0.02, exact = exact_lit_solid_angle((ndf_kind)kind, alphas[i]) * r * r;
            const double got = (double)ndf_lit_solid_angle((ndf_kind)kind, (float)(PI * r * r), (float)(alphas[i] * r));
            if (fabs(got / exact - 1.0) > 4e-3)
                fail_msg("%s, lobe %g times the disk: %g, expected %g", kind == NDF_GGX ? "GGX" : "Beckmann", alphas[i],
                         got, exact);
        }
    assert_true(ndf_lit_solid_angle(NDF_GGX, 0.125F, 0.0F) == 0.125F);
    assert_true(fabs((double)ndf_lit_solid_angle(NDF_GGX, 0.0F, 0.1F) - 0.03 * PI) < 1e-7);
    assert_true(fabs((double)ndf_lit_solid_angle(NDF_BECKMANN, 0.0F, 0.1F) - 0.02 * PI) < 1e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_agrees_with_slope_density),
        cmocka_unit_test(masking_agrees_with_lambda),
        cmocka_unit_test(total_area_agrees_with_quadrature),
        cmocka_unit_test(smallest_roughness_stays_finite),
        cmocka_unit_test(visible_normals_have_their_density),
        cmocka_unit_test(fresnel_agrees_with_complex_arithmetic),
        cmocka_unit_test(lit_solid_angle_agrees_with_quadrature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
