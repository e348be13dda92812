/* Materials from options of any bits: made and sane, or refused with a message, and never anything else. */
#define _GNU_SOURCE
#include "traps.h"

#include <stdlib.h>

/* What an allocator has given and not got back. */
typedef struct ledger {
    long open;
    uint64_t random;
    int is_short; /* of memory, at times */
} ledger;

static void *give(size_t byte_count, void *user)
{
    ledger *l = user;
    if (l->is_short && random_bits(&l->random) % 4 == 0)
        return NULL;
    void *memory = aligned_alloc(64, (byte_count + 63) / 64 * 64);
    l->open += memory != NULL;
    return memory;
}

static void take(void *memory, void *user)
{
    ledger *l = user;
    l->open -= memory != NULL;
    free(memory);
}

/* Any bits with one chance in 24: so that about as many sets of options are accepted as are refused. */
static void shake(uint64_t *random, float *numbers, size_t count, int often)
{
    for (size_t i = 0; i < count; i++)
        if (random_bits(random) % (uint64_t)often == 0)
            numbers[i] = hostile(random, numbers[i] * 2.0F);
}

static void shake_enum(uint64_t *random, void *value)
{
    const uint32_t bits = (uint32_t)(random_bits(random) >> 32), few = bits % 8;
    const uint64_t choice = random_bits(random) % 40;
    if (choice == 0)
        memcpy(value, &bits, sizeof(bits));
    else if (choice < 3)
        memcpy(value, &few, sizeof(few));
}

/* Starts from a configuration that the tests of the contract know, and changes some of its numbers. */
static glint_material_options random_options(uint64_t *random, glint_model model)
{
    glint_material_options o = single_configuration(model, (int)(random_bits(random) % CONFIGURATIONS)).options;
    const int often = 40;
    shake_enum(random, &o.distribution);
    shake_enum(random, &o.fresnel);
    shake_enum(random, &o.weighting);
    shake_enum(random, &o.facet_hash);
    shake_enum(random, &o.area_light_method);
    shake_enum(random, &o.color_count);
    shake(random, &o.surface.alpha_x, 2, often);
    shake(random, o.surface.diffuse, 3, often);
    shake(random, o.surface.f0, 3, often);
    shake(random, o.surface.f90, 3, often);
    shake(random, &o.surface.facets_per_m2, 2, often);
    shake(random, &o.ior, 7, often);
    shake(random, &o.facet_alpha, 3, often);
    shake(random, &o.density_variation, 3, often);
    shake(random, &o.colors[0][0], 3 * GLINT_MAX_COLORS, often);
    shake(random, &o.example.side_m, 1, often);
    shake(random, o.example.scale, 5, often);
    shake(random, &o.example.scale_variation, 3, often);
    shake(random, &o.example.jitter, 3, often);
    shake_enum(random, &o.example.placement);
    shake_enum(random, &o.example.flat);
    shake_enum(random, &o.example.mirror);
    if (random_bits(random) % 40 == 0)
        o.example.components = (uint32_t)random_bits(random);
    if (random_bits(random) % 40 == 0)
        o.example.size = 1U << (random_bits(random) % 32);
    if (random_bits(random) % 100 == 0)
        o.size = (size_t)random_bits(random);
    o.seed = (uint32_t)random_bits(random);
    o.facet_limit = 200U;
    return o;
}

static void use(const glint_material *m, uint64_t *random)
{
    for (int i = 0; i < 12; i++) {
        float wo[3], wi[3], u[3];
        random_direction(random, wo);
        random_direction(random, wi);
        for (int k = 0; k < 3; k++)
            u[k] = (float)random_uniform(random);
        const glint_footprint f = random_footprint(random);
        const glint_light light = { GLINT_LIGHT_CAP, (float)random_log_between(random, 1e-9, 1.0) };
        glint_value v;
        glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
        assert_sane(&v);
        const glint_area_light round = { .kind = GLINT_AREA_SUN,
                                         .solid_angle_sr = light.solid_angle_sr,
                                         .center = { wi[0], wi[1], wi[2] } };
        glint_eval_area(m, NULL, &f, wo, &round, &v);
        assert_sane(&v);
        glint_sample s;
        glint_sample_direction(m, NULL, &f, wo, u, &s);
        v = (glint_value){
            { s.weight[0], s.weight[1], s.weight[2] }, { s.pdf, glint_pdf(m, NULL, &f, wo, wi), 0.0F }, 0.0F, 0.0F, 0
        };
        assert_sane(&v);
    }
}

static void options_of_any_bits_are_made_or_refused(void **state)
{
    (void)state;
    enum { EACH = 6000 };
    uint64_t random = 41;
    ledger book = { .random = 42 };
    long made[16] = { 0 }, refused[16] = { 0 };
    for (int i = 0; i < EACH * 4; i++) {
        glint_material_options base = random_options(&random, (glint_model)(i % 4 == 0 ? i / 4 % 5 : i % 2));
        glint_material_options coat = random_options(&random, (glint_model)(i % 3));
        glint_material_options o = base;
        if (i % 5 == 0) {
            o = random_options(&random, GLINT_MODEL_COUNTING);
            o.model = GLINT_MODEL_LAYERED;
            o.layers.base = random_bits(&random) % 30 ? &base : NULL;
            o.layers.coat = random_bits(&random) % 30 ? &coat : NULL;
            shake(&random, &o.layers.coat_weight, 7, 40);
        }
        /* A dictionary takes milliseconds to bake. */
        if (random_bits(&random) % 24 && (o.model == GLINT_MODEL_DICTIONARY || base.model == GLINT_MODEL_DICTIONARY))
            continue;
        o.allocator = (glint_allocator){ give, take, &book };
        book.is_short = i % 7 == 0;
        char message[300] = "";
        glint_material *m = NULL;
        const glint_result result = glint_material_create(&o, &m, message, sizeof(message));
        if ((m != NULL) != (result == GLINT_OK))
            fail_msg("result %d with material %p", result, (void *)m);
        if (m) {
            made[o.model]++;
            use(m, &random);
        } else {
            refused[o.model]++;
            if (!message[0])
                fail_msg("result %d without a message", result);
        }
        glint_material_destroy(m);
        assert_int_equal(book.open, 0);
    }
    for (uint32_t k = 0; k < glint_model_count(); k++) {
        printf("%-12s %6ld made, %6ld refused\n", glint_model_name((glint_model)k), made[k], refused[k]);
        assert_true(made[k] > 5 && refused[k] > 5);
    }
}

static void generated_maps_are_sane(void **state)
{
    (void)state;
    uint64_t random = 43;
    static float normals[3 * 32 * 32];
    long made = 0, refused = 0;
    for (int i = 0; i < 20000; i++) {
        glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
        glint_example_kind kind = (glint_example_kind)(random_bits(&random) % 6);
        shake_enum(&random, &kind);
        shake(&random, &shape.slope, 3, 6);
        if (i % 3 == 0)
            shape.count = (uint32_t)random_bits(&random) >> (random_bits(&random) % 32);
        const uint32_t size = i % 20 ? 8U << (random_bits(&random) % 3) : (uint32_t)random_bits(&random) % 40;
        memset(normals, 0xff, sizeof(normals));
        if (size > 32U || glint_example_generate(kind, size, &shape, (uint32_t)i, normals) != GLINT_OK) {
            refused++;
            continue;
        }
        made++;
        for (uint32_t k = 0; k < size * size; k++) {
            const float *n = &normals[3 * k];
            const float length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
            /* Seven roundings. */
            if (!(fabsf(length2 - 1.0F) < 1e-6F) || !(n[2] > 0.0F))
                fail_msg("kind %d: normal %g %g %g", kind, (double)n[0], (double)n[1], (double)n[2]);
        }
    }
    printf("%ld maps made, %ld refused\n", made, refused);
    assert_true(made > 1000 && refused > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(options_of_any_bits_are_made_or_refused, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(generated_maps_are_sane, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
