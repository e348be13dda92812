/* The example model through the library's front: options, built-in maps, its mean over places, its energy. */
#include "configurations.h"

#include <string.h>

#define PI 3.14159265358979323846

enum { KINDS = GLINT_EXAMPLE_ANISOTROPIC_NOISE + 1 };

static glint_material_options example_options(void)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXAMPLE;
    return o;
}

static void bad_options_are_named_with_their_range(void **state)
{
    (void)state;
    static float normals[3 * 8 * 8];
    for (int i = 0; i < 64; i++)
        normals[3 * i + 2] = 1.0F;
#define CASE(assignment, text)                                                                                         \
    {                                                                                                                  \
        glint_material_options o = example_options();                                                                  \
        glint_material *m;                                                                                             \
        char message[256];                                                                                             \
        assignment;                                                                                                    \
        assert_int_equal(glint_material_create(&o, &m, message, sizeof(message)), GLINT_ERROR_RANGE);                  \
        assert_null(m);                                                                                                \
        assert_non_null(strstr(message, text));                                                                        \
    }
    CASE(o.example.size = 12, "example.size is 12, expected 8, 16, 32, 64, 128 or 256")
    CASE(o.example.size = 512, "example.size is 512")
    CASE(o.example.components = 4, "example.components is 4, expected 2 or 3")
    CASE(o.example.side_m = -1.0F, "example.side_m is -1, expected 0 or 1e-07 to 1000")
    CASE(o.example.sigma_r = 0.9F, "example.sigma_r is 0.9, expected 0 or 0.001 to 0.5")
    CASE(o.example.sigma_h = 0.1F, "example.sigma_h is 0.1, expected 0.3 to 1")
    CASE(o.example.scale[1] = 9.0F, "example.scale[1] is 9, expected 0.25 to 4")
    CASE(o.example.shear[0] = NAN, "example.shear[0] is nan, expected -1 to 1")
    CASE(o.example.jitter = 2.0F, "example.jitter is 2, expected 0 to 1")
    CASE(o.example.mirror = 2, "example.mirror is 2, expected 0 to 1")
    CASE(o.example.rotation_rad = 7.0F, "example.rotation_rad is 7")
    CASE((o.example.shear[0] = 1.0F, o.example.shear[1] = 1.0F), "example.scale with example.shear leaves 0 of")
    CASE((o.example.placement = GLINT_EXAMPLE_SCATTERED, o.example.scale[0] = o.example.scale[1] = 2.0F),
         "half a scattered map's diagonal 1.41421 squares, expected at most 1.06")
    CASE((o.example.normals = normals, o.example.size = 8, normals[3 * 11 + 2] = -1.0F),
         "example.normals[11] (row 1, column 3) begins with 0, 0, expected a normal with z > 0")
    CASE((o.example.normals = normals, o.example.size = 8, normals[3 * 11 + 2] = NAN), "example.normals[11]")
    CASE((o.example.normals = normals, o.example.size = 8, normals[3 * 11 + 2] = 1.0F, normals[0] = 9.0F),
         "example.normals[0] (row 0, column 0) begins with 9, 0")
#undef CASE
}

static void built_in_maps_tile_and_have_their_slope(void **state)
{
    (void)state;
    enum { N = 64 };
    static float normals[N * N][3], again[N * N][3];
    glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    shape.feature_texels = 8.0F;
    for (int kind = 0; kind < KINDS; kind++) {
        assert_int_equal(glint_example_generate((glint_example_kind)kind, N, &shape, 9U, normals[0]), GLINT_OK);
        assert_int_equal(glint_example_generate((glint_example_kind)kind, N, &shape, 9U, again[0]), GLINT_OK);
        assert_memory_equal(normals, again, sizeof(normals));
        double square[2] = { 0.0, 0.0 }, steps[N] = { 0.0 };
        for (int i = 0; i < N * N; i++) {
            const float *n = normals[i];
            assert_true(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0F) < 1e-6F && n[2] > 0.0F);
            for (int k = 0; k < 2; k++)
                square[k] += (double)(n[k] / n[2]) * (double)(n[k] / n[2]) / (N * N);
            const float *right = normals[i / N * N + (i + 1) % N];
            const double step = fabs((double)(right[0] - n[0])) + fabs((double)(right[1] - n[1]));
            steps[i % N] += step / N;
        }
        assert_true(fabs(sqrt(square[0] + square[1]) / (double)shape.slope - 1.0) < 1e-5);
        /* Steps from column to column: that around the edge must not stand out. */
        double inside = 0.0;
        for (int i = 0; i < N - 1; i++)
            inside = fmax(inside, steps[i]);
        printf("kind %d: slope along u %.3f, along v %.3f; largest mean step inside %.4f, around the edge %.4f\n", kind,
               sqrt(square[0]), sqrt(square[1]), inside, steps[N - 1]);
        assert_true(steps[N - 1] < 1.5 * inside + 1e-6);
        /* Features eight times as long have an eighth of the slope along them. */
        if (kind == GLINT_EXAMPLE_BRUSHED || kind == GLINT_EXAMPLE_ANISOTROPIC_NOISE)
            assert_true(square[1] > 16.0 * square[0]);
    }
    shape.slope = 0.0F;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_LEATHER, N, &shape, 0U, normals[0]), GLINT_ERROR_RANGE);
    shape.slope = 0.2F;
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_LEATHER, 20, &shape, 0U, normals[0]), GLINT_ERROR_RANGE);
    assert_int_equal(glint_example_generate(GLINT_EXAMPLE_LEATHER, N, NULL, 0U, normals[0]), GLINT_ERROR_ARGUMENT);
}

/* Two numbers a normal say the same as three. */
static void normals_may_have_two_or_three_components(void **state)
{
    (void)state;
    static float three[256][3], two[256][2];
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    glint_example_generate(GLINT_EXAMPLE_LEATHER, 16, &shape, 1U, three[0]);
    for (int i = 0; i < 256; i++) {
        two[i][0] = three[i][0];
        two[i][1] = three[i][1];
    }
    glint_material_options o = example_options();
    o.example.sigma_r = 0.05F;
    o.example.normals = three[0];
    glint_material *a = create(&o);
    o.example.normals = two[0];
    o.example.components = 2;
    glint_material *b = create(&o);
    memset(three, 0, sizeof(three)); /* what the client gives is copied */
    const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    uint64_t random = 1;
    double worst = 0.0, peak = 0.0;
    for (int i = 0; i < 2000; i++) {
        const glint_footprint f = { .u = random_between(&random, 0.0, 0.01), .dudx = 2e-4F, .dvdy = 2e-4F };
        const float wo[3] = { 0.0F, 0.0F, 1.0F };
        float wi[3], x[3], y[3];
        direction(random_between(&random, 0.0, 0.6), random_between(&random, 0.0, 2.0 * PI), wi);
        glint_eval(a, NULL, &f, wo, wi, &light, x);
        glint_eval(b, NULL, &f, wo, wi, &light, y);
        worst = fmax(worst, fabs((double)(x[0] - y[0])));
        peak = fmax(peak, (double)x[0]);
    }
    /* z = sqrt(1 - x^2 - y^2) rounds to 1e-7; a slope of sigma_r is 20 roundings of that apart, and a code may flip. */
    assert_true(peak > 0.0 && worst < 0.005 * peak);
    glint_material_destroy(a);
    glint_material_destroy(b);
}

/* A map of flat facets that all lean to one side, and the four mirror images of that side: each shows where a quarter
 * of the maps lie so, as many as chance wills. */
static void mirrored_maps_lean_to_all_four_sides_alike(void **state)
{
    (void)state;
    enum { MAPS = 4096 };
    static float normals[3 * 8 * 8];
    for (int i = 0; i < 64; i++) {
        normals[3 * i] = 0.15F;
        normals[3 * i + 1] = 0.3F;
        normals[3 * i + 2] = 1.0F;
    }
    glint_material_options o = example_options();
    o.example.normals = normals;
    o.example.size = 8;
    o.example.side_m = 1e-3F;
    o.example.flat = 1;
    o.example.sigma_r = 0.02F;
    glint_material *m = create(&o);
    const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    double sum[4] = { 0.0 };
    for (int n = 0; n < MAPS; n++) {
        /* The middle of one map, where no neighbour reaches. */
        const glint_footprint f = {
            .u = 1e-3 * (n % 64 + 0.5), .v = 1e-3 * (n / 64 + 0.5), .dudx = 1e-4F, .dvdy = 1e-4F
        };
        for (int k = 0; k < 4; k++) {
            const double x = k & 1 ? -0.15 : 0.15, y = k & 2 ? -0.3 : 0.3, z = 1.0 / (1.0 + x * x + y * y);
            const float wi[3] = { (float)(2.0 * x * z), (float)(2.0 * y * z), (float)(2.0 * z - 1.0) };
            float rgb[3];
            glint_eval(m, NULL, &f, wo, wi, &light, rgb);
            sum[k] += (double)rgb[0];
        }
    }
    glint_material_destroy(m);
    const double all = sum[0] + sum[1] + sum[2] + sum[3];
    assert_true(all > 0.0);
    for (int k = 0; k < 4; k++)
        /* Five deviations of a binomial share of a quarter. */
        if (!(fabs(sum[k] / all - 0.25) < 5.0 * sqrt(0.25 * 0.75 / MAPS)))
            fail_msg("side %d has %.4f of the light, expected a quarter +- %.4f", k, sum[k] / all,
                     sqrt(0.25 * 0.75 / MAPS));
}

/* E over seeds and places of rgb is smooth: exactly so for tiled maps, up to the eight bits and the bilinear cells of
 * two sets of maps; for scattered ones also up to the patch of surface that stands for all of it. */
static void mean_over_seeds_is_smooth(void **state)
{
    (void)state;
    uint64_t random = 11;
    const glint_light light = { GLINT_LIGHT_CAP, 1e-3F };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    for (int i = 0; i < CONFIGURATIONS; i++) {
        configuration c = configuration_of(GLINT_MODEL_EXAMPLE, i);
        const int scattered = c.options.example.placement == GLINT_EXAMPLE_SCATTERED;
        glint_material *m = create(&c.options);
        double worst = 0.0;
        for (int k = 0; k < 3; k++) {
            moments rgb = { 0 }, smooth = { 0 };
            const float side = 16.0F * 1e-4F * (k == 0 ? 0.02F : k == 1 ? 0.2F : 1.5F);
            for (int n = 0; n < 40000; n++) {
                /* A cap of half vectors over the middle of the distribution. */
                float wi[3];
                const double sine = 0.3 * sqrt(random_uniform(&random));
                direction(asin(sine), random_between(&random, 0.0, 2.0 * PI), wi);
                const glint_footprint f = {
                    random_between(&random, -1.0, 1.0), random_between(&random, -1.0, 1.0), side, 0.0F, 0.0F, side,
                    (uint32_t)random_bits(&random)
                };
                glint_value v;
                glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
                moments_add(&rgb, (double)v.rgb[0]);
                moments_add(&smooth, (double)v.smooth[0]);
            }
            const double error = rgb.mean / smooth.mean - 1.0;
            const double noise = hypot(moments_standard_error(&rgb), moments_standard_error(&smooth)) / smooth.mean;
            worst = fmax(worst, fabs(error));
            printf("%-48s pixel of %.2f maps: mean of rgb over smooth %+.2f %% (noise %.2f %%)\n", c.name,
                   (double)side / 1.6e-3, 100.0 * error, 100.0 * noise);
            /* 1 % for maps; 3 % for the 576 cells of the patch, each of another transform. */
            if (fabs(error) > 4.2 * noise + (scattered ? 0.03 : 0.01))
                fail_msg("%s, pixel of %g maps: mean of rgb %g, of smooth %g, %.1f sigma", c.name,
                         (double)side / 1.6e-3, rgb.mean, smooth.mean, error / noise);
        }
        glint_material_destroy(m);
    }
}

/* A pixel that grows by a thousandth at a time, from a hundredth of a map to a hundred maps: what it shows moves on by
 * a few thousandths, and where a tile is taken whole from then on by no more than the error that is promised, 10 % of
 * the peak. A seam between two ways of evaluation would be of the order of the peak itself. */
static void nothing_jumps_as_the_pixel_grows(void **state)
{
    (void)state;
    const glint_light light = { GLINT_LIGHT_CAP, 1e-4F };
    const float wo[3] = { 0.0F, 0.0F, 1.0F };
    uint64_t random = 8;
    for (int i = 0; i < CONFIGURATIONS; i++) {
        configuration c = configuration_of(GLINT_MODEL_EXAMPLE, i);
        glint_material *m = create(&c.options);
        double worst = 0.0;
        for (int place = 0; place < 4; place++) {
            float wi[3];
            direction(random_between(&random, 0.05, 0.3), random_between(&random, 0.0, 2.0 * PI), wi);
            const double u = random_between(&random, -1.0, 1.0), v = random_between(&random, -1.0, 1.0);
            double last = -1.0, largest_step = 0.0, peak = 0.0;
            for (double side = 16e-6; side < 0.16; side *= 1.001) {
                const glint_footprint f = { u, v, (float)side, 0.0F, 0.0F, (float)side, 3U };
                glint_value value;
                glint_eval_value(m, NULL, &f, wo, wi, &light, &value);
                const double now = (double)value.rgb[0];
                largest_step = last < 0.0 ? 0.0 : fmax(largest_step, fabs(now - last));
                peak = fmax(peak, fmax(now, (double)value.smooth[0]));
                last = now;
            }
            worst = fmax(worst, largest_step / peak);
        }
        printf("%-48s largest step %.2f %% of the peak\n", c.name, 100.0 * worst);
        assert_true(worst < 0.1);
        glint_material_destroy(m);
    }
}

/* Directional albedo of every built-in map with white facets, up to a root mean square slope of one. */
static void no_map_reflects_more_than_it_gets(void **state)
{
    (void)state;
    static const double theta[] = { 0.0, 0.6, 1.2, 1.5 };
    static float normals[3 * 32 * 32];
    uint64_t random = 5;
    for (int kind = 0; kind < KINDS; kind++)
        for (int s = 0; s < 2; s++) {
            glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
            shape.slope = s ? 1.0F : 0.1F;
            glint_material_options o = example_options();
            assert_int_equal(glint_example_generate((glint_example_kind)kind, 32, &shape, 2U, normals), GLINT_OK);
            o.example.normals = normals;
            o.example.size = 32;
            glint_material *m = create(&o);
            printf("kind %d, slope %.1f: albedo", kind, (double)shape.slope);
            for (int t = 0; t < 4; t++) {
                float wo[3];
                direction(theta[t], 0.7, wo);
                moments albedo = { 0 };
                for (int i = 0; i < 40000; i++) {
                    const float u[3] = { (float)random_uniform(&random), (float)random_uniform(&random),
                                         (float)random_uniform(&random) };
                    glint_sample sample;
                    moments_add(&albedo,
                                glint_sample_direction(m, NULL, NULL, wo, u, &sample) ? (double)sample.weight[0] : 0.0);
                }
                printf("  %.3f", albedo.mean);
                const double sigmas = (albedo.mean - 1.0) / moments_standard_error(&albedo);
                if (sigmas > 4.5 && albedo.mean > 1.0 + 1e-5)
                    fail_msg("kind %d, slope %g, view at %g: albedo %g, expected at most 1: %.1f sigma", kind,
                             (double)shape.slope, theta[t], albedo.mean, sigmas);
            }
            printf("\n");
            glint_material_destroy(m);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_options_are_named_with_their_range),
        cmocka_unit_test(built_in_maps_tile_and_have_their_slope),
        cmocka_unit_test(normals_may_have_two_or_three_components),
        cmocka_unit_test(mirrored_maps_lean_to_all_four_sides_alike),
        cmocka_unit_test(mean_over_seeds_is_smooth),
        cmocka_unit_test(nothing_jumps_as_the_pixel_grows),
        cmocka_unit_test(no_map_reflects_more_than_it_gets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
