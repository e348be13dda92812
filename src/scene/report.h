/* How the tools say what went wrong: one error that ends the work, any number of warnings that do not. */
#ifndef SCENE_REPORT_H
#define SCENE_REPORT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct report {
    char error[1024];                           /* empty: no error */
    void (*warn)(const char *text, void *user); /* NULL: warnings are dropped */
    void *user;
} report;

/* Keeps the first error and returns false, so that a function can end with `return report_error(...)`.
 * The text names the file, the place in it, what was found and what was expected. */
bool report_error(report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
void report_warning(report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

#ifdef __cplusplus
}
#endif

#endif
