/* Values that nobody means to change keep their bits, on every machine. */
#include "configurations.h"

#include <string.h>

#include "exact_inputs.h"

/* FNV-1a of the bits of rgb. */
static uint64_t hash_of_values(glint_model model)
{
    enum { EACH = 4000 };
    uint64_t random = 31, hash = HASH_START;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        configuration c = configuration_of(model, i);
        c.options.color_variation = 0.0F;
        c.options.color_count = 0;
        glint_material *m = create(&c.options);
        for (int k = 0; k < EACH; k++) {
            float wo[3], wi[3], rgb[3];
            exact_direction(&random, wo);
            exact_direction(&random, wi);
            const glint_footprint f = exact_footprint(&random);
            const glint_light light = { GLINT_LIGHT_CAP, exact_solid_angle(&random) };
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            hash = hash_floats(hash, rgb, 3);
        }
        glint_material_destroy(m);
    }
    return hash;
}

/* 32000 values of each model, last written down when counts got triangles of half vectors and a tabulated normal
 * quantile, those of examples when many squares of them were summed in lanes, and explicit ones when large numbers of
 * objects got seeds of their own. A change that is meant to give other
 * values writes down what this prints. */
static void values_without_colors_keep_their_bits(void **state)
{
    (void)state;
    static const struct {
        glint_model model;
        uint64_t hash;
    } before[] = { { GLINT_MODEL_COUNTING, 0x4a5d6bb02341869fU },
                   { GLINT_MODEL_EXPLICIT, 0x219c8336ff3f58aaU },
                   { GLINT_MODEL_DICTIONARY, 0x470d5fdf3057be69U },
                   { GLINT_MODEL_EXAMPLE, 0xc612902fb3f97c50U } };
    int failed = 0;
    for (size_t i = 0; i < sizeof(before) / sizeof(before[0]); i++) {
        const uint64_t hash = hash_of_values(before[i].model);
        if (hash != before[i].hash) {
            printf("%s: %#llx, expected %#llx\n", glint_model_name(before[i].model), (unsigned long long)hash,
                   (unsigned long long)before[i].hash);
            failed++;
        }
    }
    assert_int_equal(failed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_without_colors_keep_their_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
