/* glint export povray: the command line of glint_export_povray. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "glint_export.h"

typedef struct export_values {
    const char *output, *camera;
    int form;
    int64_t size[2];
    assignments materials;
    bool json;
} export_values;

static const char *form_choice(int index)
{
    static const char *const names[] = { "auto", "portable", "exact", "analytic", "mesh", NULL };
    return names[index];
}

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "DIR",
      .help = "the folder to write to; made where there is none; required",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(export_values, output) },
    { .name = "form",
      .help = "how flakes are written; auto takes the best for each object",
      .kind = ARGUMENT_CHOICE,
      .choice = form_choice,
      .target = offsetof(export_values, form) },
    { .name = "material",
      .value = "NAME=PRESET",
      .help = "replace a material of the file, or all (*); repeatable",
      .kind = ARGUMENT_ASSIGNMENT,
      .target = offsetof(export_values, materials) },
    { .name = "camera",
      .value = "NAME|N",
      .help = "which camera of the file; N counts from 0",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(export_values, camera) },
    { .name = "size",
      .value = "WxH",
      .help = "pixels; 1280x720",
      .kind = ARGUMENT_INTEGERS,
      .count = 2,
      .separator = 'x',
      .min = 1,
      .max = 65536,
      .target = offsetof(export_values, size) },
    { .name = "json",
      .help = "print one JSON document of what was done",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint export povray",
    .operands = "SCENE -o DIR",
    .summary = "Writes a folder that stock POV-Ray 3.7 renders: a scene, its materials, glint.inc and an .ini file.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* What the exporter says while it works. */
typedef struct record {
    messages messages;
    document *files, *objects; /* NULL without --json */
    char scene[256];           /* the name of the .ini file */
} record;

static void hear_warning(const char *text, void *user)
{
    record *r = user;
    r->messages.report.warn(text, r->messages.report.user);
}

static void hear_file(const char *file, void *user)
{
    record *r = user;
    const size_t length = strlen(file);
    if (length > 4 && strcmp(file + length - 4, ".ini") == 0)
        snprintf(r->scene, sizeof r->scene, "%s", file);
    if (r->files)
        document_append_text(r->files, file);
}

static void hear_object(const char *name, const char *material, const char *form, void *user)
{
    record *r = user;
    if (!r->objects)
        return;
    document *o = document_object();
    document_set_text(o, "name", name);
    document_set_text(o, "material", material ? material : "");
    document_set_text(o, "form", form);
    document_append(r->objects, o);
}

static int print_result(record *r, const char *input, const export_values *v)
{
    if (!v->json) {
        printf("%s: render with: cd '%s' && povray %s\n", input, v->output, r->scene);
        messages_end(&r->messages);
        return COMMAND_DONE;
    }
    document *d = document_object(), *size = document_array();
    document_set_text(d, "file", input);
    document_set_text(d, "output", v->output);
    document_set_text(d, "form", form_choice(v->form));
    document_append_integer(size, (uint64_t)v->size[0]);
    document_append_integer(size, (uint64_t)v->size[1]);
    document_set(d, "size", size);
    document_set(d, "files", r->files);
    document_set(d, "objects", r->objects);
    document_set(d, "warnings", r->messages.warnings);
    return print_document(d);
}

static int export_folder(const char *input, const export_values *v)
{
    record r = { .files = NULL };
    messages_begin(&r.messages, v->json);
    if (v->json) {
        r.files = document_array();
        r.objects = document_array();
    }
    glint_export_assignment *pairs = calloc(v->materials.count + 1, sizeof *pairs);
    for (size_t i = 0; pairs && i < v->materials.count; ++i)
        pairs[i] = (glint_export_assignment){ v->materials.items[i].name, v->materials.items[i].value };
    glint_export_povray_options o = GLINT_EXPORT_POVRAY_OPTIONS_INIT;
    o.input = input;
    o.output = v->output;
    o.form = (glint_export_povray_form)v->form;
    o.camera = v->camera;
    o.width = (int)v->size[0];
    o.height = (int)v->size[1];
    o.materials = pairs;
    o.material_count = v->materials.count;
    o.listener = (glint_export_listener){ hear_warning, &r };
    o.wrote = hear_file;
    o.object = hear_object;
    char *error = r.messages.report.error;
    const bool done = pairs ? glint_export_povray(&o, error, sizeof r.messages.report.error) == GLINT_EXPORT_OK
                            : report_error(&r.messages.report, "%s: out of memory", input);
    free(pairs);
    if (done)
        return print_result(&r, input, v);
    document_free(r.files);
    document_free(r.objects);
    return messages_fail(&r.messages);
}

int command_export_povray(int argc, char **argv)
{
    export_values values = { .size = { 1280, 720 } };
    const char *input;
    int code = COMMAND_DONE;
    switch (arguments_parse(&syntax, argc, argv, &values, &input)) {
    case ARGUMENTS_HELP:
        break;
    case ARGUMENTS_WRONG:
        code = COMMAND_WRONG_USAGE;
        break;
    case ARGUMENTS_OK:
        code = values.output ? export_folder(input, &values) : arguments_wrong(&syntax, "-o DIR is missing");
        break;
    }
    assignments_free(&values.materials);
    return code;
}
