/* The layered model against its layers: each evaluated by itself, in its own frame, and put together in double
 * precision; and its limits, bit for bit. */
#include "configurations.h"

#include <string.h>

static const glint_model SINGLE[] = { GLINT_MODEL_SMOOTH, GLINT_MODEL_COUNTING, GLINT_MODEL_EXPLICIT,
                                      GLINT_MODEL_DICTIONARY, GLINT_MODEL_EXAMPLE };
enum { SINGLE_COUNT = sizeof(SINGLE) / sizeof(SINGLE[0]), POINTS = 2000 };

static glint_material *create_layered(const glint_material_options *base, const glint_material_options *coat,
                                      float weight)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_LAYERED;
    o.layers.base = base;
    o.layers.coat = coat;
    o.layers.coat_weight = weight;
    return create(&o);
}

static void assert_same_value(const glint_value *a, const glint_value *b)
{
    assert_memory_equal(a->rgb, b->rgb, sizeof(a->rgb));
    assert_memory_equal(a->smooth, b->smooth, sizeof(a->smooth));
    assert_memory_equal(&a->facet_count, &b->facet_count, sizeof(float));
    assert_memory_equal(&a->lit_probability, &b->lit_probability, sizeof(float));
    assert_int_equal(a->over_limit, b->over_limit);
}

/* At random points under random lights, seen and lit from anywhere above. */
static void assert_same_values(const glint_material *a, const glint_material *b, uint64_t *random)
{
    for (int i = 0; i < POINTS; i++) {
        float wo[3], wi[3];
        random_direction(random, wo);
        random_direction(random, wi);
        const glint_footprint f = random_footprint(random);
        const glint_light light = { GLINT_LIGHT_CAP, (float)random_log_between(random, 1e-6, 1.0) };
        glint_value va, vb;
        glint_eval_value(a, NULL, &f, wo, wi, &light, &va);
        glint_eval_value(b, NULL, &f, wo, wi, &light, &vb);
        assert_same_value(&va, &vb);
    }
}

static void without_a_coat_there_is_the_base_alone(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int k = 0; k < SINGLE_COUNT; k++) {
        const configuration c = configuration_of(SINGLE[k], 5), d = configuration_of(SINGLE[(k + 1) % SINGLE_COUNT], 0);
        glint_material *base = create(&c.options), *both = create_layered(&c.options, &d.options, 0.0F);
        assert_same_values(base, both, &random);
        for (int i = 0; i < POINTS; i++) {
            float wo[3];
            random_direction(&random, wo);
            const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                 (float)random_uniform(&random) };
            glint_sample a, b;
            assert_int_equal(glint_sample_direction(base, NULL, NULL, wo, u, &a),
                             glint_sample_direction(both, NULL, NULL, wo, u, &b));
            assert_memory_equal(&a, &b, sizeof(a));
            float through[3];
            glint_transmittance(both, NULL, wo, i % 2 ? wo : NULL, through);
            assert_true(through[0] == 1.0F && through[1] == 1.0F && through[2] == 1.0F);
        }
        glint_material_destroy(base);
        glint_material_destroy(both);
    }
}

static void over_a_black_base_there_is_the_coat_alone(void **state)
{
    (void)state;
    uint64_t random = 2;
    glint_material_options black = GLINT_MATERIAL_OPTIONS_INIT;
    black.model = GLINT_MODEL_SMOOTH;
    memset(black.surface.f0, 0, sizeof(black.surface.f0));
    memset(black.surface.f90, 0, sizeof(black.surface.f90));
    for (int k = 0; k < SINGLE_COUNT; k++) {
        const configuration c = configuration_of(SINGLE[k], 5);
        glint_material *coat = create(&c.options), *both = create_layered(&black, &c.options, 1.0F);
        assert_same_values(coat, both, &random);
        glint_material_destroy(coat);
        glint_material_destroy(both);
    }
}

/* ---- Eq. 10, written out ---- */

typedef struct frame {
    double x[3], y[3], z[3];
} frame;

static double dot(const double a[3], const float b[3])
{
    return a[0] * (double)b[0] + a[1] * (double)b[1] + a[2] * (double)b[2];
}

static frame frame_of(const glint_coat *c)
{
    frame f;
    double along = 0.0, length = 0.0;
    for (int k = 0; k < 3; k++) {
        f.z[k] = (double)c->normal[k];
        along += (double)c->tangent[k] * f.z[k];
    }
    for (int k = 0; k < 3; k++)
        f.x[k] = (double)c->tangent[k] - along * f.z[k];
    for (int k = 0; k < 3; k++)
        length += f.x[k] * f.x[k];
    for (int k = 0; k < 3; k++)
        f.x[k] /= sqrt(length);
    f.y[0] = f.z[1] * f.x[2] - f.z[2] * f.x[1];
    f.y[1] = f.z[2] * f.x[0] - f.z[0] * f.x[2];
    f.y[2] = f.z[0] * f.x[1] - f.z[1] * f.x[0];
    return f;
}

static void to_frame(const frame *f, const float v[3], float local[3])
{
    local[0] = (float)dot(f->x, v);
    local[1] = (float)dot(f->y, v);
    local[2] = (float)dot(f->z, v);
}

/* t of a Schlick coat without diffuse light: 1 - F at the cosine times 1 - min(.8 alpha, .16). */
static double let_through(const glint_surface *s, double coverage, int channel, double cosine)
{
    const double alpha = fmax((double)s->alpha_x, (double)s->alpha_y);
    const double slanted = fmax(cosine, 0.0) * (1.0 - fmin(0.8 * alpha, 0.16));
    const double f0 = (double)s->f0[channel], f90 = (double)s->f90[channel];
    return 1.0 - coverage * fmax(f0 + (f90 - f0) * pow(1.0 - slanted, 5.0), f0);
}

static glint_coat bent_coat(const glint_material *layered, double tilt, uint64_t *random)
{
    glint_coat c = *glint_material_surface(layered).coat;
    direction(tilt, random_between(random, 0.0, 6.28), c.normal);
    direction(1.2, random_between(random, 0.0, 6.28), c.tangent);
    c.weight = (float)random_between(random, 0.1, 1.0);
    c.surface.alpha_x = (float)random_log_between(random, 0.01, 1.0);
    c.surface.alpha_y = (float)random_log_between(random, 0.01, 1.0);
    c.surface.facets_per_m2 = (float)random_log_between(random, 1e3, 1e9);
    for (int k = 0; k < 3; k++) {
        c.surface.f0[k] = (float)random_uniform(random);
        c.surface.f90[k] = (float)random_uniform(random);
    }
    return c;
}

/* Each layer by itself, its surface given by the call. */
static void the_sum_is_that_of_the_paper(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int k = 0; k < SINGLE_COUNT; k++) {
        const configuration b = configuration_of(SINGLE[k], 5), d = configuration_of(SINGLE[(k + 3) % SINGLE_COUNT], 4);
        glint_material_options co = d.options;
        co.coverage = 0.8F;
        if (co.model == GLINT_MODEL_EXAMPLE)
            co.model = GLINT_MODEL_COUNTING; /* what lets light through is measured: test_layered_energy.c */
        glint_material *base = create(&b.options), *coat = create(&co), *both = create_layered(&b.options, &co, 1.0F);
        for (int i = 0; i < POINTS; i++) {
            float wo[3], wi[3], wo_coat[3], wi_coat[3];
            random_direction(&random, wo);
            random_direction(&random, wi);
            const glint_footprint f = random_footprint(&random), g = random_footprint(&random);
            const glint_light light = { GLINT_LIGHT_CAP, (float)random_log_between(&random, 1e-5, 0.1) };
            glint_coat c = bent_coat(both, i % 3 ? 0.5 : 0.0, &random);
            c.footprint = i % 2 ? &g : NULL;
            glint_surface s = glint_material_surface(both);
            s.coat = &c;
            const frame at = frame_of(&c);
            to_frame(&at, wo, wo_coat);
            to_frame(&at, wi, wi_coat);
            glint_value vb, vc, v;
            glint_eval_value(base, NULL, &f, wo, wi, &light, &vb);
            glint_eval_value(coat, &c.surface, i % 2 ? &g : &f, wo_coat, wi_coat, &light, &vc);
            glint_eval_value(both, &s, &f, wo, wi, &light, &v);
            float through[3], left[3], in_its_frame[3];
            glint_coat upright = c;
            memcpy(upright.normal, glint_material_surface(both).coat->normal, sizeof(upright.normal));
            glint_transmittance(both, &c, wo, NULL, through);
            glint_transmittance(both, &c, wo, wi, left);
            glint_transmittance(both, &upright, wo_coat, wi_coat, in_its_frame);
            for (int n = 0; n < 3; n++) {
                const double to = let_through(&c.surface, 0.8, n, (double)wo_coat[2]);
                const double ti = let_through(&c.surface, 0.8, n, (double)wi_coat[2]);
                const double t = fmin(fmin(to, ti), to * ti / let_through(&c.surface, 0.8, n, 1.0));
                const double w = (double)c.weight, kept = 1.0 - w * (1.0 - t);
                const double rgb = kept * (double)vb.rgb[n] + w * (double)vc.rgb[n];
                const double smooth = kept * (double)vb.smooth[n] + w * (double)vc.smooth[n];
                /* The frame of the coat is rounded, and a glossy lobe of alpha .01 makes a hundred of each rounding. */
                assert_true(fabs((double)v.smooth[n] - smooth) <= 1e-4 * smooth + 1e-7);
                assert_true(fabs((double)through[n] - (1.0 - w * (1.0 - to))) < 1e-6);
                assert_true(fabs((double)left[n] - kept) < 1e-5 && fabs((double)in_its_frame[n] - kept) < 1e-5);
                if (co.model == GLINT_MODEL_SMOOTH)
                    assert_true(fabs((double)v.rgb[n] - rgb) <= 1e-4 * rgb + 1e-7);
            }
        }
        glint_material_destroy(base);
        glint_material_destroy(coat);
        glint_material_destroy(both);
    }
}

/* ---- lights of real size ---- */

/* A parallelogram somewhere above, turned to the origin or away. */
static glint_area_light random_rectangle(uint64_t *random)
{
    glint_area_light l = { .kind = GLINT_AREA_RECTANGLE, .two_sided = 1U };
    float towards[3];
    random_direction(random, towards);
    for (int k = 0; k < 3; k++) {
        l.center[k] = 2.0F * towards[k];
        l.half_x[k] = (float)random_between(random, -0.3, 0.3);
        l.half_y[k] = (float)random_between(random, -0.3, 0.3);
    }
    return l;
}

static glint_area_light turned(const frame *f, const glint_area_light *from)
{
    glint_area_light l = *from;
    to_frame(f, from->center, l.center);
    to_frame(f, from->half_x, l.half_x);
    to_frame(f, from->half_y, l.half_y);
    return l;
}

static void upright(glint_coat *c)
{
    const glint_coat up = GLINT_COAT_INIT;
    memcpy(c->normal, up.normal, sizeof(up.normal));
    memcpy(c->tangent, up.tangent, sizeof(up.tangent));
}

/* What is left of the base lies between what the coat leaves for the directions of single points of the light. */
static void assert_between_points(const glint_material *both, const glint_coat *c, const float wo[3],
                                  const glint_area_light *l, int channel, double kept)
{
    double least = 1.0, most = 0.0;
    for (int i = 0; i < 21 * 21; i++) {
        float wi[3], through[3];
        double length = 0.0;
        for (int k = 0; k < 3; k++) {
            wi[k] = l->center[k] + l->half_x[k] * ((float)(i % 21) / 10.0F - 1.0F) +
                    l->half_y[k] * ((float)(i / 21) / 10.0F - 1.0F);
            length += (double)(wi[k] * wi[k]);
        }
        for (int k = 0; k < 3; k++)
            wi[k] = (float)((double)wi[k] / sqrt(length));
        glint_transmittance(both, c, wo, wi, through);
        least = fmin(least, (double)through[channel]);
        most = fmax(most, (double)through[channel]);
    }
    if (!(kept >= least - 1e-4 && kept <= most + 1e-4))
        fail_msg("%.6f of the base is left, expected %.6f to %.6f", kept, least, most);
}

static void area_lights_are_those_of_the_layers(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (int k = 0; k < SINGLE_COUNT; k++) {
        const configuration b = configuration_of(SINGLE[k], 5), d = configuration_of(SINGLE[(k + 3) % SINGLE_COUNT], 4);
        glint_material *base = create(&b.options), *coat = create(&d.options),
                       *both = create_layered(&b.options, &d.options, 1.0F);
        /* These look at points of the light, others in another frame. */
        const int is_drawn = d.options.model == GLINT_MODEL_DICTIONARY || d.options.model == GLINT_MODEL_EXAMPLE;
        for (int i = 0; i < 100; i++) {
            float wo[3], wo_coat[3];
            random_direction(&random, wo);
            const glint_area_light light = random_rectangle(&random);
            glint_coat c = bent_coat(both, i % 3 ? 0.3 : 0.0, &random);
            if (is_drawn)
                upright(&c);
            glint_surface s = glint_material_surface(both);
            s.coat = &c;
            const frame at = frame_of(&c);
            to_frame(&at, wo, wo_coat);
            const glint_area_light from_coat = turned(&at, &light);
            glint_value vb, vc, v;
            glint_eval_area(base, NULL, NULL, wo, &light, &vb);
            glint_eval_area(coat, &c.surface, NULL, wo_coat, &from_coat, &vc);
            glint_eval_area(both, &s, NULL, wo, &light, &v);
            /* Integrals are good to 1e-5 or so; where the coat outshines the base nothing can be said of the base. */
            if (!(vb.smooth[1] > 0.1F * v.smooth[1]))
                continue;
            const double coats = (double)c.weight * (double)vc.smooth[1];
            assert_between_points(both, &c, wo, &light, 1, ((double)v.smooth[1] - coats) / (double)vb.smooth[1]);
        }
        glint_material_destroy(base);
        glint_material_destroy(coat);
        glint_material_destroy(both);
    }
}

/* With one normal for both the frames have the same bits, and so has what is counted. */
static void facets_of_both_layers_are_counted(void **state)
{
    (void)state;
    uint64_t random = 4;
    glint_material_options o[2] = { GLINT_MATERIAL_OPTIONS_INIT, GLINT_MATERIAL_OPTIONS_INIT };
    o[1].seed = 1U;
    o[1].surface.facets_per_m2 = 3e7F;
    memset(o[1].surface.f0, 0, sizeof(o[1].surface.f0));
    glint_material *base = create(&o[0]), *coat = create(&o[1]), *both = create_layered(&o[0], &o[1], 0.25F);
    for (int i = 0; i < POINTS; i++) {
        float wo[3], wi[3];
        random_direction(&random, wo);
        random_direction(&random, wi);
        const glint_footprint f = random_footprint(&random);
        const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
        glint_value b, c, v;
        glint_eval_value(base, NULL, &f, wo, wi, &light, &b);
        glint_eval_value(coat, NULL, &f, wo, wi, &light, &c);
        glint_eval_value(both, NULL, &f, wo, wi, &light, &v);
        const double n = (double)b.facet_count + (double)c.facet_count;
        const double lit = (double)(b.facet_count * b.lit_probability) + (double)(c.facet_count * c.lit_probability);
        assert_true(fabs((double)v.facet_count - n) <= 1e-6 * n);
        assert_true(fabs((double)(v.facet_count * v.lit_probability) - lit) <= 1e-6 * lit);
        assert_true((double)v.rgb[0] >= 0.25 * (double)c.rgb[0] * (1.0 - 1e-6));
    }
    glint_material_destroy(base);
    glint_material_destroy(coat);
    glint_material_destroy(both);
}

/* ---- horizons ---- */

static void each_layer_has_a_horizon_of_its_own(void **state)
{
    (void)state;
    const configuration c = configuration_of(GLINT_MODEL_LAYERED, 0);
    glint_material *m = create(&c.options);
    glint_surface s = glint_material_surface(m);
    glint_coat coat = *s.coat;
    s.coat = &coat;
    direction(0.5, 0.0, coat.normal); /* leans to +x */
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    float low[3], high[3], nadir[3] = { 0.0F, 0.0F, -1.0F }, rgb[3];
    direction(1.8, 0.0, low);                    /* below the base, 1.3 rad from the coat's normal */
    direction(1.3, 3.14159265, high);            /* above the base, 1.8 rad from the coat's normal */
    glint_eval(m, &s, NULL, up, low, NULL, rgb); /* the coat alone */
    assert_true(rgb[0] > 0.0F && rgb[1] > 0.0F);
    glint_eval(m, &s, NULL, low, up, NULL, rgb);
    assert_true(rgb[0] > 0.0F && rgb[1] > 0.0F);
    glint_eval(m, &s, NULL, up, nadir, NULL, rgb);
    assert_true(rgb[0] == 0.0F && rgb[1] == 0.0F && rgb[2] == 0.0F);
    assert_true(glint_pdf(m, &s, NULL, up, low) > 0.0F && glint_pdf(m, &s, NULL, up, nadir) == 0.0F);
    /* No light enters from below the coat when it reflects all at grazing angles; half of it, half covered. */
    glint_eval(m, &s, NULL, up, high, NULL, rgb);
    assert_true(rgb[0] < 1e-6F);
    coat.weight = 0.5F;
    float bare[3];
    glint_eval(m, &s, NULL, up, high, NULL, rgb);
    coat.weight = 0.0F;
    glint_eval(m, &s, NULL, up, high, NULL, bare);
    assert_true(bare[0] > 0.0F && fabs((double)(rgb[0] / bare[0]) - 0.5) < 1e-5);
    glint_material_destroy(m);
}

static void a_coat_without_a_direction_shows_nothing(void **state)
{
    (void)state;
    const configuration c = configuration_of(GLINT_MODEL_LAYERED, 1);
    glint_material *m = create(&c.options);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    static const float bad[][3] = { { 0, 0, 0 }, { 0, 0, 3 }, { NAN, 0, 1 }, { INFINITY, 0, 0 } };
    for (int i = 0; i < 8; i++) {
        glint_surface s = glint_material_surface(m);
        glint_coat coat = *s.coat;
        s.coat = &coat;
        memcpy(i < 4 ? coat.normal : coat.tangent, bad[i % 4], sizeof(bad[0]));
        float rgb[3];
        glint_eval(m, &s, NULL, up, up, NULL, rgb);
        assert_true(rgb[0] == 0.0F && rgb[1] == 0.0F && rgb[2] == 0.0F);
        glint_transmittance(m, &coat, up, NULL, rgb);
        assert_true(rgb[0] == 0.0F && rgb[1] == 0.0F && rgb[2] == 0.0F);
    }
    /* A tangent along the normal is no mistake where the coat is round. */
    glint_surface s = glint_material_surface(m);
    glint_coat coat = *s.coat;
    memcpy(coat.tangent, coat.normal, sizeof(coat.tangent));
    float rgb[3], round[3];
    glint_eval(m, &s, NULL, up, up, NULL, round);
    s.coat = &coat;
    glint_eval(m, &s, NULL, up, up, NULL, rgb);
    assert_memory_equal(rgb, round, sizeof(rgb));
    glint_material_destroy(m);
}

/* ---- what comes from where ---- */

static void a_coat_that_a_call_brings_is_as_one_of_the_options(void **state)
{
    (void)state;
    uint64_t random = 5;
    const configuration c = configuration_of(GLINT_MODEL_LAYERED, 4), d = configuration_of(GLINT_MODEL_LAYERED, 4);
    glint_material_options changed = *c.options.layers.coat, o = d.options;
    changed.surface.alpha_x = 0.5F;
    changed.surface.f0[1] = 0.3F;
    changed.surface.facets_per_m2 = 1e6F;
    o.layers.coat = &changed;
    o.layers.coat_weight = 0.3F;
    direction(0.2, 1.0, o.layers.coat_normal);
    direction(1.5, 2.0, o.layers.coat_tangent);
    glint_material *plain = create(&c.options), *other = create(&o);
    glint_surface s = glint_material_surface(plain);
    glint_coat coat = GLINT_COAT_INIT;
    coat.surface = changed.surface;
    coat.weight = 0.3F;
    memcpy(coat.normal, o.layers.coat_normal, sizeof(coat.normal));
    memcpy(coat.tangent, o.layers.coat_tangent, sizeof(coat.tangent));
    s.coat = &coat;
    for (int i = 0; i < POINTS; i++) {
        float wo[3], wi[3];
        random_direction(&random, wo);
        random_direction(&random, wi);
        const glint_footprint f = random_footprint(&random);
        const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
        glint_value a, b;
        glint_eval_value(plain, &s, &f, wo, wi, &light, &a);
        glint_eval_value(other, NULL, &f, wo, wi, &light, &b);
        assert_same_value(&a, &b);
    }
    glint_material_destroy(plain);
    glint_material_destroy(other);
}

static void features_are_those_of_the_layers(void **state)
{
    (void)state;
    const uint32_t seen = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_SAMPLE_FOOTPRINT;
    const uint32_t expected[CONFIGURATIONS] = { 0,
                                                GLINT_FEATURE_DISCRETE,
                                                GLINT_FEATURE_DISCRETE,
                                                GLINT_FEATURE_DISCRETE,
                                                GLINT_FEATURE_DISCRETE,
                                                GLINT_FEATURE_DISCRETE,
                                                GLINT_FEATURE_DISCRETE,
                                                seen };
    for (int i = 0; i < CONFIGURATIONS; i++) {
        const configuration c = configuration_of(GLINT_MODEL_LAYERED, i);
        glint_material *m = create(&c.options);
        assert_int_equal(glint_material_features(m) & seen, expected[i]);
        assert_true(glint_material_features(m) & GLINT_FEATURE_SAMPLE);
        assert_int_equal(glint_material_model(m), GLINT_MODEL_LAYERED);
        assert_int_equal(glint_material_model(glint_material_layer(m, GLINT_LAYER_BASE)), c.options.layers.base->model);
        assert_int_equal(glint_material_model(glint_material_layer(m, GLINT_LAYER_COAT)), c.options.layers.coat->model);
        assert_null(glint_material_layer(glint_material_layer(m, GLINT_LAYER_COAT), GLINT_LAYER_BASE));
        glint_material_destroy(m);
    }
    /* A smooth coat has no facets that sampling would not know. */
    const configuration base = configuration_of(GLINT_MODEL_DICTIONARY, 0),
                        coat = configuration_of(GLINT_MODEL_SMOOTH, 0);
    glint_material *m = create_layered(&base.options, &coat.options, 1.0F);
    assert_int_equal(glint_material_features(m) & seen, seen);
    glint_material_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_coat_there_is_the_base_alone),
        cmocka_unit_test(over_a_black_base_there_is_the_coat_alone),
        cmocka_unit_test(the_sum_is_that_of_the_paper),
        cmocka_unit_test(area_lights_are_those_of_the_layers),
        cmocka_unit_test(facets_of_both_layers_are_counted),
        cmocka_unit_test(each_layer_has_a_horizon_of_its_own),
        cmocka_unit_test(a_coat_without_a_direction_shows_nothing),
        cmocka_unit_test(a_coat_that_a_call_brings_is_as_one_of_the_options),
        cmocka_unit_test(features_are_those_of_the_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
