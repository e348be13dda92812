/* Integrals of several functions at once over squares, in double, cut finer where they are least known until an error
 * that is asked for is reached. The error is estimated and reported.
 */
#ifndef STUDY_ADAPTIVE_H
#define STUDY_ADAPTIVE_H

enum { ADAPTIVE_MOST = 6 };

/* The functions at (x, y) in [0, 1]^2 of a square. */
typedef void adaptive_integrand(const void *user, int square, double x, double y, double value[ADAPTIVE_MOST]);

typedef struct adaptive_task {
    adaptive_integrand *f;
    const void *user;
    int squares;      /* over which all is summed */
    int wanted;       /* of the functions the first so many are to be known */
    double tolerance; /* relative to each integral */
} adaptive_task;

typedef struct adaptive_result {
    double value[ADAPTIVE_MOST];
    double error; /* the largest of the wanted, relative: what rules of degree 13 and 22 differ by, summed over cells */
    int cells;    /* 225 points each */
} adaptive_result;

/* Stops where the error is below the tolerance, or is rounding, or there are too many cells. */
adaptive_result adaptive_integrate(const adaptive_task *task);

#endif
