/* Lights of real size against brute force, which shares no code with the library. */
#include "area_material.h"
#include "batch_points.h"

#include <stdlib.h>

#define PI AREA_PI

/* D_H by quadrature over slopes: the library has closed forms. */
static double total_area(const area_truth_lobe *l)
{
    enum { RINGS = 2000, TURNS = 128 };
    double sum = 0.0;
    for (int i = 0; i < RINGS; i++) {
        /* slope = a x / (1 - x), dense around the roughness; dw = slope dslope dphi / (1 + slope^2)^(3/2) */
        const double x = (i + 0.5) / RINGS, a = sqrt(l->alpha_x * l->alpha_y), slope = a * x / (1.0 - x);
        const double cosine = 1.0 / sqrt(1.0 + slope * slope), sine = slope * cosine;
        const double ring = slope * a / ((1.0 - x) * (1.0 - x)) * cosine * cosine * cosine / RINGS;
        for (int j = 0; j < TURNS; j++) {
            const double phi = 0.5 * PI * (j + 0.5) / TURNS;
            const double h[3] = { sine * cos(phi), sine * sin(phi), cosine };
            sum += area_truth_density(l, h) * ring * 2.0 * PI / TURNS;
        }
    }
    return sum;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double quantile(double *values, int count, double q)
{
    qsort(values, (size_t)count, sizeof(*values), compare_doubles);
    const int i = (int)(q * count);
    return values[i < count ? i : count - 1];
}

/* ---- exact ---- */

static void check_exact(uint64_t seed, int count, int anisotropic)
{
    uint64_t random = seed;
    double worst = 0.0, worst_facets = 0.0;
    int used = 0;
    while (used < count) {
        const area_case c = area_case_of(&random, anisotropic);
        const area_truth truth = area_truth_of(&c.lobe, c.wo, &c.light, 300);
        if (!area_is_lit(&truth))
            continue;
        used++;
        glint_material *m = material_of(&c, GLINT_MODEL_COUNTING, GLINT_AREA_LIGHT_EXACT);
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        glint_value v;
        glint_eval_area(m, NULL, &f, c.wo, &c.light, &v);
        /* The brute force is refined where it does not agree: its midpoints miss the edge of a narrow lobe. */
        double error = (double)v.smooth[0] / truth.specular - 1.0;
        area_truth finer = truth;
        if (fabs(error) > 2e-3) {
            finer = area_truth_of(&c.lobe, c.wo, &c.light, 1500);
            error = (double)v.smooth[0] / finer.specular - 1.0;
        }
        worst = fmax(worst, fabs(error));
        if (fabs(error) > 0.01)
            fail_msg("kind %d, %s, alpha %g %g, view %.1f degrees, %g sr: %g, by brute force %g", c.light.kind,
                     c.lobe.is_beckmann ? "Beckmann" : "GGX", c.lobe.alpha_x, c.lobe.alpha_y, c.view * 180.0 / PI,
                     truth.solid_angle, (double)v.smooth[0], finer.specular);
        if (used % 4 == 0) {
            const double p = finer.facets / total_area(&c.lobe);
            worst_facets = fmax(worst_facets, fabs((double)v.lit_probability / p - 1.0));
            if (fabs((double)v.lit_probability / p - 1.0) > 0.02)
                fail_msg("p is %g, by brute force %g", (double)v.lit_probability, p);
        }
        glint_material_destroy(m);
    }
    printf("exact, %s: radiance within %.4f, p within %.4f of brute force\n", anisotropic ? "anisotropic" : "isotropic",
           worst, worst_facets);
}

static void exact_is_within_one_percent_everywhere(void **state)
{
    (void)state;
    check_exact(31, 80, 0);
    check_exact(32, 40, 1);
}

/* ---- fast ---- */

static void fast_meets_its_quantiles(void **state)
{
    (void)state;
    enum { COUNT = 1500 };
    static double radiance[2][COUNT], facets[2][COUNT];
    int used[2] = { 0, 0 };
    uint64_t random = 33;
    for (int i = 0; i < COUNT; i++) {
        const area_case c = area_case_of(&random, 0);
        glint_material *fast = material_of(&c, GLINT_MODEL_COUNTING, GLINT_AREA_LIGHT_FAST);
        glint_material *exact = material_of(&c, GLINT_MODEL_COUNTING, GLINT_AREA_LIGHT_EXACT);
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        glint_value v, t, base;
        glint_eval_area(fast, NULL, &f, c.wo, &c.light, &v);
        glint_eval_area(exact, NULL, &f, c.wo, &c.light, &t);
        glint_surface white = glint_material_surface(fast);
        white.diffuse[0] = 1.0F;
        white.f0[0] = white.f90[0] = 0.0F;
        glint_eval_area(fast, &white, &f, c.wo, &c.light, &base);
        const int k = c.lobe.is_beckmann;
        if (t.smooth[0] > 1e-5F * base.smooth[0]) {
            radiance[k][used[k]] = fabs((double)v.smooth[0] / (double)t.smooth[0] - 1.0);
            facets[k][used[k]++] = fabs((double)v.lit_probability / (double)t.lit_probability - 1.0);
        }
        glint_material_destroy(fast);
        glint_material_destroy(exact);
    }
    for (int k = 0; k < 2; k++) {
        const double median = quantile(radiance[k], used[k], 0.5), most = quantile(radiance[k], used[k], 0.95);
        const double median_p = quantile(facets[k], used[k], 0.5), most_p = quantile(facets[k], used[k], 0.95);
        printf("fast, %s: radiance within %.4f in the median, %.4f for 95 %%, %.4f at worst; p %.4f, %.4f, %.4f\n",
               k ? "Beckmann" : "GGX", median, most, radiance[k][used[k] - 1], median_p, most_p,
               facets[k][used[k] - 1]);
        assert_true(used[k] > 400);
        assert_true(median < 0.02);
        assert_true(most < 0.04);
    }
}

/* ---- what holds for every light ---- */

static void base_is_the_exact_form_factor(void **state)
{
    (void)state;
    uint64_t random = 34;
    for (int i = 0; i < 200; i++) {
        area_case c = area_case_of(&random, 0);
        /* Every third hangs below the horizon by about half; not those that pass so close that brute force fails. */
        const int is_cut = i % 3 == 0 && c.light.solid_angle_sr < 1.0F;
        if (is_cut)
            for (uint32_t k = 0; k < 9; k++) {
                if (k < 8)
                    c.light.corners[k][2] -= c.light.center[2];
                else
                    c.light.center[2] = 0.01F;
            }
        const area_truth truth = area_truth_of(&c.lobe, c.wo, &c.light, 400);
        glint_material *m = material_of(&c, GLINT_MODEL_SMOOTH, GLINT_AREA_LIGHT_FAST);
        glint_surface s = glint_material_surface(m);
        for (int k = 0; k < 3; k++) {
            s.diffuse[k] = 1.0F;
            s.f0[k] = s.f90[k] = 0.0F;
        }
        glint_value v;
        glint_eval_area(m, &s, NULL, c.wo, &c.light, &v);
        /* The horizon cuts the brute force's cells: an error of a fraction of one of 400 rows. */
        const double bound = (is_cut ? 4e-3 : 5e-4) * truth.cosine / PI + 1e-9;
        if (fabs((double)v.smooth[0] - truth.cosine / PI) > bound)
            fail_msg("kind %d: %.7g, by brute force %.7g", c.light.kind, (double)v.smooth[0], truth.cosine / PI);
        glint_material_destroy(m);
    }
}

static void small_lights_are_points(void **state)
{
    (void)state;
    uint64_t random = 35;
    for (int i = 0; i < 300; i++) {
        area_case c = area_case_of(&random, 0);
        float d[3];
        memcpy(d, c.light.center, sizeof(d));
        if (d[2] < 0.05F)
            continue;
        c.light = area_light_towards(&random, GLINT_AREA_SUN, d, 1e-8);
        for (int method = 0; method < 2; method++) {
            glint_material *m = material_of(&c, GLINT_MODEL_COUNTING, (glint_area_light_method)method);
            const glint_light cap = { GLINT_LIGHT_CAP, 1e-8F };
            const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
            glint_value v, t;
            glint_eval_area(m, NULL, &f, c.wo, &c.light, &v);
            glint_eval_value(m, NULL, &f, c.wo, d, &cap, &t);
            /* The light's radius of 6e-5 moves D by twice that over alpha^2 >= 1e-2 at most; floats by 1e-5. */
            glint_material_destroy(m);
            if (t.smooth[0] < 1e-6F)
                continue;
            assert_true(fabs((double)v.smooth[0] / ((double)t.smooth[0] * 1e-8) - 1.0) < 0.02);
            assert_true(fabs((double)v.lit_probability / (double)t.lit_probability - 1.0) < 0.02);
        }
    }
}

static void one_sided_lights_shine_to_one_side(void **state)
{
    (void)state;
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    glint_area_light l = { .kind = GLINT_AREA_RECTANGLE,
                           .center = { 0.0F, 0.0F, 1.0F },
                           .half_x = { 0.1F, 0.0F, 0.0F },
                           .half_y = { 0.0F, -0.1F, 0.0F } }; /* half_x x half_y points down */
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int kind = GLINT_AREA_RECTANGLE; kind <= GLINT_AREA_POLYGON; kind++) {
        static const float down[4][3] = {
            { -0.1F, 0.1F, 1.0F }, { 0.1F, 0.1F, 1.0F }, { 0.1F, -0.1F, 1.0F }, { -0.1F, -0.1F, 1.0F }
        };
        l.kind = (glint_area_kind)kind;
        l.half_y[1] = -0.1F;
        l.corner_count = 4U;
        memcpy(l.corners, down, sizeof(down));
        glint_value front, back, both;
        glint_eval_area(m, NULL, NULL, up, &l, &front);
        l.half_y[1] = 0.1F;
        for (int i = 0; i < 4; i++)
            memcpy(l.corners[i], down[3 - i], sizeof(down[0]));
        glint_eval_area(m, NULL, NULL, up, &l, &back);
        l.two_sided = 1U;
        glint_eval_area(m, NULL, NULL, up, &l, &both);
        l.two_sided = 0U;
        assert_true(front.smooth[0] > 0.0F && back.smooth[0] == 0.0F && back.rgb[0] == 0.0F);
        assert_true(fabs((double)both.smooth[0] / (double)front.smooth[0] - 1.0) < 0.2);
    }
}

static void a_hidden_share_takes_light_and_facets(void **state)
{
    (void)state;
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    glint_area_light l = { .kind = GLINT_AREA_SPHERE, .radius = 0.1F, .center = { 0.2F, 0.0F, 1.0F } };
    const glint_footprint f = { .dudx = 1e-4F, .dvdy = 1e-4F };
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        glint_value whole, part;
        l.hidden = 0.0F;
        glint_eval_area(m, NULL, &f, up, &l, &whole);
        l.hidden = 0.75F;
        glint_eval_area(m, NULL, &f, up, &l, &part);
        assert_true(fabs((double)part.smooth[0] / (double)whole.smooth[0] - 0.25) < 1e-5);
        if (row->model == GLINT_MODEL_COUNTING)
            assert_true(fabs((double)part.lit_probability / (double)whole.lit_probability - 0.25) < 1e-5);
    }
}

static void batches_are_single_calls(void **state)
{
    (void)state;
    enum { COUNT = 150 };
    static batch_points points;
    static glint_area_light lights[COUNT];
    uint64_t random = 37;
    FOR_EACH_CONFIGURATION(c, m, row)
    {
        for (int i = 0; i < COUNT; i++) {
            const area_case a = area_case_of(&random, 0);
            const glint_footprint f = random_footprint(&random);
            batch_points_place(&points, i, &f);
            batch_points_light(&points, i, a.wo, a.wo, 0.0F);
            lights[i] = a.light;
        }
        glint_batch b = batch_points_of(&points, row->model == GLINT_MODEL_EXPLICIT ? 10 : COUNT);
        b.area_lights = lights;
        assert_int_equal(glint_eval_batch(m, &b), GLINT_OK);
        for (int i = 0; i < (int)b.count; i++) {
            const glint_footprint f = batch_points_footprint(&points, i);
            const float out[3] = { points.wo[0][i], points.wo[1][i], points.wo[2][i] };
            glint_value value;
            glint_eval_area(m, NULL, &f, out, &lights[i], &value);
            for (int k = 0; k < 3; k++)
                assert_memory_equal(&value.rgb[k], &points.rgb[k][i], sizeof(float));
        }
    }
}

/* The sun of Fig. 6 of Kneiphof and Klein 2024, along the normal: p of Eq. 20, and of the true disk. What the figure
 * prints as R is neither; docs/lights.md. */
static void the_sun_of_figure_6_has_the_chance_that_quadrature_says(void **state)
{
    (void)state;
    static const double roughnesses[] = { 0.1, 0.5, 0.9 };
    const double gamma = 0.26 * PI / 180.0, solid_angle = 2.0 * PI * (1.0 - cos(gamma));
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    for (int i = 0; i < 3; i++) {
        const float alpha = (float)(roughnesses[i] * roughnesses[i]);
        const area_truth_lobe lobe = { 0, (double)alpha, (double)alpha };
        const area_case c = { .lobe = lobe };
        const glint_light cap = { GLINT_LIGHT_CAP, (float)solid_angle };
        const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                       .solid_angle_sr = (float)solid_angle,
                                       .center = { 0.0F, 0.0F, 1.0F } };
        const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
        glint_material *m = material_of(&c, GLINT_MODEL_COUNTING, GLINT_AREA_LIGHT_EXACT);
        glint_value point, disk;
        glint_eval_value(m, NULL, &f, up, up, &cap, &point);
        glint_eval_area(m, NULL, &f, up, &sun, &disk);
        glint_material_destroy(m);
        const double whole = total_area(&lobe);
        const double normal[3] = { 0.0, 0.0, 1.0 };
        const double of_point = solid_angle * area_truth_density(&lobe, normal) / (4.0 * whole);
        const double of_disk = area_truth_of(&lobe, up, &sun, 400).facets / whole;
        printf("roughness %.1f: p as a point %.6g (quadrature %.6g), as a disk %.6g (%.6g)\n", roughnesses[i],
               (double)point.lit_probability, of_point, (double)disk.lit_probability, of_disk);
        /* Floats, and 2000 x 128 points for D_H; the boundary integral is good to 3e-4 of the light's extent. */
        assert_true(fabs((double)point.lit_probability / of_point - 1.0) < 1e-4);
        assert_true(fabs((double)disk.lit_probability / of_disk - 1.0) < 1e-3);
    }
}

/* A panel whose upper edge lies exactly where the mirrored view points: half of the highlight, as its neighbours say.
 */
static void a_rim_through_the_peak_takes_half_of_the_lobe(void **state)
{
    (void)state;
    static const float alphas[] = { 0.01F, 0.09F, 0.36F };
    for (int i = 0; i < 6; i++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.distribution = (glint_distribution)(i / 3);
        o.surface.alpha_x = o.surface.alpha_y = alphas[i % 3];
        o.area_light_method = GLINT_AREA_LIGHT_EXACT;
        glint_material *m = NULL;
        assert_int_equal(glint_material_create(&o, &m, NULL, 0), GLINT_OK);
        float wo[3] = { -2.25F, 0.0F, 1.2F };
        area_unit(wo);
        double at[3];
        const double step = 0.01 * (double)alphas[i % 3];
        for (int k = 0; k < 3; k++) {
            const glint_area_light panel = { .kind = GLINT_AREA_RECTANGLE,
                                             .two_sided = 1U,
                                             .center = { 2.25F, 0.2F, (float)(0.8 + (k - 1) * step) },
                                             .half_x = { 0.0F, 0.5F, 0.0F },
                                             .half_y = { 0.0F, 0.0F, 0.4F } };
            glint_value v;
            glint_eval_area(m, NULL, NULL, wo, &panel, &v);
            at[k] = (double)v.smooth[0];
        }
        glint_material_destroy(m);
        /* What is odd in the step cancels; what is even is of order (step / alpha)^2 = 1e-4, and the integral may be
         * off by its own tolerance. */
        if (!(fabs(at[1] / (0.5 * (at[0] + at[2])) - 1.0) < 2e-3))
            fail_msg("alpha %g: %g between %g and %g", (double)alphas[i % 3], at[1], at[0], at[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rim_through_the_peak_takes_half_of_the_lobe),
        cmocka_unit_test(exact_is_within_one_percent_everywhere),
        cmocka_unit_test(fast_meets_its_quantiles),
        cmocka_unit_test(the_sun_of_figure_6_has_the_chance_that_quadrature_says),
        cmocka_unit_test(base_is_the_exact_form_factor),
        cmocka_unit_test(small_lights_are_points),
        cmocka_unit_test(one_sided_lights_shine_to_one_side),
        cmocka_unit_test(a_hidden_share_takes_light_and_facets),
        cmocka_unit_test(batches_are_single_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
