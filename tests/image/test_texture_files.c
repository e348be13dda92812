/* Images as they come: good ones in every format, and broken or hostile ones, which end in an error that names them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "texture_scene.h"

static bytes data_file(const char *name)
{
    return file_read(folder_path(TEST_DATA, name));
}

/* Copies, so that sanitizers see a read past the end. */
static textures *open_part(const bytes *whole, size_t size, report *r)
{
    bytes part = { malloc(size ? size : 1), size };
    assert_non_null(part.data);
    memcpy(part.data, whole->data, size);
    *r = (report){ 0 };
    textures *t = open_bytes(part, r);
    free(part.data);
    return t;
}

static void assert_refused(const bytes *image_file, size_t size, const char *reason)
{
    report r;
    textures *t = open_part(image_file, size, &r);
    if (t)
        fail_msg("accepted, expected \"%s\"", reason);
    if (!strstr(r.error, "images/0: ") || !strstr(r.error, reason))
        fail_msg("found \"%s\", expected images/0 and \"%s\"", r.error, reason);
}

static void assert_bytes_refused(const char *start, size_t size, const char *reason)
{
    const bytes b = { (uint8_t *)start, size };
    assert_refused(&b, size, reason);
}

static bytes small_png(void)
{
    uint8_t samples[8 * 8 * 3];
    for (size_t i = 0; i < sizeof samples; i++)
        samples[i] = (uint8_t)(i * 7);
    return png_make(8, 8, 8, PNG_RGB, samples);
}

static void assert_color(const char *name, int red, int green, int blue)
{
    report r = { 0 };
    textures *t = open_file(folder_path(TEST_DATA, name), &r);
    if (!t)
        fail_msg("%s", r.error);
    const scene_texture data = texture_plain(false);
    const int expected[3] = { red, green, blue };
    float rgba[4];
    texture_at(t, &data, 0.5F, 0.5F, rgba);
    for (int c = 0; c < 3; c++)
        /* JPEG rounds luma and chroma; the inverse matrix has entries below 1.8: three codes at most. */
        assert_true(fabs((double)rgba[c] * 255.0 - expected[c]) <= 3.0);
    assert_true(rgba[3] == 1.0F);
    textures_close(t);
}

static void jpeg_and_webp_open_from_files(void **state)
{
    (void)state;
    assert_color("orange.jpg", 200, 120, 40);
    assert_color("orange.webp", 200, 120, 40);
    assert_color("grey.jpg", 90, 90, 90);
}

static void the_contents_and_not_the_name_say_the_format(void **state)
{
    (void)state;
    char *folder = folder_make();
    bytes jpeg = data_file("orange.jpg");
    const char *path = folder_path(folder, "mistaken.png");
    file_write(path, jpeg.data, jpeg.size);
    report r = { 0 };
    textures *t = open_file(path, &r);
    assert_non_null(t);
    textures_close(t);
    free(jpeg.data);
    folder_remove(folder);
}

static void what_is_not_an_image_is_refused(void **state)
{
    (void)state;
    assert_bytes_refused("", 0, "is empty");
    assert_bytes_refused("not an image", 12, "6e 6f 74 20");
    assert_bytes_refused("\x89", 1, "begins with the bytes 89");
    assert_bytes_refused("\xabKTX 20\xbb\r\n\x1a\n", 12, "KTX2");
    assert_bytes_refused("DDS |", 5, "DDS");
    assert_bytes_refused("GIF89a", 6, "GIF");
    assert_bytes_refused("\x76\x2f\x31\x01", 4, "OpenEXR");
}

static void what_is_not_a_file_is_refused(void **state)
{
    (void)state;
    char *folder = folder_make();
    const char *pipe_path = folder_path(folder, "pipe");
    assert_int_equal(mkfifo(pipe_path, 0600), 0);
    const char *const paths[3] = { folder_path(folder, "missing.png"), folder, pipe_path };
    static const char *const reasons[3] = { "No such file", "is not a regular file", "is not a regular file" };
    for (int i = 0; i < 3; i++) {
        report r = { 0 };
        assert_null(open_file(paths[i], &r));
        assert_non_null(strstr(r.error, paths[i]));
        assert_non_null(strstr(r.error, reasons[i]));
    }
    folder_remove(folder);
}

static void absurd_sizes_are_refused(void **state)
{
    (void)state;
    static const struct {
        uint32_t width, height;
        const char *reason;
    } cases[] = {
        { 100000, 100000, "100000 x 100000" },
        { 16385, 1, "16385 x 1" },
        { 16384, 16384, "268435456 pixels" },
        { 0x7FFFFFFF, 0x7FFFFFFF, "" },
        { 0, 1, "" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bytes png = png_header(cases[i].width, cases[i].height);
        /* libpng reads on to the first IDAT before it gives the size. */
        bytes one = png_make(1, 1, 8, PNG_GREY, (const uint8_t *)"");
        png.data = realloc(png.data, png.size + one.size);
        assert_non_null(png.data);
        memcpy(png.data + png.size, one.data + 33, one.size - 33);
        png.size += one.size - 33;
        assert_refused(&png, png.size, cases[i].reason);
        free(png.data);
        free(one.data);
    }
    bytes jpeg = data_file("orange.jpg");
    for (size_t i = 0; i + 9 < jpeg.size; i++)
        if (jpeg.data[i] == 0xFF && jpeg.data[i + 1] == 0xC0)
            memset(jpeg.data + i + 5, 0x7F, 4); /* height and width in the frame header */
    assert_refused(&jpeg, jpeg.size, "32639 x 32639");
    free(jpeg.data);
}

static void every_truncation_is_refused(void **state)
{
    (void)state;
    bytes png = small_png();
    bytes jpeg = data_file("orange.jpg");
    bytes webp = data_file("orange.webp");
    for (size_t size = 0; size < png.size; size++)
        assert_refused(&png, size, "images/0");
    for (size_t size = 0; size < jpeg.size; size++)
        assert_refused(&jpeg, size, "images/0");
    for (size_t size = 0; size < webp.size; size++)
        assert_refused(&webp, size, "images/0");
    free(png.data);
    free(jpeg.data);
    free(webp.data);
}

/* Whatever the bytes say, the answer is textures or an error. */
static void damaged_bytes_never_crash(void **state)
{
    (void)state;
    bytes originals[3] = { small_png(), data_file("orange.jpg"), data_file("orange.webp") };
    uint32_t random = 17;
    for (int i = 0; i < 1500; i++) {
        const bytes *original = &originals[i % 3];
        bytes damaged = { malloc(original->size), original->size };
        assert_non_null(damaged.data);
        memcpy(damaged.data, original->data, original->size);
        for (int k = 0; k < 1 + i % 4; k++) {
            random = random * 1664525U + 1013904223U;
            damaged.data[(random >> 8) % damaged.size] ^= (uint8_t)(1U << (random >> 29));
        }
        report r;
        textures *t = open_part(&damaged, damaged.size, &r);
        assert_true(t ? r.error[0] == '\0' : strstr(r.error, "images/0: ") != NULL);
        textures_close(t);
        free(damaged.data);
    }
    for (int i = 0; i < 3; i++)
        free(originals[i].data);
}

/* A file may hold images for other materials, or for none. */
static void an_image_that_nobody_uses_is_not_opened(void **state)
{
    (void)state;
    scene_image broken = { .name = "images/0", .path = "/nowhere/image.png" };
    scene_material material = scene_material_default();
    const scene s = { .images = &broken, .image_count = 1, .materials = &material, .material_count = 1 };
    textures *t = NULL;
    report r = { 0 };
    assert_true(textures_open(&s, &t, &r));
    textures_close(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jpeg_and_webp_open_from_files),
        cmocka_unit_test(the_contents_and_not_the_name_say_the_format),
        cmocka_unit_test(what_is_not_an_image_is_refused),
        cmocka_unit_test(what_is_not_a_file_is_refused),
        cmocka_unit_test(absurd_sizes_are_refused),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(damaged_bytes_never_crash),
        cmocka_unit_test(an_image_that_nobody_uses_is_not_opened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
