/* Command lines by table: one row an option, its value checked to the last character, unknown names met with the
 * nearest. */
#ifndef CLI_ARGUMENTS_H
#define CLI_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum argument_kind {
    ARGUMENT_FLAG,      /* no value; target bool */
    ARGUMENT_TEXT,      /* any text but the empty one; target const char * */
    ARGUMENT_NUMBER,    /* a finite decimal number in [min, max]; target double */
    ARGUMENT_INTEGERS,  /* count whole numbers in [min, max] with separator between; target int64_t[count] */
    ARGUMENT_RANGE,     /* A-B, or A for A-A: whole numbers in [min, max], A <= B; target int64_t[2] */
    ARGUMENT_CHOICE,    /* one of the names choice(0), choice(1) ... up to NULL; target int, the index */
    ARGUMENT_ASSIGNMENT /* NAME=VALUE, repeatable; target assignments */
} argument_kind;

typedef struct argument_rule {
    const char *name;  /* without the dashes */
    const char *value; /* what the help calls the value; NULL: none, or the choices */
    const char *help;
    argument_kind kind;
    char letter; /* of the short form; 0: none */
    char separator;
    int count;
    double min, max; /* at most 2^53, so that whole numbers are exact */
    const char *(*choice)(int index);
    size_t target; /* offset in the values struct */
} argument_rule;

/* Values of a repeatable NAME=VALUE, in the order of the command line. */
typedef struct assignments {
    struct assignment {
        char *name;
        const char *value;
    } * items;
    size_t count;
} assignments;

void assignments_free(assignments *a);

typedef struct argument_syntax {
    const char *command;  /* "glint render" */
    const char *operands; /* for the usage line: "SCENE -o OUT" */
    const char *summary;  /* one sentence */
    int operands_min, operands_max;
    const argument_rule *rules;
    size_t rule_count;
} argument_syntax;

typedef enum arguments_result {
    ARGUMENTS_OK,
    ARGUMENTS_HELP, /* --help was asked for and printed */
    ARGUMENTS_WRONG /* what is wrong was printed to standard error */
} arguments_result;

/* Reads argv[1] to argv[argc - 1]; argv[0] is the name of the subcommand. Options and operands may be mixed; "--" ends
 * the options; an option that is given twice keeps the last value. Option names are written out: an abbreviation would
 * change its meaning with the next option that is added.
 *
 * values    the struct that the rules' targets point into, filled with the defaults
 * operands  operands_max entries, NULL where the command line has none
 */
arguments_result arguments_parse(const argument_syntax *syntax, int argc, char **argv, void *values,
                                 const char **operands);

/* Prints "glint render: TEXT" and where help is to be had; returns the exit code of wrong usage, 2. */
int arguments_wrong(const argument_syntax *syntax, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The choices of --model: "auto", then libglint's models, so that the index less one is a glint_model and auto is -1.
 */
const char *arguments_model_choice(int index);

#endif
