/* Which cells of a square grid a pixel covers, and how much of each: the pixel's parallelogram against unit squares,
 * exactly. */
#include "footprint/coverage.h"

#include <math.h>

enum { MOST_CORNERS = 8 }; /* a parallelogram cut by two lines has six */

typedef struct polygon {
    int count;
    double x[MOST_CORNERS], y[MOST_CORNERS];
} polygon;

/* The part of p where a x + b y <= c (Sutherland and Hodgman). */
static polygon cut(const polygon *p, double a, double b, double c)
{
    polygon r = { 0 };
    for (int i = 0; i < p->count; i++) {
        const int k = (i + 1) % p->count;
        const double here = a * p->x[i] + b * p->y[i] - c, there = a * p->x[k] + b * p->y[k] - c;
        if (here <= 0.0 && r.count < MOST_CORNERS) {
            r.x[r.count] = p->x[i];
            r.y[r.count++] = p->y[i];
        }
        if ((here < 0.0) != (there < 0.0) && here != there && r.count < MOST_CORNERS) {
            const double t = here / (here - there);
            r.x[r.count] = p->x[i] + t * (p->x[k] - p->x[i]);
            r.y[r.count++] = p->y[i] + t * (p->y[k] - p->y[i]);
        }
    }
    return r;
}

static double area_of(const polygon *p)
{
    /* A fan around the first corner: products of coordinates would swamp the area of a small pixel. */
    double sum = 0.0;
    for (int i = 1; i + 1 < p->count; i++)
        sum += (p->x[i] - p->x[0]) * (p->y[i + 1] - p->y[0]) - (p->x[i + 1] - p->x[0]) * (p->y[i] - p->y[0]);
    return 0.5 * fabs(sum);
}

static void range_of(const double *values, int count, double *low, double *high)
{
    *low = *high = values[0];
    for (int i = 1; i < count; i++) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
}

double coverage_area(const coverage_pixel *p)
{
    const double reach = fabs(p->dudx) + fabs(p->dudy) + fabs(p->dvdx) + fabs(p->dvdy);
    const double area = fabs(p->dudx * p->dvdy - p->dudy * p->dvdx);
    /* Corners are off by 2^-53 of a cell or of the reach: 10^-6 of the area that is left here. */
    return area > 1e-10 * reach * fmax(reach, 1.0) ? area : 0.0;
}

double coverage_cell_bound(const coverage_pixel *p)
{
    if (!(fabs(p->u) < 1e12 && fabs(p->v) < 1e12))
        return HUGE_VAL;
    /* A convex shape touches the cells of its area, and those along its outline. */
    const double width = fabs(p->dudx) + fabs(p->dudy), height = fabs(p->dvdx) + fabs(p->dvdy);
    return coverage_area(p) + 2.0 * (width + height) + 4.0;
}

void coverage_each(const coverage_pixel *p, void (*visit)(int64_t x, int64_t y, double share, void *user), void *user)
{
    /* Corners relative to the cell of the centre: far from the origin nothing but the cell's number is large. */
    const double base_u = floor(p->u), base_v = floor(p->v);
    polygon whole = { .count = 4 };
    for (int i = 0; i < 4; i++) {
        const double sx = i == 1 || i == 2 ? 0.5 : -0.5, sy = i >= 2 ? 0.5 : -0.5;
        whole.x[i] = p->u - base_u + sx * p->dudx + sy * p->dudy;
        whole.y[i] = p->v - base_v + sx * p->dvdx + sy * p->dvdy;
    }
    const double scale = 1.0 / area_of(&whole);
    double bottom, top;
    range_of(whole.y, whole.count, &bottom, &top);
    for (double row = floor(bottom); row < top; row += 1.0) {
        polygon strip = cut(&whole, 0.0, -1.0, -row);
        strip = cut(&strip, 0.0, 1.0, row + 1.0);
        if (strip.count < 3)
            continue;
        double left, right;
        range_of(strip.x, strip.count, &left, &right);
        /* The area left of each cell border; a cell has the difference of two. */
        double before = 0.0;
        for (double column = floor(left); column < right; column += 1.0) {
            const polygon part = cut(&strip, 1.0, 0.0, column + 1.0);
            const double up_to = column + 1.0 < right ? area_of(&part) : area_of(&strip);
            if (up_to > before)
                visit((int64_t)(base_u + column), (int64_t)(base_v + row), (up_to - before) * scale, user);
            before = fmax(before, up_to);
        }
    }
}
