/* Rectangles and disks in pictures: form factors in closed form, no noise without a shadow, penumbrae against brute
 * force, and facets where a light is half hidden. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "penumbra_truth.h"
#include "pictures.h"
#include "scenes.h"
#include "statistics.h"

#define PI 3.14159265358979323846
#define ALBEDO 0.6

/* The library integrates in double and gives floats; a picture is a mean of floats. */
#define FLOAT_BOUND 2e-6

static scene floor_of(scene_material m)
{
    scene s = scenes_empty();
    m.glint.uv_scale = 10.0F;
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 5.0F), NULL, 0);
    return s;
}

/* A light at `from` that shines down; x to the right. */
static scene_light *add_panel(scene *s, scene_light_kind kind, const float from[3], float width, float height)
{
    static const float down[16] = { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1 };
    scene_light *const l = scenes_add_light(s, kind, from, 3.0F);
    memcpy(l->to_world, down, sizeof down);
    memcpy(&l->to_world[12], from, 3 * sizeof(float));
    l->width_m = width;
    l->height_m = height;
    return l;
}

/* A camera that sees next to a point: the mean over it differs by (1e-4)^2. */
static const float SPOT = 1e-4F;

static double floor_radiance(const scene *s, const char *channel)
{
    const scene_camera c = pictures_from_above(SPOT);
    const preview_options o = pictures_options(&c);
    image i = pictures_render(s, &o);
    const double value = pictures_mean(&i, channel);
    image_free(&i);
    return value;
}

/* Form factor of a parallel rectangle a x b with a corner above the point at height 1 (Howell, C-11... of a
 * differential element): 1 / 2 pi (a / sqrt(1 + a^2) atan(b / sqrt(1 + a^2)) + the same with a and b exchanged). */
static double corner_factor(double a, double b)
{
    const double p = sqrt(1.0 + a * a), q = sqrt(1.0 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2.0 * PI);
}

static void a_rectangle_lights_by_its_form_factor(void **state)
{
    (void)state;
    scene s = floor_of(scenes_matte((float)ALBEDO));
    const float above[3] = { 0.0F, 2.0F, 0.0F };
    add_panel(&s, SCENE_LIGHT_RECT, above, 3.0F, 1.0F);
    pictures_assert_relative(floor_radiance(&s, "R"), ALBEDO * 3.0 * 4.0 * corner_factor(0.75, 0.25), FLOAT_BOUND);
    scene_free(&s);

    /* Its corner above the point. */
    s = floor_of(scenes_matte((float)ALBEDO));
    const float aside[3] = { 1.5F, 2.0F, -0.5F };
    add_panel(&s, SCENE_LIGHT_RECT, aside, 3.0F, 1.0F);
    pictures_assert_relative(floor_radiance(&s, "G"), ALBEDO * 3.0 * corner_factor(1.5, 0.5), 1e-4);
    scene_free(&s);
}

/* r^2 / (r^2 + h^2), and on its back none. */
static void a_disk_lights_by_its_form_factor_and_to_one_side(void **state)
{
    (void)state;
    scene s = floor_of(scenes_matte((float)ALBEDO));
    const float above[3] = { 0.0F, 2.0F, 0.0F };
    scene_light *const l = add_panel(&s, SCENE_LIGHT_DISK, above, 3.0F, 3.0F);
    l->color[2] = 0.5F;
    const double expected = ALBEDO * 3.0 * 2.25 / (2.25 + 4.0);
    pictures_assert_relative(floor_radiance(&s, "R"), expected, FLOAT_BOUND);
    pictures_assert_relative(floor_radiance(&s, "B"), 0.5 * expected, FLOAT_BOUND);
    for (int k = 4; k < 11; ++k) /* y and z axes turn over: up */
        l->to_world[k] = -l->to_world[k];
    assert_true(floor_radiance(&s, "R") == 0.0);
    scene_free(&s);
}

/* Form factor of a sphere of which the plane of the surface may hide a part: cosine to its centre, distance over radius
 * (Snyder's integral, as Quilez writes it). */
static double sphere_factor(double cosine, double distance)
{
    const double h2 = distance * distance, k2 = 1.0 - h2 * cosine * cosine;
    if (k2 <= 0.0)
        return fmax(cosine, 0.0) / h2;
    const double clipped = cosine * acos(-cosine * sqrt((h2 - 1.0) / (1.0 - cosine * cosine))) - sqrt(k2 * (h2 - 1.0));
    return (clipped / h2 + atan(sqrt(k2 / (h2 - 1.0)))) / PI;
}

/* Above the floor, half sunk into it, and with its centre below: a bulb sends I = L pi r^2. */
static void a_bulb_lights_by_the_part_above_the_horizon(void **state)
{
    (void)state;
    static const float heights[] = { 2.0F, 0.5F, 0.1F, 0.0F, -0.2F };
    for (int i = 0; i < 5; ++i) {
        scene s = floor_of(scenes_matte((float)ALBEDO));
        const float from[3] = { 1.0F, heights[i], 0.0F };
        scene_light *const l = scenes_add_light(&s, SCENE_LIGHT_POINT, from, 3.0F);
        l->radius_m = 0.4F;
        const double height = (double)heights[i], distance = sqrt(1.0 + height * height), r = 0.4;
        const double expected = ALBEDO * 3.0 / (PI * r * r) * sphere_factor(height / distance, distance / r);
        /* The spot is 1e-4 from the place of the closed form, the light one metre away. */
        pictures_assert_relative(floor_radiance(&s, "R"), expected, 1e-4);
        scene_free(&s);
    }
}

/* A highlight narrower than the sun is as bright as the sun, but for what of the lobe passes it by: seen and lit along
 * the normal, the distribution of the slopes up to tan(radius / 2), 1 - 1 / (1 + (t / alpha)^2) for GGX. */
static void a_mirror_shows_the_sun_with_its_size(void **state)
{
    (void)state;
    scene_material m = scene_material_default();
    m.metallic = 1.0F;
    for (int i = 0; i < 4; ++i) {
        static const double roughnesses[] = { 0.05, 0.1, 0.2, 0.4 };
        m.roughness = (float)roughnesses[i];
        scene s = floor_of(m);
        const float above[3] = { 0.0F, 1.0F, 0.0F };
        scene_light *const l = add_panel(&s, SCENE_LIGHT_DIRECTIONAL, above, 0.0F, 0.0F);
        l->angular_diameter_rad = 0.2F;
        const double sine = sin(0.1), t = tan(0.05) / (roughnesses[i] * roughnesses[i]);
        const double radiance = 3.0 / (PI * sine * sine);
        /* 2 %, what the fast path is to keep; masking takes less than 1e-4. */
        pictures_assert_relative(floor_radiance(&s, "R"), radiance * t * t / (1.0 + t * t), 0.02);
        scene_free(&s);
    }
}

/* A node that mirrors still shines along its -z. */
static void a_mirrored_node_does_not_turn_its_light_over(void **state)
{
    (void)state;
    scene s = floor_of(scenes_matte((float)ALBEDO));
    const float above[3] = { 0.0F, 2.0F, 0.0F };
    scene_light *const l = add_panel(&s, SCENE_LIGHT_RECT, above, 3.0F, 1.0F);
    l->to_world[0] = -4.0F;
    pictures_assert_relative(floor_radiance(&s, "R"), ALBEDO * 3.0 * 4.0 * corner_factor(0.75, 0.25), FLOAT_BOUND);
    scene_free(&s);
}

/* Where nothing is in the way there is no chance in the picture: glossy, coated, with facets or without. */
static void light_without_an_obstacle_has_no_noise(void **state)
{
    (void)state;
    scene_material m = scene_material_default();
    m.roughness = 0.4F;
    m.metallic = 0.5F;
    m.clearcoat = 1.0F;
    m.clearcoat_roughness = 0.1F;
    scene s = floor_of(m);
    const float above[3] = { 0.3F, 1.0F, 0.2F };
    add_panel(&s, SCENE_LIGHT_RECT, above, 1.0F, 0.5F);
    add_panel(&s, SCENE_LIGHT_DISK, above, 0.2F, 0.2F);
    const scene_camera c = pictures_from_above(SPOT);
    preview_options o = pictures_options(&c);
    o.width = o.height = 4;
    image first = pictures_render(&s, &o);
    assert_true(pictures_mean(&first, "R") > 0.1);
    for (o.seed = 1; o.seed < 8; ++o.seed) {
        image i = pictures_render(&s, &o);
        /* The samples lie elsewhere in the pixel, a ten-thousandth of the distance to the light. */
        pictures_assert_relative(pictures_at(&i, "R", 1, 1), pictures_at(&first, "R", 1, 1), 1e-3);
        image_free(&i);
    }
    image_free(&first);
    scene_free(&s);
}

/* ---- shadows ---- */

/* A wall that hangs above x > edge at the height, far to the right and to both sides. */
static void add_blocker(scene *s, float edge, float height)
{
    scene_material black = scenes_matte(0.0F);
    black.double_sided = true;
    const float h = height, far = 50.0F;
    const float corners[18] = { edge, h, -far, far, h, far, far, h, -far, edge, h, -far, edge, h, far, far, h, far };
    scenes_add_instance(s, scenes_add_triangles(s, scenes_add_material(s, &black), corners, 2), NULL, 1);
}

/* The quotient of sums over a few places is off in the mean by what its own sample size brings. That is simulated in a
 * few lines from the places' own law, and the picture has to show it: no more, no less. *most: how far that is from
 * what is seen, as a share of the light unhidden. */
static void check_penumbra(float roughness, float metallic, double *most)
{
    enum { DRAWS = 20000 };
    uint64_t random = 71;
    scene_material material = scenes_matte((float)ALBEDO);
    material.roughness = roughness;
    material.metallic = metallic;
    scene s = floor_of(material);
    const float above[3] = { 0.2F, 2.0F, 0.0F };
    const double panel[4] = { 0.2, 2.0, 1.2, 0.8 };
    add_panel(&s, SCENE_LIGHT_RECT, above, 1.2F, 0.8F);
    add_blocker(&s, 0.0F, 1.0F);

    glint_material_options options = GLINT_MATERIAL_OPTIONS_INIT;
    options.model = GLINT_MODEL_SMOOTH;
    options.surface.alpha_x = options.surface.alpha_y = roughness * roughness;
    for (int k = 0; k < 3; ++k) {
        options.surface.diffuse[k] = metallic > 0.0F ? 0.0F : (float)ALBEDO;
        options.surface.f0[k] = metallic > 0.0F ? (float)ALBEDO : 0.0F;
        options.surface.f90[k] = metallic > 0.0F ? 1.0F : 0.0F;
    }
    glint_material *m;
    assert_int_equal(glint_material_create(&options, &m, NULL, 0), GLINT_OK);

    for (int k = 0; k <= 4; ++k) {
        const double x =
            -0.2 + 0.1 * k; /* the light ends at -.4 and .8 of twice that: from in the half-shadow to out */
        scene_camera c = pictures_from_above(SPOT);
        c.to_world[13] = 0.5F; /* below the blocker */
        c.to_world[12] = (float)x;
        preview_options o = pictures_options(&c);
        o.width = o.height = 32;
        o.spp = 16;
        image i = pictures_render(&s, &o);
        moments pixels = { 0 };
        for (int p = 0; p < 32 * 32; ++p)
            moments_add(&pixels, pictures_at(&i, "R", p % 32, p / 32));
        image_free(&i);
        const penumbra p = { m, x, 0.0, 1.0, panel[0], panel[1], panel[2], panel[3] };
        moments share = { 0 };
        for (int n = 0; n < DRAWS; ++n)
            moments_add(&share, penumbra_estimate(&p, roughness * roughness < 0.3F ? 3 : 0, &random));
        /* The picture's light is the fast integral, which for a panel in the middle of a lobe is within a thousandth.
         */
        const double whole = penumbra_brute_force(&p, 1), seen = penumbra_brute_force(&p, 0) / whole;
        const double value = pixels.mean / (3.0 * whole);
        const double sigma = hypot(moments_standard_error(&pixels) / (3.0 * whole), moments_standard_error(&share));
        *most = fmax(*most, fabs(share.mean - seen));
        if (!(fabs(value - share.mean) < 5.0 * sigma + 1e-3))
            fail_msg("roughness %g, x %g: the share %.5g, expected %.5g (%.1f sigmas); what is seen is %.5g",
                     (double)roughness, x, value, share.mean, (value - share.mean) / sigma, seen);
    }
    glint_material_destroy(m);
    scene_free(&s);
}

static void penumbrae_have_the_light_that_their_places_see(void **state)
{
    (void)state;
    double rough = 0.0, shiny = 0.0;
    check_penumbra(1.0F, 0.0F, &rough);
    check_penumbra(0.7F, 1.0F, &rough);
    check_penumbra(0.35F, 1.0F, &shiny);
    printf("the mean of a penumbra is off by up to %.4f of the light, of a shiny surface %.4f\n", rough, shiny);
}

/* ---- facets ---- */

/* Half of a panel is hidden, so that explicit facets see the other half; they are also lit by a panel of that half
 * alone, with nothing in the way: the truth. The share of lit facets halves, and each is as bright as before, so the
 * mean halves and so does the variance. */
static void half_hidden_light_glints_as_half_the_light(void **state)
{
    (void)state;
    enum { SEEDS = 10 };
    const float all[3] = { 0.0F, 2.0F, 0.0F }, left[3] = { -0.25F, 2.0F, 0.0F };
    scene hidden = floor_of(scenes_flakes(0.5F, 4e6F));
    scene half = floor_of(scenes_flakes(0.5F, 4e6F));
    add_panel(&hidden, SCENE_LIGHT_RECT, all, 1.0F, 0.5F);
    add_blocker(&hidden, 0.0F, 1.0F);
    add_panel(&half, SCENE_LIGHT_RECT, left, 0.5F, 0.5F);

    scene_camera c = pictures_from_above(0.02F);
    c.to_world[13] = 0.5F;
    preview_options o = pictures_options(&c);
    o.width = o.height = 64;
    o.spp = 4;
    double variance[3], mean[3];
    pictures_block_statistics(&hidden, &o, SEEDS, &variance[0], &mean[0]);
    pictures_block_statistics(&half, &o, SEEDS, &variance[1], &mean[1]);
    o.model = GLINT_MODEL_EXPLICIT;
    pictures_block_statistics(&half, &o, SEEDS, &variance[2], &mean[2]);
    /* The same facets, drawn alike, lit by the same light. The rays' shares scatter by a tenth, and two samples that
     * disagree by d count d / 2 fewer facets in common: 1.13 * .1 / 2 / .5 = 11 percent of the variance at most. A
     * mask of 0 and 1 a sample would lose 40 percent. */
    if (!(variance[0] / variance[1] > 0.8 && variance[0] / variance[1] < 1.1))
        fail_msg("variance %.4g half hidden, %.4g under half the light", variance[0], variance[1]);
    /* N p = 5.7 facets a block: the variance of 640 of them is known to sqrt((2 + 1 / 5.7) / 640) = 5.8 percent, each.
     */
    if (!(fabs(variance[0] / variance[2] - 1.0) < 5.0 * 0.082))
        fail_msg("variance %.4g half hidden, %.4g explicit", variance[0], variance[2]);
    const double sigma = sqrt(variance[2] / (64.0 * SEEDS));
    if (!(fabs(mean[0] - mean[2]) < 5.0 * 1.42 * sigma && fabs(mean[0] / mean[1] - 1.0) < 0.03))
        fail_msg("mean %.5g half hidden, %.5g under half the light, %.5g explicit", mean[0], mean[1], mean[2]);
    scene_free(&hidden);
    scene_free(&half);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rectangle_lights_by_its_form_factor),
        cmocka_unit_test(a_disk_lights_by_its_form_factor_and_to_one_side),
        cmocka_unit_test(a_bulb_lights_by_the_part_above_the_horizon),
        cmocka_unit_test(a_mirror_shows_the_sun_with_its_size),
        cmocka_unit_test(a_mirrored_node_does_not_turn_its_light_over),
        cmocka_unit_test(light_without_an_obstacle_has_no_noise),
        cmocka_unit_test(penumbrae_have_the_light_that_their_places_see),
        cmocka_unit_test(half_hidden_light_glints_as_half_the_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
