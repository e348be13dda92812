/* How well the sampler spreads its points, and that its dimensions do not know of one another. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "preview/sampler.h"

#define SAMPLES 64

static void draw(int x, int y, uint32_t dimension, double points[SAMPLES][2])
{
    for (uint32_t i = 0; i < SAMPLES; ++i) {
        const sampler s = sampler_make(x, y, i, 7U);
        sampler_pair(&s, dimension, points[i]);
        assert_true(points[i][0] >= 0.0 && points[i][0] < 1.0);
        assert_true(points[i][1] >= 0.0 && points[i][1] < 1.0);
    }
}

/* The definition of a (0, m, 2)-net: every box of 2^-a by 2^-(m-a) holds one point of the first 2^m. */
static void every_elementary_box_holds_one_point(void **state)
{
    (void)state;
    double points[SAMPLES][2];
    for (int pixel = 0; pixel < 50; ++pixel) {
        draw(pixel, 3 * pixel, (uint32_t)pixel % 7U, points);
        for (int m = 0; m <= 6; ++m) {
            for (int a = 0; a <= m; ++a) {
                int seen[SAMPLES] = { 0 };
                for (int i = 0; i < 1 << m; ++i) {
                    const int column = (int)(points[i][0] * (1 << a));
                    const int row = (int)(points[i][1] * (1 << (m - a)));
                    ++seen[(column << (m - a)) + row];
                }
                for (int box = 0; box < 1 << m; ++box)
                    assert_int_equal(seen[box], 1);
            }
        }
    }
}

/* Pairs (u of one dimension, u of the next) of one sample in every pixel: independent uniforms fill an 8 x 8 table
 * evenly. Pearson's chi^2 with 63 degrees of freedom exceeds 131 with probability 1e-6. */
static double chi_square(uint32_t first, uint32_t second, int dx)
{
    enum { SIDE = 128 };
    int cells[64] = { 0 };
    for (int y = 0; y < SIDE; ++y) {
        for (int x = 0; x < SIDE; ++x) {
            double a[2], b[2];
            const sampler s = sampler_make(x, y, 5U, 1U), t = sampler_make(x + dx, y, 5U, 1U);
            sampler_pair(&s, first, a);
            sampler_pair(&t, second, b);
            ++cells[8 * (int)(8.0 * a[0]) + (int)(8.0 * b[dx == 0 && first == second ? 1 : 0])];
        }
    }
    const double expected = SIDE * SIDE / 64.0;
    double sum = 0.0;
    for (int i = 0; i < 64; ++i)
        sum += (cells[i] - expected) * (cells[i] - expected) / expected;
    return sum;
}

static void dimensions_and_neighbouring_pixels_are_independent(void **state)
{
    (void)state;
    assert_true(chi_square(0U, 0U, 0) < 131.0); /* both numbers of one pair */
    assert_true(chi_square(0U, 1U, 0) < 131.0);
    assert_true(chi_square(3U, 1U << 20, 0) < 131.0);
    assert_true(chi_square(2U, 2U, 1) < 131.0); /* the pixel to the right */
}

static void the_same_question_gets_the_same_answer_and_another_seed_another(void **state)
{
    (void)state;
    double a[2], b[2], c[2];
    const sampler s = sampler_make(10, 20, 3U, 1U), again = sampler_make(10, 20, 3U, 1U);
    const sampler other = sampler_make(10, 20, 3U, 2U);
    sampler_pair(&s, 4U, a);
    sampler_pair(&again, 4U, b);
    sampler_pair(&other, 4U, c);
    assert_memory_equal(a, b, sizeof a);
    assert_memory_not_equal(a, c, sizeof a);
    assert_int_equal(sampler_bits(&s, 4U), sampler_bits(&again, 4U));
    assert_int_not_equal(sampler_bits(&s, 4U), sampler_bits(&s, 5U));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_elementary_box_holds_one_point),
        cmocka_unit_test(dimensions_and_neighbouring_pixels_are_independent),
        cmocka_unit_test(the_same_question_gets_the_same_answer_and_another_seed_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
