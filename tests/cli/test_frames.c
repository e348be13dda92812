/* glint render --frames as a farm runs it: names, resume, the same bits alone and in a range, glints that stay on their
 * surface. */
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "io/image.h"
#include "printed_document.h"
#include "workplace.h"

#define SMALL "--size", "40x30", "--spp", "4", "--material", "*=craft-glitter"

static void succeed(outcome o)
{
    assert_exit(&o, 0);
    outcome_free(&o);
}

#define render(scene, ...) succeed(glint_run(NULL, "render", scene, SMALL, __VA_ARGS__))

/* Seconds and what moves, behind the plane of scene_write in one buffer. */
typedef struct keys {
    float position[4][3], normal[4][3], texcoord[4][2];
    uint16_t index[6];
    float times[48], values[48][3];
} keys;

static const keys plane = {
    .position = { { -0.5F, 0.0F, -0.5F }, { -0.5F, 0.0F, 0.5F }, { 0.5F, 0.0F, 0.5F }, { 0.5F, 0.0F, -0.5F } },
    .normal = { { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F }, { 0.0F, 1.0F, 0.0F } },
    .texcoord = { { 0.0F, 0.0F }, { 0.0F, 1.0F }, { 1.0F, 1.0F }, { 1.0F, 0.0F } },
    .index = { 0, 1, 2, 0, 2, 3 },
};

/* A plane under a directional light, seen by a camera from above: nodes 0, 1 and 2 below node 3. */
#define NODES(plane_at, camera_at, all_at)                                                                             \
    "\"nodes\": [{ \"mesh\": 0, \"translation\": [" plane_at "] },"                                                    \
    "  { \"camera\": 0, \"translation\": [" camera_at "], \"rotation\": [-0.70710678, 0, 0, 0.70710678] },"            \
    "  { \"rotation\": [-0.70710678, 0, 0, 0.70710678], \"extensions\": { \"KHR_lights_punctual\": { \"light\": 0 } "  \
    "} },"                                                                                                             \
    "  { \"children\": [0, 1, 2], \"translation\": [" all_at "] }]"

#define MOVES(node, path, interpolation)                                                                               \
    ", \"animations\": [{ \"name\": \"Move\","                                                                         \
    "  \"samplers\": [{ \"input\": 4, \"output\": 5, \"interpolation\": \"" interpolation "\" }],"                     \
    "  \"channels\": [{ \"sampler\": 0, \"target\": { \"node\": " node ", \"path\": \"" path "\" } }] }]"

#define AT_REST NODES("0, 0, 0", "0, 2, 0", "0, 0, 0")

static void write_scene(const char *name, const keys *k, int key_count, const char *nodes, const char *animations)
{
    char path[64], text[4096];
    snprintf(path, sizeof path, "%s.bin", name);
    file_write(path, k, sizeof *k);
    snprintf(
        text, sizeof text,
        "{ \"asset\": { \"version\": \"2.0\" }, \"extensionsUsed\": [\"KHR_lights_punctual\"],"
        "  \"extensions\": { \"KHR_lights_punctual\": { \"lights\": [{ \"type\": \"directional\", \"intensity\": 3 }] "
        "} },"
        "  \"buffers\": [{ \"uri\": \"%s\", \"byteLength\": %zu }],"
        "  \"bufferViews\": [{ \"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48 },"
        "    { \"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 48 },"
        "    { \"buffer\": 0, \"byteOffset\": 96, \"byteLength\": 32 },"
        "    { \"buffer\": 0, \"byteOffset\": 128, \"byteLength\": 12 },"
        "    { \"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu },"
        "    { \"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu }],"
        "  \"accessors\": [{ \"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\" },"
        "    { \"bufferView\": 1, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\" },"
        "    { \"bufferView\": 2, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC2\" },"
        "    { \"bufferView\": 3, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\" },"
        "    { \"bufferView\": 4, \"componentType\": 5126, \"count\": %d, \"type\": \"SCALAR\" },"
        "    { \"bufferView\": 5, \"componentType\": 5126, \"count\": %d, \"type\": \"VEC3\" }],"
        "  \"meshes\": [{ \"primitives\": [{ \"attributes\": { \"POSITION\": 0, \"NORMAL\": 1, \"TEXCOORD_0\": 2 },"
        "    \"indices\": 3 }] }],"
        "  \"cameras\": [{ \"type\": \"perspective\", \"perspective\": { \"yfov\": 0.4, \"znear\": 0.01 } }],"
        "  \"scenes\": [{ \"nodes\": [3] }], %s %s }",
        path, sizeof *k, offsetof(keys, times), sizeof k->times, offsetof(keys, values), sizeof k->values, key_count,
        key_count, nodes, animations);
    snprintf(path, sizeof path, "%s.gltf", name);
    file_write_text(path, text);
}

/* From the first place to the second in two seconds. */
static void write_moving(const char *name, const char *moves, const float from[3], const float to[3])
{
    keys k = plane;
    k.times[1] = 2.0F;
    memcpy(k.values[0], from, sizeof k.values[0]);
    memcpy(k.values[1], to, sizeof k.values[1]);
    write_scene(name, &k, 2, AT_REST, moves);
}

/* The camera dives to the right. */
static int enter_dive(void **state)
{
    const int result = workplace_enter(state);
    if (result == 0)
        write_moving("dive", MOVES("1", "translation", "LINEAR"), (float[]){ 0, 2, 0 }, (float[]){ 0.25F, 1, 0 });
    return result;
}

static image picture_of(const char *path)
{
    report r = { 0 };
    image i;
    if (!image_read(path, &i, &r))
        fail_msg("%s", r.error);
    return i;
}

static bool same_pixels(const char *a_path, const char *b_path)
{
    image a = picture_of(a_path), b = picture_of(b_path);
    assert_true(a.width == b.width && a.height == b.height && a.channel_count == b.channel_count);
    const bool same = memcmp(a.pixels, b.pixels,
                             sizeof *a.pixels * (size_t)a.width * (size_t)a.height * (size_t)a.channel_count) == 0;
    image_free(&a);
    image_free(&b);
    return same;
}

static void assert_absent(const char *path)
{
    if (access(path, F_OK) == 0)
        fail_msg("%s is there", path);
}

/* Half-way, frame 24 of 24 a second, is the middle of both places, which binary numbers hold. */
static void frame_is_the_picture_of_a_scene_that_was_posed_by_hand(void **state)
{
    (void)state;
    write_scene("still", &plane, 2, NODES("0, 0, 0", "0.125, 1.5, 0", "0, 0, 0"), "");
    render("still.gltf", "-o", "still.exr", "--aov");
    render("dive.gltf", "-o", "dive.exr", "--frames", "24", "--aov");
    assert_true(same_pixels("still.exr", "dive.0024.exr"));
    render("dive.gltf", "-o", "ten.exr", "--frames", "10-10", "--fps", "10", "--aov");
    assert_true(same_pixels("still.exr", "ten.0010.exr"));
    render("dive.gltf", "-o", "rest.exr", "--aov");
    assert_false(same_pixels("still.exr", "rest.exr"));
}

static void frame_has_the_same_bits_alone_and_in_a_range(void **state)
{
    (void)state;
    render("dive.gltf", "-o", "range.exr", "--frames", "3-6", "--threads", "2");
    render("dive.gltf", "-o", "alone.exr", "--frames", "5", "--threads", "1");
    assert_same_files("range.0005.exr", "alone.0005.exr");
    assert_false(same_pixels("range.0005.exr", "range.0006.exr"));
    /* Lights and views that the command line or glint brings do not depend on the range either. */
    render("dive.gltf", "-o", "lit.exr", "--frames", "0-2", "--light-set", "three-point");
    render("dive.gltf", "-o", "one.exr", "--frames", "2", "--light-set", "three-point");
    assert_same_files("lit.0002.exr", "one.0002.exr");
}

static void frames_are_numbered_in_the_name(void **state)
{
    (void)state;
    static const struct {
        const char *output, *frames, *made[2];
    } cases[] = {
        { "out.exr", "7-8", { "out.0007.exr", "out.0008.exr" } },
        { "shot_##.png", "9-10", { "shot_09.png", "shot_10.png" } },
        { "a#b.######.exr", "12", { "a#b.000012.exr", NULL } },
        { "#.png", "99-100", { "99.png", "100.png" } },
        { "v.1.png", "123456", { "v.1.123456.png", NULL } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        render("dive.gltf", "-o", cases[i].output, "--frames", cases[i].frames);
        for (int k = 0; k < 2 && cases[i].made[k]; ++k)
            if (access(cases[i].made[k], F_OK) != 0)
                fail_msg("%s: no %s", cases[i].output, cases[i].made[k]);
        assert_absent(cases[i].output);
    }
    assert_int_equal(folder_count("."), 2 + 8);
    assert_int_equal(mkdir("f#", 0755), 0);
    render("dive.gltf", "-o", "f#/out.exr", "--frames", "1"); /* in the name of a folder it is a letter */
    assert_int_equal(access("f#/out.0001.exr", F_OK), 0);
}

/* 24ths of a second are no binary numbers: a time that were not rounded as the keys are would fall short of some. */
static void frame_that_lies_on_a_key_shows_it(void **state)
{
    (void)state;
    static const float rates[] = { 24.0F, 30.0F };
    for (int i = 0; i < 2; ++i) {
        keys k = plane;
        for (int f = 0; f < 12; ++f) {
            k.times[f] = (float)f / rates[i];
            k.values[f][0] = k.values[f][1] = k.values[f][2] = f % 2 == 0 ? 1.0F : 0.0F; /* there, gone */
        }
        write_scene("blink", &k, 12, AT_REST, MOVES("0", "scale", "STEP"));
        succeed(glint_run(NULL, "render", "blink.gltf", "-o", i == 0 ? "24.exr" : "30.exr", "--frames", "0-11", "--fps",
                          i == 0 ? "24" : "30", "--size", "8x8", "--spp", "1", "--aov"));
        for (int f = 0; f < 12; ++f) {
            char path[32];
            snprintf(path, sizeof path, "%d.%04d.exr", i == 0 ? 24 : 30, f);
            image p = picture_of(path);
            const int depth = image_channel(&p, "depth.Z");
            const bool seen = p.pixels[36 * p.channel_count + depth] > 0.0F;
            image_free(&p);
            if (seen != (f % 2 == 0))
                fail_msg("frame %d of %g a second: the plane is %s", f, (double)rates[i], seen ? "there" : "gone");
        }
    }
}

/* Plane, camera and light move as one by binary numbers: the facets go along. Where the camera moves, others flash. */
static void glints_stay_on_their_surface(void **state)
{
    (void)state;
    const float to[3] = { 4.0F, -2.0F, 8.0F };
    write_moving("ride", MOVES("3", "translation", "LINEAR"), (float[]){ 0, 0, 0 }, to);
    render("ride.gltf", "-o", "ride.exr", "--frames", "0", "--size", "96x96");
    render("ride.gltf", "-o", "ride.exr", "--frames", "24", "--size", "96x96");
    succeed(glint_run(NULL, "compare", "ride.0000.exr", "ride.0024.exr", "--same-facets"));
    render("dive.gltf", "-o", "dive.exr", "--frames", "0", "--size", "96x96");
    render("dive.gltf", "-o", "dive.exr", "--frames", "4", "--size", "96x96");
    outcome o = glint_run(NULL, "compare", "dive.0000.exr", "dive.0004.exr", "--same-facets");
    assert_exit(&o, 1);
    outcome_free(&o);
}

/* Noise is the same in every frame, and so is a picture in which nothing moves. */
static void time_alone_changes_nothing(void **state)
{
    (void)state;
    write_moving("stay", MOVES("1", "translation", "LINEAR"), (float[]){ 0, 2, 0 }, (float[]){ 0, 2, 0 });
    render("stay.gltf", "-o", "stay.exr", "--frames", "0-40");
    render("stay.gltf", "-o", "still.exr");
    assert_true(same_pixels("stay.0000.exr", "stay.0040.exr"));
    assert_true(same_pixels("stay.0000.exr", "still.exr"));
}

/* Of the pixels that the plane covers; what is around is off. */
static double middle_of_plane(const char *path)
{
    image p = picture_of(path);
    const int alpha = image_channel(&p, "A");
    double sum = 0.0, covered = 0.0;
    for (int i = 0; i < p.width * p.height; ++i) {
        const double a = (double)p.pixels[i * p.channel_count + alpha];
        covered += a;
        sum += a * (i % p.width);
    }
    image_free(&p);
    assert_true(covered > 1.0);
    return sum / covered;
}

/* A file without cameras is framed once for all of its animation: the plane crosses the picture. */
static void view_of_glint_stands_still(void **state)
{
    (void)state;
    keys k = plane;
    k.times[1] = 2.0F;
    k.values[0][0] = -1.0F;
    k.values[1][0] = 1.0F;
    write_scene("bare", &k, 2, "\"nodes\": [{ \"mesh\": 0 }, {}, {}, { \"children\": [0] }]",
                MOVES("0", "translation", "LINEAR"));
    render("bare.gltf", "-o", "bare.exr", "--frames", "0", "--environment-background", "off");
    render("bare.gltf", "-o", "bare.exr", "--frames", "46-48", "--environment-background", "off");
    render("bare.gltf", "-o", "alone.exr", "--frames", "48", "--environment-background", "off");
    assert_same_files("bare.0048.exr", "alone.0048.exr");
    /* By two widths of the plane, of the three that the view holds, seen a little from the side. */
    assert_true(middle_of_plane("bare.0048.exr") - middle_of_plane("bare.0000.exr") > 40.0 / 3.0);
}

/* They stand around the view at time 0: as without frames there, and later not as around the view of then. */
static void lights_of_glint_stand_still(void **state)
{
    (void)state;
    render("dive.gltf", "-o", "set.exr", "--frames", "0", "--light-set", "three-point");
    render("dive.gltf", "-o", "set.exr", "--frames", "24", "--light-set", "three-point");
    render("dive.gltf", "-o", "rest.exr", "--light-set", "three-point");
    assert_true(same_pixels("set.0000.exr", "rest.exr"));
    write_scene("later", &plane, 2, NODES("0, 0, 0", "0.125, 1.5, 0", "0, 0, 0"), "");
    render("later.gltf", "-o", "later.exr", "--light-set", "three-point");
    assert_false(same_pixels("set.0024.exr", "later.exr"));
    /* The studio of a file without lights. */
    keys k = plane;
    k.times[1] = 2.0F;
    k.values[0][1] = k.values[1][1] = 2.0F;
    write_scene("unlit", &k, 2,
                "\"nodes\": [{ \"mesh\": 0 }, { \"camera\": 0, \"translation\": [0, 2, 0],"
                "  \"rotation\": [-0.70710678, 0, 0, 0.70710678] }, {}, { \"children\": [0, 1] }]",
                MOVES("1", "translation", "LINEAR"));
    render("unlit.gltf", "-o", "unlit.exr", "--frames", "0-1");
    render("unlit.gltf", "-o", "studio.exr");
    assert_true(same_pixels("unlit.0001.exr", "studio.exr"));
}

/* ---- resume ---- */

static struct timespec time_of(const char *path)
{
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    return s.st_mtim;
}

static void finished_frames_are_left(void **state)
{
    (void)state;
    static const char *const outputs[] = { "out.exr", "out.png" };
    for (int i = 0; i < 2; ++i) {
        char third[32], fourth[32];
        snprintf(third, sizeof third, "out.0003.%s", i == 0 ? "exr" : "png");
        snprintf(fourth, sizeof fourth, "out.0004.%s", i == 0 ? "exr" : "png");
        render("dive.gltf", "-o", outputs[i], "--frames", "2-3");
        const struct timespec before = time_of(third);
        outcome o = glint_run(NULL, "render", "dive.gltf", SMALL, "-o", outputs[i], "--frames", "2-4", "--json");
        json_t *d = printed_document(&o), *list = json_object_get(d, "frames");
        assert_int_equal(json_integer_value(json_object_get(d, "skipped")), 2);
        assert_int_equal(json_integer_value(json_object_get(d, "rendered")), 1);
        assert_int_equal(json_array_size(list), 3);
        assert_true(json_is_true(json_object_get(json_array_get(list, 1), "skipped")));
        assert_true(json_is_false(json_object_get(json_array_get(list, 2), "skipped")));
        assert_int_equal(json_integer_value(json_object_get(json_array_get(list, 2), "frame")), 4);
        assert_string_equal(json_string_value(json_object_get(json_array_get(list, 2), "output")), fourth);
        assert_true(fabs(json_number_value(json_object_get(json_array_get(list, 2), "time_s")) - 4.0 / 24.0) < 1e-8);
        json_decref(d);
        outcome_free(&o);
        const struct timespec after = time_of(third);
        assert_true(before.tv_sec == after.tv_sec && before.tv_nsec == after.tv_nsec);
        render("dive.gltf", "-o", outputs[i], "--frames", "3", "--overwrite");
        const struct timespec again = time_of(third);
        assert_true(again.tv_sec != after.tv_sec || again.tv_nsec != after.tv_nsec);
    }
}

static void frames_of_other_options_do_not_pass_for_finished(void **state)
{
    (void)state;
    static const struct {
        const char *const option[2], *says;
    } other[] = {
        { { "--spp", "5" }, "glint:spp \"4\", expected \"5\"" },
        { { "--seed", "1" }, "glint:seed" },
        { { "--fps", "25" }, "glint:fps \"24\", expected \"25\"" },
        { { "--animation", "Move" }, "glint:animation" },
        { { "--tile", "0,0,8,8" }, "glint:tile" },
        { { "--aov", "--aov" }, "glint:aov" },
        { { "--material", "*=sand" }, "glint:materials" },
        { { "--accuracy", "0.1" }, "glint:accuracy" },
    };
    render("dive.gltf", "-o", "out.exr", "--frames", "2");
    for (size_t i = 0; i < sizeof other / sizeof other[0]; ++i) {
        outcome o = glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.exr", "--frames", "1-3",
                              other[i].option[0], other[i].option[1]);
        assert_says(o.err, "out.0002.exr: was rendered with glint:");
        assert_says(o.err, "--overwrite renders it again");
        assert_refused(o, 1, other[i].says);
        assert_absent("out.0001.exr"); /* it was found before any work */
    }
    render("dive.gltf", "-o", "out.exr", "--frames", "2", "--spp", "5", "--overwrite");
    render("dive.gltf", "-o", "out.exr", "--frames", "1-3", "--spp", "5");
    render("dive.gltf", "-o", "out.png", "--frames", "2");
    assert_refused(glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.png", "--frames", "2", "--exposure", "1"),
                   1, "out.0002.png: was rendered with glint:exposure \"0\", expected \"1\"");
}

static void what_is_no_frame_does_not_pass_for_one(void **state)
{
    (void)state;
    render("dive.gltf", "-o", "still.exr");
    assert_int_equal(rename("still.exr", "out.0001.exr"), 0);
    assert_refused(glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.exr", "--frames", "1"), 1,
                   "out.0001.exr: is there and no frame that this glint has rendered; --overwrite replaces it");
    render("dive.gltf", "-o", "out.exr", "--frames", "1", "--overwrite");
    render("dive.gltf", "-o", "out.png", "--frames", "1");
    static const char *const outputs[] = { "out.exr", "out.png" }, *const frames[] = { "out.0001.exr", "out.0001.png" };
    for (int i = 0; i < 2; ++i) {
        size_t size;
        char *content = file_read(frames[i], &size);
        file_write(frames[i], content, size - 1);
        free(content);
        outcome o = glint_run(NULL, "render", "dive.gltf", SMALL, "-o", outputs[i], "--frames", "1");
        assert_says(o.err, frames[i]);
        assert_refused(o, 1, ": is broken");
    }
    file_write_text("out.0002.exr", "no picture");
    assert_refused(glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.exr", "--frames", "2"), 1, "out.0002.exr");
    assert_file_holds("out.0002.exr", "no picture");
}

static void frames_older_than_their_scene_are_told_of(void **state)
{
    (void)state;
    render("dive.gltf", "-o", "out.exr", "--frames", "1-2");
    const struct timespec later[2] = { { .tv_sec = time_of("out.0002.exr").tv_sec + 60 },
                                       { .tv_sec = time_of("out.0002.exr").tv_sec + 60 } };
    assert_int_equal(utimensat(AT_FDCWD, "dive.gltf", later, 0), 0);
    outcome o = glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.exr", "--frames", "1-2");
    assert_says(o.err,
                "warning: dive.gltf: is newer than 2 finished frames, left as they are; --overwrite renders them");
    assert_exit(&o, 0);
    outcome_free(&o);
}

/* Stopped in the midst of many frames, the command leaves whole ones, and goes on where it was. */
static void interrupted_frames_go_on(void **state)
{
    (void)state;
    running r = glint_start(NULL, (const char *const[]){ "glint", "render", "dive.gltf", SMALL, "-o", "out.exr",
                                                         "--frames", "0-99999", NULL });
    const struct timespec moment = { .tv_nsec = 1000000 };
    for (int i = 0; i < 60000 && access("out.0002.exr", F_OK) != 0; ++i)
        nanosleep(&moment, NULL);
    assert_int_equal(kill(r.pid, SIGINT), 0);
    outcome o = glint_wait(&r);
    assert_exit(&o, 130);
    assert_says(o.err, "dive.gltf: interrupted; ");
    assert_says(o.err, " of its frames are finished, and the same command goes on");
    outcome_free(&o);
    render("dive.gltf", "-o", "out.exr", "--frames", "0-3");
    render("dive.gltf", "-o", "whole.exr", "--frames", "0-3");
    assert_same_files("out.0000.exr", "whole.0000.exr");
    assert_same_files("out.0003.exr", "whole.0003.exr");
}

/* ---- together with the rest ---- */

static void tiles_of_a_frame_merge(void **state)
{
    (void)state;
    render("dive.gltf", "-o", "whole.exr", "--frames", "4-5");
    render("dive.gltf", "-o", "a.exr", "--frames", "4-5", "--tile", "0,0,40,12");
    render("dive.gltf", "-o", "b.exr", "--frames", "4-5", "--tile", "0,12,40,18");
    succeed(glint_run(NULL, "merge", "a.0005.exr", "b.0005.exr", "-o", "merged.exr"));
    assert_same_files("whole.0005.exr", "merged.exr");
    assert_refused(glint_run(NULL, "merge", "a.0004.exr", "b.0005.exr", "-o", "none.exr"), 1,
                   "b.0005.exr: was rendered with glint:frame \"5\", expected \"4\" as in a.0004.exr");
}

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; ++at)
        ++count;
    return count;
}

static void warnings_come_once(void **state)
{
    (void)state;
    outcome o =
        glint_run(NULL, "render", "dive.gltf", SMALL, "-o", "out.exr", "--frames", "48-51", "--accuracy", "1e-6");
    assert_exit(&o, 0);
    assert_says(o.err, "dive.gltf: the animation ends at 2 s, frame 48; frames behind it all show its end");
    assert_int_equal(count_of(o.err, "--accuracy 1e-06 is not met: "), 1);
    assert_says(o.err, "--accuracy 1e-06 is not met in 4 frames");
    outcome_free(&o);
    assert_true(same_pixels("out.0048.exr", "out.0051.exr"));
    /* What was left out in each pose is said of the first. */
    keys k = plane;
    k.times[1] = 1.0F;
    k.values[0][0] = 0.1F;
    write_scene("flat", &k, 2, AT_REST, MOVES("0", "scale", "LINEAR"));
    o = glint_run(NULL, "render", "flat.gltf", SMALL, "-o", "flat.exr", "--frames", "0-3");
    assert_exit(&o, 0);
    assert_int_equal(count_of(o.err, "is scaled to nothing"), 1);
    outcome_free(&o);
}

static void wrong_usage_is_refused_before_anything_is_read(void **state)
{
    (void)state;
    static const char *const wrong[] = { "5-3", "-1",  "-3-5",  "1-", "-",   "x",
                                         "1-x", "1:3", "1-3-5", " 1", "1.5", "10000000" };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        char option[64];
        snprintf(option, sizeof option, "--frames=%s", wrong[i]);
        assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", option), 2, "expected A-B, whole numbers");
    }
    assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", "--fps", "24"), 2, "there are no --frames");
    assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", "--animation", "A"), 2,
                   "there are no --frames");
    assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", "--overwrite"), 2, "there are no --frames");
    assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", "--frames", "1", "--fps", "0"), 2,
                   "--fps '0'");
    assert_refused(glint_run(NULL, "render", "none.gltf", "-o", "a.exr", "--frames", "1"), 1, "none.gltf");
}

static void file_without_frames_is_refused(void **state)
{
    (void)state;
    write_scene("still", &plane, 2, AT_REST, "");
    assert_refused(glint_run(NULL, "render", "still.gltf", "-o", "a.exr", "--frames", "1-9"), 1,
                   "still.gltf: found no animation, expected one for its frames to show");
    assert_refused(glint_run(NULL, "render", "dive.gltf", "-o", "a.exr", "--frames", "1-9", "--animation", "Jump"), 1,
                   "dive.gltf: found no animation called \"Jump\", expected one of: 0 \"Move\"");
    assert_absent("a.0001.exr");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_dive, workplace_leave)
    const struct CMUnitTest tests[] = {
        TEST(frame_is_the_picture_of_a_scene_that_was_posed_by_hand),
        TEST(frame_has_the_same_bits_alone_and_in_a_range),
        TEST(frames_are_numbered_in_the_name),
        TEST(frame_that_lies_on_a_key_shows_it),
        TEST(glints_stay_on_their_surface),
        TEST(time_alone_changes_nothing),
        TEST(view_of_glint_stands_still),
        TEST(lights_of_glint_stand_still),
        TEST(finished_frames_are_left),
        TEST(frames_of_other_options_do_not_pass_for_finished),
        TEST(what_is_no_frame_does_not_pass_for_one),
        TEST(frames_older_than_their_scene_are_told_of),
        TEST(interrupted_frames_go_on),
        TEST(tiles_of_a_frame_merge),
        TEST(warnings_come_once),
        TEST(wrong_usage_is_refused_before_anything_is_read),
        TEST(file_without_frames_is_refused),
    };
    return cmocka_run_group_tests_name("frames", tests, NULL, NULL);
}
