/* JSON for --json, on Jansson. */
#include "cli/document.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* Stands where a byte is not UTF-8. */
#define REPLACEMENT_CHARACTER "\xEF\xBF\xBD"

struct document {
    json_t *json;
    bool whole;
};

static document *document_of(json_t *json)
{
    document *d = malloc(sizeof *d);
    if (d)
        *d = (document){ .json = json, .whole = json != NULL };
    else
        json_decref(json);
    return d;
}

document *document_object(void)
{
    return document_of(json_object());
}

document *document_array(void)
{
    return document_of(json_array());
}

void document_free(document *d)
{
    if (!d)
        return;
    json_decref(d->json);
    free(d);
}

/* Length of the UTF-8 sequence at text, 0 where there is none; json_stringn knows the rules. */
static size_t sequence_length(const char *text)
{
    const size_t left = strnlen(text, 4);
    for (size_t length = 1; length <= left; ++length) {
        json_t *one = json_stringn(text, length);
        if (one) {
            json_decref(one);
            return length;
        }
    }
    return 0;
}

static json_t *string_of(const char *text)
{
    json_t *string = json_string(text);
    if (string)
        return string;
    char *mended = malloc(strlen(text) * strlen(REPLACEMENT_CHARACTER) + 1);
    if (!mended)
        return NULL;
    char *end = mended;
    while (*text) {
        const size_t length = sequence_length(text);
        const char *from = length > 0 ? text : REPLACEMENT_CHARACTER;
        const size_t copied = length > 0 ? length : strlen(REPLACEMENT_CHARACTER);
        memcpy(end, from, copied);
        end += copied;
        text += length > 0 ? length : 1;
    }
    *end = '\0';
    string = json_string(mended);
    free(mended);
    return string;
}

/* json_real refuses what is not finite. */
static json_t *number_of(double value)
{
    json_t *number = json_real(value);
    return number ? number : json_null();
}

static void set(document *object, const char *key, json_t *value)
{
    if (!object)
        json_decref(value);
    else if (json_object_set_new(object->json, key, value) != 0)
        object->whole = false;
}

static void append(document *array, json_t *value)
{
    if (!array)
        json_decref(value);
    else if (json_array_append_new(array->json, value) != 0)
        array->whole = false;
}

static json_t *take(document *parent, document *child)
{
    if (!child || !child->whole) {
        if (parent)
            parent->whole = false;
        document_free(child);
        return NULL;
    }
    json_t *json = json_incref(child->json);
    document_free(child);
    return json;
}

void document_set_text(document *object, const char *key, const char *text)
{
    set(object, key, string_of(text));
}

void document_set_boolean(document *object, const char *key, bool value)
{
    set(object, key, json_boolean(value));
}

void document_set_integer(document *object, const char *key, uint64_t value)
{
    set(object, key, json_integer((json_int_t)value));
}

void document_set_number(document *object, const char *key, double value)
{
    set(object, key, number_of(value));
}

static document *numbers_of(const float *values, int count)
{
    document *array = document_array();
    for (int i = 0; i < count; ++i)
        append(array, number_of((double)values[i]));
    return array;
}

void document_set_numbers(document *object, const char *key, const float *values, int count)
{
    document_set(object, key, numbers_of(values, count));
}

void document_set(document *object, const char *key, document *child)
{
    set(object, key, take(object, child));
}

void document_append(document *array, document *child)
{
    append(array, take(array, child));
}

void document_append_text(document *array, const char *text)
{
    append(array, string_of(text));
}

void document_append_integer(document *array, uint64_t value)
{
    append(array, json_integer((json_int_t)value));
}

void document_append_numbers(document *array, const float *values, int count)
{
    document_append(array, numbers_of(values, count));
}

bool document_print(document *d, FILE *out)
{
    const bool whole = d && d->whole && json_dumpf(d->json, out, JSON_REAL_PRECISION(9) | JSON_COMPACT) == 0;
    document_free(d);
    return whole;
}
