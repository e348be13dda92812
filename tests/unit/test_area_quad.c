/* The sums over a light are the same bits whatever the processor knows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "model/area_cells.h"
#include "model/area_quad.h"
#include "statistics.h"

static float between(uint64_t *random, double low, double high)
{
    return (float)random_between(random, low, high);
}

static vec3 unit_above(uint64_t *random)
{
    const vec3 v = { between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, 0.01, 1.0) };
    return vec3_normalize(v);
}

static ltc fit_of(const quad_lobe *lobe)
{
    return ltc_find_base(lobe->is_ggx ? NDF_GGX : NDF_BECKMANN, (double)lobe->alpha, vec3d_of(lobe->wo));
}

static vec3d any_vector(uint64_t *random, double size)
{
    return (vec3d){ size * random_between(random, -1.0, 1.0), size * random_between(random, -1.0, 1.0),
                    size * random_between(random, -1.0, 1.0) };
}

/* Rectangles, ellipses and round lights, above the horizon or astride it, of any size. */
static void any_light(uint64_t *random, area_light *light)
{
    const double size = random_log_between(random, 1e-5, 30.0);
    vec3d center = any_vector(random, 1.0);
    center.z = fabs(center.z);
    const vec3d x = any_vector(random, size), y = any_vector(random, size);
    switch (random_bits(random) % 3U) {
    case 0:
        area_make_rectangle(light, center, x, y, 1);
        break;
    case 1:
        area_make_ellipse(light, center, x, y, 1);
        break;
    default: {
        const double angle = random_log_between(random, 1e-5, 1.5);
        area_make_round(light, vec3d_normalize(center), sin(angle), cos(angle));
    }
    }
}

static void every_processor_gives_the_same_bits(void **state)
{
    (void)state;
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2"))
        skip();
    uint64_t random = 51;
    int seen = 0;
    for (int i = 0; i < 100000; i++) {
        quad_lobe lobe = { .is_ggx = (int)(random_bits(&random) & 1U),
                           .is_schlick = (int)(random_bits(&random) & 1U),
                           .alpha = (float)random_log_between(&random, 1e-4, 1.0),
                           .masked_o = between(&random, 0.0, 0.5),
                           .wo = unit_above(&random) };
        const ltc fit = fit_of(&lobe);
        lobe.back[0] = (vec3){ (float)fit.column[0].x, (float)fit.column[1].x, (float)fit.column[2].x };
        lobe.back[1] = (vec3){ (float)fit.column[0].y, (float)fit.column[1].y, (float)fit.column[2].y };
        area_light light;
        ltc_light moved[2];
        quad_sums sums[2];
        any_light(&random, &light);
        if (light.kind == AREA_NOTHING)
            continue;
        memset(moved, 0, sizeof(moved));
        const int is_seen = ltc_move_base(&fit, &light, &moved[0]);
        assert_int_equal(ltc_move_avx2(&fit, &light, &moved[1]), is_seen);
        assert_memory_equal(&moved[0], &moved[1], sizeof(moved[0]));
        if (!is_seen)
            continue;
        area_quad_sum_base(&lobe, &moved[0], &sums[0]);
        area_quad_sum_avx2(&lobe, &moved[0], &sums[1]);
        assert_memory_equal(&sums[0], &sums[1], sizeof(sums[0]));
        seen++;
    }
    assert_true(seen > 50000);
#else
    skip();
#endif
}

/* Maps of any shape, whether or not they are those of lights. */
static area_patches any_patches(uint64_t *random)
{
    area_patches p = { .is_round = (int)(random_bits(random) & 1U), .turn = between(random, 1e-5, 0.5) };
    p.count = p.is_round ? 1 : 1 + (int)(random_bits(random) % 5U);
    const double size = random_log_between(random, 1e-4, 2.0);
    for (int i = 0; i < p.count; i++)
        for (int k = 0; k < 3; k++) {
            p.middle[k][i] = between(random, k < 2 ? -1.0 : 0.0, 1.0);
            p.u[k][i] = between(random, -size, size);
            p.v[k][i] = between(random, -size, size);
            p.w[k][i] = between(random, -0.1 * size, 0.1 * size);
            p.size[k][i] = between(random, k ? -0.1 : 0.0, k ? 0.1 : 1.0);
        }
    return p;
}

static void every_processor_sums_cells_to_the_same_bits(void **state)
{
    (void)state;
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2"))
        skip();
    uint64_t random = 52;
    int summed = 0;
    for (int i = 0; i < 20000; i++) {
        const area_eye eye = { .is_ggx = (int)(random_bits(&random) & 1U),
                               .is_schlick = (int)(random_bits(&random) & 1U),
                               .has_base = (int)(random_bits(&random) & 1U),
                               .wo = unit_above(&random),
                               .visible_o = between(&random, 0.1, 1.5),
                               .alpha_x = (float)random_log_between(&random, 1e-2, 1.0),
                               .alpha_y = (float)random_log_between(&random, 1e-2, 1.0) };
        const area_patches patches = any_patches(&random);
        area_node_sums sums[2];
        memset(sums, 0, sizeof(sums));
        const float left = area_cells_sum_base(&eye, &patches, &sums[0]);
        assert_true(area_cells_sum_avx2(&eye, &patches, &sums[1]) == left);
        assert_memory_equal(&sums[0], &sums[1], sizeof(sums[0]));
        summed += left < 1.0F;
    }
    printf("%d of 20000 summed\n", summed);
    assert_true(summed > 5000);
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_processor_gives_the_same_bits),
        cmocka_unit_test(every_processor_sums_cells_to_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
