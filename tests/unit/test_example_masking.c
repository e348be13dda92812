/* Masking from the table against the projected area of every cell of the map, in double precision. */
#include "example_bench.h"

/* E[(v . m)+] - v.z over the cells of the overall map, each for its own tent: three points a side. */
static double masked_truth(const example *e, double x, double y, double z)
{
    const slope_map *m = e->overall.maps;
    const double cell = 1.0 / (double)m->cells_per_unit;
    double sum = 0.0, weight = 0.0;
    for (int j = 0; j < m->rows; j++)
        for (int i = 0; i < m->columns; i++) {
            const double code = (double)e->overall.codes[m->first + (uint32_t)(j * m->columns + i)];
            for (int k = 0; code > 0.0 && k < 9; k++) {
                /* Points at -1/2, 0 and 1/2 with weights 1/3 have the tent's variance, 1/6. */
                const int right = k % 3 - 1, up = k / 3 - 1;
                const double sx = (double)m->low[0] + (i + 0.5 * right) * cell;
                const double sy = (double)m->low[1] + (j + 0.5 * up) * cell;
                sum += code * code * fmax(0.0, z + x * sx + y * sy);
                weight += code * code;
            }
        }
    return fmax(0.0, sum / weight - z);
}

static void masking_is_that_of_the_maps_own_slopes(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int kind = 0; kind <= GLINT_EXAMPLE_ANISOTROPIC_NOISE; kind++) {
        glint_example o = GLINT_EXAMPLE_INIT;
        bench b;
        bench_make(&b, (glint_example_kind)kind, &o);
        const example *e = b.material.baked;
        double worst = 0.0;
        for (int i = 0; i < 300; i++) {
            const double cosine = random_log_between(&random, 1e-4, 1.0), turn = random_between(&random, 0.0, 6.2832);
            const double sine = sqrt(1.0 - cosine * cosine), x = sine * cos(turn), y = sine * sin(turn);
            const double truth = masked_truth(e, x, y, cosine);
            const double own = (double)example_masked(&e->masking, (float)x, (float)y, (float)cosine);
            /* Interpolating a convex function gives too much, never too little; bins and tents are 1e-3 of a slope. */
            assert_true(own > truth - 1e-3);
            worst = fmax(worst, own - truth);
        }
        printf("kind %d: masking adds at most %.4f too much to a projected area of up to 1\n", kind, worst);
        /* Linear interpolation adds at most step^2 / 8 times the second derivative: the square of the slopes, at most
         * one, times the density of the slope along the direction where it is cut, at most 2 for these maps; once
         * for the directions, .196 apart, once for the cotangents. */
        assert_true(worst < 2.0 * 2.0 * 0.196 * 0.196 / 8.0);
        bench_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masking_is_that_of_the_maps_own_slopes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
