/* What is left out, gathered: the same words about many places become one warning that names the first few. */
#ifndef EXPORTERS_POVRAY_NOTES_H
#define EXPORTERS_POVRAY_NOTES_H

#include "scene/report.h"

typedef struct note {
    char *what, *places;
    int count;
} note;

typedef struct notes {
    const char *input; /* the file that all of them are about */
    report told;       /* where they go in the end */
    note *list;
    int count, capacity;
} notes;

/* Takes the warnings of r: those of the reader, "INPUT: POINTER: TEXT", are gathered too. Tells nothing yet. */
void notes_begin(notes *n, const char *input, report *r);

/* place: as in messages, or NULL for the file as a whole. */
void notes_add(notes *n, const char *place, const char *what);

/* Tells all, in the order in which things were first noted, and frees. */
void notes_end(notes *n);

#endif
