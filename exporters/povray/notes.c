/* What is left out, gathered: the same words about many places become one warning that names the first few. */
#include "exporters/povray/notes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMED_PLACES = 3 };

static void tell(notes *n, const char *places, int others, const char *what)
{
    char more[32] = "";
    if (others > 0)
        snprintf(more, sizeof more, " and %d more", others);
    if (places)
        report_warning(&n->told, "%s: %s%s: %s", n->input, places, more, what);
    else
        report_warning(&n->told, "%s: %s", n->input, what);
}

static note *find(const notes *n, const char *place, const char *what)
{
    for (int i = 0; i < n->count; ++i)
        if ((n->list[i].places != NULL) == (place != NULL) && strcmp(n->list[i].what, what) == 0)
            return &n->list[i];
    return NULL;
}

static char *joined(const char *places, const char *place)
{
    const size_t size = strlen(places) + strlen(place) + 3;
    char *all = malloc(size);
    if (all)
        snprintf(all, size, "%s, %s", places, place);
    return all;
}

static bool append(notes *n, const char *place, const char *what)
{
    if (n->count == n->capacity) {
        const int capacity = 2 * n->capacity + 16;
        note *list = realloc(n->list, (size_t)capacity * sizeof *list);
        if (!list)
            return false;
        n->list = list;
        n->capacity = capacity;
    }
    note added = { strdup(what), place ? strdup(place) : NULL, 1 };
    if (!added.what || (place && !added.places)) {
        free(added.what);
        free(added.places);
        return false;
    }
    n->list[n->count++] = added;
    return true;
}

void notes_add(notes *n, const char *place, const char *what)
{
    note *known = find(n, place, what);
    if (!known) {
        /* Without memory for it the note is told here and now. */
        if (!append(n, place, what))
            tell(n, place, 0, what);
        return;
    }
    if (++known->count > NAMED_PLACES || !place)
        return;
    char *places = joined(known->places, place);
    if (!places)
        return;
    free(known->places);
    known->places = places;
}

/* A pointer has no colon followed by a blank but in a name, and then only the place is cut elsewhere. */
static void hear(const char *text, void *user)
{
    notes *n = user;
    const size_t length = strlen(n->input);
    if (strncmp(text, n->input, length) == 0 && strncmp(text + length, ": ", 2) == 0)
        text += length + 2;
    const char *end = *text == '/' ? strstr(text, ": ") : NULL;
    char *place = end ? strndup(text, (size_t)(end - text)) : NULL;
    notes_add(n, place, place ? end + 2 : text);
    free(place);
}

void notes_begin(notes *n, const char *input, report *r)
{
    *n = (notes){ .input = input, .told = { .warn = r->warn, .user = r->user } };
    r->warn = hear;
    r->user = n;
}

void notes_end(notes *n)
{
    for (int i = 0; i < n->count; ++i) {
        const int others = n->list[i].count - NAMED_PLACES;
        tell(n, n->list[i].places, others, n->list[i].what);
        free(n->list[i].what);
        free(n->list[i].places);
    }
    free(n->list);
    *n = (notes){ 0 };
}
