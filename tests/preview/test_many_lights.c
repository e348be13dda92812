/* Of more lights than are evaluated one by one some are chosen; whoever looks long enough sees them all. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "preview/choose_lights.h"
#include "scenes.h"
#include "statistics.h"

/* ---- lights of all kinds ---- */

/* Over a floor of 2 m, up to 1.5 m high, powers in a range of 30. */
static void add_lights(scene *s, int count, uint64_t seed)
{
    static const scene_light_kind kinds[] = { SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT, SCENE_LIGHT_RECT, SCENE_LIGHT_DISK,
                                              SCENE_LIGHT_DIRECTIONAL };
    for (int i = 0; i < count; ++i) {
        const float from[3] = { (float)random_between(&seed, -1.0, 1.0), (float)random_between(&seed, 0.1, 1.5),
                                (float)random_between(&seed, -1.0, 1.0) };
        scene_light *const l =
            scenes_add_light(s, kinds[i % 5], from, (float)(random_log_between(&seed, 1.0, 30.0) / count));
        for (int c = 0; c < 3; ++c)
            l->color[c] = (float)random_between(&seed, 0.3, 1.0);
        l->radius_m = 0.02F;
        l->outer_cone_rad = (float)random_between(&seed, 0.2, 1.2);
        l->inner_cone_rad = 0.5F * l->outer_cone_rad;
        l->width_m = (float)random_between(&seed, 0.05, 0.2);
        l->height_m = l->kind == SCENE_LIGHT_DISK ? l->width_m : (float)random_between(&seed, 0.05, 0.2);
        if (l->kind == SCENE_LIGHT_RECT || l->kind == SCENE_LIGHT_DISK)
            l->intensity /= l->width_m * l->height_m;
        if (i % 3 == 0)
            l->range = (float)random_between(&seed, 0.5, 3.0);
    }
}

/* A floor of flakes under a ball that throws shadows. */
static scene lit_scene(int light_count)
{
    scene s = scenes_empty();
    const scene_material flakes = scenes_flakes(0.5F, 1e6F), matte = scenes_matte(0.5F);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &flakes), 1.0F), NULL, 0);
    float place[16];
    scenes_translation(place, 0.2F, 0.15F, 0.1F);
    scenes_add_instance(&s, scenes_add_sphere(&s, scenes_add_material(&s, &matte), 0.1F, 16, 8), place, 1);
    add_lights(&s, light_count, 5);
    return s;
}

/* ---- the choice alone ---- */

/* A point of a material that is half matte, half mirrors, in any pose. */
static shade_point any_point(uint64_t *random)
{
    shade_point p = { .layer_count = 1 };
    shade_layer *const l = &p.layers[0];
    const double turn = random_between(random, 0.0, 6.2831853), lean = random_between(random, 0.0, 1.0);
    l->z = v3(sin(lean) * cos(turn), cos(lean), sin(lean) * sin(turn));
    l->x = v3_any_tangent(l->z);
    l->y = v3_cross(l->z, l->x);
    l->wo[0] = 0.6F;
    l->wo[2] = 0.8F;
    l->weight = 1.0F;
    l->surface.alpha_x = l->surface.alpha_y = (float)random_log_between(random, 0.05, 0.8);
    for (int c = 0; c < 3; ++c) {
        l->surface.diffuse[c] = 0.4F;
        l->surface.f0[c] = 0.3F;
    }
    return p;
}

static bool can_light(const light *l, const shade_point *p, vec3 position)
{
    light_view view;
    if (!light_see(l, position, &view))
        return false;
    const shade_area area = { .center = v3_sub(l->position, position), .half_x = l->half_x, .half_y = l->half_y };
    return light_is_area(l) ? shade_faces_area(p, &area) : shade_faces(p, view.wi);
}

/* 4^8 samples: the sampler then puts one into every interval of 2^-16, so that a light of probability P is chosen
 * P 2^16 times, but for two at the edges of its interval. */
#define SAMPLES (1U << 16)

static void assert_choice_is_fair(const light_tree *t, const light *lights, int count, uint64_t *random)
{
    const shade_point p = any_point(random);
    const vec3 position = v3(random_between(random, -1.0, 1.0), 0.0, random_between(random, -1.0, 1.0));
    double *const sum = calloc((size_t)count, sizeof *sum);
    double *const probability = calloc((size_t)count, sizeof *probability);
    assert_non_null(sum);
    assert_non_null(probability);
    for (uint32_t i = 0; i < SAMPLES; ++i) {
        chosen_light chosen[MOST_LIGHTS];
        const sampler s = sampler_make(3, 4, i, 5);
        const int chosen_count = lights_choose(t, &p, position, &s, 100U, chosen);
        assert_in_range(chosen_count, 0, MOST_LIGHTS);
        for (int k = 0; k < chosen_count; ++k) {
            sum[chosen[k].index] += 1.0;
            probability[chosen[k].index] = (double)chosen[k].probability;
        }
    }
    for (int i = 0; i < count; ++i) {
        if (sum[i] == 0.0 && can_light(&lights[i], &p, position))
            fail_msg("light %d of %d lights the point and is never chosen", i, count);
        if (sum[i] > 0.0 && fabs(sum[i] - probability[i] * SAMPLES) > 2.0 + 1e-6 * SAMPLES * probability[i])
            fail_msg("light %d of %d: chosen %.0f times of %u; expected %.3f within 2", i, count, sum[i], SAMPLES,
                     probability[i] * SAMPLES);
    }
    free(sum);
    free(probability);
}

static void every_light_is_chosen_as_often_as_its_probability_says(void **state)
{
    (void)state;
    static const int counts[] = { 17, 100, 1024 };
    uint64_t random = 11;
    for (int k = 0; k < 3; ++k) {
        scene s = scenes_empty();
        add_lights(&s, counts[k], 7);
        light *const lights = calloc((size_t)counts[k], sizeof *lights);
        light_tree t;
        report r = { 0 };
        assert_non_null(lights);
        for (int i = 0; i < counts[k]; ++i)
            lights[i] = light_make(&s.lights[i]);
        assert_true(light_tree_make(lights, counts[k], &t, &r));
        for (int i = 0; i < 2; ++i)
            assert_choice_is_fair(&t, lights, counts[k], &random);
        light_tree_free(&t);
        free(lights);
        scene_free(&s);
    }
}

/* ---- pictures ---- */

#define SIDE 12                   /* pixels */
#define CELLS 4                   /* pictures are compared in CELLS x CELLS parts */
#define PARTS (2 * CELLS * CELLS) /* of both channels */
#define PICTURES 8
static const char *const channels[] = { "R", "smooth.R" };

/* Adds the means of the picture's parts. */
static void add_parts(const image *i, double parts[PARTS])
{
    for (int c = 0; c < 2; ++c)
        for (int y = 0; y < SIDE; ++y)
            for (int x = 0; x < SIDE; ++x)
                parts[c * CELLS * CELLS + y * CELLS / SIDE * CELLS + x * CELLS / SIDE] +=
                    pictures_at(i, channels[c], x, y) * CELLS * CELLS / (SIDE * SIDE);
}

static preview_options options_of(const scene_camera *c, uint32_t seed)
{
    preview_options o = pictures_options(c);
    o.width = o.height = SIDE;
    o.spp = 4;
    o.seed = seed;
    return o;
}

/* The sum of pictures of a few lights each. */
static void add_exact(const scene *s, const preview_options *o, double parts[PARTS])
{
    for (int first = 0; first < s->light_count; first += MOST_LIGHTS) {
        scene few = *s;
        few.lights += first;
        few.light_count = s->light_count - first < MOST_LIGHTS ? s->light_count - first : MOST_LIGHTS;
        image i = pictures_render(&few, o);
        add_parts(&i, parts);
        image_free(&i);
    }
}

/* Both pictures have the same paths of the camera, so what differs is the choice and the places of shadow rays.
 * Student's t with 7 degrees of freedom passes 9 once in 2e4 times. */
static void assert_mean_is_the_sum(int light_count)
{
    scene s = lit_scene(light_count);
    const float eye[3] = { 0.0F, 3.0F, 2.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    const scene_camera c = scenes_camera(SCENE_ORTHOGRAPHIC, eye, target, 0.7F);
    double sum[PARTS] = { 0 }, square[PARTS] = { 0 }, exact[PARTS] = { 0 };
    for (uint32_t k = 0; k < PICTURES; ++k) {
        double with[PARTS] = { 0 }, without[PARTS] = { 0 };
        const preview_options o = options_of(&c, k);
        image i = pictures_render(&s, &o);
        add_parts(&i, with);
        image_free(&i);
        add_exact(&s, &o, without);
        for (int n = 0; n < PARTS; ++n) {
            const double difference = with[n] - without[n];
            sum[n] += difference / PICTURES;
            square[n] += difference * difference;
            exact[n] += without[n] / PICTURES;
        }
    }
    double all = 0.0, all_error = 0.0; /* of the picture without single facets */
    for (int n = 0; n < PARTS; ++n) {
        const double variance = fmax(square[n] - PICTURES * sum[n] * sum[n], 0.0) / (PICTURES - 1);
        const double error = sqrt(variance / PICTURES) + 1e-6 * exact[n]; /* and the rounding of the sums */
        if (!(fabs(sum[n]) <= 9.0 * error))
            fail_msg("%d lights, %s, part %d: off by %.5g of %.5g, %.1f sigmas", light_count,
                     channels[n / (CELLS * CELLS)], n % (CELLS * CELLS), sum[n], exact[n], sum[n] / error);
        all += n < PARTS / 2 ? 0.0 : exact[n];
        all_error += n < PARTS / 2 ? 0.0 : error * error;
    }
    print_message("%d lights: the mean of a picture is known within %.2g\n", light_count, sqrt(all_error) / all);
    assert_true(sqrt(all_error) < 0.01 * all); /* or it proves nothing */
    scene_free(&s);
}

static void a_few_of_many_lights_have_the_mean_of_all(void **state)
{
    (void)state;
    static const int counts[] = { 1, 16, 17, 64, 1024 };
    for (int k = 0; k < 5; ++k)
        assert_mean_is_the_sum(counts[k]);
}

static void as_many_lights_as_are_summed_leave_no_noise(void **state)
{
    (void)state;
    scene s = scenes_empty();
    const scene_material flakes = scenes_flakes(0.5F, 1e5F);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &flakes), 1.0F), NULL, 0);
    add_lights(&s, MOST_LIGHTS, 5);
    const scene_camera c = pictures_from_above(0.7F);
    const preview_options o = options_of(&c, 1);
    image all = pictures_render(&s, &o);
    double sum[SIDE * SIDE] = { 0 };
    for (int k = 0; k < MOST_LIGHTS; ++k) {
        scene one = s;
        one.lights += k;
        one.light_count = 1;
        image i = pictures_render(&one, &o);
        for (int n = 0; n < SIDE * SIDE; ++n)
            sum[n] += pictures_at(&i, "R", n % SIDE, n / SIDE);
        image_free(&i);
    }
    for (int n = 0; n < SIDE * SIDE; ++n) /* 16 sums of four samples in single precision */
        pictures_assert_relative(pictures_at(&all, "R", n % SIDE, n / SIDE), sum[n], 64 * 6e-8);
    image_free(&all);
    scene_free(&s);
}

static void the_choice_does_not_depend_on_threads(void **state)
{
    (void)state;
    scene s = lit_scene(200);
    const scene_camera c = pictures_from_above(0.7F);
    preview_options o = options_of(&c, 3);
    o.width = o.height = 40;
    o.bounces = 1;
    o.accuracy = 0.02;
    image one = pictures_render(&s, &o);
    o.threads = 3;
    image three = pictures_render(&s, &o);
    assert_memory_equal(one.pixels, three.pixels, sizeof(float) * 40 * 40 * (size_t)one.channel_count);
    image_free(&one);
    image_free(&three);
    scene_free(&s);
}

/* A thousand spots that each light a place of their own: the cones leave two or three that matter, and the picture is
 * as good as their sum. */
static void lights_that_cannot_reach_a_point_take_no_place(void **state)
{
    (void)state;
    scene s = scenes_empty();
    const scene_material matte = scenes_matte(0.5F);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &matte), 2.0F), NULL, 0);
    for (int i = 0; i < 1024; ++i) {
        const float from[3] = { 0.0F, 1.0F, 0.0F };
        scene_light *const l = scenes_add_light(&s, SCENE_LIGHT_SPOT, from, 1.0F);
        l->outer_cone_rad = 0.05F;
        l->inner_cone_rad = 0.04F;
        l->to_world[12] = (float)(i % 32 - 15.5) / 16.0F;
        l->to_world[14] = (float)(i / 32 - 15.5) / 16.0F; /* NOLINT(bugprone-integer-division): rows */
    }
    const scene_camera c = pictures_from_above(0.5F);
    const preview_options o = options_of(&c, 1);
    image i = pictures_render(&s, &o);
    scene half = s;
    half.light_count = 512;
    image first = pictures_render(&half, &o);
    half.lights += 512;
    image second = pictures_render(&half, &o);
    for (int n = 0; n < SIDE * SIDE; ++n) {
        const double sum = pictures_at(&first, "R", n % SIDE, n / SIDE) + pictures_at(&second, "R", n % SIDE, n / SIDE);
        assert_true(fabs(pictures_at(&i, "R", n % SIDE, n / SIDE) - sum) <= 1e-6 * sum);
    }
    assert_true(pictures_mean(&i, "R") > 0.0);
    image_free(&i);
    image_free(&first);
    image_free(&second);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_light_is_chosen_as_often_as_its_probability_says),
        cmocka_unit_test(a_few_of_many_lights_have_the_mean_of_all),
        cmocka_unit_test(as_many_lights_as_are_summed_leave_no_noise),
        cmocka_unit_test(the_choice_does_not_depend_on_threads),
        cmocka_unit_test(lights_that_cannot_reach_a_point_take_no_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
