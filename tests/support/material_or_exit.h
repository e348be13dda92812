/* A material for programs that cannot go on without it. */
#ifndef TESTS_MATERIAL_OR_EXIT_H
#define TESTS_MATERIAL_OR_EXIT_H

#include <stdio.h>
#include <stdlib.h>

#include "glint.h"

/* glint_material_create, or the end of the program after its message. */
static inline glint_material *material_or_exit(const glint_material_options *o)
{
    glint_material *m = NULL;
    char message[256];
    if (glint_material_create(o, &m, message, sizeof(message)) != GLINT_OK) {
        fprintf(stderr, "glint_material_create: %s\n", message);
        exit(1);
    }
    return m;
}

#endif
