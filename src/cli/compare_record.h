/* What a comparison leaves: one JSON document, or lines for people. */
#ifndef CLI_COMPARE_RECORD_H
#define CLI_COMPARE_RECORD_H

#include "cli/document.h"
#include "compare/compare.h"

/* Names are the paths of the pictures. The caller frees. */
document *compare_document(const compare_result *result, const char *a, const char *b);

/* The verdict first, then every check. */
void compare_print_lines(const compare_result *result, const char *a, const char *b);

#endif
