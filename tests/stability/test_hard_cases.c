/* Inputs at the edge of what floats can say: nothing is NaN, infinite or negative, and no floating-point exception is
 * raised. */
#define _GNU_SOURCE
#include "traps.h"

static const double GRAZING = 1.5707945813; /* 89.9999 degrees */

static void listed_hard_cases_are_sane(void **state)
{
    (void)state;
    static const float alphas[][2] = { { 1e-4F, 1e-4F }, { 1.0F, 1.0F }, { 1.0F, 1e-3F }, { 1e-4F, 0.1F } };
    static const double thetas[] = { 0.0, 1e-7, 0.7, 1.5, GRAZING, 1.5707963, 1.5707964, 3.0 };
    static const float densities[] = { 0.0F, 1e-6F, 0.5F, 1.0F, 1e6F, 1e9F, 1e15F, 1e18F };
    static const float angles[] = { 0.0F, 1e-30F, 1e-9F, 6.8e-5F, 1.0F, 6.28318F };
    static const float steps[][4] = {
        { 1e-3F, 0, 0, 1e-3F },    { 0, 0, 0, 0 },         { 1e-3F, 1e-3F, 1e-3F, 1e-3F }, { 1.0F, 0, 0, 1e-6F },
        { 1e-20F, 0, 0, 1e-20F },  { 1e6F, 0, 0, 1e6F },   { 1e-3F, 0, 0, 1e-38F },        { NAN, 0, 0, 1e-3F },
        { INFINITY, 0, 0, 1e-3F }, { 1e30F, 0, 0, 1e30F }, { 3e-5F, 7e2F, 1e-6F, 4e-2F }
    };
    static const double places[] = { 0.0, 1e-6, -1e6, 1e9, 1e15, 1e300, (double)NAN, (double)INFINITY };
    FOR_EACH_CONFIGURATION(c, m, row)
    for (size_t a = 0; a < sizeof(alphas) / sizeof(alphas[0]); a++)
        for (size_t to = 0; to < 8; to++)
            for (size_t ti = 0; ti < 8; ti++)
                for (size_t d = 0; d < 8; d++)
                    for (size_t s = 0; s < 6; s++) {
                        const size_t mix = d * 7 + s * 5 + to * 3 + ti + a;
                        const float *j = steps[mix % 11];
                        glint_surface surface = glint_material_surface(m);
                        surface.alpha_x = alphas[a][0];
                        surface.alpha_y = alphas[a][1];
                        surface.facets_per_m2 = densities[d];
                        float wo[3], wi[3];
                        direction(thetas[to], 0.0, wo);
                        direction(thetas[ti], mix % 3 ? 3.14159265359 : 0.3, wi);
                        const glint_footprint f = { places[mix % 8], places[mix / 8 % 8], j[0], j[1], j[2], j[3], 1U };
                        const glint_light light = { GLINT_LIGHT_CAP, angles[s] };
                        glint_value v;
                        glint_eval_value(m, &surface, &f, wo, wi, &light, &v);
                        assert_sane(&v);
                    }
}

/* wi = -wo has no half vector; one of the two is below the horizon, or both lie in it. */
static void a_light_straight_behind_is_dark(void **state)
{
    (void)state;
    static const double thetas[] = { 0.0, 1e-7, 0.7, 1.5, GRAZING, 1.5707963, 1.5707964, 3.0 };
    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 9; i++) {
        float wo[3] = { 1.0F, 0.0F, 0.0F };
        if (i < 8)
            direction(thetas[i], 0.4 * i, wo);
        const float wi[3] = { -wo[0], -wo[1], -wo[2] };
        glint_value v;
        glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
        assert_sane(&v);
        for (int k = 0; k < 3; k++)
            assert_true(v.rgb[k] == 0.0F && v.smooth[k] == 0.0F);
    }
}

static void roughen(glint_surface *s, uint64_t *random)
{
    s->alpha_x = hostile(random, s->alpha_x);
    s->alpha_y = hostile(random, s->alpha_y);
    s->facets_per_m2 = hostile(random, s->facets_per_m2);
    s->discreteness = hostile(random, s->discreteness);
    for (int k = 0; k < 3; k++) {
        s->diffuse[k] = hostile(random, s->diffuse[k]);
        s->f0[k] = hostile(random, s->f0[k]);
        s->f90[k] = hostile(random, s->f90[k]);
    }
}

/* A coat in any frame, one in four out of its mind altogether; only the layered model looks at it. */
static glint_coat hostile_coat(const glint_surface *surface, const glint_footprint *f, uint64_t *random)
{
    glint_coat c = GLINT_COAT_INIT;
    const int wild = random_bits(random) % 4 == 0;
    c.surface = *surface;
    roughen(&c.surface, random);
    c.weight = hostile(random, (float)random_uniform(random));
    c.footprint = random_bits(random) & 1 ? f : NULL;
    random_direction(random, c.normal);
    random_direction(random, c.tangent);
    for (int k = 0; wild && k < 3; k++) {
        c.normal[k] = hostile(random, c.normal[k]);
        c.tangent[k] = hostile(random, c.tangent[k]);
    }
    return c;
}

static void random_bits_are_sane(void **state)
{
    (void)state;
    uint64_t random = 21;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 200000; i++) {
        float wo[3], wi[3], u[3];
        random_direction(&random, wo);
        random_direction(&random, wi);
        const int wild = random_bits(&random) % 4 == 0;
        for (int k = 0; k < 3; k++) {
            if (wild) {
                wo[k] = hostile(&random, wo[k]);
                wi[k] = hostile(&random, wi[k]);
            }
            u[k] = hostile(&random, (float)random_uniform(&random));
        }
        glint_footprint f = random_footprint(&random);
        f.dudx = hostile(&random, f.dudx);
        f.dvdy = hostile(&random, f.dvdy);
        uint64_t place = random_bits(&random);
        if (i % 3 == 0)
            memcpy(&f.u, &place, sizeof(place));
        glint_surface s = glint_material_surface(m);
        roughen(&s, &random);
        glint_footprint other = random_footprint(&random);
        other.dvdx = hostile(&random, other.dvdx);
        const glint_coat coat = hostile_coat(&s, &other, &random);
        if (i % 4)
            s.coat = &coat;
        const glint_light light = { GLINT_LIGHT_CAP, hostile(&random, 1e-4F) };
        glint_value v;
        glint_eval_value(m, &s, &f, wo, wi, &light, &v);
        assert_sane(&v);
        glint_sample sample;
        glint_sample_direction(m, &s, &f, wo, u, &sample);
        v = (glint_value){ { sample.weight[0], sample.weight[1], sample.weight[2] },
                           { sample.pdf, glint_pdf(m, &s, &f, wo, wi), 0.0F },
                           0.0F,
                           0.0F,
                           0 };
        assert_sane(&v);
        float through[3];
        glint_transmittance(m, i % 2 ? &coat : NULL, wo, i % 3 ? wi : NULL, through);
        v = (glint_value){ { through[0], through[1], through[2] }, { 0 }, 0.0F, 0.0F, 0 };
        assert_sane(&v);
    }
}

/* Vector code computes every branch for every lane: one lane's hard case must not raise an exception in another's
 * branch. */
static void random_batches_are_sane(void **state)
{
    (void)state;
    enum { COUNT = 256 };
    static double u[COUNT], v[COUNT];
    static float step[4][COUNT], wo[3][COUNT], wi[3][COUNT], angle[COUNT], rgb[3][COUNT];
    static glint_surface surface[COUNT];
    uint64_t random = 22;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < COUNT; i++) {
            float o[3], w[3];
            random_direction(&random, o);
            random_direction(&random, w);
            const glint_footprint f = random_footprint(&random);
            const double far = random_log_between(&random, 1e-3, 1e14);
            u[i] = f.u * far;
            v[i] = f.v;
            step[0][i] = hostile(&random, f.dudx);
            step[1][i] = f.dudy;
            step[2][i] = f.dvdx;
            step[3][i] = hostile(&random, f.dvdy);
            for (int k = 0; k < 3; k++) {
                wo[k][i] = o[k];
                wi[k][i] = w[k];
            }
            angle[i] = hostile(&random, 1e-4F);
            surface[i] = glint_material_surface(m);
            surface[i].facets_per_m2 = (float)random_log_between(&random, 1e-6, 1e18);
            surface[i].alpha_x = hostile(&random, 0.1F);
        }
        const glint_batch b = { sizeof(b),
                                COUNT,
                                u,
                                v,
                                step[0],
                                step[1],
                                step[2],
                                step[3],
                                NULL,
                                { wo[0], wo[1], wo[2] },
                                { wi[0], wi[1], wi[2] },
                                angle,
                                surface,
                                { rgb[0], rgb[1], rgb[2] },
                                NULL };
        assert_int_equal(glint_eval_batch(m, &b), GLINT_OK);
        for (int i = 0; i < COUNT; i++)
            assert_sane(&(glint_value){ { rgb[0][i], rgb[1][i], rgb[2][i] }, { 0 }, 0, 0, 0 });
    }
}

static void degenerate_footprints_give_the_smooth_limit(void **state)
{
    (void)state;
    static const float steps[][4] = {
        { 0, 0, 0, 0 }, { 1e-3F, 1e-3F, 1e-3F, 1e-3F }, { NAN, 0, 0, 1e-3F }, { 1e30F, 0, 0, 1 }
    };
    const float wo[3] = { 0.0F, 0.6F, 0.8F }, wi[3] = { 0.0F, -0.6F, 0.8F };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        float smooth[3];
        glint_eval(m, NULL, NULL, wo, wi, NULL, smooth);
        for (int i = 0; i < 4; i++) {
            const glint_footprint f = { 1.0, 2.0, steps[i][0], steps[i][1], steps[i][2], steps[i][3], 0U };
            float rgb[3];
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            assert_memory_equal(rgb, smooth, sizeof(rgb));
        }
        /* So does a density of zero, as a texture may say. */
        glint_coat coat;
        const glint_surface s = surface_of_density(m, 0.0F, &coat);
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        float rgb[3];
        glint_eval(m, &s, &f, wo, wi, &light, rgb);
        assert_memory_equal(rgb, smooth, sizeof(rgb));
    }
}

/* A light so large that every facet is lit leaves nothing to count. */
static void certain_reflection_is_smooth(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.surface.alpha_x = o.surface.alpha_y = 1e-3F;
    glint_material *m = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_footprint f = { .dudx = 1e-5F, .dvdy = 1e-5F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.1F };
    glint_value v;
    glint_eval_value(m, NULL, &f, up, up, &light, &v);
    assert_true(v.lit_probability == 1.0F);
    assert_memory_equal(v.rgb, v.smooth, sizeof(v.rgb));
    glint_material_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(listed_hard_cases_are_sane, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_straight_behind_is_dark, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(random_bits_are_sane, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(random_batches_are_sane, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(degenerate_footprints_give_the_smooth_limit, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(certain_reflection_is_smooth, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
