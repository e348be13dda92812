/* glint compare: holds a picture against another and says whether they show the same material. */
#include <stdlib.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/compare_record.h"
#include "compare/compare.h"
#include "io/output_file.h"

typedef struct compare_values {
    const char *output;
    compare_options options;
    bool json;
} compare_values;

#define AT(member) offsetof(compare_values, member)

static const argument_rule rules[] = {
    { .name = "output",
      .letter = 'o',
      .value = "REPORT.html",
      .help = "write a report, one page that needs nothing else",
      .kind = ARGUMENT_TEXT,
      .target = AT(output) },
    { .name = "mean-tolerance",
      .value = "X",
      .help = "of the ratio of mean luminances, relative; .02",
      .kind = ARGUMENT_NUMBER,
      .max = 1e6,
      .target = AT(options.mean_tolerance) },
    { .name = "variance-tolerance",
      .value = "X",
      .help = "of the ratio of the variances of block means; .2",
      .kind = ARGUMENT_NUMBER,
      .max = 1e6,
      .target = AT(options.variance_tolerance) },
    { .name = "same-facets",
      .help = "both show the same facets: judge pixel by pixel (found out without this, too)",
      .kind = ARGUMENT_FLAG,
      .target = AT(options.exact) },
    { .name = "least-correlation",
      .value = "X",
      .help = "of pixels, where both show the same facets; .995",
      .kind = ARGUMENT_NUMBER,
      .min = -1,
      .max = 1,
      .target = AT(options.least_correlation) },
    { .name = "json", .help = "print one JSON document", .kind = ARGUMENT_FLAG, .target = AT(json) },
};

static const argument_syntax syntax = {
    .command = "glint compare",
    .operands = "A B",
    .summary = "Holds picture B against the reference A (.exr, .hdr, .png ...) and says whether they agree.",
    .operands_min = 2,
    .operands_max = 2,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};

/* The document as text; NULL without memory. */
static char *text_of(document *d)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        document_free(d);
        return NULL;
    }
    const bool printed = document_print(d, out);
    if (fclose(out) == 0 && printed)
        return text;
    free(text);
    return NULL;
}

static bool write_report(const compare_values *v, const char *const names[2], const image pictures[2],
                         const compare_result *result, report *r)
{
    if (!v->output)
        return true;
    char *json = text_of(compare_document(result, names[0], names[1]));
    const bool done = json ? compare_write_page(v->output, &pictures[0], &pictures[1], json, r)
                           : report_error(r, "%s: out of memory", v->output);
    free(json);
    return done;
}

/* Reads, compares, writes the page. */
static bool compare(const compare_values *v, const char *const names[2], compare_result *result, report *r)
{
    image pictures[2] = { 0 };
    const bool done = (!v->output || output_file_check(v->output, r)) && image_read(names[0], &pictures[0], r) &&
                      image_read(names[1], &pictures[1], r) &&
                      compare_pictures(&pictures[0], names[0], &pictures[1], names[1], &v->options, result, r) &&
                      write_report(v, names, pictures, result, r);
    image_free(&pictures[0]);
    image_free(&pictures[1]);
    return done;
}

int command_compare(int argc, char **argv)
{
    compare_values values = { .options = COMPARE_OPTIONS_INIT };
    const char *names[2];
    switch (arguments_parse(&syntax, argc, argv, &values, names)) {
    case ARGUMENTS_HELP:
        return COMMAND_DONE;
    case ARGUMENTS_WRONG:
        return COMMAND_WRONG_USAGE;
    case ARGUMENTS_OK:
        break;
    }
    messages m;
    compare_result result;
    messages_begin(&m, values.json);
    if (!compare(&values, names, &result, &m.report))
        return messages_fail(&m);
    int code = COMMAND_DONE;
    if (values.json)
        code = print_document(compare_document(&result, names[0], names[1]));
    else
        compare_print_lines(&result, names[0], names[1]);
    messages_end(&m);
    return code == COMMAND_DONE && result.outcome == COMPARE_FAIL ? COMMAND_BAD_INPUT : code;
}
