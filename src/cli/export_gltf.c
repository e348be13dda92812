/* glint export gltf: the command line of glint_export_gltf. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "glint_export.h"

typedef struct export_values {
    const char *output, *variant;
    assignments materials, values;
    bool whole, strip, bake_fallback, dry_run, json;
} export_values;

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "OUT",
      .help = "the file to write; may be SCENE itself",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(export_values, output) },
    { .name = "material",
      .value = "NAME=PRESET",
      .help = "puts a preset on a material, or on all (*); repeatable",
      .kind = ARGUMENT_ASSIGNMENT,
      .target = offsetof(export_values, materials) },
    { .name = "set",
      .value = "POINTER=VALUE",
      .help = "sets a property of the extension: /glintDensity=2e7; repeatable",
      .kind = ARGUMENT_ASSIGNMENT,
      .target = offsetof(export_values, values) },
    { .name = "new",
      .help = "writes a new file of what a renderer sees, in one piece",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, whole) },
    { .name = "variant",
      .value = "NAME",
      .help = "with --new: a variant of the file (KHR_materials_variants)",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(export_values, variant) },
    { .name = "strip",
      .help = "first takes back what earlier exports changed",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, strip) },
    { .name = "bake-fallback",
      .help = "writes OUT.fallback too, with glints as a normal map",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, bake_fallback) },
    { .name = "dry-run",
      .help = "checks everything and writes nothing",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, dry_run) },
    { .name = "json",
      .help = "print one JSON document of what was done",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(export_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint export gltf",
    .operands = "SCENE",
    .summary = "Puts glint materials on a glTF 2.0 file (.gltf, .glb) and leaves every other byte of it as it is.\n"
               "With --new it writes another file of all that a renderer sees.",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* The command line's pairs as those of the library, which have the same members. NULL when memory is short. */
static glint_export_assignment *pairs_of(const assignments *a)
{
    glint_export_assignment *pairs = calloc(a->count + 1, sizeof *pairs);
    for (size_t i = 0; pairs && i < a->count; ++i)
        pairs[i] = (glint_export_assignment){ a->items[i].name, a->items[i].value };
    return pairs;
}

static int finish(glint_export_result result, messages *m, const char *summary)
{
    switch (result) {
    case GLINT_EXPORT_OK:
        break;
    case GLINT_EXPORT_WRONG_USAGE:
        return arguments_wrong(&syntax, "%s", m->report.error);
    case GLINT_EXPORT_BAD_INPUT:
        return messages_fail(m);
    }
    if (summary)
        puts(summary);
    return COMMAND_DONE;
}

static glint_export_result write_new(const char *input, const export_values *values,
                                     const glint_export_assignment *materials, char **summary, messages *m)
{
    const glint_export_gltf_scene_options o = {
        .size = sizeof o,
        .input = input,
        .output = values->dry_run ? NULL : values->output,
        .variant = values->variant,
        .materials = materials,
        .material_count = values->materials.count,
        .listener = { .warn = m->report.warn, .user = m->report.user },
        .summary = values->json ? summary : NULL,
    };
    return glint_export_gltf_scene(&o, m->report.error, sizeof m->report.error);
}

static glint_export_result patch(const char *input, const export_values *values,
                                 const glint_export_assignment *materials, const glint_export_assignment *sets,
                                 char **summary, messages *m)
{
    const glint_export_gltf_options o = {
        .size = sizeof o,
        .input = input,
        .output = values->dry_run ? NULL : values->output,
        .materials = materials,
        .material_count = values->materials.count,
        .values = sets,
        .value_count = values->values.count,
        .strip = values->strip,
        .bake_fallback = values->bake_fallback,
        .listener = { .warn = m->report.warn, .user = m->report.user },
        .summary = values->json ? summary : NULL,
    };
    return glint_export_gltf(&o, m->report.error, sizeof m->report.error);
}

static int export_file(const char *input, const export_values *values)
{
    messages m;
    messages_begin(&m, values->json);
    glint_export_assignment *materials = pairs_of(&values->materials), *sets = pairs_of(&values->values);
    char *summary = NULL;
    glint_export_result result = GLINT_EXPORT_BAD_INPUT;
    if (!materials || !sets)
        report_error(&m.report, "%s: out of memory", input);
    else if (values->whole)
        result = write_new(input, values, materials, &summary, &m);
    else
        result = patch(input, values, materials, sets, &summary, &m);
    const int code = finish(result, &m, summary);
    glint_export_free(summary);
    free(materials);
    free(sets);
    messages_end(&m);
    return code;
}

static int parse_and_export(int argc, char **argv, export_values *values)
{
    const char *input;
    switch (arguments_parse(&syntax, argc, argv, values, &input)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    if (!values->output && !values->dry_run)
        return arguments_wrong(&syntax, "-o OUT is missing; --dry-run needs none");
    if (values->variant && !values->whole)
        return arguments_wrong(&syntax, "--variant: only with --new; without, all variants stay in the file");
    if (values->whole && (values->strip || values->bake_fallback || values->values.count > 0))
        return arguments_wrong(&syntax, "--new: not with --set, --strip or --bake-fallback; export its file again");
    return export_file(input, values);
}

int command_export_gltf(int argc, char **argv)
{
    export_values values = { 0 };
    const int code = parse_and_export(argc, argv, &values);
    assignments_free(&values.materials);
    assignments_free(&values.values);
    return code;
}
