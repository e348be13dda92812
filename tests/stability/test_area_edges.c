/* The hard cases of lights of real size one by one, each against brute force or against what it must be: edge-on,
 * behind, astride the horizon, touching the surface, of no area, all around. No floating-point exception is raised. */
#define _GNU_SOURCE
#include "traps.h"

#include "area_cases.h"
#include "lobe_truth.h"

#define PI AREA_PI

static const float VIEW[3] = { 0.5F, 0.0F, 0.8660254F };

static glint_material *lobe_material(int is_beckmann, int method, float alpha)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.distribution = is_beckmann ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
    o.area_light_method = (glint_area_light_method)method;
    o.surface.alpha_x = o.surface.alpha_y = alpha;
    return create(&o);
}

static glint_value value_of(const glint_material *m, const glint_area_light *l)
{
    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_value v;
    glint_eval_area(m, NULL, &f, VIEW, l, &v);
    assert_sane(&v);
    return v;
}

/* Both distributions, by both methods, against brute force of side * side points, of which the horizon may cut a row:
 * the share of rows that a test allows for comes on top of 1 %, 4 % for the fast integral. */
static void check(const glint_area_light *l, double alpha, int side, double rows, const char *what, double at)
{
    for (int k = 0; k < 2; k++) {
        const area_truth_lobe lobe = { k, (double)(float)alpha, (double)(float)alpha };
        const area_truth truth = area_truth_of(&lobe, VIEW, l, side);
        for (int method = 0; method < 2 && area_is_lit(&truth); method++) {
            glint_material *m = lobe_material(k, method, (float)alpha);
            const double value = (double)value_of(m, l).smooth[0];
            glint_material_destroy(m);
            const double bound = (method ? 0.01 : 0.04) + rows / side;
            if (!(fabs(value / truth.specular - 1.0) <= bound))
                fail_msg("%s at %g, kind %d, %s, alpha %g: %.6g, by brute force %.6g (%+.4f, at most %.4f)", what, at,
                         (int)l->kind, method ? "exact" : "fast", alpha, value, truth.specular,
                         value / truth.specular - 1.0, bound);
        }
    }
}

/* One of each model, made once. */
enum { KINDS_OF_MODEL = sizeof(MODELS) / sizeof(MODELS[0]) };
static glint_material *one_of_each[KINDS_OF_MODEL];

static int make_materials(void **state)
{
    (void)state;
    for (int i = 0; i < KINDS_OF_MODEL; i++) {
        const configuration c = configuration_of(MODELS[i].model, 2); /* the example with a map, two layers */
        one_of_each[i] = create(&c.options);
    }
    return 0;
}

static int free_materials(void **state)
{
    (void)state;
    for (int i = 0; i < KINDS_OF_MODEL; i++)
        glint_material_destroy(one_of_each[i]);
    return 0;
}

static void assert_dark(const glint_area_light *l)
{
    for (int i = 0; i < KINDS_OF_MODEL; i++) {
        const glint_value v = value_of(one_of_each[i], l);
        for (int k = 0; k < 3; k++)
            assert_true(v.rgb[k] == 0.0F && v.smooth[k] == 0.0F);
    }
}

/* The same shape as a rectangle, a disk and a polygon. */
static glint_area_light flat(glint_area_kind kind, const float center[3], const float x[3], const float y[3])
{
    static const float turn[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    glint_area_light l = { .kind = kind, .two_sided = 1U, .corner_count = 4U };
    for (int k = 0; k < 3; k++) {
        l.center[k] = center[k];
        l.half_x[k] = x[k];
        l.half_y[k] = y[k];
        for (int i = 0; i < 4; i++)
            l.corners[i][k] = center[k] + turn[i][0] * x[k] + turn[i][1] * y[k];
    }
    return l;
}

static void a_light_seen_edge_on_fades_and_goes_out(void **state)
{
    (void)state;
    static const double tilts[] = { 0.3, 0.03, 3e-3, 3e-4, 0.0 };
    for (int kind = GLINT_AREA_RECTANGLE; kind <= GLINT_AREA_POLYGON; kind++)
        for (int i = 0; i < 5; i++) {
            /* A plane through the point, and how far it is tilted out of that; of numbers that floats have. */
            const float center[3] = { -0.5F, 0.0F, 0.75F }, across[3] = { 0.0F, 0.25F, 0.0F };
            const float along[3] = { (float)(-0.125 + 0.1875 * tilts[i]), 0.0F, (float)(0.1875 + 0.125 * tilts[i]) };
            const glint_area_light l = flat((glint_area_kind)kind, center, across, along);
            if (tilts[i] > 0.0)
                check(&l, 0.3, 200, 0.0, "tilt", tilts[i]);
            else
                assert_dark(&l);
        }
}

/* In any direction: a half axis is half of the way to the middle, exactly, so that the plane holds the point; what
 * doubles make of the distance is rounding, and no light. */
static void a_light_in_a_plane_through_the_point_is_dark(void **state)
{
    (void)state;
    uint64_t random = 61;
    for (int i = 0; i < 4000; i++) {
        float center[3], along[3], across[3];
        for (int k = 0; k < 3; k++) {
            center[k] = (float)random_between(&random, k < 2 ? -1.0 : 0.1, 1.0);
            along[k] = 0.5F * center[k];
            across[k] = (float)random_between(&random, -0.5, 0.5);
        }
        const glint_area_light l = flat(i % 2 ? GLINT_AREA_RECTANGLE : GLINT_AREA_DISK, center, across, along);
        assert_dark(&l);
    }
}

static void a_light_behind_shows_nothing(void **state)
{
    (void)state;
    const float x[3] = { 0.3F, 0.0F, 0.0F }, y[3] = { 0.0F, 0.3F, 0.0F };
    const float above[3] = { -0.3F, 0.0F, 1.0F }, below[3] = { -0.3F, 0.0F, -1.0F };
    for (int kind = GLINT_AREA_SUN; kind <= GLINT_AREA_POLYGON; kind++) {
        glint_area_light l = flat((glint_area_kind)kind, below, x, y);
        l.radius = 0.5F;
        l.solid_angle_sr = 0.5F;
        assert_dark(&l); /* below the horizon */
        if (kind < GLINT_AREA_RECTANGLE)
            continue;
        l = flat((glint_area_kind)kind, above, x, y);
        l.two_sided = 0U; /* half_x x half_y points up, away from the point */
        assert_dark(&l);
    }
}

static void a_light_astride_the_horizon_shows_its_upper_part(void **state)
{
    (void)state;
    static const double heights[] = { 0.29, 0.1, 0.0, -0.1, -0.25 };
    const float x[3] = { 0.0F, 0.3F, 0.0F }, y[3] = { 0.05F, 0.0F, 0.3F };
    for (int kind = GLINT_AREA_SUN; kind <= GLINT_AREA_POLYGON; kind++)
        for (int i = 0; i < 5; i++) {
            const float center[3] = { -1.0F, 0.1F, (float)heights[i] };
            glint_area_light l = flat((glint_area_kind)kind, center, x, y);
            l.radius = 0.3F;
            l.solid_angle_sr = (float)(2.0 * PI * (1.0 - cos(0.3)));
            /* A row of points is cut at the horizon, of those that are left a tenth at least. */
            check(&l, 0.5, 350, 10.0, "height", heights[i]);
        }
}

static void a_light_that_touches_the_surface_is_no_exception(void **state)
{
    (void)state;
    static const double distances[] = { 0.3, 0.1, 0.03 };
    const float across[3] = { 0.0F, 0.5F, 0.0F }, up[3] = { 0.0F, 0.0F, 0.5F };
    for (int kind = GLINT_AREA_RECTANGLE; kind <= GLINT_AREA_POLYGON; kind++)
        for (int i = 0; i < 3; i++) { /* a wall on the floor, closer and closer */
            const float center[3] = { (float)-distances[i], 0.1F, 0.5F };
            const glint_area_light l = flat((glint_area_kind)kind, center, across, up);
            check(&l, 0.4, 400, 0.0, "distance", distances[i]);
        }
    /* On the point itself: with a corner, with a side, and lying on it. What a corner's neighbourhood shows. */
    const float corner[3] = { -0.3F, 0.3F, 0.3F }, x[3] = { -0.3F, 0.0F, 0.3F }, y[3] = { 0.0F, 0.3F, 0.0F };
    const float beside[3] = { -0.301F, 0.3F, 0.3F };
    for (int k = 0; k < 4; k++) {
        glint_material *m = lobe_material(k & 1, k >> 1, 0.4F);
        const glint_area_light there = flat(GLINT_AREA_RECTANGLE, corner, x, y);
        const glint_area_light close_by = flat(GLINT_AREA_RECTANGLE, beside, x, y);
        const double on = (double)value_of(m, &there).smooth[0], off = (double)value_of(m, &close_by).smooth[0];
        /* The corner is a plane through the point: half of what stands in front of it is seen edge-on. */
        assert_true(on <= off * 1.05);
        glint_material_destroy(m);
    }
    const float nowhere[3] = { 0.0F, 0.0F, 0.0F }, flat_x[3] = { 0.3F, 0.0F, 0.0F };
    const glint_area_light on_it = flat(GLINT_AREA_RECTANGLE, nowhere, flat_x, y);
    assert_dark(&on_it);
    const glint_area_light around = { .kind = GLINT_AREA_SPHERE, .radius = 1.0F, .center = { 0.0F, 0.0F, 1.0F } };
    assert_dark(&around); /* it touches from outside; from there on the point is within */
}

static void a_light_of_no_area_shows_nothing_and_a_small_one_its_area(void **state)
{
    (void)state;
    const float center[3] = { -0.5F, 0.1F, 0.8F }, none[3] = { 0.0F, 0.0F, 0.0F };
    for (int kind = GLINT_AREA_SUN; kind <= GLINT_AREA_POLYGON; kind++) {
        const glint_area_light l = flat((glint_area_kind)kind, center, none, none);
        assert_dark(&l);
        const float thin[3] = { 0.0F, 0.2F, 0.0F };
        const glint_area_light line =
            flat((glint_area_kind)kind, center, thin, kind == GLINT_AREA_RECTANGLE ? none : thin);
        if (kind >= GLINT_AREA_RECTANGLE)
            assert_dark(&line);
        for (int k = 0; k < 4; k++) {
            glint_material *m = lobe_material(k & 1, k >> 1, 0.3F);
            double per_area[2];
            for (int i = 0; i < 2; i++) {
                const float size = i ? 1e-6F : 1e-3F;
                const float x[3] = { size, 0.0F, 0.0F }, y[3] = { 0.0F, size, 0.0F };
                glint_area_light small = flat((glint_area_kind)kind, center, x, y);
                small.radius = size;
                small.solid_angle_sr = size * size;
                per_area[i] = (double)value_of(m, &small).smooth[0] / ((double)size * (double)size);
            }
            /* A thousandth across changes the lobe by (1e-3 / alpha)^2; floats give the light's corners by 6e-8 of a
             * millionth. A flat light of 1e-6 m has corners that are 6 % off: rounding of where it is. */
            const double bound = kind == GLINT_AREA_POLYGON ? 0.15 : 1e-3;
            if (!(fabs(per_area[1] / per_area[0] - 1.0) < bound))
                fail_msg("kind %d: %g per area, %g for a smaller one", kind, per_area[0], per_area[1]);
            glint_material_destroy(m);
        }
    }
}

/* A disk seen nearly edge-on, moved past the mirrored view: where its rim passes closely, the azimuth around the peak
 * turns by half a circle at once. The fit of the fast integral is not asked. */
static void a_rim_may_pass_the_mirrored_view_closely(void **state)
{
    (void)state;
    const double alpha = (double)0.1F, view = 70.0 * PI / 180.0, s = sin(view), c = cos(view), radius = 0.5;
    const float wo[3] = { (float)s, 0.0F, (float)c };
    /* Along the ray that is mirrored, but for five degrees; across it. */
    const double tilt = 85.0 * PI / 180.0, u = radius * cos(tilt), w = radius * sin(tilt);
    const double x[3] = { u * c - w * s, 0.0, u * s + w * c }, y[3] = { 0.0, radius, 0.0 };
    for (int k = 0; k < 2; k++) {
        glint_material *m = lobe_material(k, GLINT_AREA_LIGHT_EXACT, (float)alpha);
        const area_truth_lobe lobe = { k, alpha, alpha };
        for (int i = 0; i < 52; i++) {
            const double angle = PI / 3.0 * (i / 13), past = 1.0 + 0.004 * alpha * (i % 13 - 6) / radius;
            glint_area_light l = { .kind = GLINT_AREA_DISK, .two_sided = 1U };
            for (int d = 0; d < 3; d++) {
                const double mirrored = d == 0 ? -s : d == 1 ? 0.0 : c;
                l.half_x[d] = (float)x[d];
                l.half_y[d] = (float)y[d];
                l.center[d] = (float)(mirrored - past * (cos(angle) * x[d] + sin(angle) * y[d]));
            }
            const area_truth truth = area_truth_of(&lobe, wo, &l, 300);
            glint_value v;
            glint_eval_area(m, NULL, NULL, wo, &l, &v);
            /* Half of what the exact integral promises. */
            if (!(fabs((double)v.smooth[0] / truth.specular - 1.0) <= 0.005))
                fail_msg("distribution %d, %.0f degrees along the rim, %+.3f of the lobe's width beyond it: %.6g, by "
                         "brute force %.6g",
                         k, angle * 180.0 / PI, (past - 1.0) * radius / alpha, (double)v.smooth[0], truth.specular);
        }
        glint_material_destroy(m);
    }
}

/* What covers the whole sky is the sky, whatever its shape. */
static void lights_all_around_are_alike(void **state)
{
    (void)state;
    static const float alphas[] = { 0.01F, 0.1F, 0.5F, 1.0F };
    const float center[3] = { 0.0F, 0.0F, 1.0F }, x[3] = { 1e4F, 0.0F, 0.0F }, y[3] = { 0.0F, 1e4F, 0.0F };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            glint_material *m = lobe_material(k & 1, k >> 1, alphas[i]);
            glint_area_light sky = { .kind = GLINT_AREA_SUN,
                                     .solid_angle_sr = 6.28318531F,
                                     .center = { 0.0F, 0.0F, 1.0F } };
            const double expected = (double)value_of(m, &sky).smooth[0];
            for (int kind = GLINT_AREA_SPHERE; kind <= GLINT_AREA_POLYGON; kind++) {
                glint_area_light l = flat((glint_area_kind)kind, center, x, y);
                l.radius = 0.99999994F; /* just below its distance: 89.98 degrees to each side */
                const double value = (double)value_of(m, &l).smooth[0];
                if (!(fabs(value / expected - 1.0) < 0.01))
                    fail_msg("kind %d, %s, alpha %g: %g, the sky %g", kind, k >> 1 ? "exact" : "fast",
                             (double)alphas[i], value, expected);
            }
            glint_material_destroy(m);
        }
}

/* The area of facets that mirror the view above the horizon, over that of all: the midpoint rule over half vectors. */
static double facets_that_see_the_sky(int is_beckmann, double alpha)
{
    enum { ROWS = 400 };
    const wide_lobe l = { !is_beckmann, (wide)alpha, (wide)alpha };
    wide lit = 0.0L, all = 0.0L;
    for (int i = 0; i < ROWS; i++)
        for (int k = 0; k < ROWS; k++) {
            const double theta = 0.5 * PI * (i + 0.5) / ROWS, phi = 2.0 * PI * (k + 0.5) / ROWS, s = sin(theta);
            const wide h[3] = { (wide)(s * cos(phi)), (wide)(s * sin(phi)), (wide)cos(theta) };
            const wide dot = (wide)VIEW[0] * h[0] + (wide)VIEW[2] * h[2], area = wide_density(&l, h) * (wide)s;
            all += area;
            lit += dot > 0.0L && 2.0L * dot * h[2] > (wide)VIEW[2] ? area : 0.0L;
        }
    return (double)(lit / all);
}

/* The limit of what p may be, where D at the middle of the light says forty times as much. */
static void the_whole_sky_lights_the_facets_that_mirror_it(void **state)
{
    (void)state;
    static const float alphas[] = { 0.1F, 0.3F, 0.6F };
    const glint_area_light sky = { .kind = GLINT_AREA_SUN,
                                   .solid_angle_sr = 6.28318531F,
                                   .center = { 0.0F, 0.0F, 1.0F } };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) {
            glint_material *m = lobe_material(k & 1, k >> 1, alphas[i]);
            const double p = (double)value_of(m, &sky).lit_probability;
            const double expected = facets_that_see_the_sky(k & 1, (double)alphas[i]);
            /* What the integrals promise, and half a row of the quadrature where it is cut. */
            const double bound = (k >> 1 ? 0.01 : 0.04) + 0.5 / 400;
            if (!(fabs(p / expected - 1.0) < bound))
                fail_msg("distribution %d, %s, alpha %g: p %.5f, expected %.5f", k & 1, k >> 1 ? "exact" : "fast",
                         (double)alphas[i], p, expected);
            glint_material_destroy(m);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_light_seen_edge_on_fades_and_goes_out, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_in_a_plane_through_the_point_is_dark, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_behind_shows_nothing, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_astride_the_horizon_shows_its_upper_part, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_that_touches_the_surface_is_no_exception, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(a_light_of_no_area_shows_nothing_and_a_small_one_its_area, with_traps,
                                        without_traps),
        cmocka_unit_test_setup_teardown(a_rim_may_pass_the_mirrored_view_closely, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(lights_all_around_are_alike, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(the_whole_sky_lights_the_facets_that_mirror_it, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, make_materials, free_materials);
}
