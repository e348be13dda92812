/* glint validate: every issue of every file, with its place, what was found and what was expected. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "io/validate.h"

enum { FILES_MAX = 4096, SEVERITY_COUNT = 3 };

typedef struct validate_values {
    bool json;
} validate_values;

static const argument_rule rules[] = {
    { .name = "json",
      .help = "print one JSON document",
      .kind = ARGUMENT_FLAG,
      .target = offsetof(validate_values, json) },
};

static const argument_syntax syntax = {
    .command = "glint validate",
    .operands = "FILE...",
    .summary = "Checks the glint materials of glTF files (.gltf, .glb) and presets (.json).",
    .operands_min = 1,
    .operands_max = FILES_MAX,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

typedef struct record {
    const char *file;
    document *issues; /* NULL: lines for people */
    unsigned counts[SEVERITY_COUNT];
} record;

static const char *severity_name(validate_severity severity)
{
    static const char *const names[SEVERITY_COUNT] = { "error", "warning", "info" };
    return names[severity];
}

static void take(const validate_issue *issue, void *user)
{
    record *r = user;
    r->counts[issue->severity]++;
    if (r->issues) {
        document *d = document_object();
        document_set_text(d, "code", issue->code);
        document_set_text(d, "severity", severity_name(issue->severity));
        document_set_text(d, "pointer", issue->pointer);
        document_set_text(d, "found", issue->found);
        document_set_text(d, "expected", issue->expected);
        document_append(r->issues, d);
        return;
    }
    printf("%s: %s %s: ", r->file, severity_name(issue->severity), issue->code);
    if (*issue->pointer)
        printf("%s: ", issue->pointer);
    printf("found %s", issue->found);
    if (*issue->expected)
        printf(", expected %s", issue->expected);
    putchar('\n');
}

static void set_counts(document *d, const unsigned counts[SEVERITY_COUNT])
{
    document_set_integer(d, "errors", counts[VALIDATE_ERROR]);
    document_set_integer(d, "warnings", counts[VALIDATE_WARNING]);
    document_set_integer(d, "infos", counts[VALIDATE_INFO]);
}

static document *check_file(const char *file, bool json, unsigned total[SEVERITY_COUNT])
{
    record r = { .file = file, .issues = json ? document_array() : NULL };
    validate_file(file, take, &r);
    for (int i = 0; i < SEVERITY_COUNT; ++i)
        total[i] += r.counts[i];
    if (!json)
        return NULL;
    document *d = document_object();
    document_set_text(d, "file", file);
    set_counts(d, r.counts);
    document_set(d, "issues", r.issues);
    return d;
}

static const char *plural(unsigned count)
{
    return count == 1 ? "" : "s";
}

static void print_sum(int count, const unsigned total[])
{
    const unsigned errors = total[VALIDATE_ERROR], warnings = total[VALIDATE_WARNING], infos = total[VALIDATE_INFO];
    printf("%d file%s: %u error%s, %u warning%s, %u info%s\n", count, plural((unsigned)count), errors, plural(errors),
           warnings, plural(warnings), infos, plural(infos));
}

static int check_all(const char *const *files, bool json)
{
    unsigned total[SEVERITY_COUNT] = { 0 };
    document *checked = json ? document_array() : NULL;
    int count = 0;
    for (; count < FILES_MAX && files[count]; ++count) {
        document *d = check_file(files[count], json, total);
        if (json)
            document_append(checked, d);
    }
    if (json) {
        document *all = document_object();
        document_set(all, "files", checked);
        set_counts(all, total);
        if (print_document(all) != COMMAND_DONE)
            return COMMAND_BAD_INPUT;
    } else {
        print_sum(count, total);
    }
    return total[VALIDATE_ERROR] > 0 ? COMMAND_BAD_INPUT : COMMAND_DONE;
}

int command_validate(int argc, char **argv)
{
    validate_values values = { 0 };
    const char **files = calloc(FILES_MAX, sizeof *files);
    if (!files) {
        fputs("glint: out of memory\n", stderr);
        return COMMAND_BAD_INPUT;
    }
    int code = COMMAND_DONE;
    switch (arguments_parse(&syntax, argc, argv, &values, files)) {
    case ARGUMENTS_HELP:
        break;
    case ARGUMENTS_WRONG:
        code = COMMAND_WRONG_USAGE;
        break;
    case ARGUMENTS_OK:
        code = check_all(files, values.json);
        break;
    }
    free(files);
    return code;
}
