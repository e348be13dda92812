/* glint merge: the tiles of a picture become the whole. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "io/image_merge.h"
#include "io/output_file.h"

enum { TILES_MAX = 65536, TEXTS_MAX = 64 };

typedef struct merge_values {
    const char *output;
    bool json;
} merge_values;

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "OUT.exr",
      .help = "the picture to write; required",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(merge_values, output) },
    { .name = "json",
      .help = "print one JSON document about the picture",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(merge_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint merge",
    .operands = "TILE.exr... -o OUT.exr",
    .summary = "Puts the tiles that glint render --tile wrote together to the whole picture.",
    .operands_min = 1,
    .operands_max = TILES_MAX,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* ---- what the tiles say about how they were rendered ---- */

/* The metadata of glint: those of the first tile, and whether the tile at hand has the same. */
typedef struct texts {
    image_text items[TEXTS_MAX]; /* own copies */
    size_t count, found;
    const char *first, *path; /* path NULL: the first is being read */
    report *r;
    bool good;
} texts;

static bool is_tile(const char *key)
{
    return strcmp(key, "glint:tile") == 0;
}

static bool keep_text(texts *t, const image_text *text)
{
    char *key = strdup(text->key), *value = strdup(text->value);
    if (t->count < TEXTS_MAX && key && value) {
        t->items[t->count++] = (image_text){ key, value };
        return true;
    }
    free(key);
    free(value);
    return report_error(t->r, "%s: found more metadata of glint than there can be", t->first);
}

static bool compare_text(texts *t, const image_text *text)
{
    for (size_t i = 0; i < t->count; ++i) {
        if (strcmp(t->items[i].key, text->key) != 0)
            continue;
        ++t->found;
        if (is_tile(text->key) || strcmp(t->items[i].value, text->value) == 0)
            return true;
        return report_error(t->r, "%s: was rendered with %s \"%s\", expected \"%s\" as in %s", t->path, text->key,
                            text->value, t->items[i].value, t->first);
    }
    return report_error(t->r, "%s: was rendered with %s \"%s\", which %s does not have", t->path, text->key,
                        text->value, t->first);
}

static void take_text(const image_text *text, void *user)
{
    texts *t = user;
    if (strncmp(text->key, "glint:", strlen("glint:")) == 0 && t->good)
        t->good = t->path ? compare_text(t, text) : keep_text(t, text);
}

static bool read_texts(texts *t, const char *const *paths, int count)
{
    t->first = paths[0];
    for (int i = 0; t->good && i < count; ++i) {
        t->path = i > 0 ? paths[i] : NULL;
        t->found = 0;
        t->good = image_read_metadata(paths[i], take_text, t, t->r) && t->good;
        if (t->good && i > 0 && t->found < t->count)
            t->good = report_error(t->r, "%s: lacks metadata of glint that %s has, expected tiles of one picture",
                                   paths[i], t->first);
    }
    return t->good;
}

static void free_texts(texts *t)
{
    for (size_t i = 0; i < t->count; ++i) {
        free((char *)t->items[i].key);
        free((char *)t->items[i].value);
    }
}

/* ---- the command ---- */

static bool write_picture(const texts *t, const image *picture, const merge_values *v, report *r)
{
    image_text metadata[TEXTS_MAX];
    char whole[64];
    snprintf(whole, sizeof whole, "0,0,%d,%d", picture->width, picture->height);
    for (size_t i = 0; i < t->count; ++i)
        metadata[i] = is_tile(t->items[i].key) ? (image_text){ t->items[i].key, whole } : t->items[i];
    return image_write_exr(v->output, picture, metadata, t->count, r);
}

static int say(const image *picture, int tile_count, const merge_values *v, messages *m)
{
    if (!v->json) {
        printf("%s: %dx%d, %d channels, %d tile%s\n", v->output, picture->width, picture->height,
               picture->channel_count, tile_count, tile_count == 1 ? "" : "s");
        messages_end(m);
        return COMMAND_DONE;
    }
    document *d = document_object(), *size = document_array(), *channels = document_array();
    document_append_integer(size, (uint64_t)picture->width);
    document_append_integer(size, (uint64_t)picture->height);
    for (int c = 0; c < picture->channel_count; ++c)
        document_append_text(channels, picture->channel_names[c]);
    document_set_text(d, "output", v->output);
    document_set(d, "size", size);
    document_set(d, "channels", channels);
    document_set_integer(d, "tiles", (uint64_t)tile_count);
    document_set(d, "warnings", m->warnings);
    m->warnings = NULL;
    return print_document(d);
}

static int merge(const char *const *paths, const merge_values *v)
{
    int count = 0;
    while (count < TILES_MAX && paths[count])
        ++count;
    messages m;
    messages_begin(&m, v->json);
    image picture = { 0 };
    texts t = { .r = &m.report, .good = true };
    const bool done = output_file_check(v->output, &m.report) && image_merge(paths, count, &picture, &m.report) &&
                      read_texts(&t, paths, count) && write_picture(&t, &picture, v, &m.report);
    const int code = done ? say(&picture, count, v, &m) : messages_fail(&m);
    free_texts(&t);
    image_free(&picture);
    return code;
}

static int check_usage(const merge_values *v)
{
    if (!v->output)
        return arguments_wrong(&syntax, "-o OUT.exr is missing");
    const size_t length = strlen(v->output);
    if (length < 5 || strcasecmp(v->output + length - 4, ".exr") != 0)
        return arguments_wrong(&syntax, "-o '%s': expected a name that ends in .exr", v->output);
    return COMMAND_DONE;
}

int command_merge(int argc, char **argv)
{
    merge_values values = { 0 };
    const char **paths = calloc(TILES_MAX, sizeof *paths);
    if (!paths) {
        fputs("glint: out of memory\n", stderr);
        return COMMAND_BAD_INPUT;
    }
    int code = COMMAND_DONE;
    switch (arguments_parse(&syntax, argc, argv, &values, paths)) {
    case ARGUMENTS_HELP:
        break;
    case ARGUMENTS_WRONG:
        code = COMMAND_WRONG_USAGE;
        break;
    case ARGUMENTS_OK:
        code = check_usage(&values);
        if (code == COMMAND_DONE)
            code = merge(paths, &values);
        break;
    }
    free(paths);
    return code;
}
