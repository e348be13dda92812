/* The explicit model against closed forms, and the counting model's blocks of pixels against the explicit one. */
#include "configurations.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* D of the material averaged over the light's cap, with the Jacobian 4 h.wi as the facets have it: what the mean of
 * value / reflectance must be. Fibonacci points on the cap. */
static double mean_over_cap(const glint_material *m, const float wo[3], const float wi[3], double solid_angle)
{
    enum { POINTS = 20000 };
    const double cos_rim = 1.0 - solid_angle / (2.0 * PI);
    const double z[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
    const double length = sqrt(z[0] * z[0] + z[2] * z[2]);
    const double x[3] = { z[2] / length, 0.0, -z[0] / length };
    const double y[3] = { z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0] };
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double c = 1.0 - (1.0 - cos_rim) * (i + 0.5) / POINTS, s = sqrt(1.0 - c * c), phi = 2.39996322972865 * i;
        float w[3], rgb[3];
        for (int k = 0; k < 3; k++)
            w[k] = (float)(c * z[k] + s * (cos(phi) * x[k] + sin(phi) * y[k]));
        glint_eval(m, NULL, NULL, wo, w, NULL, rgb);
        sum += (double)rgb[0];
    }
    return sum / POINTS;
}

/* Mean over pixels: the smooth value averaged over the light. A narrow light, so that F and G2, which the model takes
 * at the light's middle, do not matter. */
static void mean_of_explicit_is_smooth_over_the_light(void **state)
{
    (void)state;
    uint64_t random = 1;
    const double solid_angle = 0.01;
    for (int i = 0; i < 5; i++)
        for (int hash = 0; hash < 2; hash++)
            for (int t = 0; t < 3; t++) {
                configuration c = configuration_of(GLINT_MODEL_EXPLICIT, i);
                c.options.facet_hash = (glint_facet_hash)hash;
                c.options.facet_alpha = 0.0F;
                c.options.surface.facets_per_m2 = 1e8F; /* 100 under a pixel */
                glint_material *m = create(&c.options);
                c.options.model = GLINT_MODEL_SMOOTH;
                glint_material *smooth = create(&c.options);
                float wo[3], wi[3];
                direction(0.5 * t, 0.0, wo);
                direction(0.5 * t + 0.15, PI, wi);
                const double expected = mean_over_cap(smooth, wo, wi, solid_angle);
                moments x = { 0 };
                for (int k = 0; k < 6000; k++) {
                    const glint_footprint f = { random_between(&random, -0.5, 0.5),
                                                random_between(&random, -0.5, 0.5),
                                                1e-3F,
                                                2e-4F,
                                                -1e-4F,
                                                1e-3F,
                                                (uint32_t)k };
                    const glint_light light = { GLINT_LIGHT_CAP, (float)solid_angle };
                    glint_value v;
                    glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
                    moments_add(&x, (double)v.rgb[0]);
                }
                const double sigma = moments_standard_error(&x), error = x.mean - expected;
                /* 30 means: 4 sigmas. F and G2 vary by less than .3 % over a light of 3 degrees. */
                if (fabs(error) > 4.0 * sigma + 0.003 * expected)
                    fail_msg("%s, hash %d, view %d: mean %g, expected %g, %.1f sigmas", c.name, hash, t, x.mean,
                             expected, error / sigma);
                glint_material_destroy(m);
                glint_material_destroy(smooth);
            }
}

/* Pixels that are whole cells see N facets with shares 1/N each: the count of lit ones is binomial. */
static void variance_of_explicit_is_binomial(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXPLICIT;
    o.surface.facets_per_m2 = 1e8F;
    glint_material *m = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    moments x = { 0 };
    glint_value v = { { 0 }, { 0 }, 0, 0, 0 };
    for (int k = 0; k < 40000; k++) {
        /* 5 x 5 cells of 1e-4 m, on their borders */
        const glint_footprint f = {
            1e-4 * (5 * (k % 200) + 2.5), 1e-4 * (5 * (k / 200) + 2.5), 5e-4F, 0.0F, 0.0F, 5e-4F, 0U
        };
        glint_eval_value(m, NULL, &f, up, up, &light, &v);
        moments_add(&x, (double)(v.rgb[0] / v.smooth[0]));
    }
    const double p = (double)v.lit_probability, variance = (1.0 - p) / (25.0 * p);
    /* Kurtosis 3 + 1/Np; D falls over the light's radius of .08, on average by 3 % in p. */
    const double noise = 4.0 * sqrt((2.0 + 1.0 / (25.0 * p)) / x.count);
    printf("variance of explicit over (1-p)/Np: %.3f\n", moments_variance(&x) / variance);
    assert_true(fabs(moments_variance(&x) / variance - 1.0) < noise + 0.04);
    assert_true(fabs((double)v.facet_count - 25.0) < 1e-3);
    glint_material_destroy(m);
}

static void more_facets_than_the_limit_give_the_smooth_value_and_their_number(void **state)
{
    (void)state;
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = GLINT_MODEL_EXPLICIT;
    o.facet_limit = 1000U;
    glint_material *m = create(&o);
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    const glint_light light = { GLINT_LIGHT_CAP, 0.02F };
    const glint_footprint f = { .dudx = 1e-2F, .dvdy = 1e-2F };
    glint_value v;
    glint_eval_value(m, NULL, &f, up, up, &light, &v);
    assert_memory_equal(v.rgb, v.smooth, sizeof(v.rgb));
    assert_true(fabs((double)v.facet_count / 1e4 - 1.0) < 1e-5);
    glint_material_destroy(m);
}

/* ---- blocks of pixels ---- */

enum { SIDE = 48, SPLIT = 4, BORDER = SPLIT, FINE = SIDE * SPLIT + 2 * BORDER, SIZES = 5, ROUNDS = 30 };

typedef struct patch {
    double u, v, j[4]; /* a pixel's place and Jacobian */
    uint32_t seed;
} patch;

static double factor_at(const glint_material *m, const patch *p, double x, double y, double part, const float wo[3],
                        const float wi[3], float solid_angle)
{
    const glint_footprint f = { p->u + p->j[0] * x + p->j[1] * y,
                                p->v + p->j[2] * x + p->j[3] * y,
                                (float)(p->j[0] * part),
                                (float)(p->j[1] * part),
                                (float)(p->j[2] * part),
                                (float)(p->j[3] * part),
                                p->seed };
    const glint_light light = { GLINT_LIGHT_CAP, solid_angle };
    glint_value v;
    glint_eval_value(m, NULL, &f, wo, wi, &light, &v);
    return (double)(v.rgb[0] / v.smooth[0]);
}

/* Adds mean and mean square of k x k blocks, k = 1, 2, 4, 8, 16. */
static void add_blocks(double image[SIDE][SIDE], moments *mean, double square[SIZES])
{
    for (int s = 0; s < SIZES; s++) {
        const int k = 1 << s, count = SIDE / k;
        double sum = 0.0;
        for (int by = 0; by < count; by++)
            for (int bx = 0; bx < count; bx++) {
                double block = 0.0;
                for (int y = 0; y < k; y++)
                    for (int x = 0; x < k; x++)
                        block += image[by * k + y][bx * k + x];
                block /= k * k;
                sum += block * block;
                if (s == 0)
                    moments_add(mean, block);
            }
        square[s] += sum / (count * count) / ROUNDS;
    }
}

typedef struct statistics {
    moments mean;
    double square[SIZES];
} statistics;

static double variance_of(const statistics *s, int k)
{
    return s->square[k] - s->mean.mean * s->mean.mean;
}

/* Explicit under a box and under a tent two pixels wide, from the same fine samples; counting with 16 samples and
 * with 1. */
static void measure(const glint_material *truth, const glint_material *counting, const patch *p, const float wo[3],
                    const float wi[3], float solid_angle, statistics out[4])
{
    static double fine[FINE][FINE], image[SIDE][SIDE];
    for (int y = 0; y < FINE; y++)
        for (int x = 0; x < FINE; x++)
            fine[y][x] = factor_at(truth, p, (x - BORDER + 0.5) / SPLIT, (y - BORDER + 0.5) / SPLIT, 1.0 / SPLIT, wo,
                                   wi, solid_angle);
    for (int kind = 0; kind < 4; kind++) {
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                double sum = 0.0, weight = 0.0;
                for (int a = -BORDER; a < SPLIT + BORDER && kind < 2; a++)
                    for (int b = -BORDER; b < SPLIT + BORDER; b++) {
                        const double dy = fabs((a + 0.5) / SPLIT - 0.5), dx = fabs((b + 0.5) / SPLIT - 0.5);
                        const double w = kind == 0 ? (dx < 0.5 && dy < 0.5) : fmax(0.0, 1.0 - dx) * fmax(0.0, 1.0 - dy);
                        if (w > 0.0)
                            sum += w * fine[BORDER + y * SPLIT + a][BORDER + x * SPLIT + b];
                        weight += w;
                    }
                const int n = kind == 2 ? SPLIT : 1;
                for (int a = 0; a < n && kind >= 2; a++)
                    for (int b = 0; b < n; b++) {
                        sum +=
                            factor_at(counting, p, x + (b + 0.5) / n, y + (a + 0.5) / n, 1.0 / n, wo, wi, solid_angle);
                        weight += 1.0;
                    }
                image[y][x] = sum / weight;
            }
        add_blocks(image, &out[kind].mean, out[kind].square);
    }
}

/* Within 15 % for blocks of 2 x 2 pixels and more and 30 % for single ones, over densities, tilts and pixels between
 * the grids' levels. The noise of the measurement itself comes on top: it is estimated from the number of independent
 * lit facets. */
static void blocks_of_counting_vary_as_those_of_explicit(void **state)
{
    (void)state;
    static const double tilts[] = { 0.0, 60.0, 80.0 }, facets[] = { 0.5, 4.0, 30.0 }, sizes[] = { 1e-3, 1.4e-3 };
    const float solid_angle = 0.02F;
    printf("variance of k x k block means over explicit's, k = 1 2 4 8 16\n");
    for (int t = 0; t < 3; t++)
        for (int n = 0; n < 3; n++) {
            const double tilt = tilts[t] * PI / 180.0, ratio = 1.0 / cos(tilt), size = sizes[(t + n) % 2];
            glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
            o.surface.alpha_x = o.surface.alpha_y = 0.4F;
            o.surface.facets_per_m2 = (float)(facets[n] / (size * size * ratio));
            glint_material *counting = create(&o);
            o.model = GLINT_MODEL_EXPLICIT;
            glint_material *truth = create(&o);
            float wo[3], wi[3];
            direction(tilt, 0.0, wo);
            direction(fabs(tilt - 0.1), tilt > 0.1 ? PI : 0.0, wi);
            statistics s[4];
            memset(s, 0, sizeof(s));
            for (int r = 0; r < ROUNDS; r++) {
                const double turn = 0.7 * r, major = size * ratio;
                const patch p = { 1.3 * r,
                                  0.71 * r,
                                  { major * cos(turn), -size * sin(turn), major * sin(turn), size * cos(turn) },
                                  (uint32_t)(1000 + r) };
                measure(truth, counting, &p, wo, wi, solid_angle, s);
            }
            /* Each lit facet is one event: a variance over E of them is off by sqrt((2 + 1 / events per block) /
             * blocks). */
            const glint_footprint one = { .dudx = (float)(size * ratio), .dvdy = (float)size };
            const glint_light light = { GLINT_LIGHT_CAP, solid_angle };
            glint_value v;
            glint_eval_value(counting, NULL, &one, wo, wi, &light, &v);
            const double lit = (double)(v.facet_count * v.lit_probability);
            for (int filter = 0; filter < 2; filter++) {
                printf("tilt %2.0f N %4.1f %s:", tilts[t], facets[n], filter ? "1 sample, tent" : "16 samples, box");
                for (int k = 0; k < SIZES; k++) {
                    const double got = variance_of(&s[2 + filter], k) / variance_of(&s[filter], k);
                    const double blocks = (double)ROUNDS * (SIDE >> k) * (SIDE >> k), events = lit * (1 << 2 * k);
                    const double noise = sqrt(2.0 * (2.0 + 1.0 / events) / blocks);
                    printf("  %.2f", got);
                    const double bound = k == 0 ? 0.30 : 0.15;
                    if (fabs(got - 1.0) > bound + 3.0 * noise)
                        fail_msg("blocks of %d: %.3f, bound %.2f + 3 x %.3f", 1 << k, got, bound, noise);
                }
                printf("\n");
            }
            glint_material_destroy(counting);
            glint_material_destroy(truth);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_of_explicit_is_smooth_over_the_light),
        cmocka_unit_test(variance_of_explicit_is_binomial),
        cmocka_unit_test(more_facets_than_the_limit_give_the_smooth_value_and_their_number),
        cmocka_unit_test(blocks_of_counting_vary_as_those_of_explicit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
