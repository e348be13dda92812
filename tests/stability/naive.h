/* What the rows of the table of docs/stability.md share: for each hard case what the formula that one would write down
 * first gives in float, what is true (in long double, or known), and what the library gives. */
#ifndef TESTS_NAIVE_H
#define TESTS_NAIVE_H

#include "material_or_exit.h"
#include "wide.h"

/* What the optimiser may not compute at a higher precision, or not at all. */
static inline float f(float x)
{
    volatile float v = x;
    return v;
}

/* In place of a number: any that a weight may be. */
#define ANY_WEIGHT (-(wide)INFINITY)

typedef struct naive_row {
    const char *what;
    const char *formula; /* the one that one writes first */
    double naive;
    wide truth;
    double ours;
    const char *done, *bound, *test; /* Markdown */
} naive_row;

/* Prints it as Markdown. */
void naive_print(const naive_row *row);

void naive_facets(void);
void naive_counts(void);
void naive_places(void);
void naive_lights(void);

#endif
