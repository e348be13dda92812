/* Whatever goes wrong, a name shows the old file or the whole new one, and nothing else is left in the folder. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "files.h"
#include "io/image.h"
#include "io/output_file.h"

static void assert_contents(const char *path, const char *expected)
{
    bytes b = file_read(path);
    assert_int_equal(b.size, strlen(expected));
    assert_memory_equal(b.data, expected, b.size);
    free(b.data);
}

/* A disk that takes no more: a limit on the size of files, with the signal that goes with it ignored. */
static rlim_t limit_file_size(rlim_t byte_count)
{
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t before = limit.rlim_cur;
    limit.rlim_cur = byte_count;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    return before;
}

static bool write_text(const char *path, const char *text, report *r)
{
    output_file *f = output_file_open(path, r);
    if (!f)
        return false;
    output_file_write(f, text, strlen(text));
    return output_file_commit(f, r);
}

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

static void a_commit_replaces_the_file_and_leaves_nothing_else(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    report r = { 0 };
    assert_true(write_text(path, "old", &r));
    output_file *f = output_file_open(path, &r);
    assert_non_null(f);
    assert_true(output_file_write(f, "....", 4));
    assert_true(output_file_seek(f, 1));
    assert_true(output_file_write(f, "new", 3));
    assert_int_equal(output_file_tell(f), 4);
    assert_contents(path, "old");
    assert_true(output_file_commit(f, &r));
    assert_contents(path, ".new");
    assert_int_equal(folder_count(*state), 1);
}

static void an_abort_keeps_the_old_file(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    report r = { 0 };
    assert_true(write_text(path, "old", &r));
    output_file *f = output_file_open(path, &r);
    assert_non_null(f);
    output_file_write(f, "half of the ne", 14);
    output_file_abort(f);
    assert_contents(path, "old");
    assert_int_equal(folder_count(*state), 1);
    output_file_abort(NULL);
}

static void a_full_disk_keeps_the_old_file(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    report r = { 0 };
    assert_true(write_text(path, "old", &r));
    output_file *f = output_file_open(path, &r);
    assert_non_null(f);
    const rlim_t before = limit_file_size(10000);
    char block[4096] = { 0 };
    for (int i = 0; i < 100; i++)
        output_file_write(f, block, sizeof block);
    assert_false(output_file_write(f, block, sizeof block));
    const bool committed = output_file_commit(f, &r);
    limit_file_size(before);
    assert_false(committed);
    assert_non_null(strstr(r.error, path));
    assert_non_null(strstr(r.error, "File too large"));
    assert_contents(path, "old");
    assert_int_equal(folder_count(*state), 1);
}

/* The last bytes may wait in memory until the commit, which must not lose their failure. */
static void a_disk_that_fills_up_at_the_end_is_noticed(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    report r = { 0 };
    const rlim_t before = limit_file_size(2);
    const bool written = write_text(path, "three and more", &r);
    limit_file_size(before);
    assert_false(written);
    assert_non_null(strstr(r.error, "File too large"));
    assert_int_equal(folder_count(*state), 0);
}

static void pictures_on_a_full_disk_keep_the_old_file(void **state)
{
    report r = { 0 };
    image picture;
    assert_true(image_allocate(&picture, 256, 256, 3, &r));
    static const char *const names[3] = { "R", "G", "B" };
    for (int c = 0; c < 3; c++)
        assert_true(image_name_channel(&picture, c, names[c], "picture", &r));
    uint32_t random = 1;
    for (int i = 0; i < 256 * 256 * 3; i++) {
        random = random * 1664525U + 1013904223U;
        picture.pixels[i] = (float)(random >> 8) * 0x1p-24F;
    }
    const char *paths[2] = { folder_path(*state, "out.exr"), folder_path(*state, "out.png") };
    for (int i = 0; i < 2; i++) {
        r = (report){ 0 };
        file_write(paths[i], "old", 3);
        const rlim_t before = limit_file_size(20000);
        const bool written =
            i == 0 ? image_write_exr(paths[i], &picture, NULL, 0, &r) : image_write_png(paths[i], &picture, 0.0F, &r);
        limit_file_size(before);
        assert_false(written);
        assert_non_null(strstr(r.error, paths[i]));
        assert_non_null(strstr(r.error, "File too large"));
        assert_contents(paths[i], "old");
        assert_int_equal(folder_count(*state), i + 1);
    }
    image_free(&picture);
}

static void what_cannot_be_written_is_an_error_before_the_work(void **state)
{
    char *folder = *state;
    char long_name[400];
    memset(long_name, 'x', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    const struct {
        const char *path, *reason;
    } cases[] = {
        { folder_path(folder, "missing/out.txt"), "No such file" },
        { folder, "is a folder" },
        { "/dev/null", "is a device" },
        { folder_path(folder, long_name), "File name too long" },
        { "", "expected the name of a file" },
        { "new/", "expected the name of a file" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        report r = { 0 };
        assert_false(output_file_check(cases[i].path, &r));
        if (!strstr(r.error, cases[i].path) || !strstr(r.error, cases[i].reason))
            fail_msg("found \"%s\", expected \"%s\"", r.error, cases[i].reason);
        assert_int_equal(folder_count(folder), 0);
    }
}

static void a_check_leaves_nothing_behind(void **state)
{
    report r = { 0 };
    assert_true(output_file_check(folder_path(*state, "out.txt"), &r));
    assert_int_equal(folder_count(*state), 0);
}

/* In a child, because root, who may write everywhere, has to become somebody else for good. */
static void a_folder_without_permission_is_an_error(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    assert_int_equal(chmod(*state, 0555), 0);
    const pid_t child = fork();
    if (child == 0) {
        report r = { 0 };
        const bool ready = geteuid() != 0 || setuid(65534) == 0;
        const bool refused = !write_text(path, "text", &r);
        _exit(ready && refused && strstr(r.error, path) && strstr(r.error, "Permission denied") ? 0 : 1);
    }
    int status = 1;
    assert_int_equal(waitpid(child, &status, 0), child);
    chmod(*state, 0755);
    assert_int_equal(status, 0);
    assert_int_equal(folder_count(*state), 0);
}

static void a_link_keeps_pointing_at_the_file_that_is_replaced(void **state)
{
    const char *path = folder_path(*state, "real.txt");
    const char *link_path = folder_path(*state, "link.txt");
    report r = { 0 };
    file_write(path, "old", 3);
    assert_int_equal(symlink("real.txt", link_path), 0);
    assert_true(write_text(link_path, "new", &r));
    struct stat status;
    assert_int_equal(lstat(link_path, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_contents(path, "new");
}

static void permissions_follow_the_umask_and_then_the_old_file(void **state)
{
    const char *path = folder_path(*state, "out.txt");
    report r = { 0 };
    struct stat status;
    const mode_t before = umask(027);
    assert_true(write_text(path, "first", &r));
    umask(before);
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    assert_int_equal(chmod(path, 0604), 0);
    assert_true(write_text(path, "second", &r));
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0604);
}

int main(void)
{
#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, drop_folder)
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(a_commit_replaces_the_file_and_leaves_nothing_else),
        IN_A_FOLDER(an_abort_keeps_the_old_file),
        IN_A_FOLDER(a_full_disk_keeps_the_old_file),
        IN_A_FOLDER(a_disk_that_fills_up_at_the_end_is_noticed),
        IN_A_FOLDER(pictures_on_a_full_disk_keep_the_old_file),
        IN_A_FOLDER(what_cannot_be_written_is_an_error_before_the_work),
        IN_A_FOLDER(a_check_leaves_nothing_behind),
        IN_A_FOLDER(a_folder_without_permission_is_an_error),
        IN_A_FOLDER(a_link_keeps_pointing_at_the_file_that_is_replaced),
        IN_A_FOLDER(permissions_follow_the_umask_and_then_the_old_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
