/* Lights that are small for the lobe: the exact integral is that of a few points, as the fast one is, and both are
 * brute force's to a few roundings. What flips single facets between two integrals is what they differ by. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "area_truth.h"
#include "glint.h"
#include "statistics.h"

enum { LIGHTS = 400, SIDE = 300 };

typedef struct plain_case {
    area_truth_lobe lobe;
    float wo[3];
    glint_area_light light;
} plain_case;

/* Half vectors reach a tenth of the roughness to either side, of lights within a roughness of the mirrored view. */
static plain_case random_case(uint64_t *random)
{
    static const glint_area_kind kinds[] = { GLINT_AREA_SUN, GLINT_AREA_SPHERE, GLINT_AREA_RECTANGLE, GLINT_AREA_DISK };
    const double alpha = random_log_between(random, 0.05, 0.5), view = random_between(random, 0.0, 0.7);
    const double off = alpha * random_between(random, -1.0, 1.0), size = 0.1 * alpha, distance = 2.0;
    const double wi[3] = { sin(view + off), 0.0, cos(view + off) }, across[3] = { wi[2], 0.0, -wi[0] };
    plain_case c = { .lobe = { random_bits(random) % 2 == 0, alpha, alpha },
                     .wo = { (float)-sin(view), 0.0F, (float)cos(view) },
                     .light = { .kind = kinds[random_bits(random) % 4],
                                .two_sided = 1U,
                                .radius = (float)(size * distance),
                                .solid_angle_sr = (float)(3.14159265358979 * size * size) } };
    for (int k = 0; k < 3; k++) {
        c.light.center[k] = (float)(distance * wi[k]);
        c.light.half_x[k] = (float)(0.7 * size * distance * across[k]);
    }
    c.light.half_y[1] = (float)(0.7 * size * distance);
    return c;
}

static glint_value evaluate(const plain_case *c, glint_area_light_method method)
{
    static const glint_footprint pixel = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material *m;
    glint_value value;
    o.distribution = c->lobe.is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.surface.alpha_x = o.surface.alpha_y = (float)c->lobe.alpha_x;
    o.area_light_method = method;
    assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_OK);
    glint_eval_area(m, NULL, &pixel, c->wo, &c->light, &value);
    glint_material_destroy(m);
    return value;
}

/* What a rule leaves of a pole is about 1e-6 and 2e-5 at most (area_plain.h); a sum of eight to sixteen floats and what
 * makes its terms leave some thirty roundings of 6e-8, and as much again the shape in single precision. */
#define EXACT_BOUND 5e-6
#define FAST_BOUND 2.4e-5

static void small_lights_are_known_to_a_few_roundings(void **state)
{
    (void)state;
    uint64_t random = 41;
    double exact_worst = 0.0, fast_worst = 0.0;
    int same = 0;
    for (int i = 0; i < LIGHTS; i++) {
        const plain_case c = random_case(&random);
        const double truth = area_truth_of(&c.lobe, c.wo, &c.light, SIDE).specular;
        const glint_value exact = evaluate(&c, GLINT_AREA_LIGHT_EXACT), fast = evaluate(&c, GLINT_AREA_LIGHT_FAST);
        exact_worst = fmax(exact_worst, fabs((double)exact.smooth[0] / truth - 1.0));
        fast_worst = fmax(fast_worst, fabs((double)fast.smooth[0] / truth - 1.0));
        same += exact.rgb[0] == fast.rgb[0] && exact.lit_probability == fast.lit_probability;
        assert_true(fabs((double)fast.lit_probability / (double)exact.lit_probability - 1.0) < FAST_BOUND);
    }
    printf("exact within %.1e of brute force, fast within %.1e; %d of %d lights have the same bits\n", exact_worst,
           fast_worst, same, LIGHTS);
    assert_true(exact_worst < EXACT_BOUND && fast_worst < FAST_BOUND);
    assert_true(same > LIGHTS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_lights_are_known_to_a_few_roundings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
