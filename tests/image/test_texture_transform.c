/* KHR_texture_transform and the wrap modes against the extension's text and its product of matrices. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "io/texture_transform.h"

static texture_point at(float u, float v)
{
    return (texture_point){ .s = u, .t = v };
}

/* A wide enough clamp keeps the transformed point as it is. */
static scene_texture transformed(float offset_s, float offset_t, float rotation, float scale_s, float scale_t)
{
    return (scene_texture){ .wrap_s = SCENE_WRAP_CLAMP,
                            .wrap_t = SCENE_WRAP_CLAMP,
                            .offset = { offset_s, offset_t },
                            .rotation = rotation,
                            .scale = { scale_s, scale_t } };
}

/* "This example utilizes only the lower left quadrant of the source image, rotated clockwise 90 degrees." */
static void the_example_of_the_extension_shows_the_lower_left_quarter(void **state)
{
    (void)state;
    const scene_texture which = transformed(0.0F, 1.0F, 1.57079632679F, 0.5F, 0.5F);
    static const float corners[4][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } };
    static const float expected[4][2] = { { 0, 1 }, { 0, 0.5F }, { 0.5F, 1 }, { 0.5F, 0.5F } };
    for (int i = 0; i < 4; i++) {
        const texture_point uv = at(corners[i][0], corners[i][1]);
        const texture_point p = texture_transform(&which, &uv);
        /* The rotation is a float: a quarter turn to 2^-24. */
        assert_float_equal(p.s, expected[i][0], 1e-7F);
        assert_float_equal(p.t, expected[i][1], 1e-7F);
    }
}

/* Khronos' TextureTransformTest (in assimp-testmodels): the arrow runs down the diagonal of its picture, and where the
 * turn by 22.5 degrees is right it points at the mark "Correct", at this place of the plane around (0.5, 0.5), v
 * downwards. */
static void the_arrow_of_the_khronos_test_points_at_its_mark(void **state)
{
    (void)state;
    const scene_texture which = transformed(0.0F, 0.0F, 0.39269908169872414F, 1.0F, 1.0F);
    const texture_point mark = at(0.5F - 0.07904822439840126F, 0.5F + 0.5162674857624154F);
    const texture_point p = texture_transform(&which, &mark);
    assert_true(p.s > 0.7F);
    assert_float_equal(p.s, p.t, 4e-7F); /* the coordinates of the mark, the angle and the results are floats below 2 */
}

typedef struct matrix3 {
    double m[3][3];
} matrix3;

static matrix3 multiply(matrix3 a, matrix3 b)
{
    matrix3 c = { 0 };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                c.m[i][j] += a.m[i][k] * b.m[k][j];
    return c;
}

/* T * R * S with columns as the extension orders them, and with v downwards. */
static matrix3 matrix_of(const scene_texture *w)
{
    const double c = cos((double)w->rotation), s = sin((double)w->rotation);
    const matrix3 translation = { { { 1, 0, (double)w->offset[0] }, { 0, 1, (double)w->offset[1] }, { 0, 0, 1 } } };
    const matrix3 rotation = { { { c, s, 0 }, { -s, c, 0 }, { 0, 0, 1 } } };
    const matrix3 scale = { { { (double)w->scale[0], 0, 0 }, { 0, (double)w->scale[1], 0 }, { 0, 0, 1 } } };
    return multiply(translation, multiply(rotation, scale));
}

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static float random_in(uint32_t *state, float low, float high)
{
    return low + (high - low) * (float)random_bits(state) * 0x1p-24F;
}

static void assert_near(float value, double expected)
{
    /* One rounding to float of a value that was right to a few ulps of double. */
    if (!(fabs((double)value - expected) <= fabs(expected) * 0x1p-23 + 1e-12))
        fail_msg("found %.9g, expected %.9g", (double)value, expected);
}

static void points_and_derivatives_follow_the_matrix(void **state)
{
    (void)state;
    uint32_t random = 7;
    for (int i = 0; i < 10000; i++) {
        const scene_texture w =
            transformed(random_in(&random, -9, 9), random_in(&random, -9, 9), random_in(&random, -7, 7),
                        random_in(&random, -5, 5), random_in(&random, -5, 5));
        const texture_point uv = { random_in(&random, -3, 3),       random_in(&random, -3, 3),
                                   random_in(&random, -0.1F, 0.1F), random_in(&random, -0.1F, 0.1F),
                                   random_in(&random, -0.1F, 0.1F), random_in(&random, -0.1F, 0.1F) };
        const texture_point p = texture_transform(&w, &uv);
        const matrix3 m = matrix_of(&w);
        const double in[3][2] = { { (double)uv.s, (double)uv.t },
                                  { (double)uv.dsdx, (double)uv.dtdx },
                                  { (double)uv.dsdy, (double)uv.dtdy } };
        const float out[3][2] = { { p.s, p.t }, { p.dsdx, p.dtdx }, { p.dsdy, p.dtdy } };
        for (int k = 0; k < 3; k++)
            for (int row = 0; row < 2; row++)
                assert_near(out[k][row],
                            m.m[row][0] * in[k][0] + m.m[row][1] * in[k][1] + (k == 0 ? m.m[row][2] : 0.0));
    }
}

/* A float at 4194304 counts halves; the sum of offset and coordinate in double still has 2^-30. */
static void a_far_offset_does_not_move_texels(void **state)
{
    (void)state;
    scene_texture w = { .offset = { 1048576.0F, -4194304.0F }, .scale = { 1.0F, 1.0F } };
    for (int mode = 0; mode < 2; mode++) {
        w.wrap_s = w.wrap_t = mode ? SCENE_WRAP_MIRROR : SCENE_WRAP_REPEAT;
        for (int i = 0; i < 1000; i++) {
            const texture_point uv = at((float)(i + 0.5) / 1000.0F, (float)(i + 0.25) / 1000.0F);
            const texture_point p = texture_transform(&w, &uv);
            assert_true(fabs((double)p.s - (double)uv.s) <= 0x1p-30 + 0x1p-25);
            assert_true(fabs((double)p.t - (double)uv.t) <= 0x1p-30 + 0x1p-25);
        }
    }
}

static void repeated_points_stay_below_the_end_of_the_period(void **state)
{
    (void)state;
    scene_texture w = { .scale = { 1.0F, 1.0F } };
    const texture_point uv = at(-1e-12F, 1.0F);
    assert_true(texture_transform(&w, &uv).s < 1.0F);
    assert_true(texture_transform(&w, &uv).t == 0.0F);
    w.wrap_s = w.wrap_t = SCENE_WRAP_MIRROR;
    assert_true(texture_transform(&w, &uv).s < 2.0F);
}

static void nonsense_comes_out_finite_and_bounded(void **state)
{
    (void)state;
    static const float bad[] = { NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e30F, 0.5F };
    const size_t count = sizeof bad / sizeof *bad;
    for (size_t i = 0; i < count * count * 3; i++) {
        const float a = bad[i % count], b = bad[i / count % count];
        const scene_wrap mode = (scene_wrap)(i / (count * count));
        const scene_texture w = {
            .wrap_s = mode, .wrap_t = mode, .offset = { a, 0.25F }, .rotation = b, .scale = { b, a }
        };
        const texture_point uv = { a, b, b, a, a, b };
        const texture_point p = texture_transform(&w, &uv);
        const float out[6] = { p.s, p.t, p.dsdx, p.dtdx, p.dsdy, p.dtdy };
        for (int k = 0; k < 6; k++)
            assert_true(fabsf(out[k]) <= 32768.0F);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_example_of_the_extension_shows_the_lower_left_quarter),
        cmocka_unit_test(the_arrow_of_the_khronos_test_points_at_its_mark),
        cmocka_unit_test(points_and_derivatives_follow_the_matrix),
        cmocka_unit_test(a_far_offset_does_not_move_texels),
        cmocka_unit_test(repeated_points_stay_below_the_end_of_the_period),
        cmocka_unit_test(nonsense_comes_out_finite_and_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
