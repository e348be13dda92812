/* References in numbers that are wider than those of the library: long double has 64 bits of mantissa on x86 and 113 on
 * ARM. Its own rounding is 2^-40 of a float's and at least 2^-11 of a double's.
 *
 * Errors are counted in the unit roundoff of the type under test: half the distance between a number just above one and
 * its neighbour, which is the largest relative error of one rounding. A bound of k of them says that k roundings add up
 * at worst.
 */
#ifndef STUDY_WIDE_H
#define STUDY_WIDE_H

#include <math.h>
#include <stdio.h>

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

#define FLOAT_ROUNDING 0x1p-24L
#define DOUBLE_ROUNDING 0x1p-53L

/* The largest of many errors, and the number where it was found. */
typedef struct worst_error {
    wide error; /* over its own bound */
    wide measured, allowed;
    double at[3];
} worst_error;

/* One error against the bound that holds there. */
static inline void worst_add(worst_error *w, wide error, wide bound, double x, double y, double z)
{
    const wide e = fabsl(error) / bound;
    if (e <= w->error)
        return;
    *w = (worst_error){ e, fabsl(error), bound, { x, y, z } };
}

/* |got / exact - 1|; of two zeros 0. */
static inline wide relative_error(double got, wide exact)
{
    return exact == 0.0L ? fabsl((wide)got) : fabsl((wide)got / exact - 1.0L);
}

/* Prints what was measured; 1 where the bound holds everywhere. */
static inline int worst_holds(const worst_error *w, const char *what, double unit)
{
    printf("%-44s %8.3Lg of %8.3Lg roundings, at %g %g %g\n", what, w->measured / (wide)unit, w->allowed / (wide)unit,
           w->at[0], w->at[1], w->at[2]);
    return w->error <= 1.0L;
}

/* exp(x^2) erfc(x) for x >= 0; its asymptotic series where erfc leaves the numbers. */
static inline wide wide_erfcx(wide x)
{
    if (x < 20.0L)
        return expl(x * x) * erfcl(x);
    wide term = 1.0L, sum = 1.0L;
    for (int k = 1; k < 12; k++) {
        term *= -(2.0L * k - 1.0L) / (2.0L * x * x);
        sum += term;
    }
    return sum / (x * sqrtl(WIDE_PI));
}

#endif
