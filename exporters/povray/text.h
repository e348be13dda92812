/* The text of one file while it is written, and names that POV-Ray can read whatever the scene calls things. */
#ifndef EXPORTERS_POVRAY_TEXT_H
#define EXPORTERS_POVRAY_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "exporters/povray/linear.h"

/* Grows as it is written to. Running out of memory is remembered and asked for at the end. */
typedef struct text {
    char *bytes; /* ends in a zero once something was written */
    size_t length, capacity;
    bool failed;
} text;

void text_free(text *t);
void text_add(text *t, const char *bytes, size_t count);
/* printf. Numbers are written as %.9g, which keeps every float; the decimal point is that of the thread's locale, which
 * the exporter sets to C. */
void text_print(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* <x, y, z> */
void text_vector(text *t, vec v);
void text_color(text *t, const float rgb[3]);

enum { NAME_LENGTH = 80 };

/* Letters, digits and underscores of name, at most 40, after prefix and number: what POV-Ray takes for an identifier,
 * no keyword among them, and no two alike. */
void name_identifier(char out[NAME_LENGTH], const char *prefix, int number, const char *name);

/* name for a comment: one line of printable ASCII with no end of a comment in it; \xNN stands for other bytes, "..."
 * for what is beyond some 60. */
void name_comment(char out[NAME_LENGTH], const char *name);

/* The stem of a path as the name of files that neither a shell nor an .ini file takes for something else. */
void name_file(char out[NAME_LENGTH], const char *path);

#endif
