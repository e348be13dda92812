/* Points and weights over a square and a disk: sums over them are means of every polynomial up to a degree.
 *
 * Points come in rows of eight, for lanes. Weights add up to one. The unit test `cubature` holds each rule to its
 * degree.
 */
#ifndef LIGHT_CUBATURE_H
#define LIGHT_CUBATURE_H

enum { CUBATURE_ROW = 8 };

/* x and y in [-1, 1]; x^2 + y^2 <= 1. */
enum { CUBATURE_SQUARE, CUBATURE_DISK, CUBATURE_SHAPES };

/* Of degrees 5, 7, 11 and 15. */
enum { CUBATURE_COARSE, CUBATURE_MIDDLE, CUBATURE_FINE, CUBATURE_FINEST, CUBATURE_LEVELS };

typedef struct cubature {
    int row_count;
    const float (*row)[3][CUBATURE_ROW]; /* x, y and weight */
} cubature;

extern const cubature cubatures[CUBATURE_SHAPES][CUBATURE_LEVELS];

#endif
