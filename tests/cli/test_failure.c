/* What goes wrong while glint render works: each failure names the thing, exits with 1, leaves the old picture and no
 * rest. */
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

#include "run_glint.h"
#include "workplace.h"

#define QUICK "--size", "8x8", "--spp", "1"
/* Hours of work: a failure that is found only after rendering runs into the test's time limit. */
#define LONG "--size", "4096x4096", "--spp", "65536"

static int enter(void **state)
{
    const int result = workplace_enter(state);
    if (result == 0) {
        scene_write("plane");
        file_write_text("old.exr", "old");
    }
    return result;
}

static void scene_that_cannot_be_read_is_named(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "missing.gltf", "-o", "old.exr", QUICK), 1, "glint: missing.gltf: ");
    assert_refused(glint_run(NULL, "render", ".", "-o", "old.exr", QUICK), 1, "glint: .: ");
    assert_int_equal(chmod("plane.gltf", 0), 0);
    assert_refused(glint_run(&(run_setup){ .as_ordinary_user = true }, "inspect", "plane.gltf"), 1,
                   "glint: plane.gltf: ");
    assert_file_holds("old.exr", "old");
}

static void scene_of_another_kind_is_named(void **state)
{
    (void)state;
    static const char *const contents[] = { "", "not a scene", "{", "[]", "\x89PNG\r\n\x1a\n", "{ \"asset\": 1 }" };
    for (size_t i = 0; i < sizeof contents / sizeof contents[0]; ++i) {
        file_write_text("wrong.gltf", contents[i]);
        file_write_text("wrong.glb", contents[i]);
        assert_refused(glint_run(NULL, "render", "wrong.gltf", "-o", "old.exr", QUICK), 1, "glint: wrong.gltf: ");
        assert_refused(glint_run(NULL, "render", "wrong.glb", "-o", "old.exr", QUICK), 1, "glint: wrong.glb: ");
        assert_refused(glint_run(NULL, "inspect", "wrong.glb"), 1, "glint: wrong.glb: ");
    }
    assert_file_holds("old.exr", "old");
}

/* Cut at every power of two, and one byte before the end. */
static void truncated_glb_is_named(void **state)
{
    (void)state;
    size_t size;
    char *content = file_read(GLINT_TEST_MODELS "/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", &size);
    for (size_t kept = 1; kept < size; kept *= 2) {
        file_write("cut.glb", content, kept);
        assert_refused(glint_run(NULL, "render", "cut.glb", "-o", "old.exr", QUICK), 1, "glint: cut.glb: ");
    }
    file_write("cut.glb", content, size - 1);
    assert_refused(glint_run(NULL, "render", "cut.glb", "-o", "old.exr", QUICK), 1, "glint: cut.glb: ");
    free(content);
    assert_file_holds("old.exr", "old");
}

static void number_that_is_not_finite_is_named(void **state)
{
    (void)state;
    static const char box[] = GLINT_TEST_MODELS "/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb";
    assert_refused(glint_run(NULL, "render", box, "-o", "old.exr", QUICK), 1, "BoxWithInfinites.glb: /accessors/");
    assert_file_holds("old.exr", "old");
}

static void unknown_names_list_what_is_near(void **state)
{
    (void)state;
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "old.exr", QUICK, "--material", "*=craft-gliter"), 1,
                   "craft-glitter");
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "old.exr", QUICK, "--material", "pannel=sand"), 1,
                   "panel");
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "old.exr", QUICK, "--variant", "nigt"), 1, "night");
    assert_file_holds("old.exr", "old");
}

static void output_that_cannot_be_written_is_found_before_the_work(void **state)
{
    (void)state;
    assert_int_equal(mkdir("folder.exr", 0755), 0);
    static const char *const places[] = { "missing/a.exr", "plane.gltf/a.exr", "folder.exr", "/proc/a.exr" };
    for (size_t i = 0; i < sizeof places / sizeof places[0]; ++i) {
        char message[64];
        snprintf(message, sizeof message, "glint: %s: ", places[i]);
        assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", places[i], LONG), 1, message);
    }
    assert_int_equal(mkdir("locked", 0555), 0);
    assert_refused(
        glint_run(&(run_setup){ .as_ordinary_user = true }, "render", "plane.gltf", "-o", "locked/a.exr", LONG), 1,
        "glint: locked/a.exr: ");
    assert_int_equal(folder_count("locked"), 0);
}

/* A limit on the size of a file fails a write as a full disk does, with "File too large" for "No space left". */
static void disk_that_fills_up_leaves_the_old_picture(void **state)
{
    (void)state;
    file_write_text("old.png", "old");
    static const char *const pictures[] = { "old.exr", "old.png" };
    for (int i = 0; i < 2; ++i) {
        const int before = folder_count(".");
        outcome o = glint_run(&(run_setup){ .file_size_limit = 1024 }, "render", "plane.gltf", "-o", pictures[i],
                              "--size", "64x64", "--spp", "1", "--material", "*=craft-glitter");
        assert_says(o.err, pictures[i]);
        assert_refused(o, 1, ": File too large");
        assert_file_holds(pictures[i], "old");
        assert_int_equal(folder_count("."), before);
    }
}

/* Whether the process catches the signal: only then may it be sent. */
static bool catches(pid_t process, int signal_number)
{
    char path[64], line[256];
    snprintf(path, sizeof path, "/proc/%ld/status", (long)process);
    FILE *status = fopen(path, "r");
    unsigned long long caught = 0;
    while (status && fgets(line, sizeof line, status))
        if (strncmp(line, "SigCgt:", 7) == 0)
            caught = strtoull(line + 7, NULL, 16);
    if (status)
        fclose(status);
    return (caught >> (signal_number - 1)) & 1U;
}

static void interrupt_after(const char *picture, int signal_number, int exit_code, long wait_ms)
{
    running r = glint_start(
        NULL, (const char *const[]){ "glint", "render", "plane.gltf", "-o", picture, LONG, "--threads", "2", NULL });
    const struct timespec moment = { .tv_nsec = 1000000 }, wait = { wait_ms / 1000, wait_ms % 1000 * 1000000 };
    for (int i = 0; i < 30000 && !catches(r.pid, signal_number); ++i)
        nanosleep(&moment, NULL);
    assert_true(catches(r.pid, signal_number));
    nanosleep(&wait, NULL);
    assert_int_equal(kill(r.pid, signal_number), 0);
    outcome o = glint_wait(&r);
    assert_exit(&o, exit_code);
    assert_says(o.err, "interrupted");
    assert_string_equal(o.out, "");
    outcome_free(&o);
}

/* At once, while the scene is read, and later, while rays fly. */
static void interrupt_leaves_the_old_picture(void **state)
{
    (void)state;
    const int before = folder_count(".");
    static const long waits_ms[] = { 0, 30, 1000 };
    for (size_t i = 0; i < sizeof waits_ms / sizeof waits_ms[0]; ++i) {
        interrupt_after("old.exr", SIGINT, 130, waits_ms[i]);
        interrupt_after("old.exr", SIGTERM, 143, waits_ms[i]);
        assert_file_holds("old.exr", "old");
        assert_int_equal(folder_count("."), before);
    }
}

static void picture_that_memory_cannot_hold_is_an_error(void **state)
{
    (void)state;
    /* 2^32 pixels of at least 16 bytes; a machine that can hold them would start to render them. */
    if ((double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) > 16.0 * 4294967296.0)
        skip();
    assert_refused(glint_run(NULL, "render", "plane.gltf", "-o", "old.exr", "--size", "65536x65536", "--aov"), 1,
                   "memory");
    assert_file_holds("old.exr", "old");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(scene_that_cannot_be_read_is_named, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(scene_of_another_kind_is_named, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(truncated_glb_is_named, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(number_that_is_not_finite_is_named, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(unknown_names_list_what_is_near, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(output_that_cannot_be_written_is_found_before_the_work, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(disk_that_fills_up_leaves_the_old_picture, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(interrupt_leaves_the_old_picture, enter, workplace_leave),
        cmocka_unit_test_setup_teardown(picture_that_memory_cannot_hold_is_an_error, enter, workplace_leave),
    };
    return cmocka_run_group_tests_name("failure", tests, NULL, NULL);
}
