/* Between the C functions of glint_export.h and the reports of the readers: every exporter begins and ends with these.
 */
#ifndef EXPORTERS_EXPORT_CALL_H
#define EXPORTERS_EXPORT_CALL_H

#include <stdbool.h>

#include "glint_export.h"
#include "scene/report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A report whose warnings go to the listener. */
report export_report(const glint_export_listener *listener);

/* Hands the report's error to the caller and returns the result that belongs to it. */
glint_export_result export_result(const report *r, bool done, char *message, size_t message_size);

/* The same for options that cannot be. */
glint_export_result export_wrong_usage(const char *text, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
