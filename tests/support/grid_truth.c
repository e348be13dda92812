/* Variance of blocks of pixels of the counting model from the geometry of its grids alone, without drawing a count. */
#include "grid_truth.h"

#include <math.h>

#define GLINT_LANES 1
#include "footprint/grid.h"

#define PI 3.14159265358979323846

enum { NODES = 64, FINE = 32 }; /* of the table of [-2, 2]^2; a node's own quadrature, per unit */

/* Weight of the cell at the origin, in the skewed coordinates in which the lattice is that of the integers. */
static double hat(double x, double y)
{
    return fmax(0.0, 1.0 - fmax(fabs(x), fmax(fabs(y), fabs(x + y))));
}

/* E over places of sum_c w_c(x) w_c(x + d): the autocorrelation of the hat. */
static double correlation_at(double dx, double dy)
{
    double sum = 0.0;
    for (int i = 0; i < 2 * FINE; i++)
        for (int k = 0; k < 2 * FINE; k++) {
            const double x = (i + 0.5) / FINE - 1.0, y = (k + 0.5) / FINE - 1.0;
            sum += hat(x, y) * hat(x + dx, y + dy);
        }
    return sum / (FINE * FINE);
}

static double correlation(double dx, double dy)
{
    static double table[NODES + 1][NODES + 1];
    if (table[NODES / 2][NODES / 2] == 0.0)
        for (int i = 0; i <= NODES; i++)
            for (int k = 0; k <= NODES; k++)
                table[i][k] = correlation_at(i * 4.0 / NODES - 2.0, k * 4.0 / NODES - 2.0);
    const double x = (dx + 2.0) * NODES / 4.0, y = (dy + 2.0) * NODES / 4.0;
    if (!(x >= 0.0 && y >= 0.0 && x < NODES && y < NODES))
        return 0.0;
    const int i = (int)x, k = (int)y;
    const double a = x - i, b = y - k;
    return (1.0 - b) * ((1.0 - a) * table[i][k] + a * table[i + 1][k]) +
           b * ((1.0 - a) * table[i][k + 1] + a * table[i + 1][k + 1]);
}

/* From metres to the skewed coordinates of a grid whose cells have spacing 2^(level / 2) across and 2^ratio times that
 * along its direction. */
static void lattice_of(const grid_vertex *g, double m[4])
{
    const double angle = PI * (double)g->direction / exp2(g->ratio);
    const double across = exp2(-0.5 * g->level), along = across / exp2(g->ratio);
    const double skew = across / sqrt(3.0), tall = 2.0 * across / sqrt(3.0);
    m[0] = cos(angle) * along + sin(angle) * skew;
    m[1] = sin(angle) * along - cos(angle) * skew;
    m[2] = -sin(angle) * tall;
    m[3] = cos(angle) * tall;
}

/* E sum S_c^2: over all pairs of samples of the block, by their distance. */
static double squares_of(const grid_vertex *g, const float j[4], int side)
{
    double m[4];
    lattice_of(g, m);
    const double xx = m[0] * (double)j[0] + m[1] * (double)j[2], xy = m[0] * (double)j[1] + m[1] * (double)j[3];
    const double yx = m[2] * (double)j[0] + m[3] * (double)j[2], yy = m[2] * (double)j[1] + m[3] * (double)j[3];
    double sum = 0.0;
    for (int y = 1 - side; y < side; y++)
        for (int x = 1 - side; x < side; x++)
            sum += (side - fabs((double)x)) * (side - fabs((double)y)) * correlation(xx * x + xy * y, yx * x + yy * y);
    return sum / pow(side, 4.0);
}

double grid_overlap(int k, int split, const double jacobian[4], double facets_per_m2)
{
    float j[4];
    for (int i = 0; i < 4; i++)
        j[i] = (float)(jacobian[i] / split);
    const grid_ellipse e =
        grid_ellipse_of(j[0], j[1], j[2], j[3], grid_area(j[0], j[1], j[2], j[3]), (float)(0.5 / facets_per_m2));
    const grid_shape shape = grid_shape_of(&e);
    grid_vertex vertex[GRID_COUNT];
    float share[GRID_COUNT];
    grid_tetrahedron(&shape, vertex, share);
    double sum = 0.0;
    for (int i = 0; i < GRID_COUNT; i++)
        if (share[i] > 0.0F)
            sum += (double)share[i] * squares_of(&vertex[i], j, k * split);
    return sum / ((double)e.area * facets_per_m2);
}
