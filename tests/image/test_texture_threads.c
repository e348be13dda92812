/* A lookup gives the same bits whichever thread asks and whatever was asked before. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "texture_scene.h"

enum { COUNT = 20000, IMAGES = 3 };

typedef struct lookup {
    scene_texture which;
    float s, t, derivatives[4];
    float rgba[4];
} lookup;

typedef struct work {
    const textures *textures;
    lookup *lookups;
    const int *order;
    int count;
} work;

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static void *look_up(void *argument)
{
    const work *w = argument;
    for (int i = 0; i < w->count; i++) {
        lookup *q = &w->lookups[w->order[i]];
        texture_lookup(w->textures, &q->which, q->s, q->t, q->derivatives[0], q->derivatives[1], q->derivatives[2],
                       q->derivatives[3], q->rgba);
    }
    return NULL;
}

static textures *open_noise(void)
{
    uint32_t random = 4;
    scene_image images[IMAGES];
    scene_material material = scene_material_default();
    scene_texture *const slots[2 * IMAGES] = { &material.base_color_texture, &material.normal_texture,
                                               &material.emissive_texture,   &material.occlusion_texture,
                                               &material.specular_texture,   &material.anisotropy_texture };
    for (int i = 0; i < IMAGES; i++) {
        static uint8_t samples[100 * 100 * 4];
        const uint32_t size = (uint32_t)(33 * (i + 1));
        for (size_t k = 0; k < sizeof samples; k++)
            samples[k] = (uint8_t)random_bits(&random);
        const bytes png = png_make(size, size, 8, i == 0 ? PNG_RGB : PNG_RGBA, samples);
        images[i] = (scene_image){ .name = "noise", .bytes = png.data, .byte_count = png.size };
        for (int srgb = 0; srgb < 2; srgb++) {
            *slots[2 * i + srgb] = texture_plain(srgb);
            slots[2 * i + srgb]->image = i;
        }
    }
    const scene s = { .images = images, .image_count = IMAGES, .materials = &material, .material_count = 1 };
    textures *t;
    report r = { 0 };
    if (!textures_open(&s, &t, &r))
        fail_msg("%s", r.error);
    for (int i = 0; i < IMAGES; i++)
        free(images[i].bytes);
    return t;
}

static void make_lookups(lookup *lookups)
{
    uint32_t random = 8;
    for (int i = 0; i < COUNT; i++) {
        lookup *q = &lookups[i];
        *q = (lookup){ .which = texture_plain(random_bits(&random) % 2) };
        q->which.image = (int)(random_bits(&random) % IMAGES);
        q->which.wrap_s = (scene_wrap)(random_bits(&random) % 3);
        q->which.rotation = (float)(random_bits(&random) % 7);
        q->s = (float)random_bits(&random) * 0x1p-22F;
        q->t = (float)random_bits(&random) * 0x1p-22F;
        for (int k = 0; k < 4; k++)
            q->derivatives[k] = (float)random_bits(&random) / (float)(1U << (24 + random_bits(&random) % 8));
    }
}

static void shuffle(int *order)
{
    uint32_t random = 12;
    for (int i = COUNT - 1; i > 0; i--) {
        const int k = (int)(random_bits(&random) % (uint32_t)(i + 1));
        const int kept = order[i];
        order[i] = order[k];
        order[k] = kept;
    }
}

static void threads_and_order_do_not_change_a_bit(void **state)
{
    (void)state;
    lookup *alone = calloc(COUNT, sizeof *alone);
    lookup *together = calloc(COUNT, sizeof *together);
    int *order = calloc(COUNT, sizeof *order);
    assert_true(alone && together && order);
    make_lookups(alone);
    make_lookups(together);
    for (int i = 0; i < COUNT; i++)
        order[i] = i;

    textures *t = open_noise();
    work one = { t, alone, order, COUNT };
    look_up(&one);
    textures_close(t);

    shuffle(order);
    t = open_noise();
    work halves[2] = { { t, together, order, COUNT / 2 }, { t, together, order + COUNT / 2, COUNT - COUNT / 2 } };
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, look_up, &halves[i]), 0);
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    textures_close(t);

    for (int i = 0; i < COUNT; i++)
        assert_memory_equal(alone[i].rgba, together[i].rgba, sizeof alone[i].rgba);
    free(alone);
    free(together);
    free(order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_and_order_do_not_change_a_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
