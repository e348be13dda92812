/* Keeps the first error of a piece of work and passes its warnings on. */
#include "scene/report.h"

#include <stdarg.h>
#include <stdio.h>

bool report_error(report *r, const char *format, ...)
{
    if (r->error[0] != '\0')
        return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error, sizeof r->error, format, arguments);
    va_end(arguments);
    return false;
}

void report_warning(report *r, const char *format, ...)
{
    if (!r->warn)
        return;
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    r->warn(text, r->user);
}
