/* What the subcommands say on standard error, and the clock they time themselves with. */
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "cli/command.h"

static void warn(const char *text, void *user)
{
    messages *m = user;
    /* A progress bar may stand on the line. */
    fprintf(stderr, "%sglint: warning: %s\n", isatty(STDERR_FILENO) ? "\r\033[K" : "", text);
    if (m->warnings)
        document_append_text(m->warnings, text);
}

void messages_begin(messages *m, bool json)
{
    *m = (messages){ .report = { .warn = warn, .user = m }, .warnings = json ? document_array() : NULL };
}

void messages_end(messages *m)
{
    document_free(m->warnings);
    m->warnings = NULL;
}

int messages_fail(messages *m)
{
    fprintf(stderr, "glint: %s\n", m->report.error);
    if (m->warnings) {
        document *d = document_object();
        document_set_text(d, "error", m->report.error);
        document_set(d, "warnings", m->warnings);
        m->warnings = NULL;
        print_document(d);
    }
    return COMMAND_BAD_INPUT;
}

int print_document(document *d)
{
    if (document_print(d, stdout) && putchar('\n') != EOF)
        return COMMAND_DONE;
    /* main() tells of a stream that failed. */
    if (!ferror(stdout))
        fputs("glint: out of memory for the JSON document\n", stderr);
    return COMMAND_BAD_INPUT;
}

double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
