/* How far long work is: a bar on a terminal, a plain line every few seconds anywhere else. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct progress {
    FILE *out;
    int columns;   /* width of the terminal; 0: not a terminal */
    double next_s; /* elapsed time from which on the next line is due */
} progress;

/* Looks at the terminal behind out, if there is one. */
progress progress_begin(FILE *out);
/* The callback of preview_options, with a progress as user: fraction in [0, 1], times in seconds; a time left that is
 * negative or not finite is not known yet. */
void progress_update(double fraction, double elapsed_s, double left_s, void *user);
/* Clears the bar, so that the next message starts on an empty line. */
void progress_end(progress *p);

#endif
