/* glint inspect: says what is in a scene. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "io/scene_file.h"

typedef struct inspect_values {
    bool json;
} inspect_values;

static const argument_rule rules[] = {
    { .name = "json",
      .help = "print one JSON document",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(inspect_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint inspect",
    .operands = "FILE",
    .summary = "Says what is in a glTF scene (.gltf, .glb).",
    .operands_min = 1,
    .operands_max = 1,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

int command_inspect(int argc, char **argv)
{
    inspect_values values = { 0 };
    const char *path;
    switch (arguments_parse(&syntax, argc, argv, &values, &path)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    messages m;
    messages_begin(&m, values.json);
    const scene_file_options options = { 0 };
    scene s = { 0 };
    if (!scene_file_read(path, &options, &s, &m.report))
        return messages_fail(&m);
    char *text = scene_describe(&s, values.json);
    scene_free(&s);
    if (!text) {
        report_error(&m.report, "%s: out of memory", path);
        return messages_fail(&m);
    }
    fputs(text, stdout);
    free(text);
    messages_end(&m);
    return COMMAND_DONE;
}
