/* Which cells of a square grid a pixel covers, and how much of each: the pixel's parallelogram against unit squares,
 * exactly. */
#ifndef FOOTPRINT_COVERAGE_H
#define FOOTPRINT_COVERAGE_H

#include <stdint.h>

/* A pixel in units of cells: its centre and its two sides. */
typedef struct coverage_pixel {
    double u, v;
    double dudx, dudy, dvdx, dvdy;
} coverage_pixel;

/* Area of the pixel in cells. */
double coverage_area(const coverage_pixel *p);

/* At least as many as the cells that the pixel touches; infinite where a cell's number would not be whole in a double.
 */
double coverage_cell_bound(const coverage_pixel *p);

/* Calls visit once for every cell that the pixel touches, row by row: cell (x, y) holds the part `share` of the pixel.
 * The shares add up to one. The time is linear in the number of cells. The pixel must have an area. */
void coverage_each(const coverage_pixel *p, void (*visit)(int64_t x, int64_t y, double share, void *user), void *user);

#endif
