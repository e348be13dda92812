/* Progress: plain lines that a log can hold, a bar that fits its terminal, and signals that stop once and kill twice.
 */
#include <math.h>
#include <pty.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "cli/interrupt.h"
#include "cli/progress.h"

enum { LINE_SIZE = 1024 };

static void log_gets_one_line_every_five_seconds(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    progress p = progress_begin(out);
    for (int i = 0; i <= 200; ++i)
        progress_update(i / 200.0, i * 0.1, 20.0 - i * 0.1, &p);
    progress_end(&p);
    fclose(out);
    assert_string_equal(text, "glint: 25 %, 0:05 elapsed, 0:15 left\n"
                              "glint: 50 %, 0:10 elapsed, 0:10 left\n"
                              "glint: 75 %, 0:15 elapsed, 0:05 left\n"
                              "glint: 100 %, 0:20 elapsed, 0:00 left\n");
    free(text);
}

static void unknown_time_left_is_not_shown(void **state)
{
    (void)state;
    static const double unknown[] = { -1.0, (double)INFINITY, (double)NAN };
    for (int i = 0; i < 3; ++i) {
        char *text = NULL;
        size_t size;
        FILE *out = open_memstream(&text, &size);
        progress p = progress_begin(out);
        progress_update(i == 2 ? (double)NAN : 0.0, 3723.0, unknown[i], &p);
        fclose(out);
        assert_string_equal(text, "glint: 0 %, 1:02:03 elapsed\n");
        free(text);
    }
}

/* What stands on the terminal's line after the last return to its start. */
static void last_drawn(int terminal, FILE *out, char line[LINE_SIZE])
{
    char all[LINE_SIZE];
    size_t length = 0;
    /* A terminal hands on what was written in pieces and after a while: this comes last. */
    fputc('\a', out);
    fflush(out);
    do {
        const ssize_t piece = read(terminal, all + length, sizeof all - length);
        assert_true(piece > 0);
        length += (size_t)piece;
    } while (all[length - 1] != '\a');
    all[length - 1] = '\0';
    assert_null(strchr(all, '\n'));
    static const char start[] = "\r\033[K";
    const char *last = all;
    for (const char *next = all; (next = strstr(next, start)) != NULL; next += strlen(start))
        last = next + strlen(start);
    memmove(line, last, strlen(last) + 1);
}

static void draw_on_terminal(unsigned short columns, double fraction, char line[LINE_SIZE])
{
    int terminal, user_side;
    const struct winsize window = { .ws_row = 24, .ws_col = columns };
    assert_int_equal(openpty(&terminal, &user_side, NULL, NULL, &window), 0);
    FILE *out = fdopen(user_side, "w");
    progress p = progress_begin(out);
    progress_update(fraction / 2.0, 1.0, 9.0, &p);
    progress_update(fraction, 30.0, 45.0, &p);
    last_drawn(terminal, out, line);
    progress_end(&p);
    char rest[LINE_SIZE];
    last_drawn(terminal, out, rest);
    assert_string_equal(rest, "");
    fclose(out);
    close(terminal);
}

static void terminal_gets_a_bar_with_percent_elapsed_and_left(void **state)
{
    (void)state;
    char line[LINE_SIZE];
    draw_on_terminal(120, 0.45, line);
    assert_string_equal(line, "[##################......................]  45 %, 0:30 elapsed, 0:45 left");
    draw_on_terminal(120, 1.5, line);
    assert_string_equal(line, "[########################################] 100 %, 0:30 elapsed, 0:45 left");
}

static void bar_fits_any_terminal(void **state)
{
    (void)state;
    for (unsigned short columns = 1; columns <= 130; ++columns) {
        char line[LINE_SIZE];
        draw_on_terminal(columns, 0.45, line);
        assert_true(strlen(line) < columns);
    }
}

/* Runs the body in a process of its own and returns how that ended. */
static int status_of_child(void (*body)(void))
{
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void interrupt_once(void)
{
    const atomic_bool *cancel = interrupt_watch();
    if (atomic_load(cancel) || interrupt_exit_code() != 0)
        _exit(1);
    raise(SIGINT);
    if (!atomic_load(cancel) || interrupt_exit_code() != 130)
        _exit(2);
}

static void interrupt_twice(void)
{
    interrupt_once();
    raise(SIGINT);
}

static void interrupt_while_ignored(void)
{
    signal(SIGINT, SIG_IGN);
    const atomic_bool *cancel = interrupt_watch();
    raise(SIGINT);
    if (atomic_load(cancel))
        _exit(1);
}

static void first_interrupt_asks_to_stop_and_the_second_kills(void **state)
{
    (void)state;
    const int once = status_of_child(interrupt_once);
    assert_true(WIFEXITED(once));
    assert_int_equal(WEXITSTATUS(once), 0);
    const int twice = status_of_child(interrupt_twice);
    assert_true(WIFSIGNALED(twice));
    assert_int_equal(WTERMSIG(twice), SIGINT);
}

static void ignored_interrupt_stays_ignored(void **state)
{
    (void)state;
    const int status = status_of_child(interrupt_while_ignored);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(log_gets_one_line_every_five_seconds),
        cmocka_unit_test(unknown_time_left_is_not_shown),
        cmocka_unit_test(terminal_gets_a_bar_with_percent_elapsed_and_left),
        cmocka_unit_test(bar_fits_any_terminal),
        cmocka_unit_test(first_interrupt_asks_to_stop_and_the_second_kills),
        cmocka_unit_test(ignored_interrupt_stays_ignored),
    };
    return cmocka_run_group_tests_name("progress", tests, NULL, NULL);
}
