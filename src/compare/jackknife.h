/* Sums over 8 x 8 parts of a picture, and the standard error of what is computed from them.
 *
 * The jackknife: leave out one part at a time; the spread of the 64 values tells how far the whole one may be off. It
 * knows nothing about the distribution, which for glints has long tails, and holds for ratios too.
 */
#ifndef COMPARE_JACKKNIFE_H
#define COMPARE_JACKKNIFE_H

#include "compare/compare.h"

enum { JACKKNIFE_SIDE = 8, JACKKNIFE_PARTS = JACKKNIFE_SIDE * JACKKNIFE_SIDE };

typedef struct jackknife_sums {
    double count, a, b, aa, bb, ab;
} jackknife_sums;

typedef struct jackknife {
    jackknife_sums part[JACKKNIFE_PARTS];
} jackknife;

/* Adds a pair of values at a pixel of a picture of this size. */
void jackknife_add(jackknife *j, int x, int y, int width, int height, double a, double b);
jackknife_sums jackknife_total(const jackknife *j);

/* B over A of the means, or of the means of squares. */
compare_ratio jackknife_ratio_of_means(const jackknife *j);
compare_ratio jackknife_ratio_of_squares(const jackknife *j);

/* Pearson's; 1 where both do not vary, 0 where one does not. */
double jackknife_correlation(const jackknife_sums *s);

#endif
