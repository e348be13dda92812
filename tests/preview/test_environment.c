/* The environment as a distribution: where a texel lies in the world, and with which density directions are drawn. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "maps.h"
#include "preview/environment.h"
#include "statistics.h"

static environment make(const preview_environment *from)
{
    environment e;
    report r = { 0 };
    if (!environment_make(from, &e, &r))
        fail_msg("%s", r.error);
    return e;
}

static void assert_direction(vec3 found, double x, double y, double z, double bound)
{
    if (!(v3_length(v3_sub(found, v3(x, y, z))) <= bound))
        fail_msg("found (%g, %g, %g), expected (%g, %g, %g) within %g", found.x, found.y, found.z, x, y, z, bound);
}

/* The middle of the map is +x, to its right lies +z, the top is +y: u = 3/4 is +z, u = 1/4 is -z. */
static void the_middle_of_the_map_is_x_and_z_lies_to_its_right(void **state)
{
    (void)state;
    static const double places[6][5] = { { 0.5, 0.5, 1, 0, 0 },  { 0.75, 0.5, 0, 0, 1 }, { 0.25, 0.5, 0, 0, -1 },
                                         { 0.0, 0.5, -1, 0, 0 }, { 0.3, 0.0, 0, 1, 0 },  { 0.6, 1.0, 0, -1, 0 } };
    for (int i = 0; i < 6; ++i) {
        double d[3], u, v;
        environment_map_direction(places[i][0], places[i][1], d);
        assert_direction(v3(d[0], d[1], d[2]), places[i][2], places[i][3], places[i][4], 1e-15);
        environment_map_place(d, &u, &v);
        assert_true(fabs(v - places[i][1]) < 1e-15);
        if (i < 3)
            assert_true(fabs(u - places[i][0]) < 1e-15);
    }
}

/* One bright texel, looked at from the world: a quarter turn about +y, counter-clockwise from above, brings +x to -z.
 */
static void a_rotation_turns_the_map_counter_clockwise_seen_from_above(void **state)
{
    (void)state;
    environment_map m = maps_even(64, 0.0F);
    maps_set(&m, 32, 16, 5.0F); /* around +x */
    preview_environment from = maps_environment(&m);
    environment straight = make(&from);
    from.rotation[1] = from.rotation[3] = 0.70710678F;
    environment turned = make(&from);
    float rgb[3];
    double middle[3];
    environment_map_direction(32.5 / 64.0, 16.5 / 32.0, middle);
    environment_seen(&straight, v3(middle[0], middle[1], middle[2]), rgb);
    assert_true(fabsf(rgb[0] - 5.0F) < 1e-4F);
    environment_seen(&turned, v3(middle[2], middle[1], -middle[0]), rgb);
    assert_true(fabsf(rgb[0] - 5.0F) < 1e-4F);
    environment_seen(&turned, v3(middle[0], middle[1], middle[2]), rgb);
    assert_true(rgb[0] == 0.0F);
    environment_free(&straight);
    environment_free(&turned);
    environment_map_free(&m);
}

/* A map with a bit of everything but suns, and a rotation about no axis in particular. */
static environment_map busy_map(void)
{
    environment_map m = maps_even(64, 0.0F);
    uint64_t random = 7;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            maps_set(&m, x, y, x < 20 ? 0.0F : (float)random_between(&random, 0.0, 1.0 + (y > 10 ? 8.0 : 0.0)));
    return m;
}

static preview_environment busy_environment(const environment_map *m)
{
    preview_environment from = maps_environment(m);
    const float turned[4] = { 0.2F, 0.4F, -0.4F, 0.8F };
    for (int i = 0; i < 4; ++i)
        from.rotation[i] = turned[i];
    return from;
}

enum { SAMPLES = 400000 };

/* Counts over the texels against share = pdf * solid angle; a texel of less than 5 expected joins the others like it.
 */
static void directions_are_drawn_with_the_density_that_is_said(void **state)
{
    (void)state;
    environment_map m = busy_map();
    const preview_environment from = busy_environment(&m);
    environment e = make(&from);
    static int counts[32][64];
    uint64_t random = 1;
    for (int i = 0; i < SAMPLES; ++i) {
        const double u[2] = { random_uniform(&random), random_uniform(&random) };
        environment_light l, back;
        assert_true(environment_sample(&e, u, &l));
        assert_true(fabs(v3_length(l.wi) - 1.0) < 1e-12);
        environment_from(&e, l.wi, &back);
        /* A direction on an edge may round into the next texel: one in 1e10. */
        assert_true(back.pdf == l.pdf && back.rgb[1] == l.rgb[1] && back.solid_angle_sr == l.solid_angle_sr);
        double place[2];
        maps_place(&from, l.wi, place);
        ++counts[(int)(place[1] * 32.0)][(int)(place[0] * 64.0)];
    }
    double chi = 0.0, freedom = -1.0, rest = 0.0, rest_count = 0.0, total = 0.0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            environment_light l;
            environment_from(&e, maps_direction(&from, (x + 0.5) / 64.0, (y + 0.5) / 32.0), &l);
            const double expected = SAMPLES * (double)l.pdf * maps_texel_sr(&m, y);
            total += expected;
            if (expected < 5.0) {
                rest += expected;
                rest_count += counts[y][x];
                continue;
            }
            chi += (counts[y][x] - expected) * (counts[y][x] - expected) / expected;
            freedom += 1.0;
        }
    if (rest > 5.0) {
        chi += (rest_count - rest) * (rest_count - rest) / rest;
        freedom += 1.0;
    }
    assert_true(fabs(total / SAMPLES - 1.0) < 1e-5); /* densities are floats: 6e-8 each */
    const double p = chi_square_tail(chi, freedom);
    if (!(p > 1e-4))
        fail_msg("chi^2 is %.1f with %.0f degrees of freedom: probability %.2g", chi, freedom, p);
    environment_free(&e);
    environment_map_free(&m);
}

/* Irradiance by its own samples: the mean of L cos / pdf is the integral, which the texels give in closed form. */
static void samples_estimate_the_irradiance(void **state)
{
    (void)state;
    environment_map m = busy_map();
    const preview_environment from = busy_environment(&m);
    environment e = make(&from);
    moments found = { 0 };
    uint64_t random = 3;
    for (int i = 0; i < SAMPLES; ++i) {
        const double u[2] = { random_uniform(&random), random_uniform(&random) };
        environment_light l;
        assert_true(environment_sample(&e, u, &l));
        moments_add(&found, (double)l.rgb[0] * fmax(l.wi.y, 0.0) / (double)l.pdf);
    }
    double expected = 0.0; /* 8 x 8 points a texel */
    for (int y = 0; y < 32 * 8; ++y)
        for (int x = 0; x < 64 * 8; ++x) {
            const vec3 d = maps_direction(&from, (x + 0.5) / 512.0, (y + 0.5) / 256.0);
            expected += (double)m.rgb[3 * ((y / 8) * 64 + x / 8)] * fmax(d.y, 0.0) *
                        sin(PREVIEW_PI * (y + 0.5) / 256.0) * (PREVIEW_PI / 256.0) * (2.0 * PREVIEW_PI / 512.0);
        }
    const double sigma = moments_standard_error(&found);
    if (!(fabs(found.mean - expected) < 5.0 * sigma + 2e-4 * expected)) /* the midpoint rule: (1/512)^2, edges of cos */
        fail_msg("irradiance %.6g, expected %.6g: %.1f standard errors", found.mean, expected,
                 (found.mean - expected) / sigma);
    environment_free(&e);
    environment_map_free(&m);
}

/* ---- suns ---- */

/* A disc of 1 degree radius at (35, 60) degrees on a grey sky: its place, size and light come out of the texels. */
static void a_small_bright_disc_becomes_a_sun_of_its_size(void **state)
{
    (void)state;
    environment_map m = maps_even(1024, 0.5F);
    const vec3 towards = v3_normalize(v3(0.3, 0.7, -0.5));
    const double radius = PREVIEW_PI / 180.0;
    const double covered = maps_add_disc(&m, towards, radius, 2000.0F);
    const preview_environment from = maps_environment(&m);
    environment e = make(&from);
    assert_int_equal(e.sun_count, 1);
    const light sun = light_make(&e.suns[0]);
    /* The centroid of some 26 texels across is good to a tenth of one. */
    assert_direction(sun.axis, towards.x, towards.y, towards.z, 0.1 * 2.0 * PREVIEW_PI / 1024.0);
    if (!(fabs((double)sun.solid_angle_sr - covered) < 1e-5 * covered))
        fail_msg("the sun has %.6g sr, its texels %.6g", (double)sun.solid_angle_sr, covered);
    /* A rim of some 20 texels of which each is in or out: .3 sqrt(20) of the 28 within, five times. */
    assert_true(fabs(covered - light_cap_sr(radius)) < 0.24 * covered);
    assert_true(fabs((double)sun.intensity[0] - 2000.0 * covered) < 1e-5 * 2000.0 * covered);

    environment_light there;
    environment_from(&e, towards, &there);
    assert_true(there.rgb[0] == 0.0F && there.pdf == 0.0F); /* else it would count twice */
    float rgb[3];
    environment_seen(&e, towards, rgb);
    assert_true(fabsf(rgb[0] - 2000.0F) < 1e-2F); /* but a camera sees it */
    environment_free(&e);
    environment_map_free(&m);
}

/* On the seam at the sides of the map one disc stays one sun; around the pole too. */
static void a_sun_on_a_seam_is_one(void **state)
{
    (void)state;
    const vec3 places[2] = { v3(-1.0, 0.0, 0.0), v3(0.0, 1.0, 0.0) };
    for (int i = 0; i < 2; ++i) {
        environment_map m = maps_even(512, 0.1F);
        const double covered = maps_add_disc(&m, places[i], 0.03, 900.0F);
        const preview_environment from = maps_environment(&m);
        environment e = make(&from);
        assert_int_equal(e.sun_count, 1);
        const light sun = light_make(&e.suns[0]);
        assert_direction(sun.axis, places[i].x, places[i].y, places[i].z, 0.002);
        assert_true(fabs((double)sun.solid_angle_sr - covered) < 1e-5 * covered);
        environment_free(&e);
        environment_map_free(&m);
    }
}

/* Of twelve equal lamps eight become lights of their own, and all light is still there. */
static void light_that_is_no_sun_stays_in_the_map(void **state)
{
    (void)state;
    environment_map m = maps_even(256, 0.01F);
    double lamps = 0.0;
    for (int i = 0; i < 12; ++i) {
        const double angle = 2.0 * PREVIEW_PI * i / 12.0;
        lamps += 300.0 * maps_add_disc(&m, v3(cos(angle), 0.0, sin(angle)), 0.04, 300.0F);
    }
    const preview_environment from = maps_environment(&m);
    environment e = make(&from);
    assert_int_equal(e.sun_count, ENVIRONMENT_MOST_SUNS);
    double suns = 0.0, rest = 0.0;
    for (int i = 0; i < e.sun_count; ++i)
        suns += (double)e.suns[i].color[1];
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            environment_light l;
            environment_from(&e, maps_direction(&from, (x + 0.5) / 256.0, (y + 0.5) / 128.0), &l);
            rest += (double)l.rgb[1] * maps_texel_sr(&m, y);
        }
    if (!(suns > 0.6 * lamps && suns < 0.72 * lamps))
        fail_msg("suns %g of %g", suns, lamps);
    const double all = maps_light(&m);
    assert_true(fabs(suns + rest - all) < 1e-5 * all);
    environment_free(&e);
    environment_map_free(&m);
}

/* ---- patches ---- */

static double patch_at(const environment *e, double x, double y, double z)
{
    environment_light l;
    environment_from(e, v3_normalize(v3(x, y, z)), &l);
    return (double)l.solid_angle_sr;
}

/* An even map is one light for all facets. A sky over a dark ground is two; a window is as large as it is, to the
 * power of two of the texels that hold it. */
static void patches_are_as_large_as_their_light_is_even(void **state)
{
    (void)state;
    environment_map m = maps_even(256, 1.0F);
    preview_environment from = maps_environment(&m);
    environment e = make(&from);
    assert_true(patch_at(&e, 0.3, -0.2, 0.5) == 0.0);
    environment_free(&e);

    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 256; ++x)
            maps_set(&m, x, y, 4.0F);
    e = make(&from);
    assert_true(fabs(patch_at(&e, 0.3, 0.2, 0.5) / (2.0 * PREVIEW_PI) - 1.0) < 1e-6);
    assert_true(fabs(patch_at(&e, 0.3, -0.2, 0.5) / (2.0 * PREVIEW_PI) - 1.0) < 1e-6);
    environment_free(&e);

    /* 32 x 32 texels at the equator, aligned: 45 degrees of longitude and of latitude, sin 45 high. */
    for (int y = 32; y < 64; ++y)
        for (int x = 128; x < 160; ++x)
            maps_set(&m, x, y, 60.0F);
    e = make(&from);
    double d[3];
    environment_map_direction(144.0 / 256.0, 48.0 / 128.0, d);
    assert_true(fabs(patch_at(&e, d[0], d[1], d[2]) / (0.25 * PREVIEW_PI * sin(0.25 * PREVIEW_PI)) - 1.0) < 1e-6);
    environment_free(&e);
    environment_map_free(&m);
}

static void a_black_map_gives_no_direction(void **state)
{
    (void)state;
    environment_map m = maps_even(32, 0.0F);
    const preview_environment from = maps_environment(&m);
    environment e = make(&from);
    const double u[2] = { 0.4, 0.7 };
    environment_light l;
    assert_false(environment_sample(&e, u, &l));
    assert_int_equal(e.sun_count, 0);
    environment_free(&e);
    environment_map_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_middle_of_the_map_is_x_and_z_lies_to_its_right),
        cmocka_unit_test(a_rotation_turns_the_map_counter_clockwise_seen_from_above),
        cmocka_unit_test(directions_are_drawn_with_the_density_that_is_said),
        cmocka_unit_test(samples_estimate_the_irradiance),
        cmocka_unit_test(a_small_bright_disc_becomes_a_sun_of_its_size),
        cmocka_unit_test(a_sun_on_a_seam_is_one),
        cmocka_unit_test(light_that_is_no_sun_stays_in_the_map),
        cmocka_unit_test(patches_are_as_large_as_their_light_is_even),
        cmocka_unit_test(a_black_map_gives_no_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
