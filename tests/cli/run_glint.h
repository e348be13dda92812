/* Runs the real glint command as a user would and keeps what it said. */
#ifndef TESTS_RUN_GLINT_H
#define TESTS_RUN_GLINT_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct run_setup {
    const char *input;     /* standard input; NULL: empty */
    size_t input_size;     /* 0: that of the text */
    const char *output;    /* path that standard output goes to; NULL: kept */
    const char *folder;    /* working folder; NULL: the test's own */
    long file_size_limit;  /* bytes; 0: none */
    bool as_ordinary_user; /* gives up root's right to write anywhere, if the test has it */
} run_setup;

typedef struct outcome {
    int exit_code; /* -1 when a signal ended it */
    int signal;    /* 0 unless a signal ended it */
    char *out, *err;
} outcome;

typedef struct running {
    pid_t pid;
    int in, out, err; /* files of the child's standard streams */
} running;

running glint_start(const run_setup *setup, const char *const *arguments);
outcome glint_wait(running *r);
void outcome_free(outcome *o);

/* glint_run(NULL, "render", "a.gltf", "-o", "a.exr") */
outcome glint_run_list(const run_setup *setup, const char *const *arguments);
#define glint_run(setup, ...) glint_run_list(setup, (const char *const[]){ "glint", __VA_ARGS__, NULL })

/* Fails the test with what the command said unless it ended with this exit code. */
void assert_exit(const outcome *o, int exit_code);
/* Fails unless the text is in there. */
void assert_says(const char *text, const char *wanted);
/* Exit code, an empty standard output, and a message that holds the text; frees. */
void assert_refused(outcome o, int exit_code, const char *wanted);

#endif
