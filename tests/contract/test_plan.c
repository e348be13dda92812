/* The plan: decisions follow from the summary's numbers, errors add up to no more than the budget, and a summary that
 * cannot be is refused by name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "glint.h"
#include "statistics.h"

/* One material under one light, N p facets lit in every pixel. */
typedef struct small_scene {
    glint_material_options options;
    glint_plan_material material;
    glint_plan_light light;
    glint_plan_pair pair;
    glint_plan_summary summary;
} small_scene;

static void fill(small_scene *s, float lit_facets, uint32_t samples)
{
    s->options = (glint_material_options)GLINT_MATERIAL_OPTIONS_INIT;
    s->material = (glint_plan_material){ .name = "flakes", .base = &s->options, .seen = 1.0F };
    s->light = (glint_plan_light){ .name = "the lamp", .shadow_rays = 400, .blocked_rays = 30 };
    s->pair = (glint_plan_pair){ .seen = 1.0F };
    s->pair.share[glint_plan_bin(lit_facets)] = 1.0F;
    s->pair.rate[glint_plan_bin(lit_facets)] = 1.0F;
    s->summary = (glint_plan_summary)GLINT_PLAN_SUMMARY_INIT;
    s->summary.materials = &s->material;
    s->summary.lights = &s->light;
    s->summary.pairs = &s->pair;
    s->summary.material_count = s->summary.light_count = s->summary.pair_count = 1;
    s->summary.samples_per_pixel = samples;
    s->summary.pixel_count = 400;
}

static glint_plan *plan_of(const small_scene *s)
{
    glint_plan *plan;
    char message[256];
    if (glint_plan_create(&s->summary, &plan, message, sizeof message) != GLINT_OK)
        fail_msg("%s", message);
    return plan;
}

static const glint_decision *find(const glint_plan *plan, glint_effect effect)
{
    for (uint32_t i = 0; i < glint_plan_decision_count(plan); i++)
        if (glint_plan_decision(plan, i)->effect == effect)
            return glint_plan_decision(plan, i);
    fail_msg("no decision about %s", glint_effect_name(effect));
    return NULL;
}

static void bins_are_powers_of_two(void **state)
{
    (void)state;
    for (int k = -16; k < 32; k++) {
        assert_int_equal(glint_plan_bin((float)ldexp(1.0, k)), k + 16);
        assert_int_equal(glint_plan_bin((float)ldexp(1.99, k)), k + 16);
    }
    assert_int_equal(glint_plan_bin(0.0F), 0);
    assert_int_equal(glint_plan_bin(-1.0F), 0);
    assert_int_equal(glint_plan_bin((float)NAN), 0);
    assert_int_equal(glint_plan_bin(1e30F), GLINT_PLAN_BINS - 1);
}

/* 1.1 / (N p) of variance against a budget of 0.02: 2750 facets. */
static void few_facets_are_counted_and_many_are_smooth(void **state)
{
    (void)state;
    small_scene s;
    fill(&s, 10.0F, 16);
    glint_plan *few = plan_of(&s);
    assert_string_equal(find(few, GLINT_EFFECT_FACETS)->choice, "counted");
    assert_true(find(few, GLINT_EFFECT_FACETS)->ns_per_sample > 0.0F);
    glint_material_options cut = s.options;
    glint_plan_cut(few, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_COUNTING);
    /* Of a tile, of which 16 make a pixel: at most four times the budget. */
    assert_true(cut.smooth_deviation > 0.06F && cut.smooth_deviation <= 0.08F);
    glint_plan_destroy(few);

    fill(&s, 1e4F, 16);
    glint_plan *many = plan_of(&s);
    assert_string_equal(find(many, GLINT_EFFECT_FACETS)->choice, "smooth");
    assert_false(find(many, GLINT_EFFECT_FACETS)->is_on);
    assert_true(find(many, GLINT_EFFECT_FACETS)->ns_per_sample == 0.0F);
    assert_non_null(strstr(find(many, GLINT_EFFECT_FACETS)->reason, "the lamp"));
    cut = s.options;
    glint_plan_cut(many, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_SMOOTH);
    glint_plan_destroy(many);
}

/* A draw adds 9 / (N p) of a tile to a sample: with 1024 samples and 16 tiles 9 16 / (1024 N p) to a pixel, and the
 * facets themselves still show where 1.1 / (N p) is more than the budget. */
static void many_samples_allow_single_draws(void **state)
{
    (void)state;
    small_scene s;
    fill(&s, 1500.0F, 1024);
    glint_plan *plan = plan_of(&s);
    assert_string_equal(find(plan, GLINT_EFFECT_LOOKUPS)->choice, "one of 36");
    glint_material_options cut = s.options;
    glint_plan_cut(plan, 0, &cut);
    assert_true(cut.draw_deviation > 0.0F && cut.draw_deviation <= 0.02F * 32.0F);
    glint_plan_destroy(plan);

    fill(&s, 1500.0F, 16);
    plan = plan_of(&s);
    assert_string_equal(find(plan, GLINT_EFFECT_LOOKUPS)->choice, "all 36");
    glint_plan_destroy(plan);

    fill(&s, 1500.0F, 1024);
    s.light.kind = GLINT_PLAN_LIGHT_SURROUNDINGS;
    plan = plan_of(&s);
    assert_string_equal(find(plan, GLINT_EFFECT_LOOKUPS)->choice, "all 36");
    glint_plan_destroy(plan);
}

/* Noise of .3 a sample, independent: with N samples .09 / N, of a budget of .0004. Facets that show or that fade cost
 * and leave nothing, so the fewest powers of two do: 225 samples make 256. */
static void fewest_samples_are_taken_whose_noise_is_within_the_budget(void **state)
{
    (void)state;
    small_scene s;
    fill(&s, 10.0F, 16);
    s.summary.most_samples = 4096;
    s.summary.noise = 0.3F;
    glint_plan *plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 256);
    assert_true(glint_plan_result(plan).is_met);
    assert_string_equal(find(plan, GLINT_EFFECT_SAMPLES)->choice, "256");
    glint_plan_destroy(plan);

    /* Known of 16 samples, .05, and falling as samples^-1.5: (.05 / .02)^(2 / 1.5) = 3.4 times as many. */
    s.summary.noise = 0.05F;
    s.summary.noise_samples = 16;
    s.summary.noise_fall = 1.5F;
    plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 64);
    glint_plan_destroy(plan);
    /* A faster fall is not believed of more samples than were looked at, and an uncertain one is kept clear of. */
    s.summary.noise_fall = 3.0F;
    plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 64);
    glint_plan_destroy(plan);
    s.summary.noise_spread = 0.5F;
    plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 128);
    glint_plan_destroy(plan);

    /* No number is enough: the most, and it is said. */
    s.summary.most_samples = 32;
    plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 32);
    assert_false(glint_plan_result(plan).is_met);
    assert_true(glint_plan_result(plan).enough_samples > 32);
    glint_plan_destroy(plan);

    /* Nothing varies: the fewest. */
    s.summary.most_samples = 4096;
    s.summary.noise = 0.0F;
    plan = plan_of(&s);
    assert_int_equal(glint_plan_result(plan).samples, 16);
    glint_plan_destroy(plan);
}

/* What noise leaves of the budget may be left out: with any other number of samples whose noise fits, a plan for what
 * it leaves is no cheaper. */
static void cheapest_number_of_samples_is_taken(void **state)
{
    (void)state;
    uint64_t random = 11;
    for (int k = 0; k < 2000; k++) {
        small_scene s;
        fill(&s, (float)random_log_between(&random, 1.0, 1e6), 16);
        s.summary.error_budget = (float)random_log_between(&random, 0.01, 0.3);
        s.summary.noise = (float)random_log_between(&random, 0.01, 1.0);
        s.light.kind = (glint_plan_light_kind)(random_bits(&random) % 3);
        s.summary.most_samples = 4096;
        glint_plan *plan = plan_of(&s);
        const glint_plan_outcome chosen = glint_plan_result(plan);
        glint_plan_destroy(plan);
        const double budget = (double)s.summary.error_budget, one = (double)s.summary.noise;
        s.summary.most_samples = 0;
        s.summary.noise = 0.0F;
        for (uint32_t n = 16; n <= 4096; n *= 2) {
            if (!(one * one / n < budget * budget))
                continue;
            assert_true(chosen.is_met);
            s.summary.samples_per_pixel = n;
            s.summary.error_budget = (float)sqrt(budget * budget - one * one / n);
            plan = plan_of(&s);
            const double cost = (double)glint_plan_result(plan).ns_per_sample * n;
            glint_plan_destroy(plan);
            if (!((double)chosen.ns_per_sample * chosen.samples <= cost * 1.001))
                fail_msg("%u samples at %g ns, but %u at %g", chosen.samples, (double)chosen.ns_per_sample, n,
                         cost / n);
        }
    }
}

/* A lamp whose shape shows, N p facets lit in every pixel. */
static void fill_shape(small_scene *s, float lit_facets, float budget)
{
    fill(s, lit_facets, 16);
    s->light.kind = GLINT_PLAN_LIGHT_SHAPE;
    s->pair.shapes[GLINT_PLAN_SHAPES - 1] = (glint_plan_shape){ 1.0F, 1.0F, 1.0F / lit_facets };
    s->summary.error_budget = budget;
}

static const char *way_to_light(const small_scene *s, float *error)
{
    static char choice[24];
    glint_plan *plan = plan_of(s);
    const glint_decision *const d = find(plan, GLINT_EFFECT_LIGHT);
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
        for (int k = 0; k < 4; k++)
            s.pair.shapes[k] = (glint_plan_shape){ 0.25F, 0.25F, 0.25F / cases[i].lit_facets };
        glint_plan *plan = plan_of(&s);
        const float found = glint_plan_result(plan).cap_error;
        const glint_decision *const d = find(plan, GLINT_EFFECT_LIGHT);
        if (!(fabsf(found - cases[i].cap_error) < 1e-6F))
            fail_msg("%g lit facets, budget %g: caps up to %g, expected %g", (double)cases[i].lit_facets,
                     (double)cases[i].budget, (double)found, (double)cases[i].cap_error);
        assert_int_equal(strcmp(d->choice, "cap") == 0, found > 0.0F);
        assert_true((double)d->error <= sqrt(0.5) * (double)cases[i].budget * (1.0 + 1e-6) || found == 0.0F);
        glint_plan_destroy(plan);
    }
}

static void nothing_is_left_out_without_a_budget(void **state)
{
    (void)state;
    small_scene s;
    fill(&s, 1e9F, 1024);
    s.summary.error_budget = 0.0F;
    s.summary.bounces = 2;
    s.light.blocked_rays = 0;
    glint_plan *plan = plan_of(&s);
    glint_material_options cut = s.options;
    glint_plan_cut(plan, 0, &cut);
    assert_int_equal(cut.model, GLINT_MODEL_COUNTING);
    assert_true(cut.smooth_deviation == 0.0F && cut.draw_deviation == 0.0F);
    assert_true(glint_plan_result(plan).error == 0.0F);
    assert_int_equal(glint_plan_result(plan).bounces, 2);
    assert_true(find(plan, GLINT_EFFECT_SHADOWS)->is_on);
    glint_plan_destroy(plan);
}

/* A shadow that a survey has missed makes a dark pixel bright, by any factor: no number of rays is enough. */
static void shadows_stay_whatever_a_survey_has_not_seen(void **state)
{
    (void)state;
    static const uint32_t rays[] = { 1, 400, 1000000 };
    for (int k = 0; k < 3; k++) {
        small_scene s;
        fill(&s, 10.0F, 16);
        s.summary.error_budget = 1.0F;
        s.light.blocked_rays = 0;
        s.light.shadow_rays = rays[k];
        glint_plan *plan = plan_of(&s);
        assert_true(find(plan, GLINT_EFFECT_SHADOWS)->is_on);
        glint_plan_destroy(plan);
    }
}

/* Random summaries: the error of what is left out is within the budget, shares of time add up to one. */
static void errors_stay_within_the_budget(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int k = 0; k < 20000; k++) {
        small_scene s;
        fill(&s, (float)random_log_between(&random, 1e-4, 1e9), (uint32_t)random_log_between(&random, 1.0, 4096.0));
        s.summary.tiles_per_pixel = s.summary.samples_per_pixel < 16 ? 1 : 16;
        s.summary.error_budget = (float)random_log_between(&random, 1e-4, 1.0);
        s.summary.bounces = (uint32_t)random_between(&random, 0.0, 3.0);
        s.summary.bounced = (float)random_log_between(&random, 1e-6, 1.0);
        s.summary.noise = (float)random_log_between(&random, 1e-3, 10.0);
        s.light.kind = (glint_plan_light_kind)(random_bits(&random) % 3);
        for (int i = 0; i < GLINT_PLAN_SHAPES; i++)
            s.pair.shapes[i] = (glint_plan_shape){ 1.0F / GLINT_PLAN_SHAPES, (float)random_between(&random, 0.0, 0.2),
                                                   (float)random_log_between(&random, 1e-9, 1e3) };
        s.light.blocked_rays = random_bits(&random) % 2 ? 0U : 7U;
        s.light.shadow_rays = (uint32_t)random_log_between(&random, 7.0, 1e6);
        s.options.color_variation = random_bits(&random) % 2 ? 0.0F : 0.9F;
        glint_plan *plan = plan_of(&s);
        const glint_plan_outcome out = glint_plan_result(plan);
        double time = 0.0, variance = 0.0;
        for (uint32_t i = 0; i < glint_plan_decision_count(plan); i++) {
            const glint_decision *d = glint_plan_decision(plan, i);
            time += (double)d->time_share;
            variance += (double)d->error * (double)d->error;
            assert_true(d->choice[0] != '\0' && d->reason[0] != '\0');
            assert_true(d->is_on || d->ns_per_sample == 0.0F);
        }
        assert_true(fabs(time - 1.0) < 1e-4);
        assert_true(fabs(sqrt(variance) - (double)out.error) < 1e-5);
        if (!((double)out.error <= (double)s.summary.error_budget * (1.0 + 1e-6)))
            fail_msg("error %g, budget %g", (double)out.error, (double)s.summary.error_budget);
        /* Root sum of squares, and not met where it is too much. */
        const double both = hypot((double)out.error, (double)out.noise), budget = (double)s.summary.error_budget;
        assert_true(fabs(both - budget) < 1e-5 * budget || out.is_met == (both <= budget));
        glint_plan_destroy(plan);
    }
}

static void impossible_summaries_are_refused_by_name(void **state)
{
    (void)state;
    small_scene s;
    glint_plan *plan;
    char message[256];
    fill(&s, 1.0F, 16);
    s.summary.error_budget = (float)NAN;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_null(plan);
    assert_non_null(strstr(message, "error_budget"));
    fill(&s, 1.0F, 16);
    s.pair.light = 1;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_string_equal(message, "pairs[0].light is 1, expected less than 1");
    fill(&s, 1.0F, 16);
    s.summary.size = 4;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_non_null(strstr(message, "GLINT_PLAN_SUMMARY_INIT"));
    fill(&s, 1.0F, 16);
    s.summary.most_samples = 8;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_non_null(strstr(message, "most_samples is 8"));
    fill(&s, 1.0F, 16);
    s.summary.noise_fall = 0.5F;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_RANGE);
    assert_non_null(strstr(message, "noise_fall"));
    fill(&s, 1.0F, 16);
    s.material.base = NULL;
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_plan_create(NULL, &plan, message, sizeof message), GLINT_ERROR_ARGUMENT);
    assert_int_equal(glint_plan_create(&s.summary, NULL, NULL, 0), GLINT_ERROR_ARGUMENT);
}

static void *refuse(size_t byte_count, void *user)
{
    (void)byte_count;
    (void)user;
    return NULL;
}

static void release(void *memory, void *user)
{
    (void)user;
    free(memory);
}

static void no_memory_is_said(void **state)
{
    (void)state;
    small_scene s;
    glint_plan *plan;
    char message[256];
    fill(&s, 1.0F, 16);
    s.summary.allocator = (glint_allocator){ refuse, release, NULL };
    assert_int_equal(glint_plan_create(&s.summary, &plan, message, sizeof message), GLINT_ERROR_MEMORY);
    assert_null(plan);
    glint_plan_destroy(NULL);
}

/* ---- the models obey ---- */

enum { SEEDS = 4000 };

/* Values over seeds at a footprint of N facets, of which p are lit. */
static void evaluate(const glint_material *m, double n, int i, uint32_t draw, glint_value *value)
{
    static const float wo[3] = { 0.0F, 0.0F, 1.0F }, wi[3] = { 0.0995037F, 0.0F, 0.995037F };
    const float side = (float)sqrt(n / 1e8);
    const glint_footprint f = { .u = 0.01 * i, .v = 0.37 * i, .dudx = side, .dvdy = side, .draw = draw };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    glint_eval_value(m, NULL, &f, wo, wi, &light, value);
}

static glint_material *material_with(glint_model model, float smooth_deviation, float draw_deviation)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    glint_material *m;
    o.model = model;
    o.smooth_deviation = smooth_deviation;
    o.draw_deviation = draw_deviation;
    assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_OK);
    return m;
}

/* A model, the facets of a footprint that are tried, and how much its values vary over 1 / (N p) at most. */
typedef struct fading {
    glint_model model;
    int seeds;
    double first, last, step, variance;
    double bias; /* of the smooth value, at most */
} fading;

/* How far a value is off without what is left out, and the share of the count that shows. */
static double compare_at(const fading *c, double n, const glint_material *all, const glint_material *less, moments *off)
{
    double shown = 0.0;
    for (int i = 0; i < c->seeds; i++) {
        glint_value a, b;
        evaluate(all, n, i, 0U, &a);
        evaluate(less, n, i, 0U, &b);
        moments_add(off, ((double)b.rgb[0] - (double)a.rgb[0]) / (double)a.smooth[0]);
        const double counted = (double)a.rgb[0] - (double)a.smooth[0];
        if (fabs(counted) > 1e-3 * (double)a.smooth[0])
            shown = ((double)b.rgb[0] - (double)b.smooth[0]) / counted;
        assert_true(a.facet_count == b.facet_count && a.lit_probability == b.lit_probability);
    }
    return shown;
}

/* What is left out has the mean zero and never varies by more than the limit, from counting all to counting nothing. */
static void fade_out(const fading *c)
{
    const float limit = 0.1F;
    glint_material *all = material_with(c->model, 0.0F, 0.0F), *less = material_with(c->model, limit, 0.0F);
    double before = 1.0;
    assert_true(c->seeds >= 200);
    for (double n = c->first; n < c->last; n *= c->step) {
        moments off = { 0 };
        const double shown = compare_at(c, n, all, less, &off), deviation = sqrt(moments_variance(&off));
        /* So many samples know a deviation to 1 / sqrt(2 seeds). */
        const double most = (double)limit * sqrt(c->variance) * (1.0 + 4.5 / sqrt(2.0 * c->seeds));
        printf("%s, N %6.0f: %3.0f %% of the count shows; what is left out varies by %.4f, mean %.5f\n",
               glint_model_name(c->model), n, 100.0 * fabs(shown), deviation, off.mean);
        if (!(deviation <= most))
            fail_msg("it varies by %g, expected at most %g", deviation, most);
        if (!(fabs(off.mean) < 4.5 * moments_standard_error(&off) + c->bias + 1e-6))
            fail_msg("its mean is %g, %g sigmas from 0", off.mean, off.mean / moments_standard_error(&off));
        /* No seam: a quarter more facets never take more than a third of the count away. */
        assert_true(shown <= before + 1e-4 && shown >= before - 0.34 * log(c->step) / log(1.25));
        before = shown;
    }
    assert_true(fabs(before) < 1e-4);
    glint_material_destroy(all);
    glint_material_destroy(less);
}

/* Counting varies by half of 1 / (N p) in a footprint by itself; explicit by all of it, and knows all of the light, of
 * which the smooth value takes the middle: a cap of .02 sr turns half vectors by up to .04, and GGX falls by
 * (.04 / alpha)^2 in the mean over a disc around its top. */
static void what_fades_never_varies_by_more_than_its_limit(void **state)
{
    (void)state;
    static const fading cases[] = {
        { GLINT_MODEL_COUNTING, SEEDS, 100.0, 3e4, 1.25, 0.5, 0.0 },
        { GLINT_MODEL_DICTIONARY, 1000, 300.0, 1e5, 1.25, 1.0, 0.0 },
        { GLINT_MODEL_EXPLICIT, 300, 500.0, 15000.0, 1.5, 1.0, 0.0255 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        fade_out(&cases[i]);
}

/* The explicit model visits no facet where none shows, however many there are. */
static void facets_that_do_not_show_are_not_visited(void **state)
{
    (void)state;
    glint_material *all = material_with(GLINT_MODEL_EXPLICIT, 0.0F, 0.0F),
                   *less = material_with(GLINT_MODEL_EXPLICIT, 0.1F, 0.0F);
    glint_value a, b;
    evaluate(all, 1e8, 0, 0U, &a);
    evaluate(less, 1e8, 0, 0U, &b);
    assert_true(a.over_limit && !b.over_limit);
    assert_true(b.rgb[0] == b.smooth[0] && b.smooth[0] == a.smooth[0]);
    glint_material_destroy(all);
    glint_material_destroy(less);
}

/* Draws of single realisations have the mean of the whole value, and no more noise than was allowed. */
static void draws_vary_by_no_more_than_they_may(void **state)
{
    (void)state;
    const float limit = 1.0F;
    glint_material *all = material_with(GLINT_MODEL_COUNTING, 0.0F, 0.0F),
                   *drawn = material_with(GLINT_MODEL_COUNTING, 0.0F, limit);
    uint64_t random = 9;
    int differ = 0;
    for (double n = 10.0; n < 3e4; n *= 2.0) {
        moments off = { 0 };
        for (int i = 0; i < SEEDS; i++) {
            glint_value a, b;
            evaluate(all, n, i, 0U, &a);
            evaluate(drawn, n, i, (uint32_t)random_bits(&random), &b);
            moments_add(&off, ((double)b.rgb[0] - (double)a.rgb[0]) / (double)a.smooth[0]);
        }
        const double deviation = sqrt(moments_variance(&off));
        printf("N %8.0f: draws vary by %.4f\n", n, deviation);
        differ += deviation > 0.0;
        assert_true(deviation <= (double)limit * 1.05);
        assert_true(fabs(off.mean) < 4.5 * moments_standard_error(&off) + 1e-6);
    }
    assert_true(differ > 5);
    glint_material_destroy(all);
    glint_material_destroy(drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_are_powers_of_two),
        cmocka_unit_test(few_facets_are_counted_and_many_are_smooth),
        cmocka_unit_test(many_samples_allow_single_draws),
        cmocka_unit_test(fewest_samples_are_taken_whose_noise_is_within_the_budget),
        cmocka_unit_test(cheapest_number_of_samples_is_taken),
        cmocka_unit_test(fit_stands_for_a_shape_unless_it_turns_few_facets_on_and_off),
        cmocka_unit_test(cap_stands_for_a_shape_where_the_budget_allows_it),
        cmocka_unit_test(nothing_is_left_out_without_a_budget),
        cmocka_unit_test(shadows_stay_whatever_a_survey_has_not_seen),
        cmocka_unit_test(errors_stay_within_the_budget),
        cmocka_unit_test(impossible_summaries_are_refused_by_name),
        cmocka_unit_test(no_memory_is_said),
        cmocka_unit_test(what_fades_never_varies_by_more_than_its_limit),
        cmocka_unit_test(facets_that_do_not_show_are_not_visited),
        cmocka_unit_test(draws_vary_by_no_more_than_they_may),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
