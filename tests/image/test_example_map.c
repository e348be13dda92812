/* Normal maps for the example model: what a picture says, which way it lies, and pictures that are none. */
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
#include "io/example_map.h"

typedef struct opened {
    glint_material_options options;
    float *normals;
    report said;
    bool done;
} opened;

/* Opens a picture, which is freed, as the example of a material; change m before. */
static opened open_with(scene_material m, bytes encoded)
{
    char name[] = "images/0";
    scene_image picture = { .name = name, .bytes = encoded.data, .byte_count = encoded.size };
    const scene s = { .images = &picture, .image_count = 1, .materials = &m, .material_count = 1 };
    const glint_material_options defaults = GLINT_MATERIAL_OPTIONS_INIT;
    opened o = { .options = defaults };
    o.done = example_map_open(&s, &m.glint, &o.options, &o.normals, &o.said);
    free(encoded.data);
    return o;
}

static scene_material mapped(void)
{
    scene_material m = scene_material_default();
    m.glint.present = true;
    m.glint.structure = SCENE_STRUCTURE_EXAMPLE;
    m.glint.example_texture.image = 0;
    m.glint.example_size = 0.02F;
    return m;
}

static void assert_close(float value, double expected, double bound)
{
    if (!(fabs((double)value - expected) <= bound))
        fail_msg("found %.9g, expected %.9g within %g", (double)value, expected, bound);
}

/* 8 x 8 normals that say where they are, (x, y up, z): two texels stand out, in row 1 column 2 and row 6 column 5. */
static void fill(double normals[64][3])
{
    for (int i = 0; i < 64; i++) {
        normals[i][0] = normals[i][1] = 0.0;
        normals[i][2] = 1.0;
    }
    normals[1 * 8 + 2][0] = 0.6;
    normals[1 * 8 + 2][2] = 0.8;
    normals[6 * 8 + 5][1] = -0.28;
    normals[6 * 8 + 5][2] = 0.96;
}

/* The normals as a picture of these bits and channels. */
static bytes encode(int bits, int color_type)
{
    static uint8_t samples[64 * 8];
    double normals[64][3];
    fill(normals);
    const int channels = color_type == PNG_RGBA ? 4 : 3;
    size_t n = 0;
    for (int i = 0; i < 64; i++)
        for (int c = 0; c < channels; c++) {
            const double value = c < 3 ? (normals[i][c] + 1.0) / 2.0 : 0.5;
            const long code = lround(value * (bits == 8 ? 255.0 : 65535.0));
            if (bits == 16)
                samples[n++] = (uint8_t)(code >> 8);
            samples[n++] = (uint8_t)code;
        }
    return png_make(8, 8, bits, color_type, samples);
}

static void a_normal_keeps_its_row_and_turns_its_y(void **state)
{
    (void)state;
    static const struct {
        int bits, type;
        double step;
    } rows[] = { { 8, PNG_RGB, 1.0 / 255.0 },
                 { 16, PNG_RGB, 1.0 / 65535.0 },
                 { 8, PNG_RGBA, 1.0 / 255.0 },
                 { 16, PNG_RGBA, 1.0 / 65535.0 } };
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        opened o = open_with(mapped(), encode(rows[r].bits, rows[r].type));
        if (!o.done)
            fail_msg("%s", o.said.error);
        double normals[64][3];
        fill(normals);
        /* v runs down the picture as rows do, and y up: along v it is the other way round. No sRGB, no premultiplied
         * alpha: half a code is all that is lost. */
        for (int i = 0; i < 64; i++) {
            assert_close(o.normals[3 * i], normals[i][0], rows[r].step + 1e-6);
            assert_close(o.normals[3 * i + 1], -normals[i][1], rows[r].step + 1e-6);
            assert_close(o.normals[3 * i + 2], normals[i][2], rows[r].step + 1e-6);
        }
        const glint_example *e = &o.options.example;
        assert_true(e->normals == o.normals && e->size == 8 && e->components == 3);
        assert_true(e->side_m == 0.02F && e->placement == GLINT_EXAMPLE_TILED && e->mirror == 0 && e->flat == 0);
        o.options.model = GLINT_MODEL_EXAMPLE;
        glint_material *material;
        char message[256];
        if (glint_material_create(&o.options, &material, message, sizeof message) != GLINT_OK)
            fail_msg("%s", message);
        glint_material_destroy(material);
        free(o.normals);
    }
}

/* Compressed textures keep x and y alone. */
static void without_blue_z_is_worked_out(void **state)
{
    (void)state;
    static uint8_t samples[64 * 3];
    for (int i = 0; i < 64; i++) {
        samples[3 * i] = 204;    /* .6 */
        samples[3 * i + 1] = 51; /* -.6 */
    }
    opened o = open_with(mapped(), png_make(8, 8, 8, PNG_RGB, samples));
    assert_true(o.done);
    assert_close(o.normals[0], 0.6, 1e-6);
    assert_close(o.normals[1], 0.6, 1e-6);
    assert_close(o.normals[2], sqrt(1.0 - 2.0 * 0.36), 1e-6);
    free(o.normals);
}

static void what_is_no_normal_map_is_refused(void **state)
{
    (void)state;
    static uint8_t flat[512 * 512 * 3];
    for (size_t i = 0; i < sizeof flat; i++)
        flat[i] = i % 3 == 2 ? 255 : 128;
    static const struct {
        uint32_t width, height;
        const char *text;
    } sizes[] = { { 16, 8, "images/0: is 16 x 8 texels, expected a square of 8, 16, 32, 64, 128 or 256" },
                  { 12, 12, "is 12 x 12 texels" },
                  { 4, 4, "is 4 x 4 texels" },
                  { 512, 512, "is 512 x 512 texels" } };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const opened o = open_with(mapped(), png_make(sizes[i].width, sizes[i].height, 8, PNG_RGB, flat));
        assert_false(o.done);
        assert_null(o.normals);
        assert_null(o.options.example.normals);
        assert_non_null(strstr(o.said.error, sizes[i].text));
    }
    opened o = open_with(mapped(), png_make(8, 8, 8, PNG_GREY, flat));
    assert_false(o.done);
    assert_non_null(strstr(o.said.error, "images/0: is grey, expected a normal map with red, green and blue"));

    flat[3 * (8 * 3 + 1) + 2] = 100; /* z below 0 */
    o = open_with(mapped(), png_make(8, 8, 8, PNG_RGB, flat));
    assert_false(o.done);
    assert_non_null(
        strstr(o.said.error, "images/0: texel (1, 3) holds the normal (0.00392, 0.00392, -0.216), expected"));
}

/* Whatever bytes: an error or a map, and nothing that the library would not take. */
static void hostile_pictures_do_no_harm(void **state)
{
    (void)state;
    const bytes whole = encode(8, PNG_RGB);
    int refused = 0;
    for (size_t cut = 0; cut < whole.size; cut += 7) {
        bytes part = { malloc(whole.size), whole.size - cut };
        memcpy(part.data, whole.data, whole.size);
        if (part.size > 40)
            part.data[37 + cut % (part.size - 38)] ^= (uint8_t)(1U << cut % 8);
        const opened o = open_with(mapped(), part);
        assert_true(o.done == (o.normals != NULL) && (o.done || o.said.error[0] != '\0'));
        refused += !o.done;
        free(o.normals);
    }
    free(whole.data);
    assert_true(refused > 10);
    const opened o = open_with(mapped(), png_header(8, 8));
    assert_false(o.done);
    char name[] = "map.png", path[] = "/nowhere/map.png";
    scene_image picture = { .name = name, .path = path };
    const scene_material m = mapped();
    const scene s = { .images = &picture, .image_count = 1 };
    glint_material_options options = GLINT_MATERIAL_OPTIONS_INIT;
    float *normals;
    report said = { 0 };
    assert_false(example_map_open(&s, &m.glint, &options, &normals, &said));
    assert_non_null(strstr(said.error, "map.png"));
}

/* M takes the map to where KHR_texture_transform shows it: the transform of M t is t, but for the offset and for the
 * mean scale, which is in side_m. */
static void the_texture_transform_lays_the_map(void **state)
{
    (void)state;
    static const float cases[][3] = {
        { 0.0F, 1.0F, 1.0F }, { 0.7F, 2.0F, 2.0F }, { -1.2F, 2.0F, 0.5F }, { 2.5F, 0.8F, 1.0F }
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scene_material m = mapped();
        m.glint.example_texture.rotation = cases[i][0];
        m.glint.example_texture.scale[0] = cases[i][1];
        m.glint.example_texture.scale[1] = cases[i][2];
        const opened o = open_with(m, encode(8, PNG_RGB));
        assert_true(o.done);
        const glint_example *e = &o.options.example;
        const double c = cos((double)e->rotation_rad), s = sin((double)e->rotation_rad);
        const double side = (double)e->side_m / 0.02;
        const double xx = side * (c * (double)e->scale[0] - s * (double)e->shear[1]);
        const double xy = side * (c * (double)e->shear[0] - s * (double)e->scale[1]);
        const double yx = side * (s * (double)e->scale[0] + c * (double)e->shear[1]);
        const double yy = side * (s * (double)e->shear[0] + c * (double)e->scale[1]);
        /* (c, s; -s, c) diag(scale): see test_texture_transform.c */
        const double rc = cos((double)cases[i][0]), rs = sin((double)cases[i][0]);
        const double a = (double)cases[i][1], b = (double)cases[i][2];
        assert_close((float)(rc * a * xx + rs * b * yx), 1.0, 1e-5);
        assert_close((float)(rc * a * xy + rs * b * yy), 0.0, 1e-5);
        assert_close((float)(-rs * a * xx + rc * b * yx), 0.0, 1e-5);
        assert_close((float)(-rs * a * xy + rc * b * yy), 1.0, 1e-5);
        free(o.normals);
    }
    scene_material m = mapped();
    m.glint.example_texture.scale[0] = -1.0F;
    const opened o = open_with(m, encode(8, PNG_RGB));
    assert_false(o.done);
    assert_non_null(strstr(o.said.error, "KHR_texture_transform scales it by -1, 1, expected numbers above 0"));
}

static void scattered_maps_and_nearest_texels_are_said(void **state)
{
    (void)state;
    scene_material m = mapped();
    m.glint.example_placement = SCENE_PLACEMENT_SCATTERED;
    m.glint.example_texture.nearest = true;
    m.glint.example_rotation_variation = 0.5F;
    m.glint.example_scale_variation = 0.1F;
    const opened o = open_with(m, encode(8, PNG_RGB));
    assert_true(o.done);
    const glint_example *e = &o.options.example;
    assert_true(e->placement == GLINT_EXAMPLE_SCATTERED && e->flat == 1 && e->mirror == 1);
    assert_true(e->rotation_variation_rad == 0.5F && e->scale_variation == 0.1F && e->jitter == 1.0F);
    free(o.normals);
}

static void a_written_map_reads_back(void **state)
{
    (void)state;
    char *folder = folder_make();
    const char *path = folder_path(folder, "map.png");
    static float normals[3 * 256];
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_LEATHER, 16, &shape, 1U, normals), GLINT_OK);
    for (int bits = 8; bits <= 16; bits += 8) {
        report said = { 0 };
        assert_true(example_map_write_png(path, normals, 16, bits, &said));
        const opened o = open_with(mapped(), file_read(path));
        assert_true(o.done);
        for (int i = 0; i < 3 * 256; i++)
            assert_close(o.normals[i], (double)normals[i], bits == 8 ? 1.1 / 255.0 : 1.1 / 65535.0);
        free(o.normals);
    }
    folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_normal_keeps_its_row_and_turns_its_y),
        cmocka_unit_test(without_blue_z_is_worked_out),
        cmocka_unit_test(what_is_no_normal_map_is_refused),
        cmocka_unit_test(hostile_pictures_do_no_harm),
        cmocka_unit_test(the_texture_transform_lays_the_map),
        cmocka_unit_test(scattered_maps_and_nearest_texels_are_said),
        cmocka_unit_test(a_written_map_reads_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
