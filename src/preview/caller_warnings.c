/* Lines of text, one list a part. A warning that memory has no room for is lost. */
#include "preview/caller_warnings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(char **list, const char *text, const char *end)
{
    const size_t before = *list != NULL ? strlen(*list) : 0;
    const size_t room = before + strlen(text) + strlen(end) + 1;
    char *const grown = realloc(*list, room);
    if (grown == NULL)
        return;
    *list = grown;
    snprintf(&grown[before], room - before, "%s%s", text, end);
}

void caller_warnings_keep(const char *text, void *user)
{
    caller_warnings *const w = user;
    append(&w->of_part[w->now], text, "\n");
}

void caller_warnings_join(caller_warnings *w)
{
    free(w->all);
    w->all = NULL;
    for (int i = 0; i < CALLER_PARTS; ++i) {
        if (w->of_part[i] != NULL)
            append(&w->all, w->of_part[i], "");
    }
}

void caller_warnings_move(caller_warnings *to, caller_warnings *from, caller_part part)
{
    free(to->of_part[part]);
    to->of_part[part] = from->of_part[part];
    from->of_part[part] = NULL;
}

void caller_warnings_free(caller_warnings *w)
{
    for (int i = 0; i < CALLER_PARTS; ++i)
        free(w->of_part[i]);
    free(w->all);
    *w = (caller_warnings){ 0 };
}
