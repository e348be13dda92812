/* The light that the command line brings: environments and light sets, and what is refused of them. */
#define _GNU_SOURCE /* memmem */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "io/image.h"
#include "run_glint.h"
#include "workplace.h"

#define SMALL "--size", "24x16", "--spp", "4"

/* The plane, and an even map of radiance 1 as a Radiance file: 128, 128, 128 with exponent 129. */
static int enter(void **state)
{
    const int result = workplace_enter(state);
    if (result != 0)
        return result;
    scene_write("plane");
    static const char head[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
    char map[sizeof head - 1 + 4 * 32];
    memcpy(map, head, sizeof head - 1);
    for (size_t i = 0; i < 32; ++i)
        memcpy(&map[sizeof head - 1 + 4 * i], "\x80\x80\x80\x81", 4);
    file_write("white.hdr", map, sizeof map);
    file_write("square.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81", 49);
    return 0;
}

/* Mean of a channel of the picture that the options give. */
static double render(const char *channel, const char *const *options)
{
    const char *arguments[24] = { "glint", "render", "plane.gltf", "-o", "out.exr", SMALL };
    size_t count = 9;
    for (; *options; ++options)
        arguments[count++] = *options;
    outcome o = glint_run_list(NULL, arguments);
    assert_exit(&o, 0);
    outcome_free(&o);
    report r = { 0 };
    image i;
    if (!image_read("out.exr", &i, &r))
        fail_msg("%s", r.error);
    const int c = image_channel(&i, channel);
    double sum = 0.0;
    for (int k = 0; k < i.width * i.height; ++k)
        sum += (double)i.pixels[k * i.channel_count + c];
    sum /= (double)i.width * i.height;
    image_free(&i);
    return sum;
}
#define mean_of(channel, ...) render(channel, (const char *const[]){ __VA_ARGS__, NULL })

static void an_environment_lights_and_is_seen(void **state)
{
    (void)state;
    const double without = mean_of("G", "--light-set", "none"),
                 with = mean_of("G", "--light-set", "none", "--environment", "white.hdr");
    assert_true(without == 0.0 && with > 0.1);
    /* One EV doubles what it gives, to the rounding of floats. */
    const double doubled =
        mean_of("G", "--light-set", "none", "--environment", "white.hdr", "--environment-exposure", "1");
    assert_true(doubled > 1.99999 * with && doubled < 2.00001 * with);
    assert_true(mean_of("A", "--environment", "white.hdr") == 1.0);
}

static void the_background_can_be_left_out(void **state)
{
    (void)state;
    /* A wide picture shows more than the plane at its sides. */
    assert_true(mean_of("A", "--size", "64x16", "--environment", "white.hdr") == 1.0);
    const double plane =
        mean_of("A", "--size", "64x16", "--environment", "white.hdr", "--environment-background", "off");
    assert_true(plane > 0.1 && plane < 0.9);
    assert_true(mean_of("G", "--environment", "white.hdr", "--environment-background", "off") > 0.1);
}

static void every_light_set_lights_the_plane(void **state)
{
    (void)state;
    static const char *const names[] = { "three-point", "sun-and-sky", "ring", "point" };
    for (size_t i = 0; i < 4; ++i)
        if (!(mean_of("R", "--light-set", names[i]) > 0.02))
            fail_msg("%s leaves the plane dark", names[i]);
    assert_true(mean_of("R", "--light-set", "none") == 0.0);
    assert_true(mean_of("R", "--light-set", "file") == mean_of("R", "--bounces", "1"));
}

static void the_document_and_the_picture_name_their_light(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "render", "plane.gltf", "-o", "out.exr", SMALL, "--light-set", "ring", "--environment",
                          "white.hdr", "--environment-rotation", "-90", "--json");
    assert_exit(&o, 0);
    json_t *d = json_loads(o.out, 0, NULL);
    assert_non_null(d);
    assert_string_equal(json_string_value(json_object_get(d, "light_set")), "ring");
    assert_string_equal(json_string_value(json_object_get(d, "environment")), "white.hdr");
    assert_true(json_number_value(json_object_get(d, "environment_rotation_deg")) == -90.0);
    json_decref(d);
    outcome_free(&o);
    size_t size;
    char *const file = file_read("out.exr", &size);
    assert_non_null(memmem(file, size, "glint:light-set", 15));
    assert_non_null(memmem(file, size, "white.hdr", 9));
    free(file);
}

static void light_that_cannot_be_is_refused(void **state)
{
    (void)state;
#define TRY(...) glint_run(NULL, "render", "plane.gltf", "-o", "bad.exr", SMALL, __VA_ARGS__)
    assert_refused(TRY("--light-set", "disco"), 2, "three-point");
    assert_refused(TRY("--environment-rotation", "9"), 2, "--environment-rotation: there is no --environment to turn");
    assert_refused(TRY("--environment-exposure", "9"), 2, "--environment-exposure: there is no --environment");
    assert_refused(TRY("--environment-background", "maybe"), 2, "on");
    assert_refused(TRY("--environment-rotation", "nan", "--environment", "white.hdr"), 2, "--environment-rotation");
    assert_refused(TRY("--environment", "missing.hdr"), 1, "missing.hdr: cannot be read");
    assert_refused(TRY("--environment", "square.hdr"), 1,
                   "square.hdr: has 1 x 1 pixels, expected a latitude-longitude");
    assert_refused(TRY("--environment", "plane.gltf"), 1, "plane.gltf");
    assert_int_equal(folder_count("."), 4); /* the scene, its buffer, two maps: no picture and no part of one */
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, enter, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(an_environment_lights_and_is_seen), TEST(the_background_can_be_left_out),
        TEST(every_light_set_lights_the_plane),  TEST(the_document_and_the_picture_name_their_light),
        TEST(light_that_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
