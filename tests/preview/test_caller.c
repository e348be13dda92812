/* libglint_preview.so as another program uses it: pictures that are known by hand, passes, threads, no leaks. */
#include <malloc.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "caller.h"

static void assert_relative(float value, double expected, double bound)
{
    if (!(fabs((double)value - expected) <= bound * fabs(expected)))
        fail_msg("%.9g is not %.9g", (double)value, expected);
}

/* ---- pictures that are known ---- */

/* E albedo / pi; single precision and cosines of a sun of half a degree around 1: (.00465)^2 / 4. */
static void a_matte_square_under_the_sun_has_the_radiance_of_lambert(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    assert_string_equal(glint_preview_scene_warnings(s), "");
    const glint_preview_camera camera = from_above(0.9F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float rgba[256], normal[192], depth[64], albedo[192];
    get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
    get(p, GLINT_PREVIEW_NORMAL, normal, 192);
    get(p, GLINT_PREVIEW_ALBEDO, albedo, 192);
    get(p, GLINT_PREVIEW_DEPTH, depth, 64);
    const double color[3] = { 0.5, 0.25, 0.125 };
    for (size_t i = 0; i < 64; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            assert_relative(rgba[4 * i + c], 3.0 * color[c] / 3.14159265358979, 1e-4);
            assert_relative(albedo[3 * i + c], color[c], 1e-6);
        }
        assert_true(rgba[4 * i + 3] == 1.0F);
        assert_relative(normal[3 * i + 1], 1.0, 1e-6);
        assert_relative(depth[i], 4.0, 1e-6);
    }
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static void what_surrounds_the_scene_is_seen_unless_it_is_transparent(void **state)
{
    (void)state;
    glint_preview_scene_options empty = GLINT_PREVIEW_SCENE_OPTIONS_INIT;
    empty.world.color[0] = 0.25F;
    empty.world.color[2] = 2.0F;
    glint_preview_scene *const s = create(&empty);
    const glint_preview_camera camera = from_above(1.0F);
    glint_preview_picture_options o = small(&camera);
    for (int transparent = 0; transparent < 2; ++transparent) {
        o.transparent = transparent;
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 4);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        assert_true(rgba[0] == (transparent ? 0.0F : 0.25F) && rgba[2] == (transparent ? 0.0F : 2.0F));
        assert_true(rgba[3] == (transparent ? 0.0F : 1.0F));
        glint_preview_picture_destroy(p);
    }
    glint_preview_scene_destroy(s);
}

/* Red above the horizon, green below, and blue in the quarter around +x: a camera that looks down sees green. */
static void a_map_lies_as_the_header_says(void **state)
{
    (void)state;
    float map[3 * 16 * 8] = { 0 };
    for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 16; ++x) {
            map[3 * (16 * y + x) + (y < 4 ? 0 : 1)] = 1.0F;
            map[3 * (16 * y + x) + 2] = x >= 6 && x < 10 ? 1.0F : 0.0F;
        }
    glint_preview_scene_options empty = GLINT_PREVIEW_SCENE_OPTIONS_INIT;
    empty.world.map = map;
    empty.world.map_width = 16;
    empty.world.map_height = 8;
    glint_preview_scene *const s = create(&empty);
    /* z of the camera against the view: it looks along -y, +x and -x. */
    const float views[3][16] = { { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1 },
                                 { 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1 },
                                 { 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1 } };
    const float expected[3][3] = { { 0, 1, -1 }, { -1, -1, 1 }, { -1, -1, 0 } }; /* -1: either */
    for (int v = 0; v < 3; ++v) {
        glint_preview_camera camera = GLINT_PREVIEW_CAMERA_INIT;
        memcpy(camera.to_world, views[v], sizeof views[v]);
        camera.left = camera.bottom = -0.01F;
        camera.right = camera.top = 0.01F;
        const glint_preview_picture_options o = small(&camera);
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 1);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        for (size_t c = 0; c < 3; ++c)
            if (expected[v][c] >= 0.0F)
                assert_true(fabsf(rgba[c] - expected[v][c]) < 1e-3F);
        glint_preview_picture_destroy(p);
    }
    glint_preview_scene_destroy(s);
}

/* Half red, half green by texels; each triangle of the other square has a material of its own. */
static void textures_and_materials_of_triangles_are_where_they_belong(void **state)
{
    (void)state;
    const float pixels[8] = { 1, 0, 0, 1, 0, 1, 0, 1 };
    glint_preview_image image = GLINT_PREVIEW_IMAGE_INIT;
    image.pixels = pixels;
    image.width = 2;
    image.height = 1;
    const int32_t materials[2] = { 0, 1 };
    square_scene q;
    make_square(&q);
    q.options.images = &image;
    q.options.image_count = 1;
    q.options.materials =
        "{\"samplers\": [{\"magFilter\": 9728}], \"textures\": [{\"source\": 0, \"sampler\": 0}], \"materials\": "
        "[" MATTE("1, 1, 1", ", \"baseColorTexture\": {\"index\": 0}") ", " MATTE("0, 0, 1", "") "]}";
    const glint_preview_camera camera = from_above(1.0F);
    const glint_preview_picture_options o = small(&camera);
    for (int two = 0; two < 2; ++two) {
        q.mesh.materials = two ? materials : NULL;
        glint_preview_scene *const s = create(&q.options);
        glint_preview_picture *const p = begin(s, &o);
        refine(p, 4);
        float rgba[256];
        get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
        const float *const lower_left = rgba, *const upper_right = &rgba[4 * 63]; /* the lowest row comes first */
        assert_true(lower_left[0] > 0.9F && lower_left[1] == 0.0F && lower_left[2] == 0.0F);
        assert_true(upper_right[0] == 0.0F && upper_right[two ? 2 : 1] > 0.9F && upper_right[two ? 1 : 2] == 0.0F);
        glint_preview_picture_destroy(p);
        glint_preview_scene_destroy(s);
    }
}

static void a_shifted_window_sees_the_next_part_of_the_plane(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    glint_preview_camera camera = from_above(1.0F);
    camera.left = 0.0F; /* half of it beyond the edge at x = 1 */
    camera.right = 2.0F;
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float depth[64];
    get(p, GLINT_PREVIEW_DEPTH, depth, 64);
    for (size_t i = 0; i < 64; ++i)
        assert_true((depth[i] > 0.0F) == (i % 8 < 4));
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

/* ---- glints, passes and threads ---- */

static void flakes_are_counted_in_the_pass_for_it(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER; /* one unit of (s, t) is a metre, and half a metre of the square */
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 4);
    float count[64], probability[64], smooth[192], rgba[256];
    get(p, GLINT_PREVIEW_GLINT_COUNT, count, 64);
    get(p, GLINT_PREVIEW_GLINT_PROBABILITY, probability, 64);
    get(p, GLINT_PREVIEW_SMOOTH, smooth, 192);
    get(p, GLINT_PREVIEW_COMBINED, rgba, 256);
    double differs = 0.0;
    for (size_t i = 0; i < 64; ++i) {
        assert_relative(count[i], 2500.0 * 0.1 * 0.1, 0.05); /* a pixel is .2 m of the square: .1 of (s, t) */
        assert_true(probability[i] >= 0.0F && probability[i] <= 1.0F);
        differs += fabs((double)(rgba[4 * i] - smooth[3 * i]));
    }
    assert_true(differs > 0.0);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static void steps_of_any_size_give_the_same_bits(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    glint_preview_picture_options o = small(&camera);
    o.samples = 13;
    glint_preview_picture *const once = begin(s, &o), *const steps = begin(s, &o);
    refine(once, 13);
    for (int samples = 1; samples <= 13; samples += 3)
        refine(steps, samples);
    float a[256], b[256];
    get(once, GLINT_PREVIEW_COMBINED, a, 256);
    get(steps, GLINT_PREVIEW_COMBINED, b, 256);
    assert_memory_equal(a, b, sizeof a);
    assert_true(glint_preview_picture_progress(steps) == 1.0);
    glint_preview_picture_destroy(once);
    glint_preview_picture_destroy(steps);
    glint_preview_scene_destroy(s);
}

typedef struct long_work {
    glint_preview_picture *picture;
    glint_preview_result result;
} long_work;

static void *refine_for_long(void *argument)
{
    long_work *const work = argument;
    work->result = glint_preview_picture_refine(work->picture, 65536, NULL, 0);
    return NULL;
}

static void cancelling_from_another_thread_ends_soon_and_can_be_taken_back(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(0.8F);
    glint_preview_picture_options o = small(&camera);
    o.width = o.height = 256;
    o.samples = 65536; /* minutes */
    glint_preview_picture *const p = begin(s, &o);
    pthread_t thread;
    long_work work = { p, GLINT_PREVIEW_OK };
    assert_int_equal(pthread_create(&thread, NULL, refine_for_long, &work), 0);
    glint_preview_picture_cancel(p, 1);
    pthread_join(thread, NULL);
    assert_int_equal(work.result, GLINT_PREVIEW_CANCELLED);
    assert_int_equal(glint_preview_picture_refine(p, 1, NULL, 0), GLINT_PREVIEW_CANCELLED);
    glint_preview_picture_destroy(p);
    o.width = o.height = 8;
    glint_preview_picture *const again = begin(s, &o);
    glint_preview_picture_cancel(again, 1);
    assert_int_equal(glint_preview_picture_refine(again, 2, NULL, 0), GLINT_PREVIEW_CANCELLED);
    glint_preview_picture_cancel(again, 0);
    refine(again, 2);
    glint_preview_picture_destroy(again);
    glint_preview_scene_destroy(s);
}

/* Samples that an accuracy is asked to choose are those of a picture that is told their number. */
static void a_picture_takes_as_many_samples_as_its_accuracy_asks_for(void **state)
{
    (void)state;
    square_scene q;
    make_square(&q);
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(1.2F);
    glint_preview_picture_options o = small(&camera);
    glint_preview_picture *p;
    char message[256];
    o.samples = 0;
    o.accuracy = 0.0F;
    assert_int_equal(glint_preview_picture_create(s, &o, &p, message, sizeof message), GLINT_PREVIEW_BAD_INPUT);
    assert_non_null(strstr(message, "expected 1"));
    o.accuracy = 0.05F;
    assert_int_equal(glint_preview_picture_create(s, &o, &p, message, sizeof message), GLINT_PREVIEW_OK);
    const int32_t chosen = glint_preview_picture_samples(p);
    assert_true(chosen >= 4);
    refine(p, chosen);
    assert_int_equal(glint_preview_picture_refine(p, chosen + 1, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    o.samples = chosen;
    glint_preview_picture *const told = begin(s, &o);
    assert_int_equal(glint_preview_picture_samples(told), chosen);
    assert_int_equal(glint_preview_picture_samples(NULL), 0);
    glint_preview_picture_destroy(told);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
}

static glint_preview_result plan_of(const glint_preview_scene *s, float accuracy, char *text, size_t size)
{
    const glint_preview_camera camera = from_above(0.8F);
    glint_preview_picture_options o = small(&camera);
    char message[256];
    o.accuracy = accuracy;
    const glint_preview_result result = glint_preview_plan(s, &o, text, size, message, sizeof message);
    if (result != GLINT_PREVIEW_OK)
        assert_non_null(strstr(message, "expected"));
    return result;
}

/* Under a sun of 23 degrees some 1 in 20 of 25 million facets a pixel is lit: they vary by a thousandth. */
static void the_plan_says_what_a_budget_leaves_out(void **state)
{
    (void)state;
    square_scene q;
    char text[4096];
    make_square(&q);
    q.sun.angular_diameter_rad = 0.4F;
    q.options.materials = "{\"materials\": [{\"name\": \"a\\tb\", " NAMELESS_FLAKES("2.5e9") "]}";
    glint_preview_scene *const s = create(&q.options);
    assert_int_equal(plan_of(s, 0.0F, text, sizeof text), GLINT_PREVIEW_OK);
    assert_non_null(strstr(text, "\na b\tfacets\ton\tcounted\t"));
    assert_int_equal(plan_of(s, 0.1F, text, sizeof text), GLINT_PREVIEW_OK);
    assert_non_null(strstr(text, "\tfacets\toff\t"));
    const size_t length = strlen(text);
    assert_int_equal(text[length - 1], '\n');
    text[0] = 'x';
    assert_int_equal(plan_of(s, 0.1F, text, length), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(text[0], 'x'); /* what does not fit is not begun */
    assert_int_equal(plan_of(s, 0.1F, text, length + 1), GLINT_PREVIEW_OK);
    assert_int_equal(plan_of(s, 2.0F, text, sizeof text), GLINT_PREVIEW_BAD_INPUT);
    assert_int_equal(glint_preview_plan(s, NULL, text, sizeof text, NULL, 0), GLINT_PREVIEW_BAD_INPUT);
    glint_preview_scene_destroy(s);
}

/* ---- versions and memory ---- */

static void a_caller_can_check_that_it_speaks_the_same_language(void **state)
{
    (void)state;
    assert_int_equal(glint_preview_abi(), GLINT_PREVIEW_ABI);
    assert_int_equal(glint_preview_size_of("glint_preview_mesh"), sizeof(glint_preview_mesh));
    assert_int_equal(glint_preview_size_of("glint_preview_camera"), sizeof(glint_preview_camera));
    assert_int_equal(glint_preview_size_of("glint_preview_horse"), 0);
    assert_int_equal(glint_preview_size_of(NULL), 0);
}

#define GRID 200 /* 200 x 200 squares: half a megabyte of positions, and more of anything else */

typedef struct grid {
    float positions[3 * (GRID + 1) * (GRID + 1)], texcoords[2 * (GRID + 1) * (GRID + 1)];
    uint32_t indices[6 * GRID * GRID];
} grid;

static void make_grid(grid *g)
{
    for (uint32_t y = 0; y <= GRID; ++y)
        for (uint32_t x = 0; x <= GRID; ++x) {
            const size_t at = y * (GRID + 1) + x;
            const float u = (float)x / GRID, v = (float)y / GRID;
            const float position[3] = { 2.0F * u - 1.0F, 0.0F, 2.0F * v - 1.0F };
            memcpy(&g->positions[3 * at], position, sizeof position);
            g->texcoords[2 * at] = u;
            g->texcoords[2 * at + 1] = v;
        }
    for (uint32_t i = 0; i < GRID * GRID; ++i) {
        const uint32_t corner = i / GRID * (GRID + 1) + i % GRID;
        const uint32_t six[6] = { corner, corner + GRID + 1, corner + GRID + 2, corner, corner + GRID + 2, corner + 1 };
        memcpy(&g->indices[6 * (size_t)i], six, sizeof six);
    }
}

/* What the program has asked for and not given back, whatever the allocator keeps of it. */
static double allocated_mb(void)
{
    const struct mallinfo2 all = mallinfo2();
    return (double)(all.uordblks + all.hblkhd) / 1048576.0;
}

/* A scene, a picture and a failure. */
static void use_the_library(const grid *g)
{
    square_scene q;
    make_square(&q);
    q.options.materials = GLITTER;
    q.mesh.vertex_count = (GRID + 1) * (GRID + 1);
    q.mesh.triangle_count = 2 * GRID * GRID;
    q.mesh.positions = g->positions;
    q.mesh.normals = NULL;
    q.mesh.texcoords[0] = g->texcoords;
    q.mesh.indices = g->indices;
    glint_preview_scene *const s = create(&q.options);
    const glint_preview_camera camera = from_above(1.0F);
    const glint_preview_picture_options o = small(&camera);
    glint_preview_picture *const p = begin(s, &o);
    refine(p, 1);
    glint_preview_picture_destroy(p);
    glint_preview_scene_destroy(s);
    q.options.model = 1000; /* found after everything else was copied */
    refuse(&q.options, "model is 1000");
}

/* Had a round lost one of its arrays (.3 MB and more), 32 rounds would show 10 MB; a tenth of that is left to lists
 * that grow once. Sanitizers have an allocator of their own: there, their search for leaks is the test. */
static void scenes_and_pictures_leave_no_memory_behind(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip();
#endif
    static grid g;
    make_grid(&g);
    for (int i = 0; i < 4; ++i)
        use_the_library(&g);
    const double before = allocated_mb();
    for (int i = 0; i < 32; ++i)
        use_the_library(&g);
    const double after = allocated_mb();
    if (!(after - before < 1.0))
        fail_msg("32 scenes took %.2f MB and did not give them back", after - before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matte_square_under_the_sun_has_the_radiance_of_lambert),
        cmocka_unit_test(what_surrounds_the_scene_is_seen_unless_it_is_transparent),
        cmocka_unit_test(a_map_lies_as_the_header_says),
        cmocka_unit_test(textures_and_materials_of_triangles_are_where_they_belong),
        cmocka_unit_test(a_shifted_window_sees_the_next_part_of_the_plane),
        cmocka_unit_test(flakes_are_counted_in_the_pass_for_it),
        cmocka_unit_test(steps_of_any_size_give_the_same_bits),
        cmocka_unit_test(cancelling_from_another_thread_ends_soon_and_can_be_taken_back),
        cmocka_unit_test(a_picture_takes_as_many_samples_as_its_accuracy_asks_for),
        cmocka_unit_test(the_plan_says_what_a_budget_leaves_out),
        cmocka_unit_test(a_caller_can_check_that_it_speaks_the_same_language),
        cmocka_unit_test(scenes_and_pictures_leave_no_memory_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
