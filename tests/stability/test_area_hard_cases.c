/* Lights of real size at the edge of what can be one: nothing is NaN, infinite or negative, and no floating-point
 * exception is raised. */
#define _GNU_SOURCE
#include "batch_points.h"
#include "traps.h"

static const double GRAZING = 1.5707945813; /* 89.9999 degrees */

/* Lights that are edge-on, behind, astride the horizon, touching, of no size, all around, or no light at all. */
static void lights_at_the_edge_are_sane(void **state)
{
    (void)state;
    static const float numbers[] = { 0.0F, 1e-30F, 1e-12F, 1e-6F, 1e-3F, 0.5F,    1.0F,
                                     1e6F, 1e14F,  3e38F,  -1.0F, NAN,   INFINITY };
    static const float alphas[][2] = {
        { 1e-4F, 1e-4F }, { 1.0F, 1.0F }, { 1.0F, 1e-3F }, { 0.1F, 0.1F }, { 0.01F, 0.01F }
    };
    static const double thetas[] = { 0.0, 1e-7, 0.7, 1.5, GRAZING, 1.5707963 };
    uint64_t random = 23;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int i = 0; i < 6000; i++) {
        glint_area_light l = { .kind = (glint_area_kind)(random_bits(&random) % 5), .two_sided = i & 1U };
        float *all = &l.hidden;
        const int wild = random_bits(&random) % 3 == 0;
        /* Few different numbers, so that lights touch, coincide and lie in planes. */
        for (size_t k = 0; k < (sizeof(l) - offsetof(glint_area_light, hidden)) / sizeof(float); k++) {
            const float x = numbers[random_bits(&random) % (wild ? 13 : 7)];
            all[k] = random_bits(&random) & 1 ? x : wild ? -x : numbers[4 + random_bits(&random) % 3] - x;
        }
        l.corner_count = wild ? (uint32_t)(random_bits(&random) % 12) : 3U + (uint32_t)(random_bits(&random) % 6);
        if (!wild)
            l.hidden = 0.0F;
        glint_surface s = glint_material_surface(m);
        s.alpha_x = alphas[i % 5][0];
        s.alpha_y = alphas[i % 5][1];
        for (int k = 0; k < 3; k++)
            s.diffuse[k] = 0.5F;
        float wo[3];
        direction(thetas[i / 5 % 6], random_between(&random, 0.0, 6.28), wo);
        glint_footprint f = random_footprint(&random);
        f.dudx = wild ? hostile(&random, f.dudx) : 1e-4F;
        glint_value v;
        glint_eval_area(m, &s, &f, wo, &l, &v);
        assert_sane(&v);
        if (v.lit_probability > 1.0F)
            fail_msg("p is %g", (double)v.lit_probability);
    }
}

/* A light as it should be, in which some numbers, few or many, have any bits. */
static glint_area_light light_of_any_bits(uint64_t *random)
{
    glint_area_light l = { .kind = (glint_area_kind)(random_bits(random) % 5),
                           .two_sided = (uint32_t)(random_bits(random) & 1),
                           .corner_count = 3U + (uint32_t)(random_bits(random) % 6) };
    const uint64_t odds = 2U << (2 * (random_bits(random) % 4));
    const double size = random_log_between(random, 1e-6, 1.0);
    float *const all = &l.hidden;
    random_direction(random, l.center);
    l.solid_angle_sr = l.radius = (float)size;
    for (int k = 0; k < 3; k++) {
        l.half_x[k] = (float)(size * random_between(random, -1.0, 1.0));
        l.half_y[k] = (float)(size * random_between(random, -1.0, 1.0));
        for (uint32_t i = 0; i < l.corner_count; i++)
            l.corners[i][k] = l.center[k] + (float)(size * random_between(random, -1.0, 1.0));
    }
    for (size_t k = 0; k < (sizeof(l) - offsetof(glint_area_light, hidden)) / sizeof(float); k++)
        if (random_bits(random) % odds == 0) {
            const uint32_t bits = (uint32_t)(random_bits(random) >> 32);
            memcpy(&all[k], &bits, sizeof(bits));
        }
    return l;
}

/* A million with those above, in vectors: one lane's hard case must not raise an exception in another's branch. Of each
 * batch the first few again by themselves, to the same bits. */
static void lights_of_any_bits_are_sane(void **state)
{
    (void)state;
    enum { COUNT = 256, ALONE = 4 };
    static batch_points points;
    static glint_surface surface[COUNT];
    static glint_area_light light[COUNT];
    static glint_value value[COUNT];
    uint64_t random = 25;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int round = 0; round < (row->model <= GLINT_MODEL_COUNTING ? 150 : 30); round++) {
        for (int i = 0; i < COUNT; i++) {
            float wo[3];
            random_direction(&random, wo);
            glint_footprint f = random_footprint(&random);
            f.dudx = round % 4 ? f.dudx : hostile(&random, f.dudx);
            for (int k = 0; k < 3; k++)
                wo[k] = round % 4 ? wo[k] : hostile(&random, wo[k]);
            batch_points_place(&points, i, &f);
            batch_points_light(&points, i, wo, wo, 0.0F);
            surface[i] = glint_material_surface(m);
            surface[i].alpha_x = round % 3 ? surface[i].alpha_x : hostile(&random, 0.1F);
            light[i] = light_of_any_bits(&random);
        }
        glint_batch b = batch_points_of(&points, COUNT);
        b.surfaces = surface;
        b.area_lights = light;
        b.values = value;
        assert_int_equal(glint_eval_batch(m, &b), GLINT_OK);
        for (int i = 0; i < COUNT; i++)
            assert_sane(&value[i]);
        for (int i = 0; i < ALONE; i++) {
            const glint_footprint f = batch_points_footprint(&points, i);
            const float o[3] = { points.wo[0][i], points.wo[1][i], points.wo[2][i] };
            glint_value alone;
            glint_eval_area(m, &surface[i], &f, o, &light[i], &alone);
            assert_memory_equal(&alone, &value[i], sizeof(alone));
        }
    }
}

/* What a light of a hemisphere sends is the albedo: the white furnace of the smooth part. */
static void a_light_all_around_shows_the_albedo(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    for (int distribution = 0; distribution < 2; distribution++)
        for (int method = 0; method < 2; method++)
            for (int a = 0; a < 6; a++) {
                static const float alphas[] = { 1e-4F, 1e-3F, 0.01F, 0.1F, 0.4F, 1.0F };
                o.model = GLINT_MODEL_COUNTING;
                o.distribution = (glint_distribution)distribution;
                o.area_light_method = (glint_area_light_method)method;
                o.surface.alpha_x = o.surface.alpha_y = alphas[a];
                glint_material *m = create(&o);
                for (int t = 0; t < 5; t++) {
                    static const double thetas[] = { 0.0, 0.5, 1.2, 1.4, 1.5 };
                    float wo[3];
                    direction(thetas[t], 0.3, wo);
                    const glint_area_light sky = { .kind = GLINT_AREA_SUN,
                                                   .solid_angle_sr = 6.28318531F,
                                                   .center = { 0.0F, 0.0F, 1.0F } };
                    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
                    glint_value v;
                    glint_eval_area(m, NULL, &f, wo, &sky, &v);
                    moments albedo = { 0 };
                    uint64_t random = 24;
                    for (int i = 0; i < 4000; i++) {
                        const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                             (float)random_uniform(&random) };
                        glint_sample s;
                        moments_add(&albedo,
                                    glint_sample_direction(m, NULL, NULL, wo, u, &s) ? (double)s.weight[0] : 0.0);
                    }
                    const double sigma = moments_standard_error(&albedo);
                    if (fabs((double)v.smooth[0] - albedo.mean) > 4.5 * sigma + 0.01)
                        fail_msg("alpha %g, view %g: %g, albedo %g +- %g", (double)alphas[a], thetas[t],
                                 (double)v.smooth[0], albedo.mean, sigma);
                    assert_true(v.smooth[0] <= 1.005F);
                }
                glint_material_destroy(m);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lights_at_the_edge_are_sane, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(lights_of_any_bits_are_sane, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_all_around_shows_the_albedo, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
