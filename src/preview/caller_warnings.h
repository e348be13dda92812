/* What is left out or mended in a caller's scene, by the part of it that it concerns: a part that changes takes its
 * warnings along. */
#ifndef PREVIEW_CALLER_WARNINGS_H
#define PREVIEW_CALLER_WARNINGS_H

#include <stddef.h>

typedef enum caller_part { CALLER_MESHES, CALLER_LOOK, CALLER_LIGHTS, CALLER_WORLD, CALLER_PARTS } caller_part;

typedef struct caller_warnings {
    char *of_part[CALLER_PARTS]; /* a line each; NULL: none */
    char *all;                   /* joined; NULL: none */
    caller_part now;             /* whose warnings come next */
} caller_warnings;

/* report.warn: user is a caller_warnings. */
void caller_warnings_keep(const char *text, void *user);
/* Joins them. What memory has no room for is lost. */
void caller_warnings_join(caller_warnings *w);
/* Takes the place of the warnings of some parts. From is empty afterwards. */
void caller_warnings_move(caller_warnings *to, caller_warnings *from, caller_part part);
void caller_warnings_free(caller_warnings *w);

#endif
