/* glint materials: lists the presets, or shows the properties of one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/sheet.h"
#include "io/scene_file.h"

typedef struct materials_values {
    bool json;
} materials_values;

static const argument_rule rules[] = {
    { .name = "json",
      .help = "print one JSON document",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(materials_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint materials",
    .operands = "[NAME]",
    .summary = "Lists the material presets, or shows the properties of one in words and units.",
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

static document *entry(const char *name, const char *title, const char *note)
{
    document *d = document_object();
    document_set_text(d, "name", name);
    document_set_text(d, "title", title);
    document_set_text(d, "note", note);
    return d;
}

static void list_line(const char *name, const char *title, const char *note, void *user)
{
    (void)note;
    (void)user;
    printf("%-24s %s\n", name, title);
}

static void list_entry(const char *name, const char *title, const char *note, void *user)
{
    document_append(user, entry(name, title, note));
}

static int list(bool json, messages *m)
{
    if (!json)
        return preset_each(list_line, NULL, &m->report) ? COMMAND_DONE : messages_fail(m);
    document *all = document_array();
    if (!preset_each(list_entry, all, &m->report)) {
        document_free(all);
        return messages_fail(m);
    }
    return print_document(all);
}

/* Of the presets, the one that is asked for. A preset that is given by its path has no title. */
typedef struct search {
    const char *name;
    char *title, *note;
} search;

static void match(const char *name, const char *title, const char *note, void *user)
{
    search *s = user;
    if (strcmp(name, s->name) != 0)
        return;
    s->title = strdup(title);
    s->note = strdup(note);
}

static int show_object(const scene_material *m, const search *found)
{
    document *d = entry(found->name, found->title ? found->title : "", found->note ? found->note : "");
    sheet_show(m, d);
    return print_document(d);
}

/* Breaks the text at blanks so that it fits a terminal of 80 columns. */
static void print_wrapped(const char *text)
{
    enum { WIDTH = 76 };
    while (*text) {
        size_t length = strlen(text);
        if (length > WIDTH) {
            for (length = WIDTH; length > 0 && text[length] != ' '; --length)
                continue;
            if (length == 0)
                length = strcspn(text, " ");
        }
        printf("  %.*s\n", (int)length, text);
        text += length + strspn(text + length, " ");
    }
}

static int show_lines(const scene_material *m, const search *found)
{
    printf("%s%s%s\n", found->name, found->title ? ": " : "", found->title ? found->title : "");
    sheet_show(m, NULL);
    if (found->note)
        print_wrapped(found->note);
    return COMMAND_DONE;
}

static int show(const char *name, bool json, messages *m)
{
    scene s = { 0 };
    scene_material material;
    if (!preset_read(name, &s, &material, &m->report)) {
        scene_free(&s);
        return messages_fail(m);
    }
    search found = { .name = name };
    int code;
    if (!preset_each(match, &found, &m->report))
        code = messages_fail(m);
    else
        code = json ? show_object(&material, &found) : show_lines(&material, &found);
    free(found.title);
    free(found.note);
    free(material.name);
    scene_free(&s);
    return code;
}

int command_materials(int argc, char **argv)
{
    materials_values values = { 0 };
    const char *name;
    switch (arguments_parse(&syntax, argc, argv, &values, &name)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    messages m;
    messages_begin(&m, values.json);
    const int code = name ? show(name, values.json, &m) : list(values.json, &m);
    messages_end(&m);
    return code;
}
