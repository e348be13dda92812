/* Facets of different colours, in every model that has them. */
#include "configurations.h"

#include <string.h>

/* ---- what was there before there were colours ---- */

/* By operations that IEEE 754 fixes, unlike random_direction: the same on every machine. */
static void exact_direction(uint64_t *random, float v[3])
{
    double w[3], length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        w[k] = k < 2 ? random_between(random, -0.8, 0.8) : random_between(random, 0.3, 1.0);
        length2 += w[k] * w[k];
    }
    for (int k = 0; k < 3; k++)
        v[k] = (float)(w[k] / sqrt(length2));
}

static glint_footprint exact_footprint(uint64_t *random)
{
    const double size = ldexp(random_between(random, 1.0, 2.0), -(int)(random_bits(random) % 9) - 7);
    const double other = size * random_between(random, 0.1, 1.0), skew = random_between(random, -0.5, 0.5);
    return (glint_footprint){ .u = random_between(random, -10.0, 10.0),
                              .v = random_between(random, -10.0, 10.0),
                              .dudx = (float)size,
                              .dudy = (float)(-other * skew),
                              .dvdx = (float)(size * skew),
                              .dvdy = (float)other,
                              .seed = (uint32_t)random_bits(random) };
}

/* FNV-1a of the bits of rgb. */
static uint64_t hash_of_values(glint_model model)
{
    enum { EACH = 4000 };
    uint64_t random = 31, hash = 0xcbf29ce484222325U;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        configuration c = configuration_of(model, i);
        c.options.color_variation = 0.0F;
        c.options.color_count = 0;
        glint_material *m = create(&c.options);
        for (int k = 0; k < EACH; k++) {
            float wo[3], wi[3], rgb[3];
            exact_direction(&random, wo);
            exact_direction(&random, wi);
            const glint_footprint f = exact_footprint(&random);
            const glint_light light = { GLINT_LIGHT_CAP, ldexpf(1.0F, -(int)(random_bits(&random) % 16)) };
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            for (int n = 0; n < 3; n++) {
                uint32_t bits;
                memcpy(&bits, &rgb[n], sizeof(bits));
                hash = (hash ^ bits) * 0x100000001b3U;
            }
        }
        glint_material_destroy(m);
    }
    return hash;
}

/* 32000 values of each model, by a library in which counting and explicit have no colours yet. A change that is meant
 * to give other values writes down what this prints. */
static void values_without_colors_keep_their_bits(void **state)
{
    (void)state;
    static const struct {
        glint_model model;
        uint64_t hash;
    } before[] = { { GLINT_MODEL_COUNTING, 0xc12bbe9f0848bbddU },
                   { GLINT_MODEL_EXPLICIT, 0xd003affc5622a892U },
                   { GLINT_MODEL_DICTIONARY, 0xbaf16a32f0cd5673U },
                   { GLINT_MODEL_EXAMPLE, 0x1499953a38eaf5a8U } };
    int failed = 0;
    for (size_t i = 0; i < sizeof(before) / sizeof(before[0]); i++) {
        const uint64_t hash = hash_of_values(before[i].model);
        if (hash != before[i].hash) {
            printf("%s: %#llx, expected %#llx\n", glint_model_name(before[i].model), (unsigned long long)hash,
                   (unsigned long long)before[i].hash);
            failed++;
        }
    }
    assert_int_equal(failed, 0);
}

/* ---- the mean ---- */

/* Palettes: a table, a hue, both, and a table whose green and blue are black but for one color. */
enum { PALETTES = 4 };

/* Of its own: a layered material leaves colours to its layers. */
static int shows_colors(glint_model model)
{
    const uint32_t wanted = GLINT_FEATURE_COLOR | GLINT_FEATURE_DISCRETE;
    return (glint_model_features(model) & wanted) == wanted && model != GLINT_MODEL_LAYERED;
}

static void set_palette(glint_material_options *o, int palette)
{
    static const float table[3][3] = { { 0.9F, 0.1F, 0.2F }, { 0.3F, 0.8F, 0.0F }, { 0.1F, 0.2F, 1.0F } };
    o->color_variation = palette == 1 ? 1.0F : palette == 2 ? 0.6F : 0.0F;
    o->color_count = palette == 0 || palette == 2 ? 3U : palette == 3 ? 8U : 0U;
    for (uint32_t i = 0; i < o->color_count; i++)
        for (int c = 0; c < 3; c++)
            o->colors[i][c] = palette == 3 ? (float)(c == 0 || i == 5) : table[i][c];
}

/* The solid angle with which this share of the facets is lit. */
static float solid_angle_for(const glint_material *m, const float wo[3], const float wi[3], double share)
{
    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const glint_light probe = { GLINT_LIGHT_CAP, 1e-5F };
    glint_value v;
    glint_eval_value(m, NULL, &f, wo, wi, &probe, &v);
    return v.lit_probability > 0.0F ? (float)fmin(1e-5 * share / (double)v.lit_probability, 1.0) : 1e-5F;
}

typedef struct difference {
    moments channel[3]; /* tinted less plain, over the smooth value */
    double colorful;    /* mean size of it */
} difference;

/* The same facets with colours and without, at random places of random seeds. */
static difference difference_of(const glint_material_options *options, double facets, double lit, int count,
                                uint64_t *random)
{
    glint_material_options o = *options;
    o.surface.facets_per_m2 = (float)(facets / 1e-6);
    glint_material *tinted = create(&o);
    o.color_variation = 0.0F;
    o.color_count = 0;
    glint_material *plain = create(&o);
    float wo[3], wi[3];
    direction(0.4, 0.3, wo);
    direction(0.35, 3.3, wi);
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle_for(plain, wo, wi, lit) };
    difference d = { { { 0 } }, 0.0 };
    for (int i = 0; i < count; i++) {
        const glint_footprint f = {
            random_between(random, -10.0, 10.0), random_between(random, -10.0, 10.0), 1e-3F, 3e-4F, 0.0F, 1e-3F,
            (uint32_t)random_bits(random)
        };
        glint_value v, white;
        glint_eval_value(tinted, NULL, &f, wo, wi, &light, &v);
        glint_eval_value(plain, NULL, &f, wo, wi, &light, &white);
        for (int c = 0; c < 3; c++) {
            const double x = (double)(v.rgb[c] - white.rgb[c]) / (double)white.smooth[c];
            moments_add(&d.channel[c], x);
            d.colorful += fabs(x) / count;
        }
    }
    glint_material_destroy(tinted);
    glint_material_destroy(plain);
    return d;
}

/* How many of the three channels' means are off zero: 4.5 sigmas of 700 means are a significance of .005 in all. */
static int off_zero(const difference *d, const char *what)
{
    int failed = 0;
    for (int c = 0; c < 3; c++) {
        const double sigma = moments_standard_error(&d->channel[c]);
        if (fabs(d->channel[c].mean) > 4.5 * sigma + 1e-6) {
            printf("%s, channel %d: tinted - plain %+.3e, expected 0, %+.1f sigma\n", what, c, d->channel[c].mean,
                   d->channel[c].mean / sigma);
            failed++;
        }
    }
    return failed;
}

/* That the mean without colours is the smooth one is shown elsewhere. */
static void mean_tint_is_the_base_color(void **state)
{
    (void)state;
    uint64_t random = 41;
    int failed = 0;
    for (const model_row *row = MODELS; row < MODELS + sizeof(MODELS) / sizeof(MODELS[0]); row++) {
        if (!shows_colors(row->model))
            continue;
        for (int weighting = 0; weighting < 2; weighting++)
            for (int palette = 0; palette < PALETTES; palette++) {
                configuration c = configuration_of(row->model, weighting);
                c.options.weighting = (glint_weighting)weighting;
                set_palette(&c.options, palette);
                for (double n = 0.1; n < 1.1e6 && n < row->most_facets; n *= 1e1) {
                    const int count = row->model == GLINT_MODEL_COUNTING ? 20000 : n < 100.0 ? 3000 : 400;
                    const difference d = difference_of(&c.options, n, 0.1, count, &random);
                    char what[128];
                    snprintf(what, sizeof(what), "%s, %s, palette %d, N %g", glint_model_name(row->model),
                             weighting ? "equal projected area" : "equal area", palette, n);
                    failed += off_zero(&d, what);
                    if (n > 0.5 && n < 50.0 && d.colorful < 0.01) {
                        printf("%s: no colours, %g\n", what, d.colorful);
                        failed++;
                    }
                }
            }
    }
    assert_int_equal(failed, 0);
}

/* A few facets out of very many: neither their number nor how few they are chooses the colour. */
static void mean_tint_holds_for_any_share_of_lit_facets(void **state)
{
    (void)state;
    uint64_t random = 42;
    int failed = 0;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    set_palette(&o, 0);
    for (double p = 1e-9; p < 0.5; p *= 100.0) {
        const difference d = difference_of(&o, 3.0 / p, p, 60000, &random);
        char what[64];
        snprintf(what, sizeof(what), "p %g", p);
        failed += off_zero(&d, what);
        printf("p %g: mean strays by %.2f, in sigmas %+.1f %+.1f %+.1f\n", p, d.colorful,
               d.channel[0].mean / moments_standard_error(&d.channel[0]),
               d.channel[1].mean / moments_standard_error(&d.channel[1]),
               d.channel[2].mean / moments_standard_error(&d.channel[2]));
    }
    assert_int_equal(failed, 0);
}

/* A cell that carries facets or not and one that is red or green are chosen by different bits. */
static void coverage_does_not_choose_the_color(void **state)
{
    (void)state;
    uint64_t random = 43;
    configuration c = configuration_of(GLINT_MODEL_DICTIONARY, 1);
    c.options.coverage = 0.25F;
    set_palette(&c.options, 0);
    const difference d = difference_of(&c.options, 1.0, 0.1, 40000, &random);
    assert_int_equal(off_zero(&d, "dictionary, coverage .25"), 0);
}

/* A channel in which every colour is black stays as the base colour has it. */
static void channel_that_no_color_has_keeps_its_value(void **state)
{
    (void)state;
    uint64_t random = 44;
    for (const model_row *row = MODELS; row < MODELS + sizeof(MODELS) / sizeof(MODELS[0]); row++) {
        if (!shows_colors(row->model))
            continue;
        configuration c = configuration_of(row->model, 0);
        glint_material *plain = create(&c.options);
        c.options.color_count = 2;
        c.options.colors[0][0] = 1.0F;
        c.options.colors[1][0] = 0.2F;
        c.options.colors[0][2] = 0.3F;
        glint_material *tinted = create(&c.options);
        for (int i = 0; i < 2000; i++) {
            float wo[3], wi[3], white[3], rgb[3];
            random_direction(&random, wo);
            random_direction(&random, wi);
            const glint_footprint f = random_footprint(&random);
            const glint_light light = { GLINT_LIGHT_CAP, 0.05F };
            glint_eval(plain, NULL, &f, wo, wi, &light, white);
            glint_eval(tinted, NULL, &f, wo, wi, &light, rgb);
            assert_true(fabsf(rgb[1] - white[1]) <= 1e-6F * white[1]);
        }
        glint_material_destroy(plain);
        glint_material_destroy(tinted);
    }
}

/* ---- a flake and its hue ---- */

/* The brightest channel's share of rgb, and which it is: enough to tell one tint from another. */
static void share_of(const float rgb[3], double share[3])
{
    const double sum = (double)rgb[0] + (double)rgb[1] + (double)rgb[2];
    for (int c = 0; c < 3; c++)
        share[c] = sum > 0.0 ? (double)rgb[c] / sum : 0.0;
}

static double hue_step(const float a[3], const float b[3])
{
    double x[3], y[3], step = 0.0;
    share_of(a, x);
    share_of(b, y);
    for (int c = 0; c < 3; c++)
        step = fmax(step, fabs(x[c] - y[c]));
    return step;
}

/* So few facets are lit that nearly every pixel with light has one: of 48 realisations with 4/9 of the facets, on
 * average 12 * 4/9 * N p = .005 are. As the light turns within its cap and the camera moves by parts of a pixel, that
 * facet fades in and out and its hue stays; other facets, as rare as it, come in on 1 of 100 of the steps. */
static void lit_flake_keeps_its_hue(void **state)
{
    (void)state;
    uint64_t random = 45;
    const double n = 10.0, p = 1e-4, seen = 12.0 * 4.0 / 9.0 * n * p;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.facets_per_m2 = (float)(n / 1e-6);
    o.color_variation = 1.0F;
    glint_material *m = create(&o);
    float wo[3], wi[3];
    direction(0.3, 0.0, wo);
    direction(0.3, 3.0, wi);
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle_for(m, wo, wi, p) };
    const double radius = sqrt((double)light.solid_angle_sr / 3.14159265);
    int lit = 0, steps = 0, changed = 0;
    for (int i = 0; i < 300000; i++) {
        glint_footprint f = { random_between(&random, -10.0, 10.0),
                              random_between(&random, -10.0, 10.0),
                              1e-3F,
                              0.0F,
                              0.0F,
                              1e-3F,
                              (uint32_t)i };
        float first[3];
        glint_eval(m, NULL, &f, wo, wi, &light, first);
        if (!(first[0] + first[1] + first[2] > 0.0F))
            continue;
        lit++;
        const double turn = random_between(&random, 0.0, 6.28), angle = random_between(&random, 0.0, 6.28);
        for (int k = 1; k <= 4; k++) {
            /* Up to a quarter of the cap, and of a pixel. */
            f.u += 1e-3 / 16.0 * cos(turn);
            f.v += 1e-3 / 16.0 * sin(turn);
            float turned[3], rgb[3];
            direction(0.3 + radius / 16.0 * k * cos(angle), 3.0 + radius / 16.0 * k * sin(angle), turned);
            glint_eval(m, NULL, &f, wo, turned, &light, rgb);
            if (!(rgb[0] + rgb[1] + rgb[2] > 0.0F))
                continue;
            steps++;
            changed += hue_step(first, rgb) > 1e-4;
        }
    }
    printf("%d lit pixels, %d steps, hue changed on %.2f %%\n", lit, steps, 100.0 * changed / steps);
    assert_true(lit > 500 && steps > 3 * lit);
    /* A second facet with the first, or at the end of the way: twice; each pixel's steps are one event. */
    const double sigma = sqrt(2.0 * seen / lit);
    assert_true((double)changed / steps < 2.0 * seen + 4.0 * sigma);
    glint_material_destroy(m);
}

/* ---- hard values ---- */

static void hard_values_stay_finite(void **state)
{
    (void)state;
    static const float densities[] = { 0.0F, 1e-6F, 1.0F, 1e6F, 1e12F, 1e18F };
    static const float angles[] = { 1e-30F, 1e-9F, 1e-3F, 1.0F, 6.28F };
    uint64_t random = 46;
    for (const model_row *row = MODELS; row < MODELS + sizeof(MODELS) / sizeof(MODELS[0]); row++)
        for (int palette = 0; palette < PALETTES; palette++) {
            if (!shows_colors(row->model))
                continue;
            configuration c = configuration_of(row->model, 0);
            set_palette(&c.options, palette);
            glint_material *m = create(&c.options);
            for (int i = 0; i < 3000; i++) {
                glint_surface s = glint_material_surface(m);
                s.facets_per_m2 = densities[i % 6];
                s.alpha_x = s.alpha_y = (float)random_log_between(&random, 1e-4, 1.0);
                float wo[3], wi[3];
                random_direction(&random, wo);
                random_direction(&random, wi);
                const glint_footprint f = random_footprint(&random);
                const glint_light light = { GLINT_LIGHT_CAP, angles[i % 5] };
                glint_value v;
                glint_eval_value(m, &s, &f, wo, wi, &light, &v);
                for (int k = 0; k < 3; k++)
                    assert_true(isfinite(v.rgb[k]) && v.rgb[k] >= 0.0F);
                if (s.facets_per_m2 == 0.0F)
                    assert_memory_equal(v.rgb, v.smooth, sizeof(v.rgb));
            }
            glint_material_destroy(m);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_without_colors_keep_their_bits),
        cmocka_unit_test(mean_tint_is_the_base_color),
        cmocka_unit_test(mean_tint_holds_for_any_share_of_lit_facets),
        cmocka_unit_test(coverage_does_not_choose_the_color),
        cmocka_unit_test(channel_that_no_color_has_keeps_its_value),
        cmocka_unit_test(lit_flake_keeps_its_hue),
        cmocka_unit_test(hard_values_stay_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
