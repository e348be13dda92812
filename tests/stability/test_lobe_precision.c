/* Distributions, masking, Fresnel and the whole smooth lobe against long double, over every roughness and angle that
 * may come in, the hard ones most of all. Bounds count the roundings of the formulas. */
#define _GNU_SOURCE
#include "traps.h"

#include "lobe_truth.h"
#define GLINT_LANES 1
#include "ndf/fresnel.h"
#include "ndf/ndf.h"

enum { MANY = 1000000 };

static const double ROUNDING = (double)FLOAT_ROUNDING;

/* Roughness down to the smallest, one axis a thousand and more times the other. */
static ndf random_ndf(uint64_t *random, int i)
{
    const float x = (float)random_log_between(random, 1e-4, 1.0);
    return (ndf){ i & 1 ? NDF_GGX : NDF_BECKMANN, fminf(fmaxf(x, 1e-4F), 1.0F),
                  i & 2 ? fminf(fmaxf(x, 1e-4F), 1.0F) : (float)random_log_between(random, 1e-4, 1.0) };
}

/* From the pole to 89.9999 degrees and beyond: angles to the normal and to the horizon log-uniform. */
static void hard_direction(uint64_t *random, float v[3])
{
    const uint64_t bits = random_bits(random);
    const double near = random_log_between(random, 1e-8, 1.5), phi = random_between(random, 0.0, 6.283185307);
    const double z = bits & 1 ? cos(near) : sin(near), r = bits & 1 ? sin(near) : cos(near);
    v[0] = (float)(r * (bits & 6 ? cos(phi) : 1.0));
    v[1] = (float)(r * (bits & 6 ? sin(phi) : 0.0));
    v[2] = (float)z;
}

static wide_lobe lobe_of(const ndf *n)
{
    return (wide_lobe){ n->kind == NDF_GGX, (wide)n->alpha_x, (wide)n->alpha_y };
}

static void density_keeps_its_digits(void **state)
{
    (void)state;
    worst_error ggx = { 0 }, beckmann = { 0 };
    uint64_t random = 1;
    for (int i = 0; i < MANY; i++) {
        const ndf n = random_ndf(&random, i);
        const wide_lobe l = lobe_of(&n);
        float h[3];
        if (i & 4) {
            hard_direction(&random, h);
        } else {
            /* Within a few times the roughness, where the facets are. */
            const double r = random_log_between(&random, 1e-3, 9.0), phi = random_between(&random, 0.0, 6.283185307);
            const double x = r * (double)n.alpha_x * cos(phi), y = r * (double)n.alpha_y * sin(phi);
            const double z = 1.0 / sqrt(1.0 + x * x + y * y);
            h[0] = (float)(x * z);
            h[1] = (float)(y * z);
            h[2] = (float)z;
        }
        const wide v[3] = { (wide)h[0], (wide)h[1], (wide)h[2] };
        const wide exact = wide_density(&l, v);
        const double got = (double)ndf_density(&n, vec3_from(h));
        /* h is as it comes, unit or not. GGX: x / alpha, its square and two sums are four roundings of t at most, t
         * twice, its square and the rest five. */
        if (n.kind == NDF_GGX) {
            worst_add(&ggx, relative_error(got, exact), 13.0L * FLOAT_ROUNDING, (double)n.alpha_x, (double)n.alpha_y,
                      (double)h[2]);
            continue;
        }
        const wide slope2 = wide_slope2(&l, v) / (v[2] * v[2]);
        /* Beckmann: the exponent has five roundings, and e^-s multiplies a relative error by s; the rest eight and the
         * exponential's own three. Below e^-86 what is left may be a denormal, or nothing. */
        if (slope2 < 86.0L)
            worst_add(&beckmann, relative_error(got, exact), (11.0L + 5.0L * slope2) * FLOAT_ROUNDING,
                      (double)n.alpha_x, (double)n.alpha_y, (double)h[2]);
        else
            assert_true((wide)got <= exact * 1.01L + 1e-30L / (l.alpha_x * l.alpha_y));
    }
    int ok = worst_holds(&ggx, "GGX, D", ROUNDING);
    ok &= worst_holds(&beckmann, "Beckmann, D", ROUNDING);
    assert_true(ok);
}

static void masking_keeps_its_digits(void **state)
{
    (void)state;
    worst_error ggx = { 0 }, beckmann = { 0 }, both = { 0 };
    uint64_t random = 2;
    for (int i = 0; i < MANY; i++) {
        const ndf n = random_ndf(&random, i);
        const wide_lobe l = lobe_of(&n);
        float o[3], w[3];
        hard_direction(&random, o);
        hard_direction(&random, w);
        const wide v[3] = { (wide)o[0], (wide)o[1], (wide)o[2] }, u[3] = { (wide)w[0], (wide)w[1], (wide)w[2] };
        const wide exact = wide_masked(&l, v);
        const double got = (double)ndf_masked(&n, vec3_from(o));
        /* GGX: t three roundings, the root half of that, the sum and the quotient two. Denormals below 1e-36. */
        if (n.kind == NDF_GGX && exact > 1e-36L)
            worst_add(&ggx, relative_error(got, exact), 8.0L * FLOAT_ROUNDING, (double)n.alpha_x, (double)n.alpha_y,
                      (double)o[2]);
        /* Beckmann: s / sqrt pi - cos erfcx(a) is a difference, of which 1 / (2 a^2) is left for a steep view. Compared
         * with the cosine, to which it is added: erfcx's nine roundings and three more times e^-a^2 / (2 a sqrt pi),
         * and the exponent's. */
        if (n.kind == NDF_BECKMANN) {
            const wide s = sqrtl(l.alpha_x * l.alpha_x * v[0] * v[0] + l.alpha_y * l.alpha_y * v[1] * v[1]);
            const wide a = s > 0.0L ? v[2] / s : 1e9L;
            const wide scale = expl(-a * a) * s / sqrtl(WIDE_PI);
            worst_add(&beckmann, (wide)got - exact, (13.0L + 4.0L * a * a) * FLOAT_ROUNDING * scale + 1e-36L * v[2],
                      (double)n.alpha_x, (double)n.alpha_y, (double)o[2]);
        }
        const wide all = v[2] * u[2] + wide_masked(&l, v) * u[2] + wide_masked(&l, u) * v[2];
        const double masking = (double)ndf_masking_over_cosine(&n, vec3_from(o), vec3_from(w));
        /* Errors of the parts and four more roundings. Beckmann's are largest, 13 + 4 a^2 of e^-a^2 s / sqrt pi, where
         * a^2 is 1; that is .21 s, while the whole is no less than .03 s: 24 roundings. */
        if (v[2] > 1e-9L && u[2] > 1e-9L)
            worst_add(&both, relative_error(masking, u[2] / all), 28.0L * FLOAT_ROUNDING, (double)n.alpha_x,
                      (double)o[2], (double)w[2]);
    }
    int ok = worst_holds(&ggx, "GGX, cos Lambda", ROUNDING);
    ok &= worst_holds(&beckmann, "Beckmann, cos Lambda (absolute)", ROUNDING);
    ok &= worst_holds(&both, "G2 / cos_o", ROUNDING);
    assert_true(ok);
}

static void total_area_keeps_its_digits(void **state)
{
    (void)state;
    worst_error worst[2] = { 0 };
    for (int i = 0; i <= 400000; i++) {
        /* Dense at both ends of [1e-4, 1]. */
        const float a = i & 1 ? (float)pow(10.0, -4.0 * i / 400000.0) : 1.0F - (float)pow(10.0, -7.0 * i / 400000.0);
        if (!(a >= 1e-4F))
            continue;
        for (int kind = 0; kind < 2; kind++) {
            const ndf n = { kind ? NDF_BECKMANN : NDF_GGX, a, a };
            /* What is added to 1 is at most half of the whole, and has nine roundings. For GGX the quotient in the
             * logarithm has three more, over the logarithm, which is b and more; below b = .1 there is a series. */
            const wide b = fmaxl(sqrtl((1.0L - (wide)a) * (1.0L + (wide)a)), 0.1L);
            worst_add(&worst[kind], relative_error((double)ndf_total_area(&n), wide_total_area(!kind, (wide)a)),
                      (5.5L + (kind ? 0.0L : 1.5L / b)) * FLOAT_ROUNDING, (double)a, 0, 0);
        }
    }
    int ok = worst_holds(&worst[0], "GGX, D_H", ROUNDING);
    ok &= worst_holds(&worst[1], "Beckmann, D_H", ROUNDING);
    assert_true(ok);
}

/* What three roundings of g^2 = (eta + i k)^2 - sin^2 do to the reflectance |(c - g) / (c + g)|^2 of s, and to that of
 * p, which has m^2 c for c. At the critical angle, where g is 0, the root makes them large: the reflectance falls there
 * like a root, and a rounding of the cosine that comes in does as much. A dozen roundings of the quotients are
 * absolute. */
static wide conductor_bound(wide c, wide eta, wide k)
{
    const wide m2 = eta * eta + k * k, re = eta * eta - k * k - 1.0L + c * c, im = 2.0L * eta * k;
    const wide size = hypotl(re, im), g = sqrtl(size), error = 3.0L * FLOAT_ROUNDING * (m2 + 1.0L);
    const wide moved = fminl(error / (2.0L * fmaxl(g, 1e-30L)), sqrtl(error));
    const wide s = 4.0L * c / ((c + g) * (c + g)), p = 4.0L * m2 * c / ((m2 * c + g) * (m2 * c + g));
    return 12.0L * FLOAT_ROUNDING + 0.5L * moved * (s + p);
}

static void fresnel_keeps_its_digits(void **state)
{
    (void)state;
    worst_error dielectric = { 0 }, conductor = { 0 }, schlick = { 0 };
    uint64_t random = 3;
    for (int i = 0; i < MANY; i++) {
        const float c = i & 1 ? (float)random_uniform(&random) : (float)random_log_between(&random, 1e-7, 1.0);
        const float ior = 1.0F + (float)random_log_between(&random, 1.01e-4, 9.0);
        const wide exact = wide_fresnel((wide)c, (wide)ior, 0.0L);
        /* Relative to the s part, which is at least half of what there is: near Brewster's angle the p part vanishes.
         */
        const wide g = sqrtl(((wide)ior - 1.0L) * ((wide)ior + 1.0L) + (wide)c * (wide)c);
        const wide s = ((wide)c - g) / ((wide)c + g);
        worst_add(&dielectric, ((wide)fresnel_dielectric(c, ior) - exact) / (s * s), 16.0L * FLOAT_ROUNDING, (double)c,
                  (double)ior, 0);
        const float eta = (float)random_log_between(&random, 1.01e-4, 19.9);
        const float k = i % 3 ? (float)random_log_between(&random, 1e-6, 19.9) : 0.0F;
        worst_add(&conductor, (wide)fresnel_conductor(c, eta, k) - wide_fresnel((wide)c, (wide)eta, (wide)k),
                  conductor_bound((wide)c, (wide)eta, (wide)k), (double)c, (double)eta, (double)k);
        const float f0 = (float)random_uniform(&random), f90 = (float)random_uniform(&random);
        const wide m = 1.0L - (wide)c;
        worst_add(&schlick, (wide)fresnel_schlick(c, f0, f90) - ((wide)f0 + ((wide)f90 - (wide)f0) * m * m * m * m * m),
                  8.0L * FLOAT_ROUNDING, (double)c, (double)f0, (double)f90);
    }
    int ok = worst_holds(&dielectric, "Fresnel, dielectric (of its s part)", ROUNDING);
    ok &= worst_holds(&conductor, "Fresnel, conductor (absolute)", ROUNDING);
    ok &= worst_holds(&schlick, "Fresnel, Schlick (absolute)", ROUNDING);
    assert_true(ok);
}

/* wo and wi for one query: anywhere, mirrored, the same, or opposite along the ground, where wo + wi nearly vanishes.
 */
static void hard_pair(uint64_t *random, int i, float wo[3], float wi[3])
{
    hard_direction(random, wo);
    hard_direction(random, wi);
    const double z = random_log_between(random, i % 2 ? 1e-30 : 1e-9, 1e-3);
    switch (i % 5) {
    case 0:
        wi[0] = -wo[0];
        wi[1] = -wo[1];
        wi[2] = wo[2];
        break;
    case 1:
        memcpy(wi, wo, 3 * sizeof(*wo));
        break;
    case 2:
        wo[0] = (float)sqrt(1.0 - z * z);
        wo[1] = 0.0F;
        wo[2] = (float)z;
        wi[0] = -wo[0];
        wi[1] = i % 2 ? wo[2] : 0.0F;
        wi[2] = wo[2] * 0.5F;
        break;
    default:
        break;
    }
}

static void whole_lobe_keeps_its_digits(void **state)
{
    (void)state;
    worst_error value[2] = { 0 }, chance[2] = { 0 };
    uint64_t random = 4;
    for (int kind = 0; kind < 2; kind++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.distribution = kind ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
        glint_material *m = create(&o);
        for (int i = 0; i < MANY / 2; i++) {
            ndf n = random_ndf(&random, i);
            n.kind = kind ? NDF_BECKMANN : NDF_GGX;
            if (i & 8)
                n.alpha_y = n.alpha_x;
            const wide_lobe l = lobe_of(&n);
            float wo[3], wi[3];
            hard_pair(&random, i, wo, wi);
            const wide_geometry g = wide_geometry_of(wo, wi);
            if (!(wo[2] > 1e-30F) || !(wi[2] > 1e-30F))
                continue;
            glint_surface s = glint_material_surface(m);
            s.alpha_x = n.alpha_x;
            s.alpha_y = n.alpha_y;
            const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
            const glint_light light = { GLINT_LIGHT_CAP, (float)random_log_between(&random, 1e-30, 6.0) };
            glint_value v;
            glint_eval_value(m, &s, &f, wo, wi, &light, &v);
            const wide slope2 = wide_slope2(&l, g.h) / (g.h[2] * g.h[2]);
            const wide exact = wide_reflected(&l, &g);
            if ((kind && slope2 > 80.0L) || exact < 1e-30L)
                continue;
            /* D's own, and the five of each component of h, on which D depends twice: ten times twice for GGX; for
             * Beckmann twenty for z^4 and ten times the exponent. The masking's 28 and three products. */
            const wide roundings = kind ? 11.0L + 20.0L + 15.0L * slope2 : 13.0L + 20.0L;
            worst_add(&value[kind], relative_error((double)v.smooth[0], exact), (roundings + 31.0L) * FLOAT_ROUNDING,
                      (double)wo[2], (double)wi[2], (double)n.alpha_x);
            if (n.alpha_x != n.alpha_y)
                continue;
            const wide p = wide_density(&l, g.h) * (wide)light.solid_angle_sr / (4.0L * g.h_dot_wi) /
                           wide_total_area(!kind, (wide)n.alpha_x);
            /* D, D_H, h.wi with three, and three more. */
            if (p > 1e-36L)
                worst_add(&chance[kind], relative_error((double)v.lit_probability, fminl(p, 1.0L)),
                          (roundings + 8.0L + 6.0L) * FLOAT_ROUNDING, (double)wo[2], (double)wi[2], (double)n.alpha_x);
        }
        glint_material_destroy(m);
    }
    int ok = 1;
    for (int kind = 0; kind < 2; kind++) {
        ok &= worst_holds(&value[kind], kind ? "Beckmann, f cos_i" : "GGX, f cos_i", ROUNDING);
        ok &= worst_holds(&chance[kind], kind ? "Beckmann, p" : "GGX, p", ROUNDING);
    }
    assert_true(ok);
}

/* Seen head-on the slope over the roughness is sqrt(u / (1 - u)), from the pole to the farthest facet that a float
 * uniform can say. */
static void sampled_slopes_keep_their_digits(void **state)
{
    (void)state;
    worst_error ggx = { 0 };
    const vec3 up = { 0.0F, 0.0F, 1.0F };
    uint64_t random = 5;
    for (int i = 0; i < MANY; i++) {
        const float u = i & 1 ? (float)random_log_between(&random, 1e-30, 1.0) * 0.9999999F
                              : 1.0F - (float)random_log_between(&random, 6e-8, 0.5);
        const ndf n = { NDF_GGX, 0.125F, 0.125F };
        const vec3 h = ndf_sample_visible(&n, up, 0.0F, u);
        const wide slope = hypotl((wide)h.x, (wide)h.y) / (wide)h.z / 0.125L;
        /* Seven of the height and the radius, two of the turn by sincos_pi (relative, for a turn of 0), six of the
         * normal's length, twice. */
        worst_add(&ggx, relative_error((double)slope, sqrtl((wide)u / (1.0L - (wide)u))), 14.0L * FLOAT_ROUNDING,
                  (double)u, 0, 0);
    }
    assert_true(worst_holds(&ggx, "GGX, sampled slope", ROUNDING));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(density_keeps_its_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(masking_keeps_its_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(total_area_keeps_its_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(fresnel_keeps_its_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(sampled_slopes_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(whole_lobe_keeps_its_digits, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
