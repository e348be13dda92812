/* Samples of many pixels side by side are the samples of one pixel at a time, bit for bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "maps.h"
#include "plan_cases.h"
#include "preview/block.h"
#include "preview/stage.h"
#include "scenes.h"

/* Pixels that differ, of all samples of all blocks; counts the pixels that show something. */
static int differences(const world *w, int width, int height, int samples, int *lit)
{
    const block_window window = { 0, 0, width, height };
    block *const b = aligned_alloc(_Alignof(block), sizeof *b);
    ray_counts together = { 0 }, apart = { 0 };
    int count = 0;
    assert_non_null(b);
    for (int y = 0; y < height; y += BLOCK_SIDE)
        for (int x = 0; x < width; x += BLOCK_SIDE)
            for (int index = 0; index < samples; ++index) {
                block_begin(b, x, y, &window, w->seed);
                block_integrate(w, b, (uint32_t)index, true, &together);
                for (int i = 0; i < BLOCK_PIXELS; ++i) {
                    pixel_sample alone;
                    if (!b->is_seen[i])
                        continue;
                    integrate(w, b->x[i], b->y[i], (uint32_t)index, &alone, &apart);
                    count += memcmp(&alone, &b->seen[i], sizeof alone) != 0;
                    *lit += alone.light.discrete[1] > 0.0F;
                }
            }
    assert_memory_equal(&together, &apart, sizeof together);
    free(b);
    return count;
}

static void compare(const scene *s, const preview_options *o, const char *name)
{
    static stage st;
    static view v;
    preview_statistics unused;
    report r = { 0 };
    int lit = 0;
    if (!stage_set_up(&st, s, o, (double)INFINITY, &unused, &r) || !view_set_up(&v, &st, o, &r))
        fail_msg("%s: %s", name, r.error);
    /* A sample by itself has kernels of one lane; the widest come last. */
    for (int lanes = 1; lanes <= KERNELS_WIDEST; lanes *= 2) {
        v.world.kernels = kernels_of_machine(lanes);
        const int found = differences(&v.world, o->width, o->height, o->spp, &lit);
        if (found > 0 || lit == 0)
            fail_msg("%s, %d lanes: %d samples differ, %d show light", name, v.world.kernels->lanes, found, lit);
    }
    view_take_down(&v);
    stage_take_down(&st);
}

static void a_block_has_the_samples_of_its_pixels(void **state)
{
    (void)state;
    for (int i = 0; i < plan_case_count(); ++i) {
        scene_camera from;
        preview_options o;
        scene s = plan_case(i, &from, &o);
        o.spp = 2;
        o.accuracy = i % 2 == 0 ? 0.0 : 0.1;
        compare(&s, &o, plan_case_name(i));
        scene_free(&s);
    }
}

/* A mask, panes one behind the other, a coat, facets in the object's space, bounces, and the studio's sky; 37 x 21
 * pixels, so that blocks and packets are cut. */
static scene layered_scene(void)
{
    static const uint8_t checks[16] = { 255, 255, 255, 255, 90, 90, 90, 0, 90, 90, 90, 0, 255, 255, 255, 255 };
    scene_material floor = scenes_matte(0.5F), pane = scenes_matte(0.8F), ball = scenes_flakes(0.4F, 1e4F);
    scene s = scenes_empty();
    float place[16];
    floor.alpha_mode = SCENE_ALPHA_MASK;
    floor.base_color_texture = scenes_add_texture(&s, checks, 2, 2);
    floor.base_color_texture.scale[0] = floor.base_color_texture.scale[1] = 4.0F;
    pane.alpha_mode = SCENE_ALPHA_BLEND;
    pane.base_color[3] = 0.3F;
    ball.clearcoat = 0.5F;
    ball.glint.space = SCENE_SPACE_OBJECT;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &floor), 2.0F), NULL, 0);
    const int glass = scenes_add_square(&s, scenes_add_material(&s, &pane), 0.4F);
    for (int i = 0; i < 2; ++i) {
        scenes_translation(place, 0.3F, 1.2F + 0.1F * (float)i, 0.2F);
        scenes_add_instance(&s, glass, place, 1 + i);
    }
    scenes_translation(place, 0.0F, 0.5F, 0.0F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &ball), 0.5F, 24, 12), place, 3);
    return s;
}

static preview_options layered_options(void)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = 37;
    o.height = 21;
    o.spp = 4;
    o.bounces = 2;
    return o;
}

static void surfaces_one_behind_the_other_are_seen_alike(void **state)
{
    (void)state;
    scene s = layered_scene();
    const preview_options o = layered_options();
    compare(&s, &o, "layers");
    scene_free(&s);
}

/* More lights than a block takes at a time; some have a size, and one is a window. */
static void any_number_of_lights_is_seen_alike(void **state)
{
    (void)state;
    scene s = layered_scene();
    preview_options o = layered_options();
    o.bounces = 0;
    for (int i = 0; i < 41; ++i) {
        const float from[3] = { 0.1F * (float)(i - 20), 2.0F, 0.07F * (float)(i % 9) };
        const scene_light_kind kind = i == 5 ? SCENE_LIGHT_RECT : i % 7 == 0 ? SCENE_LIGHT_SPOT : SCENE_LIGHT_POINT;
        scene_light *const l = scenes_add_light(&s, kind, from, 0.1F);
        l->radius_m = i % 3 == 0 ? 0.2F : 0.01F * (float)(i % 2);
        l->width_m = l->height_m = 0.3F;
    }
    compare(&s, &o, "41 lights");
    scene_free(&s);
}

/* Light found in two ways: by rays that bounce, and by rays towards it. */
static void what_glows_and_what_surrounds_is_seen_alike(void **state)
{
    (void)state;
    scene s = layered_scene();
    preview_options o = layered_options();
    scene_material glowing = scenes_matte(0.5F);
    float place[16];
    glowing.emissive[0] = glowing.emissive[1] = 3.0F;
    glowing.double_sided = true;
    scenes_translation(place, -0.7F, 1.0F, 0.0F);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &glowing), 0.3F), place, 4);
    environment_map map = maps_even(32, 0.1F);
    maps_add_disc(&map, v3(0.3, 1.0, 0.2), 0.3, 4.0F);
    const preview_environment around = maps_environment(&map);
    o.environment = &around;
    compare(&s, &o, "glow and surroundings");
    environment_map_free(&map);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_has_the_samples_of_its_pixels),
        cmocka_unit_test(surfaces_one_behind_the_other_are_seen_alike),
        cmocka_unit_test(any_number_of_lights_is_seen_alike),
        cmocka_unit_test(what_glows_and_what_surrounds_is_seen_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
