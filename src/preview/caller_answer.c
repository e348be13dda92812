/* Results and messages. A message that is too long is cut. */
#include "preview/caller_answer.h"

#include <stdarg.h>
#include <stdio.h>

glint_preview_result answer(glint_preview_result result, const char *text, char *message, size_t message_size)
{
    if (message != NULL && message_size > 0)
        snprintf(message, message_size, "%s", text);
    return result;
}

glint_preview_result answer_of(bool done, const report *r, char *message, size_t message_size)
{
    if (done)
        return answer(GLINT_PREVIEW_OK, "", message, message_size);
    if (r->error[0] == '\0')
        return answer(GLINT_PREVIEW_CANCELLED, "cancelled", message, message_size);
    return answer(GLINT_PREVIEW_BAD_INPUT, r->error, message, message_size);
}

glint_preview_result answer_wrong(char *message, size_t message_size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (message != NULL && message_size > 0)
        vsnprintf(message, message_size, format, arguments);
    va_end(arguments);
    return GLINT_PREVIEW_BAD_INPUT;
}
