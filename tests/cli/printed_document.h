/* The JSON document that a command printed, read by another library than the one that wrote it. */
#ifndef TESTS_PRINTED_DOCUMENT_H
#define TESTS_PRINTED_DOCUMENT_H

#include <jansson.h>

#include "run_glint.h"

/* Fails the test unless the command ended with 0 and printed one document; the test gives it back. */
static inline json_t *printed_document(const outcome *o)
{
    assert_exit(o, 0);
    json_error_t error;
    json_t *d = json_loads(o->out, JSON_REJECT_DUPLICATES, &error);
    if (!d)
        fail_msg("%s in:\n%s", error.text, o->out);
    return d;
}

#endif
