/* When the renderer takes a sun for a cap of directions, and when for the disk that it is, against brute force. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "area_truth.h"
#define WIDE_LANES 1
#include "preview/sight_lanes.h"
#include "statistics.h"

#define PI 3.14159265358979323846

/* Half a degree of sun on lacquers and metals, as the renderer sees it: a cap where that is within 1 % of brute force,
 * a shape where it is not. */
static void a_sun_is_a_cap_only_where_that_shows_not(void **state)
{
    (void)state;
    static const double alphas[] = { 1e-3, 3e-3, 0.01, 0.02, 0.03, 0.1, 0.3 }, views[] = { 0.0, 0.6, 1.1, 1.3 };
    const double angle = 0.5 * 0.53 * PI / 180.0;
    double worst = 0.0, spared = 0.0;
    uint64_t random = 61;
    int caps = 0, shapes = 0;
    for (int i = 0; i < 7 * 4 * 60; ++i) {
        const double alpha = (double)(float)alphas[i % 7], view = views[i / 7 % 4];
        shade_point p = { .layer_count = 1 };
        shade_layer *const l = &p.layers[0];
        *l = (shade_layer){ .x = { 1, 0, 0 }, .y = { 0, 1, 0 }, .z = { 0, 0, 1 } };
        l->wo[0] = (float)sin(view);
        l->wo[2] = (float)cos(view);
        l->surface.alpha_x = l->surface.alpha_y = (float)alpha;
        /* From the middle of the highlight to thirty lobes away. */
        const double far = 2.0 * alpha * random_log_between(&random, 1e-2, 30.0),
                     turn = random_between(&random, 0.0, 2.0 * PI);
        const float wi[3] = { (float)(-sin(view) + far * cos(turn) * cos(view)), (float)(far * sin(turn)),
                              (float)(cos(view) + far * cos(turn) * sin(view)) };
        const float length = sqrtf(wi[0] * wi[0] + wi[1] * wi[1] + wi[2] * wi[2]);
        const float unit[3] = { wi[0] / length, wi[1] / length, wi[2] / length };
        if ((double)unit[2] < 0.1)
            continue;
        const area_truth_lobe lobe = { 0, alpha, alpha };
        const glint_area_light sun = { .kind = GLINT_AREA_SUN,
                                       .center = { unit[0], unit[1], unit[2] },
                                       .solid_angle_sr = (float)(2.0 * PI * (1.0 - cos(angle))) };
        const glint_area_light point = { .kind = GLINT_AREA_SUN,
                                         .center = { unit[0], unit[1], unit[2] },
                                         .solid_angle_sr = 1e-10F };
        const area_truth whole = area_truth_of(&lobe, l->wo, &sun, 100),
                         middle = area_truth_of(&lobe, l->wo, &point, 4);
        const double error = fabs(middle.specular / middle.solid_angle * whole.solid_angle / whole.specular - 1.0);
        wide_mask is_lit = 0, is_shape_seen = 0;
        const wide_layer layer = sight_layer_of(&p.layers[0]);
        layer_sees(&layer, w3_splat(v3_from(unit)), sin(angle), &is_lit, &is_shape_seen);
        if (wide_any(is_shape_seen)) {
            ++shapes;
            spared = fmax(spared, error);
            continue;
        }
        ++caps;
        worst = fmax(worst, error);
        if (error > 0.0125) /* the next term of the series adds a quarter at most where the first is 1 % */
            fail_msg("alpha %g, view %.1f, %.3g lobes away: a cap is off by %.4f", alpha, view, 0.5 * far / alpha,
                     error);
    }
    printf("%d caps within %.4f, %d shapes, of which a cap would be off by up to %.2f\n", caps, worst, shapes, spared);
    assert_true(caps > 400 && shapes > 200 && spared > 0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sun_is_a_cap_only_where_that_shows_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
