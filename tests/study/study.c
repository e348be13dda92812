/* What the programs of the study share: their command line, the tables that they write, and the bounds that did not
 * hold. */
#include "study.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void give_up(const char *what)
{
    fprintf(stderr, "%s: %s\n", what, strerror(errno));
    exit(1);
}

study study_start(int argc, char **argv)
{
    study s = { 0 };
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--short") == 0)
            s.is_short = 1;
        else if (strcmp(argv[i], "--middle") == 0)
            s.is_middle = 1;
        else if (argv[i][0] != '-' && !s.folder)
            s.folder = argv[i];
        else
            s.checks = -1;
    if (!s.folder || s.checks < 0 || (s.is_short && s.is_middle)) {
        fprintf(stderr, "usage: %s [--short | --middle] FOLDER\n", argv[0]);
        exit(2);
    }
    if (mkdir(s.folder, 0777) != 0 && errno != EEXIST)
        give_up(s.folder);
    return s;
}

const char *study_path(const study *s, const char *name)
{
    static char path[4096];
    snprintf(path, sizeof(path), "%s/%s", s->folder, name);
    return path;
}

FILE *study_open(const study *s, const char *name)
{
    const char *path = study_path(s, name);
    FILE *file = fopen(path, "w");
    if (!file)
        give_up(path);
    /* Line by line: whoever waits for half an hour sees how far it is. */
    setvbuf(file, NULL, _IOLBF, BUFSIZ);
    return file;
}

void study_close(FILE *file)
{
    if (ferror(file) || fclose(file) != 0)
        give_up("a table of the study");
}

void study_check(study *s, int holds, const char *format, ...)
{
    s->checks++;
    if (holds)
        return;
    s->failed++;
    va_list list;
    va_start(list, format);
    fputs("beyond its bound: ", stdout);
    vprintf(format, list);
    putchar('\n');
    va_end(list);
}

int study_end(const study *s)
{
    printf("%d bounds, %d do not hold\n", s->checks, s->failed);
    return s->failed != 0;
}
