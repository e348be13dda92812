/* The known name that a mistyped one most likely meant. */
#ifndef CLI_NEAREST_H
#define CLI_NEAREST_H

#include <stddef.h>

typedef struct nearest {
    const char *wanted;
    const char *name; /* NULL while nothing is near */
    size_t distance;
} nearest;

/* A name is near when at most a third of the wanted one's letters, and at least two, would have to change. */
nearest nearest_begin(const char *wanted);
void nearest_consider(nearest *n, const char *candidate);

#endif
