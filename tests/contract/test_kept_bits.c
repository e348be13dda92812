/* Values that nobody means to change keep their bits, on every machine. */
#include "configurations.h"

#include <string.h>

/* By operations that IEEE 754 fixes, unlike random_direction: the same on every machine. */
static void exact_direction(uint64_t *random, float v[3])
{
    double w[3], length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        w[k] = k < 2 ? random_between(random, -0.8, 0.8) : random_between(random, 0.3, 1.0);
        length2 += w[k] * w[k];
    }
    for (int k = 0; k < 3; k++)
        v[k] = (float)(w[k] / sqrt(length2));
}

static glint_footprint exact_footprint(uint64_t *random)
{
    const double size = ldexp(random_between(random, 1.0, 2.0), -(int)(random_bits(random) % 9) - 7);
    const double other = size * random_between(random, 0.1, 1.0), skew = random_between(random, -0.5, 0.5);
    return (glint_footprint){ .u = random_between(random, -10.0, 10.0),
                              .v = random_between(random, -10.0, 10.0),
                              .dudx = (float)size,
                              .dudy = (float)(-other * skew),
                              .dvdx = (float)(size * skew),
                              .dvdy = (float)other,
                              .seed = (uint32_t)random_bits(random) };
}

/* FNV-1a of the bits of rgb. */
static uint64_t hash_of_values(glint_model model)
{
    enum { EACH = 4000 };
    uint64_t random = 31, hash = 0xcbf29ce484222325U;
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
            const glint_light light = { GLINT_LIGHT_CAP, ldexpf(1.0F, -(int)(random_bits(&random) % 16)) };
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            for (int n = 0; n < 3; n++) {
                uint32_t bits;
                memcpy(&bits, &rgb[n], sizeof(bits));
                hash = (hash ^ bits) * 0x100000001b3U;
            }
        }
        glint_material_destroy(m);
    }
    return hash;
}

/* 32000 values of each model, last written down when the Fresnel term of dielectrics got its digits back. A change that
 * is meant to give other values writes down what this prints. */
static void values_without_colors_keep_their_bits(void **state)
{
    (void)state;
    static const struct {
        glint_model model;
        uint64_t hash;
    } before[] = { { GLINT_MODEL_COUNTING, 0x2411dc204b71f823U },
                   { GLINT_MODEL_EXPLICIT, 0x1a677e72754dad72U },
                   { GLINT_MODEL_DICTIONARY, 0x115e431dddcd49adU },
                   { GLINT_MODEL_EXAMPLE, 0x26d13073716522ecU } };
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
