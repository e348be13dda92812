/* A small picture of everything at once, kept in the repository: what no other test names does not change unseen. With
 * the argument --update the picture is written anew; look at it before it is committed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

/* A metal ball with flakes under a coat, a mirror that shows it, a masked floor, a pane; the studio's light. */
static scene still_life(void)
{
    static const uint8_t checks[16] = { 255, 255, 255, 255, 80, 80, 80, 255, 80, 80, 80, 255, 255, 255, 255, 0 };
    scene_material floor = scenes_matte(0.5F), pane = scenes_matte(0.8F), ball = scenes_flakes(0.45F, 3e5F);
    scene_material mirror = scene_material_default();
    scene s = scenes_empty();
    floor.alpha_mode = SCENE_ALPHA_MASK;
    floor.double_sided = true;
    floor.base_color_texture = scenes_add_texture(&s, checks, 2, 2);
    floor.base_color_texture.scale[0] = floor.base_color_texture.scale[1] = 4.0F;
    pane.alpha_mode = SCENE_ALPHA_BLEND;
    pane.base_color[3] = 0.3F;
    ball.base_color[1] = ball.base_color[2] = 0.1F;
    ball.clearcoat = 1.0F;
    ball.clearcoat_roughness = 0.1F;
    ball.glint.space = SCENE_SPACE_OBJECT;
    mirror.roughness = 0.1F;
    float place[16];
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &floor), 0.3F), NULL, 0);
    scenes_translation(place, -0.05F, 0.1F, 0.0F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &ball), 0.1F, 48, 24), place, 1);
    scenes_translation(place, 0.12F, 0.06F, 0.05F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &mirror), 0.06F, 48, 24), place, 2);
    scenes_translation(place, 0.1F, 0.2F, -0.1F);
    place[0] = place[10] = 0.3F;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &pane), 0.3F), place, 3);
    return s;
}

static image render_still_life(void)
{
    scene s = still_life();
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = 96;
    o.height = 64;
    o.spp = 16;
    o.bounces = 2;
    image i = pictures_render(&s, &o);
    scene_free(&s);
    return i;
}

/* Other machines have another libm and other vector units for Embree, which may see another triangle at an edge or the
 * sample beside it; such pixels are few. All others agree to rounding. */
static void the_still_life_looks_as_it_did(void **state)
{
    (void)state;
    image now = render_still_life(), then;
    report r = { 0 };
    if (!image_read(GOLDEN_FILE, &then, &r))
        fail_msg("%s", r.error);
    assert_int_equal(now.width, then.width);
    assert_int_equal(now.height, then.height);
    const char *const channels[4] = { "R", "G", "B", "A" };
    int different = 0;
    for (int k = 0; k < 96 * 64; ++k) {
        const int x = k % 96, y = k / 96;
        for (int c = 0; c < 4; ++c) {
            const double a = pictures_at(&now, channels[c], x, y), b = pictures_at(&then, channels[c], x, y);
            if (fabs(a - b) > 1e-4 * (1.0 + fabs(b))) {
                ++different;
                break;
            }
        }
    }
    if (different > 96 * 64 / 100)
        fail_msg("%d of %d pixels differ from %s", different, 96 * 64, GOLDEN_FILE);
    image_free(&now);
    image_free(&then);
}

static int update(void)
{
    image i = render_still_life();
    report r = { 0 };
    const bool ok = image_write_exr(GOLDEN_FILE, &i, NULL, 0, &r);
    if (!ok)
        fprintf(stderr, "%s\n", r.error);
    image_free(&i);
    return ok ? 0 : 1;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_still_life_looks_as_it_did),
    };
    if (argc == 2 && strcmp(argv[1], "--update") == 0)
        return update();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
