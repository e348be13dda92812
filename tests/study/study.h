/* What the programs of the study share: their command line, the tables that they write, and the bounds that did not
 * hold.
 *
 * NAME [--short | --middle] FOLDER writes FOLDER/NAME*.csv and exits with 1 when a bound did not hold. --short: what a
 * test has the time for. --middle: every row, in minutes, with wider bars where it takes more.
 */
#ifndef STUDY_H
#define STUDY_H

#include <stdio.h>

#include "material_or_exit.h"

typedef struct study {
    const char *folder;
    int is_short, is_middle;
    int checks, failed;
} study;

/* Reads the command line and makes the folder. A wrong one ends the program with 2. */
study study_start(int argc, char **argv);
/* Opens FOLDER/NAME for writing, or ends the program with 1. */
FILE *study_open(const study *s, const char *name);
/* A path in the folder; the text is valid until the next call. */
const char *study_path(const study *s, const char *name);
/* Closes what study_open gave; a file that could not be written whole ends the program with 1. */
void study_close(FILE *file);
/* Counts a bound, and says what was found where it does not hold. */
void study_check(study *s, int holds, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* The exit code. */
int study_end(const study *s);

#endif
