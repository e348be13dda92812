/* Glints in pictures: their mean is the smooth picture, their number is density times area, their pattern is the
 * seed's. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "facet_truth.h"
#include "pictures.h"
#include "scenes.h"

/* A floor of flakes under a light of 0.4 rad, seen from above. */
static scene flaky_floor(float facets_per_m2)
{
    const float from[3] = { 0.3F, 1.0F, 0.1F };
    scene_material m = scenes_flakes(0.5F, facets_per_m2);
    m.glint.uv_scale = 10.0F; /* the square has 10 m and one unit of texture */
    scene s = scenes_empty();
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 5.0F), NULL, 0);
    scenes_add_light(&s, SCENE_LIGHT_DIRECTIONAL, from, 1.0F)->angular_diameter_rad = 0.4F;
    return s;
}

/* Of the binomial law. */
#define COUNTING_BIAS 2e-4

/* Renders the floor with many seeds and compares the mean over them with the smooth picture. */
static void compare_means(scene *s, const preview_options *o, int seeds)
{
    double sum = 0.0, squares = 0.0, smooth = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
        s->materials[0].glint.seed = (uint32_t)seed;
        image i = pictures_render(s, o);
        const double mean = pictures_mean(&i, "R");
        sum += mean / seeds;
        squares += mean * mean / seeds;
        smooth = pictures_mean(&i, "smooth.R");
        image_free(&i);
    }
    const double sigma = sqrt(fmax(squares - sum * sum, 0.0) / (seeds - 1));
    /* Five standard errors; a test that could not see 3 percent of noise would be none. */
    assert_true(sigma < 0.006 * smooth);
    if (!(fabs(sum - smooth) <= 5.0 * sigma + COUNTING_BIAS * smooth))
        fail_msg("mean %.6g, smooth %.6g: %.1f standard errors of %.2g", sum, smooth, (sum - smooth) / sigma, sigma);
}

static void the_mean_over_seeds_is_the_smooth_picture(void **state)
{
    (void)state;
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 48;
    o.spp = 1;
    compare_means(&s, &o, 48);
    s.materials[0].glint.space = SCENE_SPACE_OBJECT;
    compare_means(&s, &o, 48);
    s.materials[0].glint.layer = SCENE_LAYER_CLEARCOAT;
    s.materials[0].metallic = s.materials[0].specular = 0.0F; /* the base is black: all light comes from the coat */
    s.materials[0].base_color[0] = 0.0F;
    s.materials[0].clearcoat = 1.0F;
    s.materials[0].clearcoat_roughness = 0.5F;
    compare_means(&s, &o, 48);
    scene_free(&s);
}

/* The light is wide for the lobe, and both see its shape. */
static void explicit_facets_make_the_picture_that_mirrors_under_a_round_light_must_make(void **state)
{
    (void)state;
    scene s = flaky_floor(20000.0F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 24;
    o.spp = 4;
    o.model = GLINT_MODEL_EXPLICIT;
    compare_means(&s, &o, 16);
    scene_free(&s);
}

/* The pixel's own box filter, exactly, however many samples make it up: their footprints tile the pixel. */
static void explicit_facets_make_the_same_picture_with_any_number_of_samples(void **state)
{
    (void)state;
    scene s = flaky_floor(20000.0F);
    const float side[3] = { -8.0F, 6.0F, 3.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera cameras[2] = { pictures_from_above(1.0F),
                                      scenes_camera(SCENE_ORTHOGRAPHIC, side, target, 1.0F) };
    for (int k = 0; k < 4; ++k) {
        s.materials[0].glint.space = k % 2 == 0 ? SCENE_SPACE_UV : SCENE_SPACE_OBJECT;
        preview_options o = pictures_options(&cameras[k / 2]);
        o.width = o.height = 24;
        o.model = GLINT_MODEL_EXPLICIT;
        o.spp = 1;
        image one = pictures_render(&s, &o);
        static const int samples[] = { 4, 16, 32 };
        for (int n = 0; n < 3; ++n) {
            o.spp = samples[n];
            image many = pictures_render(&s, &o);
            const double mean = pictures_mean(&one, "smooth.R");
            int lit = 0;
            for (int i = 0; i < 24 * 24; ++i) {
                const double a = pictures_at(&one, "R", i % 24, i / 24), b = pictures_at(&many, "R", i % 24, i / 24);
                lit += a > 1.5 * mean;
                /* A hit is known to 2^-24 of some metres, which is 1e-5 of a pixel or of a facet, of which about 140
                 * are there. */
                if (!(fabs(a - b) <= 1e-3 * mean))
                    fail_msg("camera %d, pixel %d %d: %.6g with one sample, %.6g with %d", k / 2, i % 24, i / 24, a, b,
                             samples[n]);
            }
            assert_true(lit > 5);
            image_free(&many);
        }
        image_free(&one);
    }
    scene_free(&s);
}

static void too_many_explicit_facets_are_an_error(void **state)
{
    (void)state;
    scene s = flaky_floor(1e13F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 8;
    o.spp = 1;
    o.model = GLINT_MODEL_EXPLICIT;
    report r = { .error = "" };
    image i;
    assert_false(preview_render(&s, &o, &i, NULL, &r));
    assert_null(i.pixels);
    assert_non_null(strstr(r.error, "the explicit model visits every facet"));
    assert_non_null(strstr(r.error, "expected at most 1000000"));
    scene_free(&s);
}

static void discreteness_leaves_the_smooth_channels_alone(void **state)
{
    (void)state;
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    image a = pictures_render(&s, &o);
    s.materials[0].glint.seed = 99U;
    image b = pictures_render(&s, &o);
    o.model = GLINT_MODEL_SMOOTH;
    image plain = pictures_render(&s, &o);
    int different = 0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            different += pictures_at(&a, "R", x, y) != pictures_at(&b, "R", x, y);
            assert_true(pictures_at(&a, "smooth.R", x, y) == pictures_at(&b, "smooth.R", x, y));
            assert_true(pictures_at(&a, "smooth.R", x, y) == pictures_at(&plain, "smooth.R", x, y));
            assert_true(pictures_at(&plain, "smooth.R", x, y) == pictures_at(&plain, "R", x, y));
        }
    }
    assert_true(different > 50);
    image_free(&a);
    image_free(&b);
    image_free(&plain);
    scene_free(&s);
}

/* N of a pixel is density * area of surface under it, whatever the samples: (2 m / 16)^2 from above, and more by 1 /
 * cos from the side; the same in both spaces, and without the texture coordinates that the material asks for. */
static void the_number_of_facets_is_density_times_area(void **state)
{
    (void)state;
    const float side[3] = { -8.0F, 6.0F, 0.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera cameras[2] = { pictures_from_above(1.0F),
                                      scenes_camera(SCENE_ORTHOGRAPHIC, side, target, 1.0F) };
    const double cosines[2] = { 1.0, 0.6 };
    scene s = flaky_floor(3200.0F);
    for (int k = 0; k < 6; ++k) {
        s.materials[0].glint.space = k % 3 == 1 ? SCENE_SPACE_OBJECT : SCENE_SPACE_UV;
        s.materials[0].glint.texcoord = k % 3 == 2 ? 1 : 0; /* there is no second set */
        preview_options o = pictures_options(&cameras[k / 3]);
        o.spp = k % 2 == 0 ? 1 : 9;
        image i = pictures_render(&s, &o);
        for (int x = 0; x < 16; ++x)
            pictures_assert_relative(pictures_at(&i, "glints.N", x, x), 3200.0 / 64.0 / cosines[k / 3], 1e-4);
        image_free(&i);
    }
    scene_free(&s);
}

static int warnings;

static void count_warning(const char *text, void *user)
{
    (void)user;
    assert_non_null(strstr(text, "TEXCOORD_1"));
    ++warnings;
}

static void a_mesh_without_the_texture_coordinates_of_its_glints_is_warned_of(void **state)
{
    (void)state;
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    report r = { .warn = count_warning };
    image i;
    s.materials[0].glint.texcoord = 1;
    warnings = 0;
    assert_true(preview_render(&s, &o, &i, NULL, &r));
    assert_int_equal(warnings, 1);
    image_free(&i);
    scene_free(&s);
}

/* A pixel of few facets is mostly dark and now and then bright; of many, even. The standard deviation of N p Bernoulli
 * draws, relative to the mean, is sqrt((1 - p) / (N p)) and falls as 1 / sqrt(density). */
static double contrast(float facets_per_m2)
{
    scene s = flaky_floor(facets_per_m2);
    const scene_camera c = pictures_from_above(1.0F);
    preview_options o = pictures_options(&c);
    o.width = o.height = 64;
    o.spp = 1;
    image i = pictures_render(&s, &o);
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < 64 * 64; ++k) {
        const double value = pictures_at(&i, "R", k % 64, k / 64) / pictures_at(&i, "smooth.R", k % 64, k / 64);
        sum += value / 4096.0;
        squares += value * value / 4096.0;
    }
    image_free(&i);
    scene_free(&s);
    return sqrt(squares - sum * sum);
}

static void contrast_falls_as_the_root_of_the_density(void **state)
{
    (void)state;
    /* 1024 facets on average per pixel and more, so that counts are near normal; 4096 pixels, of which 12 or so share
     * their draws, know their standard deviation to about 4 percent each: five times sqrt(2) * 4 percent. */
    const double ratio = contrast(1024.0F * 1024.0F) / contrast(64.0F * 1024.0F * 1024.0F);
    if (!(fabs(ratio - 8.0) < 8.0 * 0.28))
        fail_msg("the contrast falls by %.3g, not by 8", ratio);
}

/* Texture coordinates that stand still, normals of length zero: no number of facets can be said, the smooth limit can.
 */
static void degenerate_meshes_give_the_smooth_picture(void **state)
{
    (void)state;
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    memset(s.meshes[0].texcoord[0], 0, 8 * sizeof(float));
    memset(s.meshes[0].normal, 0, 12 * sizeof(float));
    memset(s.meshes[0].tangent, 0, 16 * sizeof(float));
    image i = pictures_render(&s, &o);
    for (int k = 0; k < 256; ++k) {
        assert_true(pictures_at(&i, "smooth.G", k % 16, k / 16) > 0.0);
        assert_true(pictures_at(&i, "G", k % 16, k / 16) == pictures_at(&i, "smooth.G", k % 16, k / 16));
    }
    image_free(&i);
    scene_free(&s);
}

static void nodes_sparkle_apart(void **state)
{
    (void)state;
    scene s = flaky_floor(3200.0F);
    const scene_camera c = pictures_from_above(1.0F);
    const preview_options o = pictures_options(&c);
    image a = pictures_render(&s, &o);
    s.instances[0].node = 1;
    image b = pictures_render(&s, &o);
    int different = 0;
    for (int x = 0; x < 256; ++x)
        different += pictures_at(&a, "R", x % 16, x / 16) != pictures_at(&b, "R", x % 16, x / 16);
    assert_true(different > 50);
    image_free(&a);
    image_free(&b);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_over_seeds_is_the_smooth_picture),
        cmocka_unit_test(explicit_facets_make_the_picture_that_mirrors_under_a_round_light_must_make),
        cmocka_unit_test(explicit_facets_make_the_same_picture_with_any_number_of_samples),
        cmocka_unit_test(too_many_explicit_facets_are_an_error),
        cmocka_unit_test(discreteness_leaves_the_smooth_channels_alone),
        cmocka_unit_test(the_number_of_facets_is_density_times_area),
        cmocka_unit_test(a_mesh_without_the_texture_coordinates_of_its_glints_is_warned_of),
        cmocka_unit_test(contrast_falls_as_the_root_of_the_density),
        cmocka_unit_test(degenerate_meshes_give_the_smooth_picture),
        cmocka_unit_test(nodes_sparkle_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
