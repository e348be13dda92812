/* JSON for --json: a tree that is built key by key and printed whole. Jansson does the work; document.c alone includes
 * it. */
#ifndef CLI_DOCUMENT_H
#define CLI_DOCUMENT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* An object or an array. What cannot be stored for lack of memory is remembered, and document_print then fails. */
typedef struct document document;

document *document_object(void);
document *document_array(void);
/* NULL is allowed. */
void document_free(document *d);

/* Keys keep their order. Bytes that are not UTF-8 (file names may hold any) become U+FFFD. */
void document_set_text(document *object, const char *key, const char *text);
void document_set_boolean(document *object, const char *key, bool value);
/* At most 2^63 - 1. */
void document_set_integer(document *object, const char *key, uint64_t value);
/* Nine significant digits: every float survives; null where the value is not finite. */
void document_set_number(document *object, const char *key, double value);
void document_set_numbers(document *object, const char *key, const float *values, int count);
/* These take the child over. */
void document_set(document *object, const char *key, document *child);
void document_append(document *array, document *child);
void document_append_text(document *array, const char *text);
void document_append_integer(document *array, uint64_t value);
void document_append_numbers(document *array, const float *values, int count);

/* Prints on one line, without a newline, and frees. False when memory ran out or the stream failed. */
bool document_print(document *d, FILE *out);

#endif
