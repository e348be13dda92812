/* The mapping from glTF's material model to libglint's, against the formulas of the glTF text written out in full. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene/surface.h"

#define ROUNDING 4e-7 /* a few float operations on numbers up to 1 */

static void assert_near(float value, double expected, double bound)
{
    if (!(fabs((double)value - expected) <= bound))
        fail_msg("%.9g is not %.9g within %g", (double)value, expected, bound);
}

static scene_material painted(void)
{
    scene_material m = scene_material_default();
    const float color[3] = { 0.8F, 0.4F, 0.1F };
    for (int i = 0; i < 3; ++i)
        m.base_color[i] = color[i];
    return m;
}

static glint_surface base_of(const scene_material *m)
{
    const scene_texels t = scene_texels_of(m);
    return scene_base_surface(m, &t);
}

static void a_metal_reflects_its_color_and_has_no_diffuse_light(void **state)
{
    (void)state;
    scene_material m = painted();
    m.roughness = 0.6F;
    const glint_surface s = base_of(&m);
    for (int i = 0; i < 3; ++i) {
        assert_near(s.f0[i], (double)m.base_color[i], ROUNDING);
        assert_near(s.f90[i], 1.0, ROUNDING);
        assert_true(s.diffuse[i] == 0.0F);
    }
    assert_near(s.alpha_x, 0.36, ROUNDING);
    assert_near(s.alpha_y, 0.36, ROUNDING);
}

static void a_dielectric_reflects_by_its_index_and_scatters_its_color(void **state)
{
    (void)state;
    const float index[4] = { 1.5F, 1.0F, 2.42F, 0.0F };
    const double head_on[4] = { 0.04, 0.0, 1.42 * 1.42 / (3.42 * 3.42),
                                1.0 }; /* ((n - 1) / (n + 1))^2; 0 means 1: KHR_materials_ior */
    for (int k = 0; k < 4; ++k) {
        scene_material m = painted();
        m.metallic = 0.0F;
        m.ior = index[k];
        const glint_surface s = base_of(&m);
        for (int i = 0; i < 3; ++i) {
            assert_near(s.f0[i], head_on[k], 1e-5);
            assert_near(s.f90[i], 1.0, ROUNDING);
            assert_near(s.diffuse[i], (double)m.base_color[i], ROUNDING);
        }
    }
}

/* dielectric_f0 = min(0.04 * specularColor, 1) * specular, dielectric_f90 = specular: KHR_materials_specular. */
static void specular_scales_the_dielectric_and_leaves_the_metal(void **state)
{
    (void)state;
    scene_material m = painted();
    m.specular = 0.5F;
    m.specular_color[0] = 30.0F; /* more than all light: held at 1 */
    m.specular_color[1] = 2.0F;
    m.specular_color[2] = 0.0F;
    m.metallic = 0.0F;
    glint_surface s = base_of(&m);
    const double expected[3] = { 0.5, 0.04, 0.0 };
    for (int i = 0; i < 3; ++i) {
        assert_near(s.f0[i], expected[i], ROUNDING);
        assert_near(s.f90[i], 0.5, ROUNDING);
    }
    m.metallic = 1.0F;
    s = base_of(&m);
    assert_near(s.f0[0], 0.8, ROUNDING);
    assert_near(s.f90[0], 1.0, ROUNDING);
    m.metallic = 0.25F; /* mix(dielectric, metal, metallic) */
    s = base_of(&m);
    assert_near(s.f0[1], 0.75 * 0.04 + 0.25 * 0.4, ROUNDING);
    assert_near(s.f90[1], 0.75 * 0.5 + 0.25, ROUNDING);
    assert_near(s.diffuse[1], 0.75 * 0.4, ROUNDING);
}

/* alpha_t = mix(alpha, 1, strength^2), alpha_b = alpha: KHR_materials_anisotropy. */
static void anisotropy_stretches_the_highlight_along_the_tangent(void **state)
{
    (void)state;
    scene_material m = painted();
    m.roughness = 0.4F;
    m.anisotropy = 0.5F;
    const glint_surface s = base_of(&m);
    assert_near(s.alpha_x, 0.16 + 0.84 * 0.25, ROUNDING);
    assert_near(s.alpha_y, 0.16, ROUNDING);
}

static void a_clear_coat_is_a_dielectric_of_index_one_and_a_half(void **state)
{
    (void)state;
    scene_material m = painted();
    m.clearcoat = 1.0F;
    m.clearcoat_roughness = 0.3F;
    m.ior = 2.0F; /* of the base: the coat does not care */
    const scene_texels t = scene_texels_of(&m);
    const glint_surface s = scene_coat_surface(&m, &t);
    for (int i = 0; i < 3; ++i) {
        assert_near(s.f0[i], 0.04, ROUNDING);
        assert_near(s.f90[i], 1.0, ROUNDING);
        assert_true(s.diffuse[i] == 0.0F);
    }
    assert_near(s.alpha_x, 0.09, ROUNDING);
}

static void every_texel_gives_a_surface_that_the_library_takes(void **state)
{
    (void)state;
    const float wild[5] = { -3.0F, 0.0F, 0.5F, 1.0F, 1e30F };
    scene_material m = painted();
    m.glint.present = true;
    m.glint.factor = 1.0F;
    for (int a = 0; a < 5; ++a) {
        for (int b = 0; b < 5; ++b) {
            scene_texels t = scene_texels_of(&m);
            t.roughness = t.clearcoat_roughness = t.base_color[0] = t.glint_color[1] = wild[a];
            t.metallic = t.specular = t.anisotropy = t.glint_factor = t.glint_density = wild[b];
            const glint_surface both[2] = { scene_base_surface(&m, &t), scene_coat_surface(&m, &t) };
            for (int k = 0; k < 2; ++k) {
                const glint_surface *const s = &both[k];
                assert_true(s->alpha_x >= 1e-4F && s->alpha_x <= 1.0F && s->alpha_y >= 1e-4F && s->alpha_y <= 1.0F);
                assert_true(s->facets_per_m2 >= 0.0F && s->discreteness >= 0.0F && s->discreteness <= 1.0F);
                for (int i = 0; i < 3; ++i) {
                    assert_true(s->diffuse[i] >= 0.0F && s->diffuse[i] <= 1.0F);
                    assert_true(s->f0[i] >= 0.0F && s->f0[i] <= 1.0F && s->f90[i] >= 0.0F && s->f90[i] <= 1.0F);
                }
            }
        }
    }
}

static void only_the_layer_that_has_glints_counts(void **state)
{
    (void)state;
    scene_material m = painted();
    m.clearcoat = 1.0F;
    assert_int_equal(scene_base_options(&m, GLINT_MODEL_COUNTING).model, GLINT_MODEL_SMOOTH);
    m.glint.present = true;
    assert_int_equal(scene_base_options(&m, GLINT_MODEL_COUNTING).model, GLINT_MODEL_SMOOTH); /* factor 0 */
    m.glint.factor = 0.5F;
    m.glint.density = 3e7F;
    m.glint.facet_roughness = 0.2F;
    m.glint.coverage = 0.75F;
    m.glint.elongation = 3.0F;
    m.glint.seed = 11U;
    m.glint.distribution = GLINT_DISTRIBUTION_BECKMANN;
    const glint_material_options base = scene_base_options(&m, GLINT_MODEL_COUNTING);
    assert_int_equal(base.model, GLINT_MODEL_COUNTING);
    assert_int_equal(base.distribution, GLINT_DISTRIBUTION_BECKMANN);
    assert_near(base.facet_alpha, 0.04, ROUNDING);
    assert_near(base.coverage, 0.75, 0.0);
    assert_near(base.elongation, 3.0, 0.0);
    assert_int_equal(base.seed, 11);
    assert_near(base.surface.facets_per_m2, 3e7, 0.0);
    assert_near(base.surface.discreteness, 0.5, 0.0);
    assert_int_equal(scene_coat_options(&m, GLINT_MODEL_COUNTING).model, GLINT_MODEL_SMOOTH);
    assert_true(scene_coat_options(&m, GLINT_MODEL_COUNTING).surface.discreteness == 0.0F);

    m.glint.layer = SCENE_LAYER_CLEARCOAT;
    assert_int_equal(scene_base_options(&m, GLINT_MODEL_COUNTING).model, GLINT_MODEL_SMOOTH);
    assert_int_equal(scene_coat_options(&m, GLINT_MODEL_COUNTING).model, GLINT_MODEL_COUNTING);
    assert_int_equal(scene_coat_options(&m, GLINT_MODEL_SMOOTH).model, GLINT_MODEL_SMOOTH);
}

static void layers_with_glints_of_their_own_never_share_facets(void **state)
{
    (void)state;
    scene_material m = painted();
    m.clearcoat = 1.0F;
    m.clearcoat_roughness = 0.5F;
    m.glint.present = m.coat_glint.present = true;
    m.glint.factor = 1.0F;
    m.coat_glint.factor = 0.25F;
    m.coat_glint.layer = SCENE_LAYER_CLEARCOAT;
    m.coat_glint.density = 5e5F;
    m.coat_glint.color[0] = 0.5F;
    m.coat_glint.coverage = 0.75F;
    m.glint.seed = m.coat_glint.seed = 7U;
    const glint_material_options base = scene_base_options(&m, GLINT_MODEL_COUNTING);
    const glint_material_options coat = scene_coat_options(&m, GLINT_MODEL_COUNTING);
    assert_true(base.model == GLINT_MODEL_COUNTING && coat.model == GLINT_MODEL_COUNTING);
    assert_true(base.surface.facets_per_m2 == 1e8F && coat.surface.facets_per_m2 == 5e5F);
    assert_true(base.surface.discreteness == 1.0F && coat.surface.discreteness == 0.25F && coat.coverage == 0.75F);
    assert_near(coat.surface.f0[0], 0.04 * (0.75 + 0.25 * 0.5), ROUNDING);
    assert_near(base.surface.f0[0], 0.8, ROUNDING);
    assert_true(base.seed == 7U && coat.seed != 7U);
    m.glint.present = false;
    assert_int_equal(scene_coat_options(&m, GLINT_MODEL_COUNTING).seed, 7);
}

static void the_color_of_glints_tints_the_share_that_is_counted(void **state)
{
    (void)state;
    scene_material m = painted();
    m.glint.present = true;
    m.glint.factor = 0.5F;
    m.glint.color[0] = 0.2F;
    const glint_surface s = base_of(&m);
    assert_near(s.f0[0], 0.8 * (0.5 + 0.5 * 0.2), ROUNDING);
    assert_near(s.f90[0], 0.5 + 0.5 * 0.2, ROUNDING);
    assert_near(s.f0[1], 0.4, ROUNDING);
}

static void the_library_takes_the_options_of_both_layers(void **state)
{
    (void)state;
    scene_material m = painted();
    m.clearcoat = 1.0F;
    m.glint.present = true;
    m.glint.factor = 1.0F;
    m.roughness = m.clearcoat_roughness = 0.0F;
    const glint_material_options both[2] = { scene_base_options(&m, GLINT_MODEL_COUNTING),
                                             scene_coat_options(&m, GLINT_MODEL_COUNTING) };
    for (int i = 0; i < 2; ++i) {
        glint_material *made;
        char message[128];
        assert_int_equal(glint_material_create(&both[i], &made, message, sizeof message), GLINT_OK);
        glint_material_destroy(made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_metal_reflects_its_color_and_has_no_diffuse_light),
        cmocka_unit_test(a_dielectric_reflects_by_its_index_and_scatters_its_color),
        cmocka_unit_test(specular_scales_the_dielectric_and_leaves_the_metal),
        cmocka_unit_test(anisotropy_stretches_the_highlight_along_the_tangent),
        cmocka_unit_test(a_clear_coat_is_a_dielectric_of_index_one_and_a_half),
        cmocka_unit_test(every_texel_gives_a_surface_that_the_library_takes),
        cmocka_unit_test(only_the_layer_that_has_glints_counts),
        cmocka_unit_test(layers_with_glints_of_their_own_never_share_facets),
        cmocka_unit_test(the_color_of_glints_tints_the_share_that_is_counted),
        cmocka_unit_test(the_library_takes_the_options_of_both_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
