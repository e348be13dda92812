/* The same picture with any number of threads and in any tiles; progress, cancelling, and options that make no sense.
 */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

/* Glints, a coat, a blended pane, a mask, soft shadows, bounces, a textureless ball: all that draws random numbers. */
static scene busy_scene(void)
{
    static const uint8_t checks[16] = { 255, 255, 255, 255, 90, 90, 90, 0, 90, 90, 90, 0, 255, 255, 255, 255 };
    scene_material floor = scenes_matte(0.5F), pane = scenes_matte(0.8F), ball = scenes_flakes(0.4F, 1e4F);
    scene s = scenes_empty();
    floor.alpha_mode = SCENE_ALPHA_MASK;
    floor.base_color_texture = scenes_add_texture(&s, checks, 2, 2);
    floor.base_color_texture.scale[0] = floor.base_color_texture.scale[1] = 4.0F;
    pane.alpha_mode = SCENE_ALPHA_BLEND;
    pane.base_color[3] = 0.3F;
    ball.clearcoat = 0.5F;
    ball.glint.space = SCENE_SPACE_OBJECT;
    float place[16];
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &floor), 2.0F), NULL, 0);
    scenes_translation(place, 0.3F, 1.2F, 0.2F);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &pane), 0.4F), place, 1);
    scenes_translation(place, 0.0F, 0.5F, 0.0F);
    const int ball_mesh = scenes_add_sphere(&s, scenes_add_material(&s, &ball), 0.5F, 24, 12);
    scenes_add_instance(&s, ball_mesh, place, 2);
    scenes_add_instance(&s, ball_mesh, place, 3); /* at the very same place */
    return s;
}

static preview_options busy_options(void)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = 50; /* tiles that the picture cuts */
    o.height = 37;
    o.spp = 4;
    o.bounces = 2;
    o.threads = 1;
    o.aov = true;
    return o;
}

static size_t byte_count(const image *i)
{
    return (size_t)i->width * (size_t)i->height * (size_t)i->channel_count * sizeof(float);
}

static void the_number_of_threads_does_not_change_a_bit(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    image one = pictures_render(&s, &o);
    const int threads[4] = { 2, 3, 16, 0 };
    for (int k = 0; k < 4; ++k) {
        o.threads = threads[k];
        image many = pictures_render(&s, &o);
        assert_memory_equal(one.pixels, many.pixels, byte_count(&one));
        image_free(&many);
    }
    o.seed = 1;
    image other = pictures_render(&s, &o);
    assert_memory_not_equal(one.pixels, other.pixels, byte_count(&one));
    image_free(&other);
    image_free(&one);
    scene_free(&s);
}

/* Decisions are bits of the summary, and their numbers of all that was seen. */
static void the_plan_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    o.accuracy = 0.05;
    o.spp = 0;
    glint_plan *plans[3];
    const int threads[3] = { 1, 3, 16 };
    report r = { 0 };
    for (int k = 0; k < 3; ++k) {
        o.threads = threads[k];
        assert_true(preview_plan(&s, &o, &plans[k], &r));
    }
    const uint32_t count = glint_plan_decision_count(plans[0]);
    assert_true(count > 10);
    for (int k = 1; k < 3; ++k) {
        const glint_plan_outcome one = glint_plan_result(plans[0]), many = glint_plan_result(plans[k]);
        assert_memory_equal(&one, &many, sizeof one);
        assert_int_equal(glint_plan_decision_count(plans[k]), count);
        for (uint32_t i = 0; i < count; ++i) {
            const glint_decision *const a = glint_plan_decision(plans[0], i), *const b =
                                                                                  glint_plan_decision(plans[k], i);
            assert_string_equal(a->reason, b->reason);
            assert_true(a->ns_per_sample == b->ns_per_sample && a->error == b->error);
        }
    }
    for (int k = 0; k < 3; ++k)
        glint_plan_destroy(plans[k]);
    scene_free(&s);
}

static void tiles_are_parts_of_the_whole(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    image whole = pictures_render(&s, &o);
    const int tiles[3][4] = { { 0, 0, 1, 1 }, { 13, 5, 20, 31 }, { 49, 36, 1, 1 } };
    for (int k = 0; k < 3; ++k) {
        o.tile_x = tiles[k][0];
        o.tile_y = tiles[k][1];
        o.tile_width = tiles[k][2];
        o.tile_height = tiles[k][3];
        image part = pictures_render(&s, &o);
        assert_int_equal(part.width, o.tile_width);
        assert_int_equal(part.height, o.tile_height);
        const size_t pixel = (size_t)whole.channel_count;
        for (int y = 0; y < part.height; ++y) {
            const size_t there = ((size_t)(y + o.tile_y) * (size_t)whole.width + (size_t)o.tile_x) * pixel;
            assert_memory_equal(&part.pixels[(size_t)y * (size_t)part.width * pixel], &whole.pixels[there],
                                (size_t)part.width * pixel * sizeof(float));
        }
        image_free(&part);
    }
    image_free(&whole);
    scene_free(&s);
}

static void further_channels_do_not_change_the_picture(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    image all = pictures_render(&s, &o);
    o.aov = false;
    image plain = pictures_render(&s, &o);
    assert_int_equal(plain.channel_count, 4);
    for (int y = 0; y < plain.height; ++y)
        for (int x = 0; x < plain.width; ++x)
            assert_true(pictures_at(&plain, "B", x, y) == pictures_at(&all, "B", x, y));
    image_free(&all);
    image_free(&plain);
    scene_free(&s);
}

/* ---- progress and cancelling ---- */

typedef struct log {
    double last;
    int calls;
    pthread_t thread;
} log_of_progress;

static void keep(double fraction, double elapsed_s, double left_s, void *user)
{
    log_of_progress *const l = user;
    assert_true(fraction >= l->last && fraction <= 1.0);
    assert_true(elapsed_s >= 0.0 && left_s >= 0.0);
    assert_true(pthread_equal(l->thread, pthread_self()));
    l->last = fraction;
    ++l->calls;
}

static void progress_rises_to_one_in_the_calling_thread(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    log_of_progress l = { .thread = pthread_self() };
    o.threads = 2;
    o.progress = keep;
    o.user = &l;
    image i = pictures_render(&s, &o);
    assert_true(l.calls >= 1);
    assert_true(l.last == 1.0);
    image_free(&i);
    scene_free(&s);
}

static atomic_bool stop;

static void *stop_soon(void *unused)
{
    (void)unused;
    const struct timespec moment = { 0, 50000000 };
    nanosleep(&moment, NULL);
    atomic_store(&stop, true);
    return NULL;
}

/* The whole picture would take longer than ctest waits; a pixel, after which the flag is read, a few milliseconds. */
static void cancelling_ends_soon_without_a_picture_and_without_an_error(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    o.width = o.height = 1024;
    o.spp = 1024;
    o.threads = 2;
    o.cancel = &stop;
    atomic_store(&stop, false);
    image i;
    report r = { 0 };
    pthread_t helper;
    assert_int_equal(pthread_create(&helper, NULL, stop_soon, NULL), 0);
    assert_false(preview_render(&s, &o, &i, NULL, &r));
    pthread_join(helper, NULL);
    assert_true(r.error[0] == '\0');
    assert_null(i.pixels);
    scene_free(&s);
}

/* ---- bad input ---- */

static void refuse(const scene *s, const preview_options *o, const char *named)
{
    image i;
    report r = { 0 };
    assert_false(preview_render(s, o, &i, NULL, &r));
    assert_null(i.pixels);
    if (strstr(r.error, named) == NULL)
        fail_msg("\"%s\" does not name %s", r.error, named);
}

static void options_that_make_no_sense_are_named(void **state)
{
    (void)state;
    scene s = busy_scene();
    preview_options o = busy_options();
    o.width = 0;
    refuse(&s, &o, "width");
    o = busy_options();
    o.height = 1 << 20;
    refuse(&s, &o, "height");
    o = busy_options();
    o.spp = 0;
    refuse(&s, &o, "spp");
    o = busy_options();
    o.bounces = -1;
    refuse(&s, &o, "bounces");
    o = busy_options();
    o.threads = -1;
    refuse(&s, &o, "threads");
    o = busy_options();
    o.model = 1000;
    refuse(&s, &o, "model");
    o = busy_options();
    o.tile_width = 4;
    o.tile_x = 47;
    o.tile_height = 1;
    refuse(&s, &o, "tile_width");
    o = busy_options();
    o.size = 8;
    refuse(&s, &o, "size");
    scene_free(&s);
}

static void a_material_that_the_library_refuses_is_named(void **state)
{
    (void)state;
    scene s = busy_scene();
    char name[] = "flaky";
    s.materials[2].name = name;
    s.materials[2].glint.elongation = -1.0F;
    const preview_options o = busy_options();
    refuse(&s, &o, "flaky");
    s.materials[2].name = NULL; /* it is ours */
    scene_free(&s);
}

static void a_broken_texture_is_an_error(void **state)
{
    (void)state;
    scene s = busy_scene();
    s.images[0].byte_count = 20;
    const preview_options o = busy_options();
    refuse(&s, &o, "test.png");
    scene_free(&s);
}

static void an_empty_scene_is_an_empty_picture(void **state)
{
    (void)state;
    scene s = scenes_empty();
    preview_options o = busy_options();
    image i = pictures_render(&s, &o); /* the studio */
    assert_true(pictures_mean(&i, "R") > 0.0);
    image_free(&i);
    o.transparent = true;
    i = pictures_render(&s, &o);
    assert_true(pictures_mean(&i, "R") == 0.0 && pictures_mean(&i, "A") == 0.0 && pictures_mean(&i, "depth.Z") == 0.0);
    image_free(&i);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_number_of_threads_does_not_change_a_bit),
        cmocka_unit_test(the_plan_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(tiles_are_parts_of_the_whole),
        cmocka_unit_test(further_channels_do_not_change_the_picture),
        cmocka_unit_test(progress_rises_to_one_in_the_calling_thread),
        cmocka_unit_test(cancelling_ends_soon_without_a_picture_and_without_an_error),
        cmocka_unit_test(options_that_make_no_sense_are_named),
        cmocka_unit_test(a_material_that_the_library_refuses_is_named),
        cmocka_unit_test(a_broken_texture_is_an_error),
        cmocka_unit_test(an_empty_scene_is_an_empty_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
