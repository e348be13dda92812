/* Runs the real glint command as a user would. Its streams are files, so that no pipe can fill up and block. */
#define _GNU_SOURCE /* memfd_create */
#include "run_glint.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

enum { COULD_NOT_START = 125 };

/* As root a new program gets every capability of the bounding set. Without these two it is held to the permissions of
 * files, as their owner. Becoming another user instead would not do: that user need not reach a checkout in root's
 * home. */
static bool give_up_rights_of_root(void)
{
    return prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0) == 0 &&
           prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH, 0, 0, 0) == 0;
}

static void set_up_child(const run_setup *setup)
{
    bool good = true;
    if (setup->folder)
        good = chdir(setup->folder) == 0;
    if (setup->file_size_limit > 0) {
        const struct rlimit limit = { (rlim_t)setup->file_size_limit, (rlim_t)setup->file_size_limit };
        good = good && setrlimit(RLIMIT_FSIZE, &limit) == 0;
    }
    if (setup->as_ordinary_user && geteuid() == 0)
        good = good && give_up_rights_of_root();
    if (!good)
        _exit(COULD_NOT_START);
}

static int memory_file(const char *content, size_t size)
{
    const int file = memfd_create("stream", 0);
    assert_true(file >= 0);
    if (size > 0)
        assert_int_equal(pwrite(file, content, size, 0), size);
    return file;
}

running glint_start(const run_setup *setup, const char *const *arguments)
{
    static const run_setup plain = { 0 };
    const run_setup *s = setup ? setup : &plain;
    const size_t input_size = s->input && s->input_size == 0 ? strlen(s->input) : s->input_size;
    running r = { .in = memory_file(s->input, input_size), .err = memory_file(NULL, 0) };
    r.out = s->output ? open(s->output, O_RDWR) : memory_file(NULL, 0);
    assert_true(r.out >= 0);
    r.pid = fork();
    assert_true(r.pid >= 0);
    if (r.pid == 0) {
        dup2(r.in, STDIN_FILENO);
        dup2(r.out, STDOUT_FILENO);
        dup2(r.err, STDERR_FILENO);
        set_up_child(s);
        execv(GLINT_COMMAND, (char *const *)arguments);
        _exit(COULD_NOT_START);
    }
    return r;
}

static char *content_of(int file)
{
    struct stat status;
    assert_int_equal(fstat(file, &status), 0);
    const size_t size = S_ISREG(status.st_mode) ? (size_t)status.st_size : 0;
    char *text = malloc(size + 1);
    assert_non_null(text);
    assert_int_equal(pread(file, text, size, 0), size);
    text[size] = '\0';
    close(file);
    return text;
}

outcome glint_wait(running *r)
{
    int status = 0;
    assert_int_equal(waitpid(r->pid, &status, 0), r->pid);
    close(r->in);
    const outcome o = { .exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                        .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                        .out = content_of(r->out),
                        .err = content_of(r->err) };
    assert_int_not_equal(o.exit_code, COULD_NOT_START);
    return o;
}

outcome glint_run_list(const run_setup *setup, const char *const *arguments)
{
    running r = glint_start(setup, arguments);
    return glint_wait(&r);
}

void outcome_free(outcome *o)
{
    free(o->out);
    free(o->err);
    *o = (outcome){ 0 };
}

void assert_exit(const outcome *o, int exit_code)
{
    if (o->exit_code != exit_code)
        fail_msg("exit code %d (signal %d), expected %d; standard error:\n%s", o->exit_code, o->signal, exit_code,
                 o->err);
}

void assert_says(const char *text, const char *wanted)
{
    if (!strstr(text, wanted))
        fail_msg("expected to find:\n%s\nin:\n%s", wanted, text);
}

void assert_refused(outcome o, int exit_code, const char *wanted)
{
    assert_exit(&o, exit_code);
    assert_string_equal(o.out, "");
    assert_says(o.err, wanted);
    outcome_free(&o);
}
