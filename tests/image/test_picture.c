/* Pictures in memory and in files: sizes, names, bits and codes. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "files.h"
#include "io/image.h"

static int make_folder(void **state)
{
    *state = folder_make();
    return 0;
}

static int drop_folder(void **state)
{
    folder_remove(*state);
    return 0;
}

static image picture_with(int width, int height, const char *const *names, int channel_count)
{
    image i;
    report r = { 0 };
    assert_true(image_allocate(&i, width, height, channel_count, &r));
    for (int c = 0; c < channel_count; c++)
        assert_true(image_name_channel(&i, c, names[c], "picture", &r));
    return i;
}

static void impossible_sizes_are_errors(void **state)
{
    (void)state;
    static const int sizes[][3] = {
        { 0, 1, 1 },
        { 1, -1, 1 },
        { 1, 1, 0 },
        { INT_MIN, 1, 1 },
        { INT_MAX, INT_MAX, INT_MAX },
        { INT_MAX, INT_MAX, 4 },
        { INT_MAX, 1 << 30, 1 },
    };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        report r = { 0 };
        image i;
        assert_false(image_allocate(&i, sizes[k][0], sizes[k][1], sizes[k][2], &r));
        assert_non_null(strstr(r.error, "a picture of"));
        assert_null(i.pixels);
        assert_null(i.channel_names);
    }
}

static void a_new_picture_is_black(void **state)
{
    (void)state;
    image i;
    report r = { 0 };
    assert_true(image_allocate(&i, 3, 2, 5, &r));
    for (int k = 0; k < 3 * 2 * 5; k++)
        assert_true(i.pixels[k] == 0.0F);
    image_free(&i);
    assert_null(i.pixels);
}

static bool contains(const bytes *b, const char *text)
{
    const size_t length = strlen(text);
    for (size_t i = 0; i + length <= b->size; i++)
        if (memcmp(b->data + i, text, length) == 0)
            return true;
    return false;
}

static void an_exr_keeps_every_channel_bit_for_bit(void **state)
{
    static const char *const names[] = { "R",        "G",        "B",        "A",     "smooth.R",
                                         "glints.N", "glints.p", "normal.X", "depth", "_x-9" };
    enum { CHANNELS = sizeof names / sizeof *names, W = 37, H = 70 };
    image out = picture_with(W, H, names, CHANNELS);
    uint32_t random = 6;
    for (int k = 0; k < W * H * CHANNELS; k++) {
        random = random * 1664525U + 1013904223U;
        memcpy(&out.pixels[k], &random, sizeof random); /* any bits: NaN, infinite, denormal */
    }
    static const float special[] = { INFINITY, -INFINITY, NAN, -0.0F, FLT_TRUE_MIN, FLT_MAX };
    memcpy(out.pixels, special, sizeof special);
    const char *path = folder_path(*state, "out.exr");
    const image_text metadata = { "glint:scene", "ball.gltf" };
    report r = { 0 };
    assert_true(image_write_exr(path, &out, &metadata, 1, &r));
    image in;
    assert_true(image_read(path, &in, &r));
    assert_true(in.width == W && in.height == H && in.channel_count == CHANNELS);
    for (int c = 0; c < CHANNELS; c++) {
        const int from = image_channel(&in, names[c]);
        assert_true(from >= 0);
        for (int p = 0; p < W * H; p++)
            assert_memory_equal(&in.pixels[p * CHANNELS + from], &out.pixels[p * CHANNELS + c], sizeof(float));
    }
    image_free(&in);
    bytes file = file_read(path);
    assert_true(contains(&file, "ball.gltf"));
    free(file.data);
    image_free(&out);
}

/* OpenEXR has attributes of its own, whose types are not text. */
static void metadata_cannot_be_called_as_what_the_format_has(void **state)
{
    static const char *const rgb[] = { "R", "G", "B" };
    const char *path = folder_path(*state, "out.exr");
    const image_text metadata = { "compression", "none" };
    image i = picture_with(2, 2, rgb, 3);
    report r = { 0 };
    assert_false(image_write_exr(path, &i, &metadata, 1, &r));
    assert_non_null(strstr(r.error, path));
    assert_non_null(strstr(r.error, "\"compression\""));
    assert_int_equal(folder_count(*state), 0);
    image_free(&i);
}

static void channels_need_names_of_their_own(void **state)
{
    static const char *const twice[] = { "R", "G", "R" };
    const char *path = folder_path(*state, "out.exr");
    image i = picture_with(2, 2, twice, 3);
    report r = { 0 };
    assert_false(image_write_exr(path, &i, NULL, 0, &r));
    assert_non_null(strstr(r.error, "two channels are called \"R\""));
    i.channel_names[2][0] = '\0';
    r = (report){ 0 };
    assert_false(image_write_exr(path, &i, NULL, 0, &r));
    assert_non_null(strstr(r.error, "channel 2 has no name"));
    r = (report){ 0 };
    assert_false(image_name_channel(&i, 0, "a.name.of.thirty-two.characters!", path, &r));
    assert_non_null(strstr(r.error, "at most 31"));
    r = (report){ 0 };
    assert_false(image_write_png(path, &i, 0.0F, &r));
    assert_non_null(strstr(r.error, "no channels R, G and B"));
    assert_int_equal(folder_count(*state), 0);
    image_free(&i);
}

/* IEC 61966-2-1: the light of an 8-bit code. */
static double light_of(int code)
{
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static void assert_codes(const char *path, const int *codes, int count)
{
    image in;
    report r = { 0 };
    if (!image_read(path, &in, &r))
        fail_msg("%s", r.error);
    assert_int_equal(in.width * in.height * in.channel_count, count);
    for (int k = 0; k < count; k++)
        if (fabs((double)in.pixels[k] - light_of(codes[k])) > 1e-6)
            fail_msg("value %d: found %g, expected code %d, which is %g", k, (double)in.pixels[k], codes[k],
                     light_of(codes[k]));
    image_free(&in);
}

static void a_png_shows_light_as_srgb_codes(void **state)
{
    static const char *const rgb[] = { "R", "G", "B" };
    /* The codes of mid grey (.18) and of half the light are in every table of sRGB: 118 and 188. */
    static const float light[12] = { 0, 1, 0.5F, 0.18F, 2, -1, NAN, INFINITY, 0.001F, 0.0031308F, 0.9999F, 1e-9F };
    static const int codes[12] = { 0, 255, 188, 118, 255, 0, 0, 255, 3, 10, 255, 0 };
    static const int brighter[12] = { 0, 255, 255, 162, 255, 0, 0, 255, 7, 18, 255, 0 };
    image i = picture_with(2, 2, rgb, 3);
    memcpy(i.pixels, light, sizeof light);
    report r = { 0 };
    const char *path = folder_path(*state, "out.png");
    assert_true(image_write_png(path, &i, 0.0F, &r));
    assert_codes(path, codes, 12);
    assert_true(image_write_png(path, &i, 1.0F, &r));
    assert_codes(path, brighter, 12);
    image_free(&i);
}

/* Half covered by white: the file stores white with half alpha, and reading multiplies again. */
static void a_png_stores_straight_alpha(void **state)
{
    static const char *const rgba[] = { "glints.N", "A", "B", "G", "R" };
    image i = picture_with(2, 1, rgba, 5);
    static const float pixels[10] = { 9, 0.2F, 0.2F, 0.1F, 0.05F, 9, 0, 0, 1, 0 };
    memcpy(i.pixels, pixels, sizeof pixels);
    const char *path = folder_path(*state, "out.png");
    report r = { 0 };
    assert_true(image_write_png(path, &i, 0.0F, &r));
    image in;
    assert_true(image_read(path, &in, &r));
    assert_int_equal(in.channel_count, 4);
    const double expected[4] = { light_of(137) * 0.2, light_of(188) * 0.2, light_of(255) * 0.2, 0.2 };
    for (int c = 0; c < 4; c++)
        assert_true(fabs((double)in.pixels[c] - expected[c]) < 1e-6);
    image_free(&in);
    image_free(&i);
}

static void the_same_picture_gives_the_same_bytes_at_any_time(void **state)
{
    static const char *const rgb[] = { "R", "G", "B" };
    const char *paths[4] = { folder_path(*state, "1.exr"), folder_path(*state, "2.exr"), folder_path(*state, "1.png"),
                             folder_path(*state, "2.png") };
    image i = picture_with(16, 16, rgb, 3);
    report r = { 0 };
    for (int k = 0; k < 2; k++) {
        assert_true(image_write_exr(paths[k], &i, NULL, 0, &r));
        assert_true(image_write_png(paths[2 + k], &i, 0.0F, &r));
        usleep(1100000); /* time stamps count seconds */
    }
    for (int k = 0; k < 4; k += 2) {
        bytes a = file_read(paths[k]);
        bytes b = file_read(paths[k + 1]);
        assert_int_equal(a.size, b.size);
        assert_memory_equal(a.data, b.data, a.size);
        free(a.data);
        free(b.data);
    }
    image_free(&i);
}

/* A header may claim any size; 2^14 x 2^29 pixels of three floats are more than any memory. */
static void an_absurd_size_in_a_file_is_an_error_that_names_it(void **state)
{
    static const char *const rgb[] = { "R", "G", "B" };
    static const uint8_t last_pixel[8] = { 0xFF, 0x3F, 0, 0, 0xFF, 0xFF, 0xFF, 0x1F };
    const char *path = folder_path(*state, "out.exr");
    image i = picture_with(2, 2, rgb, 3);
    report r = { 0 };
    assert_true(image_write_exr(path, &i, NULL, 0, &r));
    bytes file = file_read(path);
    static const char name[] = "dataWindow\0box2i"; /* then a length of 4 bytes, and the first pixel in 8 */
    for (size_t k = 0; k + sizeof name + 20 <= file.size; k++)
        if (memcmp(file.data + k, name, sizeof name) == 0)
            memcpy(file.data + k + sizeof name + 12, last_pixel, sizeof last_pixel);
    file_write(path, file.data, file.size);
    image in;
    assert_false(image_read(path, &in, &r));
    assert_non_null(strstr(r.error, path));
    assert_null(in.pixels);
    free(file.data);
    image_free(&i);
}

static void unreadable_pictures_are_errors_that_name_the_file(void **state)
{
    static const char *const rgb[] = { "R", "G", "B" };
    const char *path = folder_path(*state, "out.exr");
    image i = picture_with(64, 64, rgb, 3);
    report r = { 0 };
    assert_true(image_write_exr(path, &i, NULL, 0, &r));
    bytes whole = file_read(path);
    image in;
    for (size_t size = 0; size < whole.size; size += 7) {
        file_write(path, whole.data, size);
        r = (report){ 0 };
        assert_false(image_read(path, &in, &r));
        assert_non_null(strstr(r.error, path));
        assert_null(in.pixels);
    }
    /* OpenImageIO invents a picture for any name that ends in .null. */
    const char *const others[3] = { folder_path(*state, "missing.null"), *state, folder_path(*state, "text.null") };
    file_write(others[2], "text", 4);
    static const char *const reasons[3] = { "No such file", "is not a regular file",
                                            "begins with the bytes 74 65 78 74" };
    for (int k = 0; k < 3; k++) {
        r = (report){ 0 };
        assert_false(image_read(others[k], &in, &r));
        assert_non_null(strstr(r.error, others[k]));
        assert_non_null(strstr(r.error, reasons[k]));
    }
    free(whole.data);
    image_free(&i);
}

int main(void)
{
#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, drop_folder)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impossible_sizes_are_errors),
        cmocka_unit_test(a_new_picture_is_black),
        IN_A_FOLDER(an_exr_keeps_every_channel_bit_for_bit),
        IN_A_FOLDER(metadata_cannot_be_called_as_what_the_format_has),
        IN_A_FOLDER(channels_need_names_of_their_own),
        IN_A_FOLDER(a_png_shows_light_as_srgb_codes),
        IN_A_FOLDER(a_png_stores_straight_alpha),
        IN_A_FOLDER(the_same_picture_gives_the_same_bytes_at_any_time),
        IN_A_FOLDER(an_absurd_size_in_a_file_is_an_error_that_names_it),
        IN_A_FOLDER(unreadable_pictures_are_errors_that_name_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
