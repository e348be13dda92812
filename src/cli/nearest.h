/* The known name that a mistyped one most likely meant. */
#ifndef CLI_NEAREST_H
#define CLI_NEAREST_H

#include <stddef.h>

typedef struct nearest {
    const char *wanted;
    const char *name; /* NULL while nothing is near */
    size_t distance;
} nearest;

nearest nearest_begin(const char *wanted);
/* Keeps the candidate if it is near enough (scene/edit_distance.h) and nearer than those before it. */
void nearest_consider(nearest *n, const char *candidate);

#endif
