/* The text of one file while it is written, and names that POV-Ray can read whatever the scene calls things. */
#include "exporters/povray/text.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 4096, IDENTIFIER_LETTERS = 40, COMMENT_LETTERS = 60 };

void text_free(text *t)
{
    free(t->bytes);
    *t = (text){ 0 };
}

static bool reserve(text *t, size_t more)
{
    if (t->failed || more > SIZE_MAX / 4 - t->length) {
        t->failed = true;
        return false;
    }
    size_t capacity = t->capacity ? t->capacity : FIRST_CAPACITY;
    while (capacity <= t->length + more)
        capacity *= 2;
    if (capacity == t->capacity)
        return true;
    char *bytes = realloc(t->bytes, capacity);
    if (!bytes) {
        t->failed = true;
        return false;
    }
    t->bytes = bytes;
    t->capacity = capacity;
    return true;
}

void text_add(text *t, const char *bytes, size_t count)
{
    if (!reserve(t, count))
        return;
    memcpy(t->bytes + t->length, bytes, count);
    t->length += count;
    t->bytes[t->length] = '\0';
}

void text_print(text *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0) {
        t->failed = true;
        return;
    }
    if (!reserve(t, (size_t)length))
        return;
    va_start(arguments, format);
    vsnprintf(t->bytes + t->length, (size_t)length + 1, format, arguments);
    va_end(arguments);
    t->length += (size_t)length;
}

void text_vector(text *t, vec v)
{
    /* + 0.0 turns -0 into 0. */
    text_print(t, "<%.9g, %.9g, %.9g>", v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

void text_color(text *t, const float rgb[3])
{
    text_vector(t, vec_of(rgb));
}

static bool is_letter_or_digit(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

void name_identifier(char out[NAME_LENGTH], const char *prefix, int number, const char *name)
{
    int length = snprintf(out, NAME_LENGTH, "%s_%d", prefix, number);
    const int end = length + IDENTIFIER_LETTERS;
    for (const char *c = name ? name : ""; *c && length < end && length < NAME_LENGTH - 2; ++c) {
        if (c == name)
            out[length++] = '_';
        out[length++] = is_letter_or_digit(*c) ? *c : '_';
    }
    out[length] = '\0';
}

void name_comment(char out[NAME_LENGTH], const char *name)
{
    int length = 0;
    for (const char *c = name ? name : ""; *c; ++c) {
        if (length > COMMENT_LETTERS) {
            length += snprintf(out + length, (size_t)(NAME_LENGTH - length), "...");
            break;
        }
        /* Neither the end of a comment nor the start of another one, which nest. */
        const bool plain = *c >= ' ' && *c <= '~' && *c != '\\' && *c != '*' && *c != '/';
        length += snprintf(out + length, (size_t)(NAME_LENGTH - length), plain ? "%c" : "\\x%02x",
                           (unsigned)(unsigned char)*c);
    }
    out[length] = '\0';
}

void name_file(char out[NAME_LENGTH], const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const char *end = dot && dot > name ? dot : name + strlen(name);
    int length = 0;
    for (const char *c = name; c < end && length < IDENTIFIER_LETTERS; ++c, ++length)
        out[length] = is_letter_or_digit(*c) || (length > 0 && *c == '-') ? *c : '_';
    out[length] = '\0';
    if (length == 0)
        snprintf(out, NAME_LENGTH, "scene");
}
