/* The grids under a footprint: shares, weights, areas, and that nothing jumps when the footprint moves, turns or grows.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#define GLINT_LANES 1
#include "footprint/grid.h"
#include "statistics.h"

typedef struct ellipse {
    double major, aspect, turn, roll; /* axis in m, ratio, directions of the axes on the surface and of the pixel */
} ellipse;

typedef struct placed {
    double u, v;
    ellipse e;
} placed;

static void jacobian_of(const ellipse *e, float j[4])
{
    /* Rotation, scaling, rotation: every Jacobian with these singular values. */
    const double minor = e->major / e->aspect, c = cos(e->turn), s = sin(e->turn), a = cos(e->roll), b = sin(e->roll);
    j[0] = (float)(c * e->major * a - s * minor * b);
    j[1] = (float)(-c * e->major * b - s * minor * a);
    j[2] = (float)(s * e->major * a + c * minor * b);
    j[3] = (float)(-s * e->major * b + c * minor * a);
}

static grid_point locate(const placed *p)
{
    float j[4];
    jacobian_of(&p->e, j);
    const grid_ellipse e = grid_ellipse_of(j[0], j[1], j[2], j[3], grid_area(j[0], j[1], j[2], j[3]), 0.0F);
    grid_point g;
    grid_locate(p->u, p->v, &e, 77U, &g);
    return g;
}

static placed random_place(uint64_t *random, double most_aspect)
{
    return (placed){ random_between(random, -5.0, 5.0),
                     random_between(random, -5.0, 5.0),
                     { random_log_between(random, 1e-5, 1e-1), random_log_between(random, 1.0, most_aspect),
                       random_between(random, 0.0, 6.3), random_between(random, 0.0, 6.3) } };
}

static void shares_and_weights_are_convex(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int k = 0; k < 100000; k++) {
        const placed p = random_place(&random, 1e5);
        const grid_point g = locate(&p);
        double shares = 0.0;
        for (int i = 0; i < GRID_COUNT; i++) {
            double weights = 0.0;
            for (int c = 0; c < GRID_CELLS; c++) {
                assert_true(g.weight[GRID_CELLS * i + c] >= 0.0F);
                weights += (double)g.weight[GRID_CELLS * i + c];
            }
            assert_true(fabs(weights - 1.0) < 3e-7);
            assert_true(g.share[i] >= -2e-7F);
            shares += (double)g.share[i];
        }
        assert_true(fabs(shares - 1.0) < 6e-7);
    }
}

static void shares_are_linear_in_area(void **state)
{
    (void)state;
    uint64_t random = 2;
    double worst = 0.0;
    for (int k = 0; k < 100000; k++) {
        const placed p = random_place(&random, 1000.0);
        float j[4];
        jacobian_of(&p.e, j);
        const double area = (double)grid_area(j[0], j[1], j[2], j[3]);
        const grid_ellipse e = grid_ellipse_of(j[0], j[1], j[2], j[3], (float)area, 0.0F);
        const grid_shape shape = grid_shape_of(&e);
        grid_vertex vertex[GRID_COUNT];
        float share[GRID_COUNT];
        grid_tetrahedron(&shape, vertex, share);
        double sum = 0.0;
        for (int i = 0; i < GRID_COUNT; i++) /* sqrt(3)/2 of a stretched square of area 2^level */
            sum += (double)share[i] * 0.86602540378 * ldexp(1.0, vertex[i].level + vertex[i].ratio);
        worst = fmax(worst, fabs(sum / area - 1.0));
        /* The area from the axes, in double. */
        assert_true(fabs(area / (p.e.major * p.e.major / p.e.aspect) - 1.0) < 2e-7 * p.e.aspect + 2e-7);
    }
    printf("sum of share * area / area of the footprint is off by at most %.1e\n", worst);
    /* The aspect ratio is a quotient of floats, half a dozen roundings; the shares multiply them by at most 4. */
    assert_true(worst < 24.0 * 6e-8 * 4.0);
}

/* A pixel much thinner than a facet has the facet's width, and the determinant is that of the sum. */
static void facets_widen_thin_footprints(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int k = 0; k < 100000; k++) {
        const placed p = random_place(&random, 1e6);
        const double facet = p.e.major * random_log_between(&random, 1e-6, 1e2);
        float j[4];
        jacobian_of(&p.e, j);
        const grid_ellipse e =
            grid_ellipse_of(j[0], j[1], j[2], j[3], grid_area(j[0], j[1], j[2], j[3]), (float)(facet * facet));
        const double minor = p.e.major / p.e.aspect;
        const double area = sqrt((p.e.major * p.e.major + facet * facet) * (minor * minor + facet * facet));
        /* The pixel's own area comes from floats: at this aspect ratio they are off by an ulp of the major axis. */
        const double rounding = 2e-7 * p.e.major * p.e.major / area;
        assert_true(fabs((double)e.area / area - 1.0) < 1e-6 + rounding);
    }
}

/* Total variation between two blends over cells: 0 when the same cells have the same weights, 2 when none is shared. */
static double distance(const grid_point *a, const grid_point *b)
{
    double total = 0.0;
    const grid_point *const both[2] = { a, b };
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < GRID_COUNT * GRID_CELLS; i++) {
            double mine = 0.0, theirs = 0.0;
            int first = 1;
            for (int k = 0; k < GRID_COUNT * GRID_CELLS; k++) {
                if (both[side]->cell[k] == both[side]->cell[i]) {
                    mine += (double)(both[side]->share[k / GRID_CELLS] * both[side]->weight[k]);
                    first = first && k >= i;
                }
                if (both[1 - side]->cell[k] == both[side]->cell[i])
                    theirs += (double)(both[1 - side]->share[k / GRID_CELLS] * both[1 - side]->weight[k]);
            }
            if (first)
                total += side == 0 || theirs == 0.0 ? fabs(mine - theirs) : 0.0;
        }
    return total;
}

/* Moves in small steps along a path through footprints and sums up what changes: a jump would be an O(1) change in one
 * step. */
static void blend_moves_without_jumps(void **state)
{
    (void)state;
    uint64_t random = 5;
    const double step = 1e-4;
    double worst = 0.0;
    for (int k = 0; k < 60000; k++) {
        placed p = random_place(&random, 200.0);
        p.u *= p.e.major;
        p.v *= p.e.major;
        placed q = p;
        /* A ten-thousandth of the footprint's own size in every respect. The direction matters 1/aspect as much. */
        q.e.major *= 1.0 + step * random_between(&random, -1.0, 1.0);
        q.e.aspect *= 1.0 + step * random_between(&random, -1.0, 1.0);
        q.e.turn += step / q.e.aspect * random_between(&random, -1.0, 1.0);
        q.u += step * q.e.major / q.e.aspect * random_between(&random, -1.0, 1.0);
        q.v += step * q.e.major / q.e.aspect * random_between(&random, -1.0, 1.0);
        const grid_point a = locate(&p), b = locate(&q);
        /* Near ratio 1 the direction is undefined in float and its weight vanishes with the distance from 1. */
        worst = fmax(worst, distance(&a, &b));
    }
    printf("largest change of the blend for steps of 1e-4: %.1e\n", worst);
    /* Lipschitz: each of the four quantities moves a share by at most 4 per unit and a weight by at most 4, on both
     * sides. */
    assert_true(worst < step * 4.0 * (4.0 + 4.0) * 2.0);
}

static void cells_stay_apart_far_from_the_origin(void **state)
{
    (void)state;
    /* A hundred thousand steps of half a cell, a thousand kilometres out: a float would repeat cells by the hundred. */
    uint32_t last = 0;
    int changes = 0;
    for (int k = 0; k < 100000; k++) {
        const placed p = { 1e6 + 5e-4 * k, -1e6, { 1e-3, 1.0, 0.0, 0.0 } };
        const grid_point g = locate(&p);
        int heaviest = 0;
        for (int i = 1; i < GRID_CELLS; i++)
            heaviest = g.weight[i] > g.weight[heaviest] ? i : heaviest;
        changes += g.cell[heaviest] != last;
        last = g.cell[heaviest];
    }
    /* The lattice under a footprint of 1 mm has 1/1024 m between vertices; a straight line crosses into another
     * vertex's hexagon at least once and at most twice per spacing. */
    const double spacings = 50.0 * 1024.0;
    assert_in_range(changes, (uintmax_t)(0.95 * spacings), (uintmax_t)(2.05 * spacings));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_and_weights_are_convex),        cmocka_unit_test(shares_are_linear_in_area),
        cmocka_unit_test(facets_widen_thin_footprints),         cmocka_unit_test(blend_moves_without_jumps),
        cmocka_unit_test(cells_stay_apart_far_from_the_origin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
