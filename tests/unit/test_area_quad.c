/* The sums over a light are the same bits whatever the processor knows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

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

/* A polygon or an ellipse in the moved frame, under any lobe. */
static void make(uint64_t *random, quad_lobe *lobe, quad_light *light)
{
    *lobe = (quad_lobe){ .is_ggx = (int)(random_bits(random) & 1U),
                         .is_schlick = (int)(random_bits(random) & 1U),
                         .alpha = (float)random_log_between(random, 1e-4, 1.0),
                         .wo = unit_above(random) };
    lobe->masked_o = between(random, 0.0, 0.5);
    const float along = 2.0F * lobe->alpha;
    lobe->back[0] = (vec3){ along, 0.0F, between(random, -1.0, 1.0) };
    lobe->back[1] = (vec3){ 0.0F, along, 0.0F };
    *light = (quad_light){ .middle = { 0.0F, 0.0F, 1.0F }, .center = { 0.0F, 0.0F, 1.0F } };
    const float size = (float)random_log_between(random, 1e-4, 2.0);
    light->x.x = light->y.y = size;
    light->turn[0] = size * size;
    const int is_arc = (int)(random_bits(random) & 1U);
    light->count = 4;
    for (int i = 0; i < 4; i++) {
        static const float turn[5][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 1, 0 } };
        quad_sector *s = &light->sector[i];
        s->is_arc = is_arc;
        s->a = vec3_normalize((vec3){ size * turn[i][0], size * turn[i][1], 1.0F });
        s->b = vec3_normalize((vec3){ size * turn[i + 1][0], size * turn[i + 1][1], 1.0F });
        s->volume = s->a.x * s->b.y - s->a.y * s->b.x;
        memcpy(s->from, turn[i], sizeof(s->from));
        s->half_turns = 0.5F;
    }
}

static void every_processor_gives_the_same_bits(void **state)
{
    (void)state;
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2"))
        skip();
    uint64_t random = 51;
    for (int i = 0; i < 200000; i++) {
        quad_lobe lobe;
        quad_light light;
        quad_sums base, avx2;
        make(&random, &lobe, &light);
        area_quad_sum_base(&lobe, &light, 64, &base);
        area_quad_sum_avx2(&lobe, &light, 64, &avx2);
        assert_memory_equal(&base, &avx2, sizeof(base));
    }
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_processor_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
