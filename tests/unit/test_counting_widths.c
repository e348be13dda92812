/* The counting kernel gives the same bits at every vector width: plain, tinted, drawn, and with several lights a point.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_points.h"

static void every_width_gives_the_same_bits(void **state)
{
    (void)state;
    uint64_t random = 11;
    static float reference[COUNT], facets[COUNT], factor[COUNT], other[COUNT];
    for (int round = 0; round < 30; round++) {
        fill(&random);
        counting_kernel_1(&points, COUNT, reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            const counting_width width = counting_widest(lanes);
            if (round == 0)
                printf("%zu lanes asked, %zu found\n", lanes, width.lanes);
            width.kernel(&points, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
            counting_narrowest(lanes).kernel(&points, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        for (int i = 0; i < COUNT; i++)
            assert_true(isfinite(reference[i]) && reference[i] >= 0.0F && isfinite(facets[i]) && facets[i] >= 0.0F);
    }
}

static void every_width_draws_the_same_realisation(void **state)
{
    (void)state;
    uint64_t random = 21;
    static uint32_t draw[COUNT];
    static float reference[COUNT], facets[COUNT], factor[COUNT], other[COUNT];
    for (int round = 0; round < 30; round++) {
        fill(&random);
        for (int i = 0; i < COUNT; i++)
            draw[i] = random_bits(&random) % 40 == 0 ? 0xffffffffU : (uint32_t)random_bits(&random);
        counting_drawn_1(&points, draw, COUNT, reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            counting_widest(lanes).drawn(&points, draw, COUNT, factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        for (int i = 0; i < COUNT; i++)
            assert_true(isfinite(reference[i]) && reference[i] >= 0.0F && isfinite(facets[i]) && facets[i] >= 0.0F);
    }
}

static void every_width_gives_the_same_tints(void **state)
{
    (void)state;
    uint64_t random = 15;
    static float reference[3][COUNT], facets[COUNT], factor[3][COUNT], other[COUNT];
    float *const to_reference[3] = { reference[0], reference[1], reference[2] };
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    for (uint32_t round = 0; round < 18; round++) {
        const tint_palette palette = palette_of(round % 9, round < 9 ? 0.0F : 0.9F);
        fill(&random);
        counting_tinted_1(&points, COUNT, &palette, to_reference, facets);
        for (size_t lanes = 4; lanes <= 16; lanes *= 2) {
            counting_widest(lanes).tinted(&points, COUNT, &palette, to_factor, other);
            assert_memory_equal(factor, reference, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
        }
        counting_narrowest(16).tinted(&points, COUNT, &palette, to_factor, other);
        assert_memory_equal(factor, reference, sizeof(factor));
        assert_memory_equal(other, facets, sizeof(other));
        for (int i = 0; i < 3 * COUNT; i++)
            assert_true(isfinite(reference[i % 3][i / 3]) && reference[i % 3][i / 3] >= 0.0F);
    }
}

/* Every width, for one light or several a point, in runs that begin and end anywhere in a vector. */
static void lights_of_a_point_have_the_bits_of_points_alone(void **state)
{
    (void)state;
    uint64_t random = 31;
    static float alone[COUNT], facets[COUNT], factor[COUNT], other[COUNT], tinted[3][COUNT];
    static double far[2][COUNT];
    static float near[5][COUNT];
    static uint32_t place[COUNT], seed[COUNT];
    float *const to_tinted[3] = { tinted[0], tinted[1], tinted[2] };
    const tint_palette white = palette_of(0, 0.0F);
    for (uint32_t most = 1; most <= 12; most++) {
        fill(&random);
        for (int i = 1; i < COUNT; i++)
            place[i] = place[i - 1] + (random_bits(&random) % most == 0);
        for (int i = 0; i < COUNT; i++) {
            far[0][i] = a.u[place[i]];
            far[1][i] = a.v[place[i]];
            near[0][i] = a.dudx[place[i]];
            near[1][i] = a.dudy[place[i]];
            near[2][i] = a.dvdx[place[i]];
            near[3][i] = a.dvdy[place[i]];
            near[4][i] = a.density[place[i]];
            seed[i] = a.seed[place[i]];
        }
        const counting_points apart = { far[0],  far[1], near[0], near[1], near[2], near[3],
                                        near[4], seed,   a.hx,    a.hy,    a.cap,   a.p };
        counting_points together = points;
        together.place = place;
        counting_kernel_1(&apart, COUNT, alone, facets);
        for (size_t lanes = 1; lanes <= 16; lanes *= 2) {
            const counting_width width = counting_widest(lanes);
            width.kernel(&together, COUNT, factor, other);
            assert_memory_equal(factor, alone, sizeof(factor));
            assert_memory_equal(other, facets, sizeof(other));
            width.tinted(&together, COUNT, &white, to_tinted, other);
            for (int c = 0; c < 3; c++)
                assert_memory_equal(tinted[c], alone, sizeof(alone));
            counting_narrowest(lanes).kernel(&together, COUNT, factor, other);
            assert_memory_equal(factor, alone, sizeof(factor));
        }
    }
}

static void one_white_color_gives_the_bits_of_the_plain_kernel(void **state)
{
    (void)state;
    uint64_t random = 16;
    static float plain[COUNT], facets[COUNT], factor[3][COUNT], other[COUNT];
    float *const to_factor[3] = { factor[0], factor[1], factor[2] };
    const tint_palette white = palette_of(0, 0.0F);
    for (int round = 0; round < 10; round++) {
        fill(&random);
        const counting_width width = counting_widest(16);
        width.kernel(&points, COUNT, plain, facets);
        width.tinted(&points, COUNT, &white, to_factor, other);
        for (int c = 0; c < 3; c++)
            assert_memory_equal(factor[c], plain, sizeof(plain));
        assert_memory_equal(other, facets, sizeof(facets));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_width_gives_the_same_bits),
        cmocka_unit_test(every_width_draws_the_same_realisation),
        cmocka_unit_test(every_width_gives_the_same_tints),
        cmocka_unit_test(lights_of_a_point_have_the_bits_of_points_alone),
        cmocka_unit_test(one_white_color_gives_the_bits_of_the_plain_kernel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
