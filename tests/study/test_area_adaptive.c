/* The truth of the study of lights: adaptive cubature against closed forms, against brute force, and against itself,
 * within the error that it says. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "study/area_adaptive.h"
#include "study/area_cases.h"

#define PI AREA_PI
#define TOLERANCE 1e-10

static void assert_near(const char *what, double measured, double expected, double relative)
{
    if (!(fabs(measured - expected) <= relative * fabs(expected)))
        fail_msg("%s: %.15g, expected %.15g: %.2e off, %.2e allowed", what, measured, expected,
                 fabs(measured / expected - 1.0), relative);
}

/* Seen from straight above, a cap around the normal is lit by facets up to half its radius: their projected area is the
 * share of slopes below the tangent of that. */
static void caps_overhead_light_their_share_of_facets(void **state)
{
    (void)state;
    static const float wo[3] = { 0.0F, 0.0F, 1.0F };
    for (int k = 0; k < 2; k++)
        for (double alpha = 0.01; alpha < 1.1; alpha *= 3.0)
            for (double size = 1e-4; size < 7.0; size *= 4.0) {
                const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                               .solid_angle_sr = (float)size,
                                               .center = { 0.0F, 0.0F, 1.0F } };
                const double versine = fmin((double)sun.solid_angle_sr / (2.0 * PI), 1.0);
                const double slope = tan(0.5 * acos(1.0 - versine)) / alpha, square = slope * slope;
                const double share = k ? -expm1(-square) : square / (1.0 + square);
                double error;
                const area_truth t =
                    area_adaptive_of(&(area_truth_lobe){ k, alpha, alpha }, wo, &sun, TOLERANCE, &error);
                /* acos(1 - versine) loses 1e-16 over the versine, 2e-5 at least. */
                assert_near("facets of a cap", t.projected, share, 1e-11 + TOLERANCE);
                assert_near("solid angle of a cap", t.solid_angle, 2.0 * PI * versine, 1e-11 + TOLERANCE);
                assert_true(error <= TOLERANCE);
            }
}

/* Of a polygon above the horizon. Lambert's sum; the solid angle by Van Oosterom and Strackee. */
static void polygons_have_their_form_factor(void **state)
{
    (void)state;
    uint64_t random = 81;
    int count = 0;
    while (count < 60) {
        area_case c = area_case_of(&random, 0);
        c.light.kind = GLINT_AREA_POLYGON;
        const int n = (int)c.light.corner_count;
        double w[8][3], lambert = 0.0, angle = 0.0, least = 1.0;
        for (int i = 0; i < n; i++) {
            double length = 0.0;
            for (int a = 0; a < 3; a++)
                length += (double)c.light.corners[i][a] * (double)c.light.corners[i][a];
            for (int a = 0; a < 3; a++)
                w[i][a] = (double)c.light.corners[i][a] / sqrt(length);
            least = fmin(least, w[i][2]);
        }
        if (!(least > 0.0))
            continue;
        count++;
        for (int i = 0; i < n; i++) {
            const double *const a = w[i], *const b = w[(i + 1) % n], *const o = w[0];
            const double cross[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
            const double length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
            const double ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2], oa = o[0] * a[0] + o[1] * a[1] + o[2] * a[2],
                         ob = o[0] * b[0] + o[1] * b[1] + o[2] * b[2];
            lambert += 0.5 * atan2(length, ab) * cross[2] / length;
            angle += 2.0 * atan2(o[0] * cross[0] + o[1] * cross[1] + o[2] * cross[2], 1.0 + ab + oa + ob);
        }
        double error;
        const area_truth t = area_adaptive_of(&c.lobe, c.wo, &c.light, TOLERANCE, &error);
        /* Sums of a x b lose 1e-16 over the polygon's angle, squared in the area. */
        assert_near("form factor", t.cosine, fabs(lambert), 1e-9);
        assert_near("solid angle", t.solid_angle, fabs(angle), 1e-9);
    }
}

/* Lets a light down until the horizon cuts it, unless it would touch the point. */
static int lower(area_case *c)
{
    const float height = c->light.center[2], left = 0.1F * height;
    const float across = c->light.center[0] * c->light.center[0] + c->light.center[1] * c->light.center[1];
    if (c->light.kind == GLINT_AREA_SPHERE && !(across > 1.1F * c->light.radius * c->light.radius))
        return 0;
    c->light.center[2] = left;
    for (int k = 0; k < 8; k++)
        c->light.corners[k][2] += left - height;
    return 1;
}

enum { SIDES = 3, COARSE = 100, FINE = 400 };

typedef struct witness {
    double off[500], worst; /* of the integrals that brute force knows; worst: of what it may be off */
    int count, asked, refused;
} witness;

/* One of the integrals, at 100, 200 and 400 points a side. Midpoints leave a sixteenth with sixteen times as many
 * points; a horizon cuts some FINE cells by chance, and leaves 1 / FINE / sqrt(FINE) of the light. What they do not
 * know to a percent is no witness. A lobe that lies between the points may look known and is not: that is rare. */
static void ask(const double by_force[SIDES], double truth, witness *w)
{
    const double fine = by_force[SIDES - 1], moved = fmax(fabs(by_force[0] - fine), fabs(by_force[1] - fine));
    const double most = moved + truth / FINE / sqrt(FINE), off = fabs(fine - truth);
    w->asked++;
    if (moved > 0.01 * truth)
        return;
    w->off[w->count++] = off / truth;
    w->refused += off > most;
    w->worst = fmax(w->worst, off / most);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* All shapes, also astride the horizon and around the mirrored view. */
static void brute_force_comes_to_the_same(void **state)
{
    (void)state;
    enum { LIGHTS = 140 };
    static witness w;
    uint64_t random = 82;
    int count[5] = { 0 }, lowered = 0;
    for (int i = 0; i < LIGHTS; i++) {
        area_case c = area_case_of(&random, i % 4 == 0);
        double specular[SIDES], facets[SIDES], cosine[SIDES], error;
        lowered += i % 3 == 0 && lower(&c);
        const area_truth t = area_adaptive_of(&c.lobe, c.wo, &c.light, 1e-9, &error);
        if (!area_is_lit(&t))
            continue;
        if (!(error <= 1e-9))
            fail_msg("light %d: known to %.1e only", i, error);
        count[c.light.kind]++;
        for (int k = 0; k < SIDES; k++) {
            const area_truth by_force = area_truth_of(&c.lobe, c.wo, &c.light, COARSE << k);
            specular[k] = by_force.specular;
            facets[k] = by_force.facets;
            cosine[k] = by_force.cosine;
        }
        ask(specular, t.specular, &w);
        ask(facets, t.facets, &w);
        ask(cosine, t.cosine, &w);
    }
    qsort(w.off, (size_t)w.count, sizeof *w.off, compare_doubles);
    printf("%d of %d integrals: %.1e off in the median, at worst %.2f of what brute force may be, more in %d; %d suns, "
           "%d spheres, %d rectangles, %d disks, %d polygons, %d lowered\n",
           w.count, w.asked, w.off[w.count / 2], w.worst, w.refused, count[0], count[1], count[2], count[3], count[4],
           lowered);
    for (int k = 0; k < 5; k++)
        assert_true(count[k] > 10);
    assert_true(w.count > 0.9 * w.asked && w.refused <= 0.01 * w.count);
    /* Most lie clear of the horizon. */
    assert_true(w.off[w.count / 2] < 1.0 / FINE / FINE);
}

static void the_error_that_is_said_is_kept(void **state)
{
    (void)state;
    uint64_t random = 83;
    double worst = 0.0;
    int lights = 0;
    for (int i = 0; i < 300; i++) {
        const area_case c = area_case_of(&random, i % 2);
        double none, error;
        const area_truth truth = area_adaptive_of(&c.lobe, c.wo, &c.light, 1e-11, &none);
        if (!area_is_lit(&truth))
            continue;
        for (double tolerance = 1e-2; tolerance > 1e-8; tolerance *= 0.01) {
            const area_truth t = area_adaptive_of(&c.lobe, c.wo, &c.light, tolerance, &error);
            const double off = fmax(fabs(t.specular / truth.specular - 1.0), fabs(t.facets / truth.facets - 1.0));
            assert_true(error <= tolerance);
            worst = fmax(worst, off / (error + none));
            if (!(off <= error + none))
                fail_msg("light %d: said to be within %.2e, is %.2e off", i, error, off);
        }
        lights++;
    }
    printf("%d lights: off by at most %.2g of the error that is said\n", lights, worst);
    assert_true(lights > 200);
}

static void parts_add_up_across_the_horizon(void **state)
{
    (void)state;
    const area_truth_lobe lobe = { 1, 0.05, 0.3 };
    const float wo[3] = { 0.6F, 0.0F, 0.8F };
    glint_area_light l = { .kind = GLINT_AREA_RECTANGLE,
                           .two_sided = 1U,
                           .center = { -0.75F, 0.25F, 0.5F },
                           .half_x = { 0.25F, 0.5F, 0.0F },
                           .half_y = { 0.0F, 0.25F, 1.0F } };
    double error, specular = 0.0, facets = 0.0;
    const area_truth whole = area_adaptive_of(&lobe, wo, &l, TOLERANCE, &error);
    for (int k = 0; k < 4; k++) {
        glint_area_light part = l;
        for (int a = 0; a < 3; a++) {
            part.center[a] += (k & 1 ? 0.5F : -0.5F) * l.half_x[a] + (k & 2 ? 0.5F : -0.5F) * l.half_y[a];
            part.half_x[a] *= 0.5F;
            part.half_y[a] *= 0.5F;
        }
        const area_truth t = area_adaptive_of(&lobe, wo, &part, TOLERANCE, &error);
        specular += t.specular;
        facets += t.facets;
    }
    assert_near("light of four parts", specular, whole.specular, 5.0 * TOLERANCE);
    assert_near("facets of four parts", facets, whole.facets, 5.0 * TOLERANCE);
}

/* Beckmann: 1 + a sqrt(pi) / 2 exp(1 / a^2) erfc(1 / a). GGX: the integral of 2 sqrt(a^2 + (1 - a^2) y^2) over [0, 1].
 */
static void all_facets_have_their_area(void **state)
{
    (void)state;
    for (double alpha = 0.2; alpha < 1.0; alpha += 0.1) {
        const double rest = 1.0 - alpha * alpha;
        const double ggx = 1.0 + alpha * alpha / sqrt(rest) * asinh(sqrt(rest) / alpha);
        const double beckmann = 1.0 + 0.5 * alpha * sqrt(PI) * exp(1.0 / (alpha * alpha)) * erfc(1.0 / alpha);
        assert_near("D_H of GGX", area_adaptive_total(&(area_truth_lobe){ 0, alpha, alpha }), ggx, 1e-10);
        assert_near("D_H of Beckmann", area_adaptive_total(&(area_truth_lobe){ 1, alpha, alpha }), beckmann, 1e-10);
    }
}

/* Below the horizon, and in a plane through the point. */
static void what_is_not_seen_is_dark(void **state)
{
    (void)state;
    static const float wo[3] = { 0.0F, 0.0F, 1.0F };
    static const glint_area_light hidden[] = {
        { .kind = GLINT_AREA_SUN, .solid_angle_sr = 0.01F, .center = { 0.5F, 0.0F, -0.5F } },
        { .kind = GLINT_AREA_SPHERE, .radius = 0.05F, .center = { 0.5F, 0.0F, -0.5F } },
        { .kind = GLINT_AREA_RECTANGLE, .center = { 0.5F, 0.0F, -0.5F }, .half_x = { 0.1F }, .half_y = { 0.0F, 0.1F } },
        { .kind = GLINT_AREA_RECTANGLE,
          .center = { 0.5F, 0.0F, 0.5F },
          .half_x = { 0.1F, 0.0F, 0.1F },
          .half_y = { 0.0F, 0.1F } },
        { .kind = GLINT_AREA_DISK, .center = { 0.5F, 0.0F, -0.5F }, .half_x = { 0.1F }, .half_y = { 0.0F, 0.1F } },
        { .kind = GLINT_AREA_DISK,
          .center = { 0.5F, 0.0F, 0.5F },
          .half_x = { 0.1F, 0.0F, 0.1F },
          .half_y = { 0.0F, 0.1F } },
        { .kind = GLINT_AREA_POLYGON,
          .corner_count = 3U,
          .corners = { { 0.5F, 0.0F, -0.5F }, { 0.6F, 0.1F, -0.5F }, { 0.6F, -0.1F, -0.4F } } },
        { .kind = GLINT_AREA_POLYGON,
          .corner_count = 3U,
          .corners = { { 0.5F, 0.0F, 0.5F }, { 1.0F, 0.1F, 1.0F }, { 0.5F, 0.1F, 0.5F } } },
    };
    for (size_t i = 0; i < sizeof hidden / sizeof hidden[0]; i++) {
        double error = 1.0;
        const area_truth t = area_adaptive_of(&(area_truth_lobe){ 0, 0.3, 0.3 }, wo, &hidden[i], TOLERANCE, &error);
        if (t.specular != 0.0 || t.solid_angle != 0.0 || error != 0.0)
            fail_msg("light %zu: %g in %g sr, known to %g", i, t.specular, t.solid_angle, error);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(caps_overhead_light_their_share_of_facets),
        cmocka_unit_test(polygons_have_their_form_factor),
        cmocka_unit_test(brute_force_comes_to_the_same),
        cmocka_unit_test(the_error_that_is_said_is_kept),
        cmocka_unit_test(parts_add_up_across_the_horizon),
        cmocka_unit_test(all_facets_have_their_area),
        cmocka_unit_test(what_is_not_seen_is_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
