/* Facets of different colours, in every model that has them. */
#include "configurations.h"

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
                    /* A tint of one color in eight makes few samples skewed, and their deviations larger than sigmas
                     * say; thirty times as many, new ones, decide. */
                    if (off_zero(&d, what) > 0) {
                        const difference more = difference_of(&c.options, n, 0.1, 30 * count, &random);
                        failed += off_zero(&more, "thirty times as many samples of it");
                    }
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

/* So few facets are lit that nearly every pixel with light has one: of 36 realisations with half of the facets, on
 * average 9 / 2 * N p = .0045 are. As the light turns within its cap and the camera moves by parts of a pixel, that
 * facet fades in and out and its hue stays; other facets, as rare as it, come in on 1 of 100 of the steps. */
static void lit_flake_keeps_its_hue(void **state)
{
    (void)state;
    uint64_t random = 45;
    const double n = 10.0, p = 1e-4, seen = 9.0 / 2.0 * n * p;
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

/* The share of pairs of points, three texels apart on maps of 16 x 16, that show the same tint. */
static double same_tints(uint32_t flat)
{
    static float normals[3 * 16 * 16];
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_ISOTROPIC_NOISE, 16, &shape, 3U, normals), GLINT_OK);
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXAMPLE;
    o.example.normals = normals;
    o.example.flat = flat;
    o.example.side_m = 1.0F;
    o.example.sigma_r = 0.3F;
    glint_material *plain = create(&o);
    o.color_variation = 1.0F;
    glint_material *tinted = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
    int same = 0, count = 0;
    for (uint32_t seed = 0; seed < 400; seed++) {
        float tint[2][3];
        for (int k = 0; k < 2; k++) {
            const glint_footprint f = { 0.5 + k * 3.0 / 16.0, 0.5, 5e-3F, 0.0F, 0.0F, 5e-3F, seed };
            float rgb[3], white[3];
            glint_eval(tinted, NULL, &f, up, up, &light, rgb);
            glint_eval(plain, NULL, &f, up, up, &light, white);
            for (int c = 0; c < 3; c++)
                tint[k][c] = white[c] > 0.0F ? rgb[c] / white[c] : 1.0F;
        }
        count++;
        same += hue_step(tint[0], tint[1]) < 0.01;
    }
    glint_material_destroy(plain);
    glint_material_destroy(tinted);
    return (double)same / count;
}

/* 13 of 16 pairs lie in one map, where a texel blends with its neighbours and a map with the next one in up to one
 * texel's width: 3 of 16 more may differ. Facets of different hues are alike by chance only, some 2 * .01 * 3. */
static void flat_texels_have_tints_of_their_own_and_bumps_one_a_map(void **state)
{
    (void)state;
    const double flat = same_tints(1), bumps = same_tints(0), noise = 4.0 * 0.5 / 20.0;
    printf("same tint three texels away: flat facets %.2f, bumps %.2f of a map\n", flat, bumps);
    assert_true(flat < 0.06 + noise && bumps > 10.0 / 16.0 - noise);
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
        cmocka_unit_test(mean_tint_is_the_base_color),
        cmocka_unit_test(mean_tint_holds_for_any_share_of_lit_facets),
        cmocka_unit_test(coverage_does_not_choose_the_color),
        cmocka_unit_test(channel_that_no_color_has_keeps_its_value),
        cmocka_unit_test(lit_flake_keeps_its_hue),
        cmocka_unit_test(flat_texels_have_tints_of_their_own_and_bumps_one_a_map),
        cmocka_unit_test(hard_values_stay_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
