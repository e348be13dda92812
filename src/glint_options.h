/* Checks what a client asks for, and names the option, its value and its range when it cannot be had. */
#ifndef GLINT_OPTIONS_H
#define GLINT_OPTIONS_H

#include "glint.h"

/* Rougher than this float can resolve near the pole. */
#define LEAST_ALPHA 1e-4F

/* Where a failed check writes what it found. */
typedef struct complaint {
    char *text; /* may be NULL */
    size_t size;
    glint_result result; /* GLINT_OK until the first complaint */
    const char *scope;   /* goes before the option's name: "layers.coat."; NULL: nothing */
} complaint;

/* Keeps the first complaint. */
void __attribute__((format(printf, 3, 4))) complain(complaint *c, glint_result result, const char *format, ...);

/* Whether a material can be made from these options, its layers included. */
void check_options(complaint *c, const glint_material_options *o);

#endif
