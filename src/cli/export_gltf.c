/* glint export gltf: the command line of glint_export_gltf. */
#include "cli/arguments.h"
#include "cli/command.h"
#include "glint_export.h"

typedef struct export_values {
    const char *output;
} export_values;

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "OUT",
      .help = "the file to write; may be SCENE itself",
      .kind = ARGUMENT_TEXT,
      .target = offsetof(export_values, output) },
};

static const argument_syntax syntax = {
    .command = "glint export gltf",
    .operands = "SCENE",
    .summary = "Writes a glTF 2.0 file (.gltf, .glb).",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

static int export_file(const char *input, const export_values *values)
{
    messages m;
    messages_begin(&m, false);
    glint_export_gltf_options o = GLINT_EXPORT_GLTF_OPTIONS_INIT;
    o.input = input;
    o.output = values->output;
    o.listener = (glint_export_listener){ .warn = m.report.warn, .user = m.report.user };
    int code = COMMAND_DONE;
    if (glint_export_gltf(&o, m.report.error, sizeof m.report.error) != GLINT_EXPORT_OK)
        code = messages_fail(&m);
    messages_end(&m);
    return code;
}

int command_export_gltf(int argc, char **argv)
{
    export_values values = { 0 };
    const char *input;
    switch (arguments_parse(&syntax, argc, argv, &values, &input)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    if (!values.output)
        return arguments_wrong(&syntax, "-o OUT is missing");
    return export_file(input, &values);
}
