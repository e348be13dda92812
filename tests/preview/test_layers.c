/* The layers of a hit, which the renderer adds up one by one, against libglint's layered model in one call: textures,
 * bent normals of both layers, flakes in both. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "preview/camera.h"
#include "preview/preview.h"
#include "preview/shade.h"
#include "scenes.h"
#include "traced_scene.h"

static const uint8_t LEANING[4] = { 192, 160, 208, 255 }, LEANING_BACK[4] = { 90, 110, 230, 255 };
static const uint8_t PATCHES[16] = { 255, 90, 40, 255, 120, 200, 90, 255, 0, 60, 255, 255, 180, 255, 20, 255 };

/* Flakes in the base and in the coat, laid out in different spaces; textures on all that a coat has. */
static scene_material two_layers(scene *s)
{
    scene_material m = scene_material_default();
    m.metallic = 0.6F;
    m.roughness = 0.5F;
    m.base_color[1] = 0.3F;
    m.anisotropy = 0.5F;
    m.normal_texture = scenes_add_texture(s, LEANING, 1, 1);
    m.clearcoat = 0.9F;
    m.clearcoat_roughness = 0.6F;
    m.clearcoat_texture = scenes_add_texture(s, PATCHES, 2, 2);
    m.clearcoat_roughness_texture = m.clearcoat_texture;
    m.clearcoat_normal_texture = scenes_add_texture(s, LEANING_BACK, 1, 1);
    m.glint.present = m.coat_glint.present = true;
    m.glint.factor = m.coat_glint.factor = 1.0F;
    m.glint.density = 3e4F;
    m.coat_glint.density = 2e3F;
    m.coat_glint.density_texture = m.clearcoat_texture;
    m.coat_glint.space = SCENE_SPACE_OBJECT;
    m.coat_glint.layer = SCENE_LAYER_CLEARCOAT;
    m.coat_glint.color[2] = 0.2F;
    return m;
}

static void to_base(const shade_layer *base, vec3 world, float local[3])
{
    local[0] = (float)v3_dot(world, base->x);
    local[1] = (float)v3_dot(world, base->y);
    local[2] = (float)v3_dot(world, base->z);
}

/* The same point as one surface with a coat. */
static void eval_as_one(const shade_point *p, vec3 wi, float solid_angle_sr, glint_value *value)
{
    const shade_layer *const base = &p->layers[0], *const coat = &p->layers[1];
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle_sr };
    glint_coat c = { .surface = coat->surface, .weight = coat->weight, .footprint = &coat->footprint };
    to_base(base, coat->z, c.normal);
    to_base(base, coat->x, c.tangent);
    glint_surface s = base->surface;
    s.coat = &c;
    float local[3];
    to_base(base, wi, local);
    glint_eval_value(p->whole, &s, &base->footprint, base->wo, local, &light, value);
}

static void assert_near(float value, float expected)
{
    /* Frames go through single precision twice; alpha is .09 and more. */
    if (!(fabs((double)(value - expected)) <= 3e-5 * (double)expected + 1e-9))
        fail_msg("%.9g is not %.9g", (double)value, (double)expected);
}

/* Where both are lit, and where their counts agree: a rounding of the frame moves a few facets over the edge. */
typedef struct tally {
    int lit, same;
} tally;

static void compare_at(const shader *with, const traced_scene *t, const camera *c, int column, int row, tally *sum)
{
    trace_ray ray;
    differential d;
    hit h;
    camera_ray(c, column + 0.4, row + 0.6, &ray, &d);
    hit_step step;
    if (!traced_hit_step(t, &ray, &d, &h, &step))
        return;
    shade_point p;
    shade_prepare(with, &h, &step, v3_scale(ray.direction, -1.0), 0.3F, &p);
    assert_int_equal(p.layer_count, p.layers[1].weight > 0.0F ? 2 : 1);
    if (p.layer_count < 2)
        return;
    const vec3 wi = v3_normalize(v3(0.3 * column - 3.0, 4.0, 0.2 * row - 2.0));
    glint_value parts, one;
    shade_eval(&p, wi, 1e-3F, &parts);
    eval_as_one(&p, wi, 1e-3F, &one);
    for (int k = 0; k < 3; ++k)
        assert_near(parts.smooth[k], one.smooth[k]);
    assert_near(parts.facet_count, one.facet_count);
    assert_near(parts.lit_probability, one.lit_probability);
    sum->lit += one.smooth[0] > 0.0F;
    sum->same += one.smooth[0] > 0.0F && fabsf(parts.rgb[0] - one.rgb[0]) <= 1e-4F * one.rgb[0];
}

static void layers_one_by_one_give_the_numbers_of_the_layered_model(void **state)
{
    (void)state;
    const float eye[3] = { 1.0F, 3.0F, 5.0F }, target[3] = { 0.0F, 0.0F, 0.0F };
    scene s = scenes_empty();
    const scene_material m = two_layers(&s);
    scenes_add_instance(&s, scenes_add_square(&s, scenes_add_material(&s, &m), 2.0F), NULL, 0);
    const scene_camera from = scenes_camera(SCENE_PERSPECTIVE, eye, target, 0.5F);
    preview_options o = PREVIEW_OPTIONS_INIT;
    report r = { 0 };
    camera c;
    traced_scene t;
    materials made;
    o.model = GLINT_MODEL_COUNTING;
    textures *images = NULL;
    assert_true(camera_make(&from, 32, 32, &c, &r) && materials_make(&s, &o, NULL, &made, &r) &&
                textures_open(&s, &images, &r));
    traced_open(&t, &s, NULL);
    shader with = { &s, &made, images, NULL };
    assert_true(shader_open(&with, &r));
    tally sum = { 0, 0 };
    for (int i = 0; i < 32 * 32; ++i)
        compare_at(&with, &t, &c, i % 32, i / 32, &sum);
    assert_true(sum.lit > 300 && sum.same > 0.9 * sum.lit);
    traced_close(&t);
    shader_close(&with);
    textures_close(images);
    materials_free(&made);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_one_by_one_give_the_numbers_of_the_layered_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
