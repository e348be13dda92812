/* The subcommands, and what they share: exit codes, messages, the clock. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include <stdbool.h>

#include "cli/document.h"
#include "scene/report.h"

enum { COMMAND_DONE = 0, COMMAND_BAD_INPUT = 1, COMMAND_WRONG_USAGE = 2 };

/* One file each. argv[0] is the subcommand's own name; they return an exit code. */
int command_render(int argc, char **argv);
int command_compare(int argc, char **argv);
int command_eval(int argc, char **argv);
int command_example(int argc, char **argv);
int command_export(int argc, char **argv);
int command_export_gltf(int argc, char **argv);
int command_export_povray(int argc, char **argv);
int command_inspect(int argc, char **argv);
int command_materials(int argc, char **argv);
int command_merge(int argc, char **argv);
int command_plan(int argc, char **argv);
int command_study(int argc, char **argv);
int command_validate(int argc, char **argv);

/* A report whose warnings go to standard error as they come and, with --json, into the document as well. It must stay
 * where it is, because the report points to it. */
typedef struct messages {
    report report;
    document *warnings; /* an array; NULL without --json */
} messages;

void messages_begin(messages *m, bool json);
/* Prints the error and, with --json, a document that says the same; frees; returns COMMAND_BAD_INPUT. */
int messages_fail(messages *m);
void messages_end(messages *m);

/* Prints the one document of --json and frees it; returns COMMAND_DONE, or COMMAND_BAD_INPUT with a message. */
int print_document(document *d);

/* A monotonic clock. */
double clock_s(void);

#endif
