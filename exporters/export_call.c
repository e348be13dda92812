/* The report of a reader as what glint_export.h promises: a result and a message. */
#include "exporters/export_call.h"

#include <stdio.h>
#include <stdlib.h>

report export_report(const glint_export_listener *listener)
{
    return (report){ .warn = listener->warn, .user = listener->user };
}

static glint_export_result say(glint_export_result result, const char *text, char *message, size_t message_size)
{
    if (message && message_size > 0)
        snprintf(message, message_size, "%s", text);
    return result;
}

glint_export_result export_result(const report *r, bool done, char *message, size_t message_size)
{
    if (done)
        return say(GLINT_EXPORT_OK, "", message, message_size);
    return say(GLINT_EXPORT_BAD_INPUT, r->error, message, message_size);
}

glint_export_result export_wrong_usage(const char *text, char *message, size_t message_size)
{
    return say(GLINT_EXPORT_WRONG_USAGE, text, message, message_size);
}

void glint_export_free(char *text)
{
    free(text);
}
