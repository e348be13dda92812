/* Pictures under an environment: furnaces, irradiance in closed form, and what facets make of skies, windows and suns.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "maps.h"
#include "pictures.h"
#include "scenes.h"
#include "statistics.h"

#define PI 3.14159265358979323846

static preview_options options_under(const preview_environment *e, const scene_camera *c)
{
    preview_options o = pictures_options(c);
    o.sky = NULL;
    o.environment = e;
    return o;
}

static scene floor_of(scene_material m)
{
    scene s = scenes_empty();
    m.glint.uv_scale = 10.0F;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 5.0F), NULL, 0);
    return s;
}

/* Mean and standard error over the pixels, whose samples are independent. */
static moments pixels_of(const image *i, const char *channel)
{
    moments m = { 0 };
    for (int y = 0; y < i->height; ++y)
        for (int x = 0; x < i->width; ++x)
            moments_add(&m, pictures_at(i, channel, x, y));
    return m;
}

static void assert_mean(const image *i, const char *channel, double expected)
{
    const moments m = pixels_of(i, channel);
    const double sigma = moments_standard_error(&m);
    assert_true(sigma < 0.01 * expected);
    if (!(fabs(m.mean - expected) <= 5.0 * sigma + 1e-5 * expected))
        fail_msg("%s is %.6g, expected %.6g: %.1f standard errors of %.2g", channel, m.mean, expected,
                 (m.mean - expected) / sigma, sigma);
}

static void a_matte_floor_reflects_its_albedo_of_an_even_environment(void **state)
{
    (void)state;
    environment_map m = maps_even(64, 2.0F);
    preview_environment e = maps_environment(&m);
    e.scale = 0.5F;
    scene s = floor_of(scenes_matte(0.3F));
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = options_under(&e, &c);
    o.width = o.height = 64;
    image i = pictures_render(&s, &o);
    assert_mean(&i, "R", 0.3);
    image_free(&i);
    scene_free(&s);
    environment_map_free(&m);
}

/* L = max(y, 0): E = 2 pi / 3. The texels' own radiance is taken at their middles: (pi / 256)^2 / 8 off. */
static void a_sky_that_fades_to_the_horizon_gives_its_irradiance(void **state)
{
    (void)state;
    environment_map m = maps_even(512, 0.0F);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 512; ++x)
            maps_set(&m, x, y, (float)cos(PI * (y + 0.5) / 256.0));
    const preview_environment e = maps_environment(&m);
    scene s = floor_of(scenes_matte(0.6F));
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = options_under(&e, &c);
    o.width = o.height = 64;
    image i = pictures_render(&s, &o);
    assert_mean(&i, "G", 0.6 / PI * 2.0 * PI / 3.0);
    image_free(&i);
    scene_free(&s);
    environment_map_free(&m);
}

/* Half the sky is hidden by a wall that stands on the floor and goes very high: beside it half the light is left. */
static void what_stands_in_the_way_hides_its_part_of_the_sky(void **state)
{
    (void)state;
    environment_map m = maps_even(64, 1.0F);
    const preview_environment e = maps_environment(&m);
    scene s = floor_of(scenes_matte(0.5F));
    scene_material black = scenes_matte(0.0F);
    black.double_sided = true;
    const float wall[18] = { 0, 0, -1e4F, 0, 0, 1e4F, 0, 1e4F, 1e4F, 0, 0, -1e4F, 0, 1e4F, 1e4F, 0, 1e4F, -1e4F };
    scenes_add_instance(&s, scenes_add_triangles(&s, scenes_add_material(&s, &black), wall, 2), NULL, 1);
    scene_camera c = pictures_from_above(1e-3F);
    c.to_world[12] = 0.5F;
    preview_options o = options_under(&e, &c);
    o.width = o.height = 64;
    image i = pictures_render(&s, &o);
    assert_mean(&i, "R", 0.25);
    image_free(&i);
    scene_free(&s);
    environment_map_free(&m);
}

/* ---- suns and facets ---- */

/* Where the flakes reflect the light to a camera above. */
static const double TOWARDS[3] = { 0.3, 1.0, 0.1 };

static scene flaky_floor(float facets_per_m2)
{
    return floor_of(scenes_flakes(0.5F, facets_per_m2));
}

/* A small disc in a black map against a directional light of its size: the same mean, and the same glints. */
static void a_tiny_bright_disc_glints_as_a_sun_of_its_size(void **state)
{
    (void)state;
    environment_map m = maps_even(1024, 0.0F);
    const vec3 towards = v3(TOWARDS[0], TOWARDS[1], TOWARDS[2]);
    const double covered = maps_add_disc(&m, towards, 0.03, 1000.0F);
    const preview_environment e = maps_environment(&m);
    const scene_camera c = pictures_from_above(1.0F);
    scene s = flaky_floor(3e4F);
    preview_options o = options_under(&e, &c);
    o.width = o.height = 64;
    o.spp = 1;
    double variance[2], mean[2];
    pictures_block_statistics(&s, &o, 24, &variance[0], &mean[0]);

    const float from[3] = { (float)TOWARDS[0], (float)TOWARDS[1], (float)TOWARDS[2] };
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, (float)(1000.0 * covered))->angular_diameter_rad = 0.06F;
    o.environment = NULL;
    o.sky = &pictures_black;
    pictures_block_statistics(&s, &o, 24, &variance[1], &mean[1]);
    /* The discs differ by their rims, half a texel over 5 across: 2 percent in solid angle, and so in variance, besides
     * what 64 blocks and 24 seeds leave: sqrt(2 / (64 * 23)) = 3.7 percent each, twice as much for a heavy tail. */
    if (!(fabs(variance[0] / variance[1] - 1.0) < 5.0 * 0.074 + 0.02))
        fail_msg("the disc's variance is %.3g, the sun's %.3g", variance[0], variance[1]);
    if (!(fabs(mean[0] - mean[1]) < 5.0 * sqrt((variance[0] + variance[1]) / (64.0 * 24.0))))
        fail_msg("the disc's mean is %.6g, the sun's %.6g", mean[0], mean[1]);
    scene_free(&s);
    environment_map_free(&m);
}

/* Four windows, too large for suns, of which a sample looks into one: each flashes as if it had been summed. */
static void windows_glint_as_lights_that_are_summed(void **state)
{
    (void)state;
    environment_map m = maps_even(256, 0.0F);
    scene s = flaky_floor(2e3F);
    scene lit = flaky_floor(2e3F);
    for (int k = 0; k < 4; ++k) {
        /* 16 x 16 texels that a split can isolate, 22.5 degrees each way, 40 degrees above the horizon and more. */
        const int x0 = 64 * k + 16, y0 = 16;
        double sr = 0.0, d[3];
        for (int y = y0; y < y0 + 16; ++y)
            for (int x = x0; x < x0 + 16; ++x) {
                maps_set(&m, x, y, 10.0F);
                sr += maps_texel_sr(&m, y);
            }
        environment_map_direction((x0 + 8.0) / 256.0, (y0 + 8.0) / 128.0, d);
        const float from[3] = { (float)d[0], (float)d[1], (float)d[2] };
        scenes_add_light(&lit, SCENE_LIGHT_DIRECTIONAL, from, (float)(10.0 * sr))->angular_diameter_rad =
            (float)(4.0 * asin(sqrt(sr / (4.0 * PI))));
    }
    const preview_environment e = maps_environment(&m);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = options_under(&e, &c);
    o.width = o.height = 32;
    o.spp = 16;
    double variance[2], mean[2];
    pictures_block_statistics(&s, &o, 12, &variance[0], &mean[0]);
    o.environment = NULL;
    o.sky = &pictures_black;
    pictures_block_statistics(&lit, &o, 12, &variance[1], &mean[1]);
    /* A sample that looks into one window of four counts the facets of four footprints, whose places in the pixel are
     * random: a facet is counted once in the mean, and its square 1 (if they never overlap) to 2 times (if they were
     * independent). With their own footprints the samples would give four times the variance, less what the surface's
     * own samples add. 3.7 percent of chance for 64 blocks and 12 seeds, twice for a heavy tail, each. */
    const double noise = 5.0 * 0.11;
    if (!(variance[0] / variance[1] > 1.0 - noise && variance[0] / variance[1] < 2.0 * (1.0 + noise / 5.0)))
        fail_msg("variance %.4g sampled, %.4g summed", variance[0], variance[1]);
    /* Means of 64 blocks and 12 seeds each, of other facets. */
    const double sigma = sqrt((variance[0] + variance[1]) / (64.0 * 12.0));
    if (!(fabs(mean[0] - mean[1]) < 4.0 * sigma))
        fail_msg("mean %.5g sampled, %.5g summed, sigma %.2g", mean[0], mean[1], sigma);
    scene_free(&s);
    scene_free(&lit);
    environment_map_free(&m);
}

/* ---- skies and facets ---- */

/* Every facet reflects an even environment alike: no glints. */
static void an_even_environment_does_not_sparkle(void **state)
{
    (void)state;
    environment_map m = maps_even(64, 1.0F);
    const preview_environment e = maps_environment(&m);
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = options_under(&e, &c);
    image i = pictures_render(&s, &o);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            assert_true(pictures_at(&i, "R", x, y) > 0.0);
            pictures_assert_relative(pictures_at(&i, "R", x, y), pictures_at(&i, "smooth.R", x, y), 1e-6);
        }
    image_free(&i);
    scene_free(&s);
    environment_map_free(&m);
}

/* A map with a sky, a window and a sun: with the same samples, the mean over seeds is the smooth picture. */
static void the_mean_over_seeds_is_the_smooth_picture(void **state)
{
    (void)state;
    enum { SEEDS = 48 };
    environment_map m = maps_even(256, 0.2F);
    for (int y = 20; y < 40; ++y)
        for (int x = 100; x < 130; ++x)
            maps_set(&m, x, y, 6.0F);
    maps_add_disc(&m, v3(TOWARDS[0], TOWARDS[1], TOWARDS[2]), 0.03, 300.0F);
    const preview_environment e = maps_environment(&m);
    const scene_camera c = pictures_from_above(1.0F);
    scene s = flaky_floor(2e5F);
    preview_options o = options_under(&e, &c);
    o.width = o.height = 32;
    moments means = { 0 };
    double smooth = 0.0;
    for (uint32_t seed = 0; seed < SEEDS; ++seed) {
        s.materials[0].glint.seed = seed;
        image i = pictures_render(&s, &o);
        moments_add(&means, pictures_mean(&i, "R"));
        smooth = pictures_mean(&i, "smooth.R");
        image_free(&i);
    }
    const double sigma = moments_standard_error(&means);
    assert_true(sigma < 0.006 * smooth);
    if (!(fabs(means.mean - smooth) <= 5.0 * sigma + 2e-4 * smooth)) /* 2e-4: the binomial law, see test_glints.c */
        fail_msg("mean %.6g, smooth %.6g: %.1f standard errors", means.mean, smooth, (means.mean - smooth) / sigma);
    scene_free(&s);
    environment_map_free(&m);
}

/* ---- seen ---- */

static void a_camera_sees_the_map_and_alpha_says_whether(void **state)
{
    (void)state;
    environment_map m = maps_even(64, 0.25F);
    maps_set(&m, 0, 0, 1.0F);
    const preview_environment e = maps_environment(&m);
    scene s = scenes_empty();
    const float eye[3] = { 0, 0, 0 }, target[3] = { 1.0F, 0.0F, 0.0F };
    const scene_camera c = scenes_camera(SCENE_PERSPECTIVE, eye, target, 0.3F);
    preview_options o = options_under(&e, &c);
    image i = pictures_render(&s, &o);
    pictures_assert_relative(pictures_at(&i, "R", 3, 4), 0.25, 1e-6);
    assert_true(pictures_mean(&i, "A") == 1.0);
    image_free(&i);
    o.transparent = true;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "R") == 0.0 && pictures_mean(&i, "A") == 0.0);
    image_free(&i);
    scene_free(&s);
    environment_map_free(&m);
}

static void threads_and_tiles_do_not_change_a_bit(void **state)
{
    (void)state;
    environment_map m = maps_even(256, 0.2F);
    maps_add_disc(&m, v3(0.3, 1.0, 0.4), 0.3, 6.0F);
    maps_add_disc(&m, v3(-0.3, 1.0, 0.1), 0.02, 900.0F);
    const preview_environment e = maps_environment(&m);
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = options_under(&e, &c);
    o.width = 40;
    o.height = 33;
    o.bounces = 2;
    image one = pictures_render(&s, &o);
    o.threads = 3;
    image three = pictures_render(&s, &o);
    const size_t pixel = (size_t)one.channel_count * sizeof(float);
    assert_memory_equal(one.pixels, three.pixels, pixel * 40 * 33);
    o.tile_x = 7;
    o.tile_y = 5;
    o.tile_width = 20;
    o.tile_height = 1;
    image part = pictures_render(&s, &o);
    assert_memory_equal(part.pixels, &one.pixels[(5 * 40 + 7) * (size_t)one.channel_count], 20 * pixel);
    image_free(&one);
    image_free(&three);
    image_free(&part);
    scene_free(&s);
    environment_map_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matte_floor_reflects_its_albedo_of_an_even_environment),
        cmocka_unit_test(a_sky_that_fades_to_the_horizon_gives_its_irradiance),
        cmocka_unit_test(what_stands_in_the_way_hides_its_part_of_the_sky),
        cmocka_unit_test(a_tiny_bright_disc_glints_as_a_sun_of_its_size),
        cmocka_unit_test(windows_glint_as_lights_that_are_summed),
        cmocka_unit_test(an_even_environment_does_not_sparkle),
        cmocka_unit_test(the_mean_over_seeds_is_the_smooth_picture),
        cmocka_unit_test(a_camera_sees_the_map_and_alpha_says_whether),
        cmocka_unit_test(threads_and_tiles_do_not_change_a_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
