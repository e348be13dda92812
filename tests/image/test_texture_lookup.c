/* Filtered lookups against texels that the tests know and means that they compute. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "texture_scene.h"

/* IEC 61966-2-1, apart from the library's own. */
static double linear_of_code(int code)
{
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static float random_unit(uint32_t *state)
{
    return (float)random_bits(state) * 0x1p-24F;
}

static textures *open_png(uint32_t width, uint32_t height, int bit_depth, int color_type, const uint8_t *samples)
{
    report r = { 0 };
    const bytes png = png_make(width, height, bit_depth, color_type, samples);
    textures *t = open_bytes(png, &r);
    free(png.data);
    if (!t)
        fail_msg("%s", r.error);
    return t;
}

static void assert_rgba(const float rgba[4], double r, double g, double b, double a, double bound)
{
    const double expected[4] = { r, g, b, a };
    for (int c = 0; c < 4; c++)
        if (!(fabs((double)rgba[c] - expected[c]) <= bound))
            fail_msg("channel %d: found %.9g, expected %.9g within %g", c, (double)rgba[c], expected[c], bound);
}

static void the_origin_is_the_upper_left_corner(void **state)
{
    (void)state;
    static const uint8_t corners[] = { 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255 };
    textures *t = open_png(2, 2, 8, PNG_RGB, corners);
    const scene_texture data = texture_plain(false);
    float rgba[4];
    texture_at(t, &data, 0.25F, 0.25F, rgba);
    assert_rgba(rgba, 1, 0, 0, 1, 0);
    texture_at(t, &data, 0.75F, 0.25F, rgba);
    assert_rgba(rgba, 0, 1, 0, 1, 0);
    texture_at(t, &data, 0.25F, 0.75F, rgba);
    assert_rgba(rgba, 0, 0, 1, 1, 0);
    texture_at(t, &data, 0.75F, 0.75F, rgba);
    assert_rgba(rgba, 1, 1, 1, 1, 0);
    textures_close(t);
}

enum { WIDTH = 7, HEIGHT = 5 };

static void at_a_texel_centre_a_lookup_gives_the_texel(void **state)
{
    (void)state;
    uint8_t samples[HEIGHT][WIDTH][4][2];
    uint32_t random = 3;
    for (size_t i = 0; i < sizeof samples; i++)
        (&samples[0][0][0][0])[i] = (uint8_t)random_bits(&random);
    textures *t = open_png(WIDTH, HEIGHT, 16, PNG_RGBA, &samples[0][0][0][0]);
    const scene_texture data = texture_plain(false);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double v[4];
            for (int c = 0; c < 4; c++)
                v[c] = (samples[y][x][c][0] * 256 + samples[y][x][c][1]) / 65535.0;
            float rgba[4];
            texture_at(t, &data, ((float)x + 0.5F) / WIDTH, ((float)y + 0.5F) / HEIGHT, rgba);
            /* s, and s times the size, are right to 2^-24 of at most 7 texels each: 2^-20.2 texels on each of two
             * axes, times a contrast of 1 at most; the weighted sum of floats adds 2^-22. */
            assert_rgba(rgba, v[0], v[1], v[2], v[3], 2.5e-6);
        }
    textures_close(t);
}

static void every_code_decodes_as_color_and_as_data(void **state)
{
    (void)state;
    uint8_t codes[256];
    for (int i = 0; i < 256; i++)
        codes[i] = (uint8_t)i;
    textures *t = open_png(256, 1, 8, PNG_GREY, codes);
    scene_texture color = texture_plain(true);
    scene_texture data = texture_plain(false);
    color.nearest = data.nearest = true;
    for (int i = 0; i < 256; i++) {
        float rgba[4];
        texture_at(t, &data, ((float)i + 0.5F) / 256.0F, 0.5F, rgba);
        assert_rgba(rgba, i / 255.0, i / 255.0, i / 255.0, 1.0, 0x1p-24);
        texture_at(t, &color, ((float)i + 0.5F) / 256.0F, 0.5F, rgba);
        const double linear = linear_of_code(i);
        assert_rgba(rgba, linear, linear, linear, 1.0, linear * 0x1.01p-11); /* the rounding of a half */
    }
    textures_close(t);
}

static void grey_and_alpha_spread_and_alpha_stays_straight(void **state)
{
    (void)state;
    static const uint8_t grey_alpha[] = { 51, 102 };
    static const uint8_t rgba_samples[] = { 204, 102, 51, 0 };
    const scene_texture data = texture_plain(false);
    const scene_texture color = texture_plain(true);
    float rgba[4];
    textures *t = open_png(1, 1, 8, PNG_GREY_ALPHA, grey_alpha);
    texture_at(t, &data, 0.5F, 0.5F, rgba);
    assert_rgba(rgba, 0.2, 0.2, 0.2, 0.4, 1e-7);
    texture_at(t, &color, 0.5F, 0.5F, rgba);
    assert_rgba(rgba, linear_of_code(51), linear_of_code(51), linear_of_code(51), 0.4, 0x1p-12);
    textures_close(t);
    t = open_png(1, 1, 8, PNG_RGBA, rgba_samples);
    texture_at(t, &data, 0.5F, 0.5F, rgba);
    assert_rgba(rgba, 0.8, 0.4, 0.2, 0.0, 1e-7);
    texture_at(t, &color, 0.5F, 0.5F, rgba);
    assert_rgba(rgba, linear_of_code(204), linear_of_code(102), linear_of_code(51), 0.0, 0x1p-12);
    textures_close(t);
}

/* A texture without an image multiplies by one. */
static void no_texture_is_one(void **state)
{
    (void)state;
    static const uint8_t black[3] = { 0 };
    textures *t = open_png(1, 1, 8, PNG_RGB, black);
    const scene_texture none = scene_texture_none();
    float rgba[4];
    texture_at(t, &none, 0.5F, 0.5F, rgba);
    assert_rgba(rgba, 1, 1, 1, 1, 0);
    textures_close(t);
}

static textures *open_checkerboard(uint32_t size)
{
    uint8_t *samples = malloc((size_t)size * size);
    assert_non_null(samples);
    for (uint32_t y = 0; y < size; y++)
        for (uint32_t x = 0; x < size; x++)
            samples[y * size + x] = (x + y) % 2 ? 255 : 0;
    textures *t = open_png(size, size, 8, PNG_GREY, samples);
    free(samples);
    return t;
}

/* Half of the light, not half of the code: a black and white board is .5 from afar, where code 127.5 would be .21. */
static void a_checkerboard_tends_to_the_mean_of_light(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    textures *t = open_checkerboard(SIZE);
    const scene_texture color = texture_plain(true);
    uint32_t random = 11;
    for (int i = 0; i < 2000; i++) {
        /* A footprint of 2 to 256 texels, up to 16 times longer than wide, in any direction. */
        const float minor = exp2f(1.0F + 7.0F * random_unit(&random)) / SIZE;
        const float major = minor * exp2f(4.0F * random_unit(&random));
        const float angle = 6.2831853F * random_unit(&random);
        const float c = cosf(angle), s = sinf(angle);
        float rgba[4];
        texture_lookup(t, &color, random_unit(&random), random_unit(&random), major * c, major * s, -minor * s,
                       minor * c, rgba);
        /* From two texels on, every level that is read is constant; what is left is the rounding of the filter's
         * weights: at most 2 x 64 of them, right to 2^-24. */
        assert_rgba(rgba, 0.5, 0.5, 0.5, 1.0, 128 * 0x1p-24);
    }
    textures_close(t);
}

/* Odd sizes have texels that fall into two of the next level; the mean must survive that. */
static void from_afar_any_picture_is_its_mean(void **state)
{
    (void)state;
    enum { W = 37, H = 22, LEVELS = 6 };
    uint8_t samples[W * H * 3];
    uint32_t random = 5;
    double data_mean[3] = { 0 };
    double color_mean[3] = { 0 };
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) {
            samples[3 * i + c] = (uint8_t)(random_bits(&random) >> (8 + c));
            data_mean[c] += samples[3 * i + c] / 255.0 / (W * H);
            color_mean[c] += linear_of_code(samples[3 * i + c]) / (W * H);
        }
    textures *t = open_png(W, H, 8, PNG_RGB, samples);
    const scene_texture data = texture_plain(false);
    const scene_texture color = texture_plain(true);
    float rgba[4];
    texture_lookup(t, &data, 0.3F, 0.8F, 50.0F, 0.0F, 0.0F, 50.0F, rgba);
    /* Every level rounds once: by 2^-17 as 16-bit integers, by 2^-12 as halves below 1. */
    assert_rgba(rgba, data_mean[0], data_mean[1], data_mean[2], 1.0, LEVELS * 0x1p-17);
    texture_lookup(t, &color, 0.3F, 0.8F, 50.0F, 0.0F, 0.0F, 50.0F, rgba);
    assert_rgba(rgba, color_mean[0], color_mean[1], color_mean[2], 1.0, LEVELS * 0x1p-12);
    textures_close(t);
}

/* Stripes of 8 texels: a footprint along a stripe sees one of them, one across sees many. */
static void the_filter_follows_the_long_axis_of_the_footprint(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    uint8_t samples[SIZE * SIZE];
    for (int i = 0; i < SIZE * SIZE; i++)
        samples[i] = i % SIZE / 8 % 2 ? 255 : 0;
    textures *t = open_png(SIZE, SIZE, 8, PNG_GREY, samples);
    const scene_texture data = texture_plain(false);
    const float thin = 1.0F / SIZE, length = 16.0F / SIZE;
    for (int stripe = 0; stripe < 8; stripe++) {
        const float s = ((float)stripe * 8.0F + 4.0F) / SIZE;
        const double own = stripe % 2;
        float rgba[4];
        texture_lookup(t, &data, s, 0.4F, 0.0F, length, thin, 0.0F, rgba);
        assert_rgba(rgba, own, own, own, 1.0, 1e-5);
        texture_lookup(t, &data, s, 0.4F, thin, 0.0F, 0.0F, length, rgba);
        assert_rgba(rgba, own, own, own, 1.0, 1e-5);
        texture_lookup(t, &data, s, 0.4F, length, 0.0F, 0.0F, thin, rgba);
        assert_true(rgba[0] > 0.2F && rgba[0] < 0.8F);
    }
    textures_close(t);
}

static int wrapped(int index, int size, scene_wrap mode)
{
    if (mode == SCENE_WRAP_CLAMP)
        return index < 0 ? 0 : index >= size ? size - 1 : index;
    const int period = mode == SCENE_WRAP_MIRROR ? 2 * size : size;
    const int in_period = (index % period + period) % period;
    return in_period < size ? in_period : period - 1 - in_period;
}

static void wrap_modes_name_the_same_texel_many_periods_away(void **state)
{
    (void)state;
    enum { W = 4, H = 8 };
    uint8_t samples[H][W][3];
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            samples[y][x][0] = (uint8_t)(x * 80);
            samples[y][x][1] = (uint8_t)(y * 30);
            samples[y][x][2] = 7;
        }
    textures *t = open_png(W, H, 8, PNG_RGB, &samples[0][0][0]);
    for (int mode = 0; mode < 18; mode++) {
        scene_texture data = texture_plain(false);
        data.wrap_s = (scene_wrap)(mode % 3);
        data.wrap_t = (scene_wrap)(mode / 3 % 3);
        data.nearest = mode >= 9;
        for (int y = -3 * H; y < 4 * H; y++)
            for (int x = -3 * W; x < 4 * W; x++) {
                float rgba[4];
                texture_at(t, &data, ((float)x + 0.5F) / W, ((float)y + 0.5F) / H, rgba);
                const uint8_t *p = samples[wrapped(y, H, data.wrap_t)][wrapped(x, W, data.wrap_s)];
                /* The sizes are powers of two: the coordinates and the filter's weights are exact. */
                assert_rgba(rgba, p[0] / 255.0, p[1] / 255.0, p[2] / 255.0, 1.0, 0x1p-24);
            }
    }
    textures_close(t);
}

static void the_border_blends_with_what_the_wrap_mode_puts_beside_it(void **state)
{
    (void)state;
    static const uint8_t samples[4] = { 0, 51, 102, 255 };
    static const double expected[3] = { 0.5, 0.0, 0.0 }; /* repeat, clamp, mirror; at the left border */
    textures *t = open_png(4, 1, 8, PNG_GREY, samples);
    for (int mode = 0; mode < 3; mode++) {
        scene_texture data = texture_plain(false);
        data.wrap_s = (scene_wrap)mode;
        float rgba[4];
        texture_at(t, &data, 0.0F, 0.5F, rgba);
        assert_rgba(rgba, expected[mode], expected[mode], expected[mode], 1.0, 0x1p-23);
    }
    textures_close(t);
}

static void a_nearest_sampler_never_blends(void **state)
{
    (void)state;
    textures *t = open_checkerboard(16);
    scene_texture data = texture_plain(false);
    data.nearest = true;
    uint32_t random = 2;
    for (int i = 0; i < 1000; i++) {
        float rgba[4];
        const float s = random_unit(&random), t_ = random_unit(&random);
        texture_lookup(t, &data, s, t_, 0.1F, 0.0F, 0.0F, 0.1F, rgba);
        const int x = (int)(s * 16.0F), y = (int)(t_ * 16.0F);
        assert_true(rgba[0] == (float)((x + y) % 2));
    }
    textures_close(t);
}

/* A quarter turn of the coordinates shows the picture turned: (u, v) reads (v, 1 - u). */
static void the_transform_moves_points_and_footprints(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    uint8_t samples[SIZE * SIZE * 3];
    uint32_t random = 9;
    for (size_t i = 0; i < sizeof samples; i++)
        samples[i] = (uint8_t)random_bits(&random);
    textures *t = open_png(SIZE, SIZE, 8, PNG_RGB, samples);
    const scene_texture plain = texture_plain(false);
    scene_texture turned = plain;
    turned.offset[1] = 1.0F;
    turned.rotation = 1.57079632679F;
    for (int i = 0; i < 1000; i++) {
        const float u = random_unit(&random), v = random_unit(&random);
        const float along = 0.1F * random_unit(&random), across = 0.1F * random_unit(&random);
        float a[4];
        float b[4];
        texture_lookup(t, &turned, u, v, along, 0.0F, 0.0F, across, a);
        texture_lookup(t, &plain, v, 1.0F - u, 0.0F, -along, across, 0.0F, b);
        /* The float quarter turn is off by 4.4e-8 images, 3e-6 texels, and the rounding of 1 - u by 4e-6; a texel
         * differs from its neighbours on two axes by 1 at most. */
        assert_rgba(a, (double)b[0], (double)b[1], (double)b[2], 1.0, 2e-5);
    }
    textures_close(t);
}

static void nonsense_coordinates_give_values_of_the_picture(void **state)
{
    (void)state;
    static const uint8_t samples[] = { 51, 60, 70, 80, 90, 204 };
    static const float bad[] = { NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e9F, FLT_TRUE_MIN, 0.5F };
    enum { COUNT = sizeof bad / sizeof *bad };
    textures *t = open_png(3, 2, 8, PNG_GREY, samples);
    uint32_t random = 1;
    for (int i = 0; i < 20000; i++) {
        scene_texture data = texture_plain(random_bits(&random) % 2);
        data.wrap_s = (scene_wrap)(random_bits(&random) % 3);
        data.wrap_t = (scene_wrap)(random_bits(&random) % 3);
        data.nearest = random_bits(&random) % 4 == 0;
        float q[6];
        for (int k = 0; k < 6; k++)
            q[k] = bad[random_bits(&random) % COUNT];
        float rgba[4];
        texture_lookup(t, &data, q[0], q[1], q[2], q[3], q[4], q[5], rgba);
        /* Texels are positive and below 204/255; halves round by 2^-12 at most. */
        assert_true(rgba[0] > 0.03F && rgba[0] < 0.8003F);
        assert_true(rgba[3] == 1.0F);
    }
    textures_close(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_origin_is_the_upper_left_corner),
        cmocka_unit_test(at_a_texel_centre_a_lookup_gives_the_texel),
        cmocka_unit_test(every_code_decodes_as_color_and_as_data),
        cmocka_unit_test(grey_and_alpha_spread_and_alpha_stays_straight),
        cmocka_unit_test(no_texture_is_one),
        cmocka_unit_test(a_checkerboard_tends_to_the_mean_of_light),
        cmocka_unit_test(from_afar_any_picture_is_its_mean),
        cmocka_unit_test(the_filter_follows_the_long_axis_of_the_footprint),
        cmocka_unit_test(wrap_modes_name_the_same_texel_many_periods_away),
        cmocka_unit_test(the_border_blends_with_what_the_wrap_mode_puts_beside_it),
        cmocka_unit_test(a_nearest_sampler_never_blends),
        cmocka_unit_test(the_transform_moves_points_and_footprints),
        cmocka_unit_test(nonsense_coordinates_give_values_of_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
