/* Places: footprints, cells of the surface and of half vectors. */
#include "naive.h"

#include <math.h>

#define GLINT_LANES 1
#include "footprint/coverage.h"
#include "footprint/grid.h"
#include "model/counting_place.h"

static void long_footprint(void)
{
    /* 1 m by 1 micrometre, a sixth of a turn around. */
    const float j[4] = { 0.5F, -0.866025404e-6F, 0.866025404F, 0.5e-6F };
    const float turned[4] = { j[0] * 0.6F - j[1] * 0.8F, j[0] * 0.8F + j[1] * 0.6F, j[2] * 0.6F - j[3] * 0.8F,
                              j[2] * 0.8F + j[3] * 0.6F };
    const wide exact = fabsl((wide)turned[0] * (wide)turned[3] - (wide)turned[1] * (wide)turned[2]);
    naive_print(&(naive_row){ "area of a footprint a million times as long as wide, m²", "dudx dvdy - dudy dvdx",
                              (double)fabsf(f(turned[0] * turned[3]) - f(turned[1] * turned[2])), exact,
                              (double)grid_area(turned[0], turned[1], turned[2], turned[3]),
                              "both products exact, in double", "1 rounding; N 2", "counting_edges" });
}

static void far_cell(double u, const char *what)
{
    const double cells = 1024.0;
    const float far = f((float)u * (float)cells);
    vuint low;
    naive_print(&(naive_row){ what, "u / side - ⌊u / side⌋ in float", (double)(far - floorf(far)),
                              (wide)u * (wide)cells - floorl((wide)u * (wide)cells),
                              (double)grid_fraction(u * cells, &low),
                              "the cell's number as an integer, the rest in double",
                              "3·2⁻⁵³ of the distance in cells, and 2 roundings", "counting_edges" });
}

static void no_cell(void)
{
    /* Just below a power of two, so that the sum has half of the digits that x has. */
    const double x = 0x1p58 - 96.0, nearest = (x + 6755399441055744.0) - 6755399441055744.0;
    vuint low;
    naive_print(&(naive_row){ "weight of a cell that has no number any more, 2⁵⁸ cells out",
                              "x - ⌊x⌋ with ⌊x⌋ by adding 1.5·2⁵²", x - (x < nearest ? nearest - 1.0 : nearest),
                              ANY_WEIGHT, (double)grid_fraction(x, &low),
                              "⌊x⌋ of a double is exact: weights in [0, 1] that add up to 1, and the mean stays",
                              "mean exact", "counting_edges" });
}

static void add_share(int64_t x, int64_t y, double share, void *user)
{
    (void)x;
    (void)y;
    *(double *)user += share;
}

static void small_pixel(void)
{
    const double u = 123456789.25, v = 987654321.75, s = 1e-3;
    const coverage_pixel p = { u, v, s, 0.0, 0.0, s };
    const double x[4] = { u - 0.5 * s, u + 0.5 * s, u + 0.5 * s, u - 0.5 * s };
    const double y[4] = { v - 0.5 * s, v - 0.5 * s, v + 0.5 * s, v + 0.5 * s };
    volatile double sum = 0.0;
    for (int i = 0; i < 4; i++)
        sum += x[i] * y[(i + 1) % 4] - x[(i + 1) % 4] * y[i];
    double whole = 0.0;
    coverage_each(&p, add_share, &whole);
    naive_print(&(naive_row){ "share of a pixel of 10⁻³ cells that its cells hold, 10⁹ cells out",
                              "shoelace formula, in double, over s²", 0.5 * sum / (s * s), 1.0L, whole,
                              "corners from the pixel's own cell, a fan of differences",
                              "8 double roundings of outline² / area", "area_precision" });
}

/* Cells of polar angles have a seam, and at the pole all of them meet. */
static void over_the_pole(void)
{
    const float h = 1e-4F, cap = 0.01F;
    const angular_lattice here = angular_locate(h, 0.0F, cap), there = angular_locate(-h, 0.0F, cap);
    /* Units of 2^-16 of a cell, whose level is the power of two that has this area. A rhombus of area 1 has sides of
     * the root of 2 / sqrt 3. */
    const double cells = exp2(ceil(-0.5 * log2((double)cap))) * sqrt(0.5 * sqrt(3.0));
    naive_print(&(naive_row){ "how far h moves from 10⁻⁴ on one side of the pole to 10⁻⁴ on the other",
                              "cells of the azimuth atan2(h_y, h_x)", (double)f(atan2f(0.0F, -h) - atan2f(0.0F, h)),
                              2.0L * (wide)h, (double)(here.x - there.x) / (65536.0 * cells),
                              "cells of h_x and h_y, signed, counted from 0", "2⁻¹⁶ of a cell on either side",
                              "counting_edges" });
}

void naive_places(void)
{
    long_footprint();
    far_cell(1e6 + 0.00037, "place within a cell of 1 mm, 1000 km from the origin");
    far_cell(1e9 + 0.00037, "the same, a million km from the origin");
    no_cell();
    small_pixel();
    over_the_pole();
}
