/* Environment maps from files: where a face of a cube looks, what a texel holds, and what is refused or mended. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "files.h"
#include "io/environment_map.h"
#include "io/image.h"
#include "io/srgb.h"

static char warning[1024];

static void keep_warning(const char *text, void *user)
{
    (void)user;
    snprintf(warning, sizeof warning, "%s", text);
}

static int enter(void **state)
{
    *state = folder_make();
    warning[0] = '\0';
    return *state == NULL;
}

static int leave(void **state)
{
    folder_remove(*state);
    return 0;
}

/* A picture of channels called R, G, B ... whose texel i of channel c is 10 i + c. */
static const char *write_map(const char *folder, int width, int height, const char *names, float odd, int at)
{
    report r = { 0 };
    image i;
    assert_true(image_allocate(&i, width, height, (int)strlen(names), &r));
    for (int c = 0; names[c] != '\0'; ++c)
        (void)snprintf(i.channel_names[c], sizeof i.channel_names[c], "%c", names[c]);
    for (int k = 0; k < width * height * i.channel_count; ++k)
        i.pixels[k] = (float)(10 * (k / i.channel_count) + k % i.channel_count);
    if (at >= 0)
        i.pixels[at] = odd;
    const char *const path = folder_path(folder, "map.exr");
    assert_true(image_write_exr(path, &i, NULL, 0, &r));
    image_free(&i);
    return path;
}

static void refuse(const char *path, const char *says)
{
    environment_map m;
    report r = { 0 };
    assert_false(environment_map_read(path, &m, &r));
    assert_null(m.rgb);
    if (strstr(r.error, path) == NULL || strstr(r.error, says) == NULL)
        fail_msg("\"%s\" does not name the file or say \"%s\"", r.error, says);
}

static void a_map_keeps_its_texels(void **state)
{
    environment_map m;
    report r = { .warn = keep_warning };
    assert_true(environment_map_read(write_map(*state, 8, 4, "BGR", 0.0F, -1), &m, &r));
    assert_true(m.width == 8 && m.height == 4);
    for (int i = 0; i < 32; ++i)
        for (int c = 0; c < 3; ++c)
            assert_true(m.rgb[3 * i + c] == (float)(10 * i + 2 - c));
    assert_true(warning[0] == '\0');
    environment_map_free(&m);
}

static void a_picture_that_is_no_map_is_refused(void **state)
{
    const char *const folder = *state;
    refuse(write_map(folder, 8, 8, "RGB", 0.0F, -1), "has 8 x 8 pixels, expected a latitude-longitude map");
    refuse(write_map(folder, 8, 4, "YZ", 0.0F, -1), "has no channel R, expected R, G and B");
    refuse(folder_path(folder, "missing.hdr"), "cannot be read");
    const char *const text = folder_path(folder, "text.hdr");
    file_write(text, "no picture", 10);
    refuse(text, "expected OpenEXR, Radiance HDR");
    file_write(text, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n", 45);
    refuse(text, "broken");
}

static void light_that_cannot_be_is_mended_with_a_warning(void **state)
{
    static const float odd[4] = { NAN, -1.0F, INFINITY, -INFINITY }, mended[4] = { 0.0F, 0.0F, 65504.0F, 0.0F };
    for (int k = 0; k < 4; ++k) {
        environment_map m;
        report r = { .warn = keep_warning };
        warning[0] = '\0';
        assert_true(environment_map_read(write_map(*state, 8, 4, "RGB", odd[k], 3 * 13 + 1), &m, &r));
        assert_true(m.rgb[3 * 13 + 1] == mended[k] && m.rgb[3 * 13] == 130.0F);
        assert_non_null(strstr(warning, "1 of its 32 texels"));
        assert_non_null(strstr(warning, "(5, 1)"));
        environment_map_free(&m);
    }
}

/* ---- cubes ---- */

/* A face of side x side texels, RGBA, made by a function of the place from the upper left. */
static scene_image face(int side, int number, void (*paint)(int number, double s, double t, uint8_t rgba[4]))
{
    uint8_t *const rgba = calloc((size_t)side * (size_t)side, 4);
    assert_non_null(rgba);
    for (int i = 0; i < side * side; ++i)
        paint(number, (i % side + 0.5) / side, (i / side + 0.5) / side, &rgba[4 * i]);
    scene_image picture = { 0 };
    picture.bytes = png_file(rgba, side, side, &picture.byte_count);
    picture.name = strdup("face.png");
    free(rgba);
    return picture;
}

static scene cube(int side, void (*paint)(int number, double s, double t, uint8_t rgba[4]))
{
    scene s = { 0 };
    s.images = calloc(6, sizeof *s.images);
    assert_non_null(s.images);
    s.image_count = 6;
    s.environment.present = true;
    for (int i = 0; i < 6; ++i) {
        s.images[i] = face(side, i, paint);
        s.environment.faces[i] = i;
    }
    return s;
}

/* The direction of a place on a face as a camera in the middle sees it, y up, -z ahead: each face by its right and its
 * down, written down from the figure of the extension and its flip. */
static const double ahead[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
static const double down[6][3] = { { 0, -1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 }, { 0, -1, 0 }, { 0, -1, 0 } };

static void paint_direction(int number, double s, double t, uint8_t rgba[4])
{
    /* Not mirrored: right = down x ahead in a right-handed frame. */
    const double *const a = ahead[number], *const d = down[number];
    const double right[3] = { d[1] * a[2] - d[2] * a[1], d[2] * a[0] - d[0] * a[2], d[0] * a[1] - d[1] * a[0] };
    double v[3], length = 0.0;
    for (int c = 0; c < 3; ++c) {
        v[c] = a[c] + (2.0 * s - 1.0) * right[c] + (2.0 * t - 1.0) * d[c];
        length += v[c] * v[c];
    }
    for (int c = 0; c < 3; ++c)
        rgba[c] = (uint8_t)lround(255.0 * srgb_encode(0.5 + 0.5 * v[c] / sqrt(length)));
    rgba[3] = 255;
}

/* Every face is painted with the direction that it shows: then the map must hold every texel's own. */
static void the_faces_of_a_cube_look_where_the_extension_says(void **state)
{
    (void)state;
    scene s = cube(64, paint_direction);
    environment_map m;
    report r = { 0 };
    assert_true(environment_map_from_cube(&s, &m, &r));
    assert_true(m.width == 256 && m.height == 128);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            double d[3];
            environment_map_direction((x + 0.5) / 256.0, (y + 0.5) / 128.0, d);
            for (int c = 0; c < 3; ++c) {
                const double found = 2.0 * (double)m.rgb[3 * (256 * y + x) + c] - 1.0;
                /* A texel of the face is pi / 2 / 64 wide at most, and 8 bits hold .01 of the brightest. */
                if (!(fabs(found - d[c]) < 0.04))
                    fail_msg("texel (%d, %d), axis %d: %g, expected %g", x, y, c, found, d[c]);
            }
        }
    environment_map_free(&m);
    scene_free(&s);
}

static void paint_bright(int number, double s, double t, uint8_t rgba[4])
{
    (void)number;
    (void)s;
    (void)t;
    rgba[0] = 255;
    rgba[1] = 128;
    rgba[2] = 0;
    rgba[3] = 51;
}

/* RGBD: "the alpha channel contains a value that, when the RGB channels are divided by it ...": 1 / .2. */
static void alpha_of_a_face_divides_its_colours(void **state)
{
    (void)state;
    scene s = cube(4, paint_bright);
    environment_map m;
    report r = { 0 };
    assert_true(environment_map_from_cube(&s, &m, &r));
    assert_true(fabsf(m.rgb[0] - 5.0F) < 1e-4F);
    assert_true(fabs((double)m.rgb[1] - 5.0 * srgb_decode(128.0 / 255.0)) < 1e-4);
    assert_true(m.rgb[2] == 0.0F);
    environment_map_free(&m);
    scene_free(&s);
}

static void faces_that_make_no_cube_are_refused(void **state)
{
    (void)state;
    environment_map m;
    report r = { 0 };
    scene s = cube(4, paint_bright);
    free(s.images[3].bytes);
    free(s.images[3].name);
    s.images[3] = face(8, 3, paint_bright);
    assert_false(environment_map_from_cube(&s, &m, &r));
    assert_non_null(strstr(r.error, "face.png: has 8 x 8 pixels, expected the face of a cube: 4 x 4"));
    assert_null(m.rgb);
    s.images[3].byte_count = 20;
    assert_false(environment_map_from_cube(&s, &m, &r));
    assert_non_null(strstr(r.error, "face.png"));
    scene_free(&s);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, enter, leave)
    const struct CMUnitTest tests[] = {
        TEST(a_map_keeps_its_texels),
        TEST(a_picture_that_is_no_map_is_refused),
        TEST(light_that_cannot_be_is_mended_with_a_warning),
        TEST(the_faces_of_a_cube_look_where_the_extension_says),
        TEST(alpha_of_a_face_divides_its_colours),
        TEST(faces_that_make_no_cube_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
