/* Pictures that grow by passes: the same bits as one render, several at once, after cancelling too. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "scenes.h"

/* Flakes, soft shadows, an environment made of a sky, a second bounce: all that draws random numbers by sample. */
static scene sparkling_scene(void)
{
    scene s = scenes_empty();
    scene_material floor = scenes_matte(0.5F), ball = scenes_flakes(0.4F, 1e4F);
    ball.glint.space = SCENE_SPACE_OBJECT;
    float place[16];
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &floor), 2.0F), NULL, 0);
    scenes_translation(place, 0.0F, 0.5F, 0.0F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &ball), 0.5F, 24, 12), place, 1);
    const float from[3] = { 2.0F, 3.0F, 1.0F };
    scenes_add_light(&s, SCENE_LIGHT_POINT, from, 30.0F)->radius_m = 0.2F;
    return s;
}

static const preview_sky blue = { { 0.1F, 0.2F, 0.5F }, { 0.3F, 0.3F, 0.4F }, { 0.1F, 0.1F, 0.1F } };

static preview_options sparkling_options(void)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.width = 41;
    o.height = 29;
    o.spp = 12; /* not a power of four, and footprints of two samples a side */
    o.bounces = 1;
    o.threads = 2;
    o.aov = true;
    o.sky = &blue;
    return o;
}

static void assert_same(const image *a, const image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->channel_count, b->channel_count);
    assert_memory_equal(a->pixels, b->pixels,
                        (size_t)a->width * (size_t)a->height * (size_t)a->channel_count * sizeof(float));
}

static preview_stage *open_stage(const scene *s, const preview_options *o)
{
    preview_stage *stage;
    report r = { 0 };
    if (!preview_stage_open(s, o, &stage, &r))
        fail_msg("no stage: %s", r.error);
    return stage;
}

static preview_picture *open_picture(const preview_stage *stage, const preview_options *o)
{
    preview_picture *p;
    report r = { 0 };
    if (!preview_picture_open(stage, o, &p, &r))
        fail_msg("no picture: %s", r.error);
    return p;
}

static void refine(preview_picture *p, int samples)
{
    report r = { 0 };
    if (!preview_picture_refine(p, samples, NULL, &r))
        fail_msg("not refined: %s", r.error);
}

static void passes_of_any_size_add_up_to_one_render_bit_for_bit(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    const preview_options o = sparkling_options();
    image once = pictures_render(&s, &o);
    preview_stage *const stage = open_stage(&s, &o);
    const int passes[3][5] = { { 12 }, { 1, 2, 3, 7, 12 }, { 5, 5, 4, 12 } };
    for (int k = 0; k < 3; ++k) {
        preview_picture *const p = open_picture(stage, &o);
        for (int i = 0; i < 5 && passes[k][i] > 0; ++i)
            refine(p, passes[k][i]);
        assert_same(preview_picture_image(p), &once);
        preview_picture_close(p);
    }
    image_free(&once);
    preview_stage_close(stage);
    scene_free(&s);
}

static void a_pass_is_the_mean_of_its_own_samples(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    preview_options o = sparkling_options();
    preview_stage *const stage = open_stage(&s, &o);
    preview_picture *const p = open_picture(stage, &o);
    image end = pictures_render(&s, &o);
    refine(p, 3);
    image early;
    report r = { 0 };
    assert_true(image_allocate(&early, o.width, o.height, end.channel_count, &r));
    memcpy(early.pixels, preview_picture_image(p)->pixels,
           (size_t)o.width * (size_t)o.height * (size_t)end.channel_count * sizeof(float));
    refine(p, 12);
    /* Unbiased: the mean over the picture of 3 samples a pixel is near that of 12, and yet another picture. */
    double first = 0.0, last = 0.0, squares = 0.0;
    const size_t count = (size_t)o.width * (size_t)o.height;
    for (size_t i = 0; i < count; ++i) {
        const double a = (double)early.pixels[i * 16], b = (double)end.pixels[i * 16];
        first += a;
        last += b;
        squares += (a - b) * (a - b);
    }
    const double sigma = sqrt(squares); /* of the difference of the sums, pixels being independent */
    assert_true(squares > 0.0);
    if (!(fabs(first - last) <= 4.0 * sigma))
        fail_msg("3 samples sum to %g, 12 to %g: %g sigmas", first, last, (first - last) / sigma);
    image_free(&early);
    image_free(&end);
    preview_picture_close(p);
    preview_stage_close(stage);
    scene_free(&s);
}

static void a_part_grows_like_the_whole(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    preview_options o = sparkling_options();
    preview_stage *const stage = open_stage(&s, &o);
    o.tile_x = 11;
    o.tile_y = 7;
    o.tile_width = 18;
    o.tile_height = 20;
    image once = pictures_render(&s, &o);
    preview_picture *const p = open_picture(stage, &o);
    refine(p, 2);
    refine(p, 12);
    assert_same(preview_picture_image(p), &once);
    image_free(&once);
    preview_picture_close(p);
    preview_stage_close(stage);
    scene_free(&s);
}

static void the_colour_alone_takes_the_same_bits_without_the_other_channels(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    preview_options o = sparkling_options();
    o.aov = false;
    preview_stage *const stage = open_stage(&s, &o);
    image once = pictures_render(&s, &o);
    preview_picture *const p = open_picture(stage, &o);
    refine(p, 4);
    refine(p, 12);
    assert_int_equal(preview_picture_image(p)->channel_count, 4);
    assert_same(preview_picture_image(p), &once);
    image_free(&once);
    preview_picture_close(p);
    preview_stage_close(stage);
    scene_free(&s);
}

/* ---- cancelling ---- */

static void stop_halfway(double fraction, double elapsed_s, double left_s, void *user)
{
    (void)elapsed_s;
    (void)left_s;
    if (fraction < 1.0)
        atomic_store((atomic_bool *)user, true);
}

/* How often a picture of so many pixels a side was stopped. */
static int stops_of_a_cancelled_picture(int side)
{
    scene s = sparkling_scene();
    preview_options o = sparkling_options();
    o.width = o.height = side;
    image once = pictures_render(&s, &o);
    atomic_bool cancel = false;
    o.progress = stop_halfway;
    o.user = &cancel;
    o.cancel = &cancel;
    preview_stage *const stage = open_stage(&s, &o);
    preview_picture *const p = open_picture(stage, &o);
    report r = { 0 };
    int stops = 0;
    while (!preview_picture_refine(p, 12, NULL, &r)) {
        assert_string_equal(r.error, "");
        assert_true(++stops < 10000);
        atomic_store(&cancel, false);
    }
    assert_same(preview_picture_image(p), &once);
    image_free(&once);
    preview_picture_close(p);
    preview_stage_close(stage);
    scene_free(&s);
    return stops;
}

static void a_cancelled_picture_goes_on_where_it_was(void **state)
{
    (void)state;
    /* Progress is told after a tenth of a second: how large a picture takes as long depends on the machine. */
    int side = 100;
    while (stops_of_a_cancelled_picture(side) == 0) {
        side *= 2;
        assert_true(side <= 3200);
    }
}

/* ---- several at once ---- */

static void *refine_in_steps(void *picture)
{
    for (int samples = 1; samples <= 12; samples += 1)
        if (!preview_picture_refine(picture, samples, NULL, &(report){ 0 }))
            return NULL;
    return picture;
}

static void pictures_of_one_stage_grow_side_by_side(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    preview_options o[3] = { sparkling_options(), sparkling_options(), sparkling_options() };
    o[1].width = 30;
    o[2].seed = 5;
    preview_stage *const stage = open_stage(&s, &o[0]);
    preview_picture *p[3];
    pthread_t threads[3];
    for (int i = 0; i < 3; ++i) {
        p[i] = open_picture(stage, &o[i]);
        assert_int_equal(pthread_create(&threads[i], NULL, refine_in_steps, p[i]), 0);
    }
    for (int i = 0; i < 3; ++i) {
        void *result;
        pthread_join(threads[i], &result);
        assert_ptr_equal(result, p[i]);
        image once = pictures_render(&s, &o[i]);
        assert_same(preview_picture_image(p[i]), &once);
        image_free(&once);
        preview_picture_close(p[i]);
    }
    preview_stage_close(stage);
    scene_free(&s);
}

/* ---- bad input ---- */

static void numbers_of_samples_that_make_no_sense_are_named(void **state)
{
    (void)state;
    scene s = sparkling_scene();
    preview_options o = sparkling_options();
    preview_stage *const stage = open_stage(&s, &o);
    preview_picture *p = open_picture(stage, &o);
    const int wrong[3] = { 0, -1, 13 };
    for (int i = 0; i < 3; ++i) {
        report r = { 0 };
        assert_false(preview_picture_refine(p, wrong[i], NULL, &r));
        assert_non_null(strstr(r.error, "expected 1 to the picture's 12"));
    }
    preview_picture_close(p);
    report r = { 0 };
    o.width = 0;
    assert_false(preview_picture_open(stage, &o, &p, &r));
    assert_null(p);
    assert_non_null(strstr(r.error, "width"));
    preview_picture_close(NULL);
    preview_stage_close(stage);
    preview_stage_close(NULL);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_of_any_size_add_up_to_one_render_bit_for_bit),
        cmocka_unit_test(a_pass_is_the_mean_of_its_own_samples),
        cmocka_unit_test(a_part_grows_like_the_whole),
        cmocka_unit_test(the_colour_alone_takes_the_same_bits_without_the_other_channels),
        cmocka_unit_test(a_cancelled_picture_goes_on_where_it_was),
        cmocka_unit_test(pictures_of_one_stage_grow_side_by_side),
        cmocka_unit_test(numbers_of_samples_that_make_no_sense_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
