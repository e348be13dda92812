/* How the plan finds the light of each shape, and its shadows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "small_plan.h"

/* A lamp whose shape shows, N p facets lit in every pixel. */
static void fill_shape(small_scene *s, float lit_facets, float budget)
{
    small_plan_fill(s, lit_facets, 16);
    s->light.kind = GLINT_PLAN_LIGHT_SHAPE;
    s->pair.shapes[GLINT_PLAN_SHAPES - 1] = (glint_plan_shape){ 1.0F, 1.0F, 1.0F / lit_facets };
    s->summary.error_budget = budget;
}

static const char *way_to_light(const small_scene *s, float *error)
{
    static char choice[24];
    glint_plan *plan = small_plan_of(s);
    const glint_decision *const d = small_plan_find(plan, GLINT_EFFECT_LIGHT);
    glint_material_options cut = s->options;
    glint_plan_cut(plan, 0, &cut);
    snprintf(choice, sizeof choice, "%s", d->choice);
    *error = d->error;
    assert_int_equal(cut.area_light_method,
                     strcmp(choice, "LTC") == 0 ? GLINT_AREA_LIGHT_FAST : GLINT_AREA_LIGHT_EXACT);
    glint_plan_destroy(plan);
    return choice;
}

/* What a fit is off by turns e N p of the N p lit facets on and off, and the pixel varies by e / (N p): far more than
 * by e^2 where few are lit, and less where a hundred thousand are. */
static void fit_stands_for_a_shape_unless_it_turns_few_facets_on_and_off(void **state)
{
    (void)state;
    small_scene s;
    float few, many;
    fill_shape(&s, 0.01F, 0.02F);
    assert_string_equal(way_to_light(&s, &few), "quadrature");
    fill_shape(&s, 1e5F, 0.02F);
    assert_string_equal(way_to_light(&s, &many), "LTC");
    /* The error of a fit by itself is a few thousandths at most. */
    assert_true(many > 0.0F && many < 0.004F);
    fill_shape(&s, 1.0F, 0.2F);
    assert_string_equal(way_to_light(&s, &few), "LTC");
    assert_true(few > 2.0F * many && few < 0.1F);
    fill_shape(&s, 1e5F, 0.0F);
    assert_string_equal(way_to_light(&s, &few), "quadrature");
    /* The light of a lamp that brings a hundredth of the pixel. */
    fill_shape(&s, 1e5F, 1e-4F);
    assert_string_equal(way_to_light(&s, &few), "quadrature");
    s.pair.shapes[GLINT_PLAN_SHAPES - 1].part *= 1e-4F;
    s.pair.shapes[GLINT_PLAN_SHAPES - 1].sparks *= 1e-4F;
    assert_string_equal(way_to_light(&s, &few), "LTC");
    /* No fit knows a brushed surface. */
    fill_shape(&s, 1e5F, 0.2F);
    s.options.surface.alpha_x *= 0.5F;
    assert_string_equal(way_to_light(&s, &few), "quadrature");
}

/* Half of the evaluations each would be off by up to .01 and .02 as caps, so many facets lit that none flips. The first
 * are off by .004 in truth, the others by .02, of a budget of .02. */
static void fill_two_entries(small_scene *s)
{
    fill_shape(s, 1e9F, 0.02F);
    s->pair.shapes[GLINT_PLAN_SHAPES - 1] = (glint_plan_shape){ 0.0F };
    s->pair.shapes[0] = (glint_plan_shape){ 0.5F, 0.5F, 0.0F, 0.16e-4F, 0.16e-4F, 0.0F };
    s->pair.shapes[1] = (glint_plan_shape){ 0.5F, 0.5F, 0.0F, 4e-4F, 4e-4F, 0.0F };
}

/* A quarter each of the evaluations are off by .01, .02, .04 and .08 as caps, e, and so many facets are lit that only
 * e^2 counts: up to .04 that is (1 + 4 + 16) / 4 1e-4 of variance, up to .08 21.25e-4. Half of the budget's square is
 * 12.5e-4 and 50e-4. Of five lit facets e / 5 counts besides: 6.25e-4, 17.25e-4, 41.25e-4, 102e-4 up to .01, .02 .04
 * and .08. The fit takes next to nothing. */
static void cap_stands_for_a_shape_where_the_budget_allows_it(void **state)
{
    (void)state;
    static const struct {
        float lit_facets, budget, cap_error;
    } cases[] = {
        { 1e6F, 0.05F, 0.04F }, { 1e6F, 0.1F, 0.08F }, { 1e6F, 0.005F, 0.0F },
        { 0.1F, 0.1F, 0.0F },   { 1e6F, 0.0F, 0.0F },  { 5.0F, 0.1F, 0.04F },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        small_scene s;
        fill_shape(&s, cases[i].lit_facets, cases[i].budget);
        s.pair.shapes[GLINT_PLAN_SHAPES - 1] = (glint_plan_shape){ 0 };
        for (int k = 0; k < 4; k++) {
            const float e = 0.01F * (float)(1 << k), sparks = 0.25F / cases[i].lit_facets;
            s.pair.shapes[k] = (glint_plan_shape){ 0.25F, 0.25F, sparks, 0.25F * e * e, 0.25F * e * e, sparks };
        }
        glint_plan *plan = small_plan_of(&s);
        const float found = glint_plan_result(plan).cap_error;
        const glint_decision *const d = small_plan_find(plan, GLINT_EFFECT_LIGHT);
        if (!(fabsf(found - cases[i].cap_error) < 1e-6F))
            fail_msg("%g lit facets, budget %g: caps up to %g, expected %g", (double)cases[i].lit_facets,
                     (double)cases[i].budget, (double)found, (double)cases[i].cap_error);
        assert_int_equal(strcmp(d->choice, "cap") == 0, found > 0.0F);
        assert_true((double)d->error <= sqrt(0.5) * (double)cases[i].budget * (1.0 + 1e-6) || found == 0.0F);
        glint_plan_destroy(plan);
    }
}

/* Caps that are measured to be off by far less than they might be count for what they are off; and the last entry, of
 * which only some samples become caps, for what those are. */
static void caps_count_for_what_they_are_off(void **state)
{
    (void)state;
    small_scene s;
    fill_two_entries(&s);
    glint_plan *plan = small_plan_of(&s);
    assert_true(fabsf(glint_plan_result(plan).cap_error - 0.01F) < 1e-6F);
    assert_true(fabsf(small_plan_find(plan, GLINT_EFFECT_LIGHT)->error - 0.004F) < 1e-5F);
    glint_plan_destroy(plan);

    /* .01^2 / 4 and .004^2, of half of .02^2; with the whole of both it were .02^2 more. */
    s.pair.shapes[1].last_cap = 0.25F * 1e-4F;
    plan = small_plan_of(&s);
    assert_true(fabsf(glint_plan_result(plan).cap_error - 0.02F) < 1e-6F);
    assert_true(fabsf(small_plan_find(plan, GLINT_EFFECT_LIGHT)->error - sqrtf(0.41e-4F)) < 1e-5F);
    glint_plan_destroy(plan);
}

/* Facets that flip are .0115 of the picture's root mean square and .115 of its mean. The lamp's light on a tenth of the
 * picture, which the exact integral would make several times as dear, stays with the fit; on a thousandth it does not.
 */
static void facets_flip_over_the_mean_only_where_it_costs_much_to_prevent(void **state)
{
    (void)state;
    static const float seen[2] = { 0.1F, 1e-4F };
    for (int k = 0; k < 2; k++) {
        small_scene s;
        fill_shape(&s, 1.0F, 0.02F);
        s.pair.seen = s.pair.shapes[GLINT_PLAN_SHAPES - 1].seen = seen[k];
        s.pair.shapes[GLINT_PLAN_SHAPES - 1].part = 1e-3F;
        s.pair.shapes[GLINT_PLAN_SHAPES - 1].sparks = 0.5F;
        s.summary.contrast = 100.0F;
        glint_plan *plan = small_plan_of(&s);
        const glint_plan_outcome out = glint_plan_result(plan);
        assert_string_equal(small_plan_find(plan, GLINT_EFFECT_LIGHT)->choice, k == 0 ? "LTC" : "quadrature");
        assert_true(out.error <= 0.02F);
        if (k == 0)
            assert_true(fabsf(out.error_of_mean / out.error - 10.0F) < 0.01F);
        else
            assert_true(out.error_of_mean <= 0.02F);
        glint_plan_destroy(plan);
    }
}

/* A shadow that a survey has missed makes a dark pixel bright, by any factor: no number of rays is enough. */
static void shadows_stay_whatever_a_survey_has_not_seen(void **state)
{
    (void)state;
    static const uint32_t rays[] = { 1, 400, 1000000 };
    for (int k = 0; k < 3; k++) {
        small_scene s;
        small_plan_fill(&s, 10.0F, 16);
        s.summary.error_budget = 1.0F;
        s.light.blocked_rays = 0;
        s.light.shadow_rays = rays[k];
        glint_plan *plan = small_plan_of(&s);
        assert_true(small_plan_find(plan, GLINT_EFFECT_SHADOWS)->is_on);
        glint_plan_destroy(plan);
    }
}

/* Of two materials under the lamp one is proven to be in nobody's shadow: its rays cost nothing, those of the other do.
 */
static void shadows_that_cannot_be_are_left_out(void **state)
{
    (void)state;
    small_scene s;
    small_plan_fill(&s, 10.0F, 16);
    glint_plan_material materials[2] = { s.material, s.material };
    glint_plan_pair pairs[2] = { s.pair, s.pair };
    pairs[1].material = 1;
    pairs[1].shadow_rays = 0.25F;
    s.summary.materials = materials;
    s.summary.pairs = pairs;
    s.summary.material_count = s.summary.pair_count = 2;
    float ns[2];
    for (uint32_t k = 0; k < 2; k++) {
        pairs[0].is_clear = k;
        glint_plan *plan = small_plan_of(&s);
        const glint_decision *d = small_plan_find(plan, GLINT_EFFECT_SHADOWS);
        if (k == 1) {
            assert_true(!d->is_on && d->material == 0 && d->light == 0 && d->error == 0.0F);
            assert_string_equal(d->choice, "none");
            d++;
        }
        assert_true(d->effect == GLINT_EFFECT_SHADOWS && d->is_on && d->material == -1);
        ns[k] = d->ns_per_sample;
        glint_plan_destroy(plan);
    }
    assert_true(ns[1] > 0.0F && fabsf(ns[0] / ns[1] - 5.0F) < 1e-4F);

    pairs[1].is_clear = 1;
    glint_plan *plan = small_plan_of(&s);
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); i++)
        assert_false(glint_plan_decision(plan, i)->effect == GLINT_EFFECT_SHADOWS &&
                     glint_plan_decision(plan, i)->is_on);
    glint_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fit_stands_for_a_shape_unless_it_turns_few_facets_on_and_off),
        cmocka_unit_test(cap_stands_for_a_shape_where_the_budget_allows_it),
        cmocka_unit_test(caps_count_for_what_they_are_off),
        cmocka_unit_test(facets_flip_over_the_mean_only_where_it_costs_much_to_prevent),
        cmocka_unit_test(shadows_stay_whatever_a_survey_has_not_seen),
        cmocka_unit_test(shadows_that_cannot_be_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
