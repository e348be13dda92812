/* Comparisons of pictures whose statistics are known. */
#include "pictures.h"

enum { SIDE = 512 };

/* White noise of variance v: a mean of k x k pixels has v / k^2. Two such estimates of n blocks each have a ratio that
 * strays by sqrt(2 / n + 2 / n); the jackknife's own guess of that, from 64 parts, by sqrt(2 / 63) of itself. */
static void blocks_of_white_noise_have_its_variance_over_their_area(void **state)
{
    (void)state;
    image a = noise(SIDE, 20.0, 1.0, 1), b = noise(SIDE, 20.0, 2.0, 2);
    const compare_result c = compare(&a, &b);
    assert_int_equal(c.block_count, COMPARE_BLOCKS);
    assert_false(c.has_smooth);
    for (int i = 0; i < c.block_count; ++i) {
        const compare_block *block = &c.block[i];
        const double n = block->count, area = (double)block->side * block->side;
        const double sigma = 4.0 * sqrt(4.0 / (n * 15.0 / 16.0)); /* each family of 16 loses its mean */
        assert_int_equal(block->side, 1 << i);
        assert_true(n == (double)(SIDE / block->side) * (SIDE / block->side));
        if (fabs(block->variance.a * area - 1.0) > 5.0 * sqrt(2.0 / n) + 1e-6)
            fail_msg("blocks of %d: variance %g, expected %g", block->side, block->variance.a, 1.0 / area);
        if (fabs(block->variance.ratio - 4.0) > 5.0 * sigma)
            fail_msg("blocks of %d: ratio %g, expected 4, sigma %g", block->side, block->variance.ratio, sigma);
        if (fabs(block->variance.standard_error / sigma - 1.0) > 5.0 * sqrt(2.0 / 63.0))
            fail_msg("blocks of %d: standard error %g, expected %g", block->side, block->variance.standard_error,
                     sigma);
        assert_true(fabs(block->correlation) < 5.0 / sqrt(n));
    }
    image_free(&a);
    image_free(&b);
}

/* The picture under the noise is taken away: whole where the file has it, all but a gentle slope where it has not. */
static void the_picture_under_the_grain_does_not_count_as_grain(void **state)
{
    (void)state;
    image plain = noise(SIDE, 0.0, 1.0, 3), with = picture(SIDE, SIDE, "R G B smooth.R smooth.G smooth.B");
    image slope = picture(SIDE, SIDE, "R G B");
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x) {
            const double grain = (double)pixel(&plain, x, y)[0];
            const double steep = 50.0 + 40.0 * sin(0.1 * x) * sin(0.13 * y);
            set_grey(&with, x, y, steep + grain);
            for (int c = 3; c < 6; ++c)
                pixel(&with, x, y)[c] = (float)steep;
            set_grey(&slope, x, y, 20.0 + 0.01 * x + grain);
        }
    const compare_result smooth = compare(&with, &with), sloping = compare(&slope, &slope);
    assert_true(smooth.has_smooth && !sloping.has_smooth);
    for (int i = 0; i < COMPARE_BLOCKS; ++i) {
        const double area = (double)(1 << i) * (1 << i), n = smooth.block[i].count;
        assert_true(fabs(smooth.block[i].variance.a * area - 1.0) < 5.0 * sqrt(2.0 / n) + 1e-5);
        /* Four blocks of side k on a slope s have the variance (4^2 - 1) / 12 (s k)^2. */
        const double expected = 1.0 / area + 16.0 / 15.0 * 1.25 * 1e-4 * area;
        assert_true(fabs(sloping.block[i].variance.a / expected - 1.0) < 5.0 * sqrt(2.0 / n) + 1e-5);
    }
    image_free(&plain);
    image_free(&with);
    image_free(&slope);
}

static void spectrum_of_white_noise_is_flat_at_its_variance(void **state)
{
    (void)state;
    image a = noise(SIDE, 20.0, 1.0, 4), b = noise(SIDE, 20.0, 3.0, 5);
    const compare_result c = compare(&a, &b);
    assert_int_equal(c.ring_count, COMPARE_RINGS);
    for (int i = 1; i < c.ring_count; ++i) {
        /* A ring has pi f d f 2 * 128^2 values of exponential distribution in each square, half of them twice; of the
         * 49 overlapping squares at least 16 are independent, and a window ties neighbouring values. */
        const double values = 3.14 * 2.0 * (i + 0.5) * 4.0 / 4.0 / 2.25 * 16.0, sigma = 1.0 / sqrt(values);
        if (fabs(c.a_power[i] - 1.0) > 5.0 * sigma || fabs(c.b_power[i] / 9.0 - 1.0) > 5.0 * sigma)
            fail_msg("ring %d: %g and %g, expected 1 and 9, sigma %g", i, c.a_power[i], c.b_power[i], sigma);
    }
    image_free(&a);
    image_free(&b);
}

/* A cosine of 16 cycles in 128 pixels is at 1/8: ring 8 of 32. */
static void spectrum_shows_a_wave_at_its_frequency(void **state)
{
    (void)state;
    image a = picture(SIDE, SIDE, "R G B");
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x)
            set_grey(&a, x, y, 2.0 + cos(2.0 * 3.14159265358979 * x / 8.0));
    const compare_result c = compare(&a, &a);
    int most = 0;
    for (int i = 1; i < c.ring_count; ++i)
        if (c.a_power[i] > c.a_power[most])
            most = i;
    assert_int_equal(most, 8);
    assert_true(fabs(c.frequency[8] - 0.125) <= 0.5 / 64.0);
    image_free(&a);
}

/* 30 single pixels, 20 squares of two, and 10 pairs that touch at a corner: 60 sparks of 30 + 80 + 20 pixels. */
static void sparks_are_counted_once_each(void **state)
{
    (void)state;
    image a = picture(SIDE, SIDE, "Y"), b = picture(SIDE, SIDE, "Y");
    for (int i = 0; i < SIDE * SIDE; ++i)
        a.pixels[i] = b.pixels[i] = 1.0F;
    for (int i = 0; i < 60; ++i) {
        const int x = 8 + i % 10 * 48, y = 8 + i / 10 * 80;
        *pixel(&b, x, y) = 12.0F;
        if (i >= 30 && i < 50)
            *pixel(&b, x + 1, y) = *pixel(&b, x, y + 1) = *pixel(&b, x + 1, y + 1) = 12.0F;
        if (i >= 50)
            *pixel(&b, x - 1, y + 1) = 12.0F;
    }
    const compare_result c = compare(&a, &b);
    const double megapixels = SIDE * SIDE * 1e-6;
    for (int i = 0; i < COMPARE_SPOTS; ++i) {
        /* 12 is above 2, 4 and 8 times a mean that is hardly above 1. */
        const double expected = c.spot[i].threshold < 11.0 ? 60.0 : 0.0;
        assert_true(c.spot[i].a_per_megapixel == 0.0);
        assert_true(fabs(c.spot[i].b_per_megapixel * megapixels - expected) < 1e-6);
        assert_true(fabs(c.spot[i].b_area_share * SIDE * SIDE - (expected > 0.0 ? 130.0 : 0.0)) < 1e-6);
    }
    image_free(&a);
    image_free(&b);
}

/* Uniform in [1, 2] and in [1.25, 2.25]: the distributions are a quarter apart. */
static void distributions_have_their_quantiles_and_distance(void **state)
{
    (void)state;
    uint64_t random = 6;
    image a = picture(SIDE, SIDE, "R G B"), b = picture(SIDE, SIDE, "R G B");
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x) {
            set_grey(&a, x, y, random_between(&random, 1.0, 2.0));
            set_grey(&b, x, y, random_between(&random, 1.25, 2.25));
        }
    const compare_result c = compare(&a, &b);
    const double sigma = 1.0 / SIDE; /* of a share, at most one half over sqrt(n) */
    uint64_t total = 0;
    for (int i = 0; i < COMPARE_QUANTILES; ++i) {
        assert_true(fabs(c.a_quantile[i] - 1.0 - compare_quantile_shares[i]) < 3.0 * sigma);
        assert_true(fabs(c.b_quantile[i] - 1.25 - compare_quantile_shares[i]) < 3.0 * sigma);
    }
    assert_true(fabs(c.distance - 0.25) < 5.0 * sigma);
    for (int i = 0; i < COMPARE_BINS; ++i)
        total += c.a_bin[i];
    assert_true(total == SIDE * SIDE);
    /* A's mean is 1.5; the bin from 2^-1/2 of it to itself holds [1.06, 1.5], that above it the rest. */
    assert_true(fabs((double)c.a_bin[COMPARE_BINS / 2] / (SIDE * SIDE) - 0.5) < 5.0 * sigma);
    assert_true(fabs((double)c.a_bin[COMPARE_BINS / 2 - 1] / (SIDE * SIDE) - 0.4393) < 5.0 * sigma);
    image_free(&a);
    image_free(&b);
}

static void means_are_compared_by_channel_with_their_noise(void **state)
{
    (void)state;
    image a = noise(SIDE, 10.0, 1.0, 7), b = noise(SIDE, 10.0, 1.0, 8);
    for (int i = 0; i < SIDE * SIDE; ++i)
        b.pixels[3 * i + 1] *= 1.5F; /* green */
    const compare_result c = compare(&a, &b);
    const double sigma = sqrt(2.0) * 0.1 / SIDE; /* deviation .1 of the mean, two pictures */
    assert_true(fabs(c.mean[0].ratio - 1.0) < 5.0 * sigma && fabs(c.mean[1].ratio - 1.5) < 7.0 * sigma);
    assert_true(fabs(c.mean[3].ratio - (1.0 + 0.5 * 0.7152)) < 7.0 * sigma);
    assert_true(fabs(c.mean[0].standard_error / sigma - 1.0) < 5.0 * sqrt(2.0 / 63.0));
    assert_true(fabs(c.correlation) < 5.0 / SIDE);
    assert_int_equal(c.outcome, COMPARE_FAIL);
    image_free(&a);
    image_free(&b);
}

/* The same picture with a little noise of its own is judged pixel by pixel; the same with one percent more light, too,
 * and found wanting. */
static void pictures_of_the_same_facets_are_held_to_more(void **state)
{
    (void)state;
    uint64_t random = 9;
    image a = noise(SIDE, 10.0, 2.0, 10), near = noise(SIDE, 10.0, 2.0, 10), far = noise(SIDE, 10.0, 2.0, 10);
    image noisy = noise(SIDE, 10.0, 2.0, 10);
    for (int i = 0; i < 3 * SIDE * SIDE; ++i) {
        near.pixels[i] += 0.02F * (float)random_normal(&random);
        far.pixels[i] *= 1.01F;
        noisy.pixels[i] += 0.5F * (float)random_normal(&random);
    }
    compare_result c = compare(&a, &near);
    assert_true(c.exact && c.outcome == COMPARE_PASS);
    c = compare(&a, &far);
    assert_true(c.exact && c.outcome == COMPARE_FAIL);
    /* Correlation 1 / sqrt(1 + (.34 / 2)^2) = .986 in luminance: the same facets, but not well enough. */
    c = compare(&a, &noisy);
    assert_true(c.exact && c.outcome == COMPARE_FAIL);
    image_free(&a);
    image_free(&near);
    image_free(&far);
    image_free(&noisy);
}

/* Different noise of the same kind agrees; of half the deviation it does not; said to be the same facets it does not.
 */
static void pictures_of_the_same_kind_agree(void **state)
{
    (void)state;
    image a = noise(SIDE, 10.0, 1.0, 11), same = noise(SIDE, 10.0, 1.0, 12), calm = noise(SIDE, 10.0, 0.5, 13);
    compare_result c = compare(&a, &same);
    assert_true(!c.exact && c.outcome == COMPARE_PASS);
    c = compare(&a, &calm);
    assert_true(!c.exact && c.outcome == COMPARE_FAIL);
    compare_options options = COMPARE_OPTIONS_INIT;
    options.exact = true;
    report r = { 0 };
    assert_true(compare_pictures(&a, "a", &same, "b", &options, &c, &r));
    assert_true(c.exact && c.outcome == COMPARE_FAIL);
    image_free(&a);
    image_free(&same);
    image_free(&calm);
}

/* A few huge sparks make variances that 64 parts cannot agree on. */
static void noise_is_not_taken_for_a_difference(void **state)
{
    (void)state;
    image a = noise(SIDE, 1.0, 0.01, 14), b = noise(SIDE, 1.0, 0.01, 15);
    for (int i = 0; i < 8; ++i) {
        set_grey(&a, 40 + 60 * i, 30 + 57 * i, 60.0);
        set_grey(&b, 470 - 60 * i, 45 + 55 * i, i < 5 ? 60.0 : 20.0);
    }
    const compare_result c = compare(&a, &b);
    assert_int_equal(c.outcome, COMPARE_UNCLEAR);
    image_free(&a);
    image_free(&b);
}

static void empty_and_broken_pixels_are_left_out(void **state)
{
    (void)state;
    image a = picture(64, 64, "R G B A"), b = picture(64, 64, "R G B A");
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x) {
            set_grey(&a, x, y, 2.0);
            set_grey(&b, x, y, 2.0);
            pixel(&a, x, y)[3] = pixel(&b, x, y)[3] = 1.0F;
        }
    compare_result c = compare(&a, &b);
    assert_true(c.pixels == 32 * 64 && c.mean[3].a == c.mean[3].b && fabs(c.mean[3].a - 2.0) < 1e-6);
    assert_true(c.a_quantile[0] > 1.99 && c.outcome == COMPARE_PASS);
    pixel(&b, 40, 3)[1] = NAN;
    pixel(&a, 41, 3)[2] = INFINITY;
    c = compare(&a, &b);
    assert_true(c.a_broken == 1 && c.b_broken == 1 && c.pixels == 32 * 64 - 2);
    assert_int_equal(c.outcome, COMPARE_FAIL);
    image_free(&a);
    image_free(&b);
}

static void refuse(const image *a, const image *b, const char *says)
{
    const compare_options options = COMPARE_OPTIONS_INIT;
    compare_result result;
    report r = { 0 };
    assert_false(compare_pictures(a, "left.exr", b, "right.exr", &options, &result, &r));
    if (!strstr(r.error, says))
        fail_msg("\"%s\" does not say \"%s\"", r.error, says);
}

static void pictures_that_cannot_be_compared_are_named(void **state)
{
    (void)state;
    image a = noise(16, 1.0, 0.1, 1), small = noise(8, 1.0, 0.1, 1), depth = picture(16, 16, "depth.Z"),
          empty = picture(16, 16, "R G B A");
    refuse(&a, &small, "right.exr has 8 x 8 pixels, expected the 16 x 16 of left.exr");
    refuse(&a, &depth, "right.exr: found the channels depth.Z; expected R, G and B, or Y");
    refuse(&empty, &empty, "no pixel that is finite and not empty");
    image_free(&a);
    image_free(&small);
    image_free(&depth);
    image_free(&empty);
}

/* Blender's multi-layer files have the layer's name before the channel's. */
static void layers_of_blender_are_found(void **state)
{
    (void)state;
    image a = noise(32, 1.0, 0.1, 1);
    image b = picture(32, 32, "ViewLayer.Depth.Z ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B");
    for (int i = 0; i < 32 * 32; ++i)
        memcpy(b.pixels + 4 * i + 1, a.pixels + 3 * i, 3 * sizeof(float));
    const compare_result c = compare(&a, &b);
    assert_true(c.rms_difference == 0.0 && c.outcome == COMPARE_PASS);
    image_free(&a);
    image_free(&b);
}

/* One pixel has neither blocks nor a spectrum, and a black picture no mean to divide by. */
static void tiny_and_black_pictures_have_numbers_too(void **state)
{
    (void)state;
    image one = picture(1, 1, "R G B"), black = picture(40, 40, "R G B");
    compare_result c = compare(&one, &one);
    assert_true(c.block_count == 0 && c.ring_count == 0 && c.mean[3].ratio == 1.0);
    assert_int_equal(c.outcome, COMPARE_PASS);
    c = compare(&black, &black);
    assert_int_equal(c.outcome, COMPARE_PASS);
    set_grey(&one, 0, 0, 1.0);
    image_free(&one);
    image_free(&black);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_of_white_noise_have_its_variance_over_their_area),
        cmocka_unit_test(the_picture_under_the_grain_does_not_count_as_grain),
        cmocka_unit_test(spectrum_of_white_noise_is_flat_at_its_variance),
        cmocka_unit_test(spectrum_shows_a_wave_at_its_frequency),
        cmocka_unit_test(sparks_are_counted_once_each),
        cmocka_unit_test(distributions_have_their_quantiles_and_distance),
        cmocka_unit_test(means_are_compared_by_channel_with_their_noise),
        cmocka_unit_test(pictures_of_the_same_facets_are_held_to_more),
        cmocka_unit_test(pictures_of_the_same_kind_agree),
        cmocka_unit_test(noise_is_not_taken_for_a_difference),
        cmocka_unit_test(empty_and_broken_pixels_are_left_out),
        cmocka_unit_test(pictures_that_cannot_be_compared_are_named),
        cmocka_unit_test(layers_of_blender_are_found),
        cmocka_unit_test(tiny_and_black_pictures_have_numbers_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
