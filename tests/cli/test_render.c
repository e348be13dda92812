/* glint render as a user runs it: the same bytes from any number of threads, one JSON document, and pictures that are
 * whole. */
#include <pty.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "glint.h"
#include "io/image.h"
#include "run_glint.h"
#include "workplace.h"

#define SMALL "--size", "48x32", "--spp", "4"

/* Runs and expects success. */
#define render(...)                                                                                                    \
    do {                                                                                                               \
        outcome rendered = glint_run(NULL, "render", __VA_ARGS__);                                                     \
        assert_exit(&rendered, 0);                                                                                     \
        outcome_free(&rendered);                                                                                       \
    } while (0)

static image picture_of(const char *path)
{
    report r = { 0 };
    image i;
    if (!image_read(path, &i, &r))
        fail_msg("%s", r.error);
    return i;
}

static const float *pixel(const image *i, int x, int y, const char *channel)
{
    const int c = image_channel(i, channel);
    assert_true(c >= 0);
    return &i->pixels[((size_t)y * (size_t)i->width + (size_t)x) * (size_t)i->channel_count + (size_t)c];
}

static void one_thread_and_two_give_the_same_bytes(void **state)
{
    (void)state;
    render("plane.gltf", "-o", "one.exr", SMALL, "--material", "*=craft-glitter", "--aov", "--threads", "1");
    render("plane.gltf", "-o", "two.exr", SMALL, "--material", "*=craft-glitter", "--aov", "--threads", "2");
    assert_same_files("one.exr", "two.exr");
    render("plane.gltf", "-o", "one.png", SMALL, "--threads", "1");
    render("plane.gltf", "-o", "two.png", SMALL, "--threads", "2");
    assert_same_files("one.png", "two.png");
}

static void second_render_gives_the_same_bytes_over_the_first(void **state)
{
    (void)state;
    render("plane.gltf", "-o", "a.exr", SMALL);
    render("plane.gltf", "-o", "b.exr", SMALL);
    /* A time stamp in the file, in seconds, would differ. */
    const struct timespec second = { .tv_sec = 1 };
    nanosleep(&second, NULL);
    render("plane.gltf", "-o", "a.exr", SMALL);
    assert_same_files("a.exr", "b.exr");
}

/* What would make the test above pass if every render gave the same picture. */
static void options_reach_the_picture(void **state)
{
    (void)state;
    render("plane.gltf", "-o", "plain.exr", SMALL, "--material", "panel=craft-glitter");
    static const char *const options[][2] = {
        { "--seed", "1" },     { "--bounces", "0" },    { "--model", "smooth" },  { "--camera", "Close" },
        { "--camera", "1" },   { "--spp", "5" },        { "--variant", "night" }, { "--material", "panel=sand" },
        { "--size", "48x31" }, { "--tile", "0,0,8,8" },
    };
    size_t plain_size;
    char *plain = file_read("plain.exr", &plain_size);
    for (size_t i = 0; i < sizeof options / sizeof options[0]; ++i) {
        render("plane.gltf", "-o", "other.exr", SMALL, "--material", "panel=craft-glitter", options[i][0],
               options[i][1]);
        size_t size;
        char *other = file_read("other.exr", &size);
        if (size == plain_size && memcmp(plain, other, size) == 0)
            fail_msg("%s %s changes nothing", options[i][0], options[i][1]);
        free(other);
    }
    free(plain);
}

/* Metadata may differ. */
static void assert_same_pixels(const char *a_path, const char *b_path)
{
    image a = picture_of(a_path), b = picture_of(b_path);
    assert_true(a.width == b.width && a.height == b.height && a.channel_count == b.channel_count);
    assert_memory_equal(a.pixels, b.pixels,
                        sizeof *a.pixels * (size_t)a.width * (size_t)a.height * (size_t)a.channel_count);
    image_free(&a);
    image_free(&b);
}

static void camera_can_be_named_or_counted(void **state)
{
    (void)state;
    render("plane.gltf", "-o", "named.png", SMALL, "--camera", "Close");
    render("plane.gltf", "-o", "counted.png", SMALL, "--camera", "1");
    render("plane.gltf", "-o", "first.png", SMALL);
    render("plane.gltf", "-o", "main.png", SMALL, "--camera", "Main");
    assert_same_pixels("named.png", "counted.png");
    assert_same_pixels("first.png", "main.png");
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--camera", "2"), 1,
                   "plane.gltf: --camera '2' is unknown; there are: 0 'Main', 1 'Close'");
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--camera", "Far"), 1, "'Far' is unknown");
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", "--camera", "-1"), 1, "'-1' is unknown");
}

/* The camera's axis meets the panel; the corner of a wide picture does not. */
static void tile_is_a_part_of_the_whole_picture(void **state)
{
    (void)state;
    enum { X = 20, Y = 11, W = 9, H = 7 };
    render("plane.gltf", "-o", "whole.exr", SMALL, "--material", "*=craft-glitter");
    render("plane.gltf", "-o", "tile.exr", SMALL, "--material", "*=craft-glitter", "--tile", "20,11,9,7");
    image whole = picture_of("whole.exr"), tile = picture_of("tile.exr");
    assert_int_equal(tile.width, W);
    assert_int_equal(tile.height, H);
    assert_true(tile.x == X && tile.y == Y && tile.full_width == 48 && tile.full_height == 32);
    assert_int_equal(whole.full_width, 0);
    float sum = 0.0F;
    for (int y = 0; y < H; ++y) {
        for (int x = 0; x < W; ++x) {
            assert_true(*pixel(&tile, x, y, "R") == *pixel(&whole, X + x, Y + y, "R"));
            assert_true(*pixel(&tile, x, y, "A") == *pixel(&whole, X + x, Y + y, "A"));
            sum += *pixel(&tile, x, y, "R");
        }
    }
    assert_true(sum > 0.0F);
    image_free(&whole);
    image_free(&tile);
}

static void aov_adds_the_named_channels(void **state)
{
    (void)state;
    static const char *const names[] = { "R",        "G",        "B",        "A",        "smooth.R", "smooth.G",
                                         "smooth.B", "glints.N", "glints.p", "normal.X", "albedo.R", "depth.Z" };
    render("plane.gltf", "-o", "aov.exr", SMALL, "--aov");
    render("plane.gltf", "-o", "plain.exr", SMALL);
    image aov = picture_of("aov.exr"), plain = picture_of("plain.exr");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        assert_true(image_channel(&aov, names[i]) >= 0);
    assert_int_equal(plain.channel_count, 4);
    /* "Main" stands 2 m above the panel; a pixel sees it within cos(0.2) of the axis, and depth runs along the axis. */
    assert_float_equal(*pixel(&aov, 24, 16, "depth.Z"), 2.0F, 1e-4F);
    image_free(&aov);
    image_free(&plain);
}

static void exposure_brightens_the_png_alone(void **state)
{
    (void)state;
    render("plane.gltf", "-o", "plain.png", SMALL);
    render("plane.gltf", "-o", "zero.png", SMALL, "--exposure", "0");
    render("plane.gltf", "-o", "bright.png", SMALL, "--exposure", "1");
    assert_same_files("plain.png", "zero.png");
    image plain = picture_of("plain.png"), bright = picture_of("bright.png");
    /* One step doubles linear light. 8 bits round an sRGB value by at most .5 / 255, where linear light changes at most
     * 2.28 times as fast: once in the bright picture, twice in the plain one. */
    const float low = *pixel(&plain, 24, 16, "G"), high = *pixel(&bright, 24, 16, "G");
    assert_true(low > 0.0F && high < 1.0F);
    assert_float_equal(high, 2.0F * low, 3.0F * 0.5F / 255.0F * 2.28F);
    image_free(&plain);
    image_free(&bright);
}

static json_int_t integer_at(const json_t *document, const char *object, const char *key)
{
    const json_t *value = json_object_get(object ? json_object_get(document, object) : document, key);
    assert_true(json_is_integer(value));
    return json_integer_value(value);
}

static void json_is_one_document_about_the_render(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", SMALL, "--json", "--seed", "9");
    assert_exit(&o, 0);
    json_t *d = json_loads(o.out, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(d);
    assert_string_equal(json_string_value(json_object_get(d, "file")), "plane.gltf");
    assert_string_equal(json_string_value(json_object_get(d, "output")), "a.exr");
    assert_int_equal(json_integer_value(json_array_get(json_object_get(d, "size"), 0)), 48);
    assert_int_equal(json_integer_value(json_array_get(json_object_get(d, "size"), 1)), 32);
    assert_int_equal(integer_at(d, NULL, "spp"), 4);
    assert_int_equal(integer_at(d, NULL, "seed"), 9);
    assert_int_equal(integer_at(d, "rays", "camera"), 48 * 32 * 4);
    /* Nothing can stand between a plane that is alone and its lights, and the plan leaves their shadow rays out. */
    assert_int_equal(integer_at(d, "rays", "shadow"), 0);
    assert_true(integer_at(d, "evals", "smooth") > 0);
    assert_int_equal(integer_at(d, "evals", "glint"), 0);
    assert_true(integer_at(d, NULL, "peak_memory_bytes") > 1 << 20);
    static const char *const phases[] = { "read", "load", "build", "render", "write" };
    double sum = 0.0;
    for (size_t i = 0; i < sizeof phases / sizeof phases[0]; ++i)
        sum += json_real_value(json_object_get(json_object_get(d, "seconds"), phases[i]));
    const double total = json_real_value(json_object_get(json_object_get(d, "seconds"), "total"));
    assert_true(sum > 0.0 && sum <= total * (1.0 + 1e-6));
    assert_int_equal(json_array_size(json_object_get(d, "warnings")), 0);
    json_decref(d);
    outcome_free(&o);
}

static void json_tells_an_error_as_well(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "render", "missing.gltf", "-o", "a.exr", "--json");
    assert_exit(&o, 1);
    assert_says(o.err, "glint: missing.gltf: ");
    json_t *d = json_loads(o.out, JSON_REJECT_DUPLICATES, NULL);
    assert_says(json_string_value(json_object_get(d, "error")), "missing.gltf: ");
    json_decref(d);
    outcome_free(&o);
}

static void file_names_may_hold_anything(void **state)
{
    (void)state;
    static const char *const names[] = { "two words", "\xC3\xA4\xE2\x9C\xA8", "--size", "quote\"\\back",
                                         "new\nline", "not utf8 \xFF" };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char scene_name[64], picture_name[64];
        snprintf(scene_name, sizeof scene_name, "%s.gltf", names[i]);
        snprintf(picture_name, sizeof picture_name, "%s.exr", names[i]);
        scene_write(names[i]);
        outcome o = glint_run(NULL, "render", SMALL, "--json", "-o", picture_name, "--", scene_name);
        assert_exit(&o, 0);
        json_t *d = json_loads(o.out, 0, NULL);
        assert_non_null(d);
        if (!strchr(names[i], '\xFF'))
            assert_string_equal(json_string_value(json_object_get(d, "output")), picture_name);
        else
            assert_string_equal(json_string_value(json_object_get(d, "output")), "not utf8 \xEF\xBF\xBD.exr");
        json_decref(d);
        outcome_free(&o);
        assert_int_equal(access(picture_name, F_OK), 0);
    }
}

static void options_may_follow_and_precede_the_scene(void **state)
{
    (void)state;
    setenv("POSIXLY_CORRECT", "1", 1);
    render("plane.gltf", "--size=48x32", "--spp=4", "-oa.exr");
    unsetenv("POSIXLY_CORRECT");
    render("-o", "b.exr", "--spp", "9", "--spp", "4", "plane.gltf", "--size", "48x32");
    assert_same_files("a.exr", "b.exr");
}

static void scene_without_triangles_is_rendered_with_a_warning(void **state)
{
    (void)state;
    file_write_text("empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}");
    outcome o = glint_run(NULL, "render", "empty.gltf", "-o", "empty.png", SMALL);
    assert_exit(&o, 0);
    assert_says(o.err, "glint: warning: empty.gltf: nothing to see: no triangles");
    outcome_free(&o);
}

static void log_without_a_terminal_stays_plain(void **state)
{
    (void)state;
    outcome o = glint_run(NULL, "render", "plane.gltf", "-o", "a.exr", SMALL);
    assert_exit(&o, 0);
    assert_null(strchr(o.err, '\r'));
    assert_null(strchr(o.err, '\033'));
    assert_says(o.out, "a.exr: 48x32, 4 spp, ");
    outcome_free(&o);
}

/* Everything that the command writes to a terminal of its own. */
static void read_terminal(int terminal, char *text, size_t size)
{
    size_t length = 0;
    /* Linux ends the reading of a terminal that nobody has open any more with EIO. */
    for (ssize_t got; length + 1 < size && (got = read(terminal, text + length, size - 1 - length)) > 0;)
        length += (size_t)got;
    text[length] = '\0';
}

static void terminal_shows_a_bar_and_then_the_result(void **state)
{
    (void)state;
    int terminal;
    const struct winsize window = { .ws_row = 24, .ws_col = 100 };
    const pid_t child = forkpty(&terminal, NULL, NULL, &window);
    assert_true(child >= 0);
    if (child == 0) {
        execl(GLINT_COMMAND, "glint", "render", "plane.gltf", "-o", "a.exr", SMALL, (char *)NULL);
        _exit(1);
    }
    char text[65536];
    read_terminal(terminal, text, sizeof text);
    close(terminal);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_says(text, "\r\033[K[");
    assert_says(text, " %, 0:0");
    assert_says(text, " elapsed");
    assert_says(text, "\r\033[Ka.exr: 48x32, 4 spp, ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(one_thread_and_two_give_the_same_bytes, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(second_render_gives_the_same_bytes_over_the_first, workplace_enter_plane,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(options_reach_the_picture, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(camera_can_be_named_or_counted, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(tile_is_a_part_of_the_whole_picture, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(aov_adds_the_named_channels, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(exposure_brightens_the_png_alone, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(json_is_one_document_about_the_render, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(json_tells_an_error_as_well, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(file_names_may_hold_anything, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(options_may_follow_and_precede_the_scene, workplace_enter_plane,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(scene_without_triangles_is_rendered_with_a_warning, workplace_enter_plane,
                                        workplace_leave),
        cmocka_unit_test_setup_teardown(log_without_a_terminal_stays_plain, workplace_enter_plane, workplace_leave),
        cmocka_unit_test_setup_teardown(terminal_shows_a_bar_and_then_the_result, workplace_enter_plane,
                                        workplace_leave),
    };
    return cmocka_run_group_tests_name("render", tests, NULL, NULL);
}
