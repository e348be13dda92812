/* Rules over a square and a disk: each is exact for every polynomial of its degree, by closed forms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "light/cubature.h"

/* The mean of x^i y^j. */
static double mean_of(int shape, int i, int j)
{
    if (i % 2 || j % 2)
        return 0.0;
    if (shape == CUBATURE_SQUARE)
        return 1.0 / ((i + 1.0) * (j + 1.0));
    /* Dirichlet's integral over the disk, over its area. */
    return tgamma(0.5 * (i + 1)) * tgamma(0.5 * (j + 1)) / tgamma(0.5 * (i + j) + 2.0) / 3.14159265358979323846;
}

static double sum_of(const cubature *c, int i, int j)
{
    double sum = 0.0;
    for (int r = 0; r < c->row_count; r++)
        for (int k = 0; k < CUBATURE_ROW; k++)
            sum += (double)c->row[r][2][k] * pow((double)c->row[r][0][k], i) * pow((double)c->row[r][1][k], j);
    return sum;
}

static void every_rule_is_exact_up_to_its_degree(void **state)
{
    (void)state;
    static const int degree[CUBATURE_LEVELS] = { 5, 7, 11, 15 };
    for (int shape = 0; shape < CUBATURE_SHAPES; shape++)
        for (int level = 0; level < CUBATURE_LEVELS; level++) {
            const cubature *c = &cubatures[shape][level];
            for (int d = 0; d <= degree[level]; d++)
                for (int i = 0; i <= d; i++) {
                    const double found = sum_of(c, i, d - i), expected = mean_of(shape, i, d - i);
                    /* Nodes and weights are rounded to 2^-24 of themselves, and a power is off by as many times that.
                     */
                    if (fabs(found - expected) > (d + 1) * 0x1p-24)
                        fail_msg("shape %d, level %d, x^%d y^%d: %.9g, expected %.9g", shape, level, i, d - i, found,
                                 expected);
                }
        }
}

static void every_point_lies_within(void **state)
{
    (void)state;
    for (int shape = 0; shape < CUBATURE_SHAPES; shape++)
        for (int level = 0; level < CUBATURE_LEVELS; level++) {
            const cubature *c = &cubatures[shape][level];
            for (int k = 0; k < CUBATURE_ROW * c->row_count; k++) {
                const float x = c->row[k / 8][0][k % 8], y = c->row[k / 8][1][k % 8], w = c->row[k / 8][2][k % 8];
                assert_true(w >= 0.0F);
                assert_true(shape == CUBATURE_SQUARE ? fabsf(x) < 1.0F && fabsf(y) < 1.0F : x * x + y * y < 1.0F);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_is_exact_up_to_its_degree),
        cmocka_unit_test(every_point_lies_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
