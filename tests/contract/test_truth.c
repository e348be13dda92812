/* Values against an independent truth: Cook-Torrance in double precision. The mean over seeds: tests/study/mean.c. */
#include "configurations.h"

#include <stdlib.h>

#define PI 3.14159265358979323846

typedef struct double3 {
    double x, y, z;
} double3;

/* F D G2 / (4 cos_o) as the textbooks have it, from the floats that the library gets. */
static double cook_torrance(int beckmann, double ax, double ay, double3 o, double3 i)
{
    double3 h = { o.x + i.x, o.y + i.y, o.z + i.z };
    const double length = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    h = (double3){ h.x / length, h.y / length, h.z / length };
    const double tan2 = (h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay)) / (h.z * h.z);
    const double cos4 = h.z * h.z * h.z * h.z;
    const double d =
        beckmann ? exp(-tan2) / (PI * ax * ay * cos4) : 1.0 / (PI * ax * ay * cos4 * (1.0 + tan2) * (1.0 + tan2));
    double lambda[2];
    for (int k = 0; k < 2; k++) {
        const double3 v = k ? i : o;
        const double a = v.z / sqrt(ax * ax * v.x * v.x + ay * ay * v.y * v.y);
        lambda[k] = beckmann ? 0.5 * (exp(-a * a) / (a * sqrt(PI)) - erfc(a)) : 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    }
    return d / (4.0 * o.z * (1.0 + lambda[0] + lambda[1]));
}

static void smooth_agrees_with_double_precision(void **state)
{
    (void)state;
    uint64_t random = 1;
    double worst[2] = { 0.0, 0.0 };
    for (int k = 0; k < 300000; k++) {
        glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
        o.model = GLINT_MODEL_SMOOTH;
        o.distribution = k & 1 ? GLINT_DISTRIBUTION_BECKMANN : GLINT_DISTRIBUTION_GGX;
        o.surface.alpha_x = (float)random_log_between(&random, 1e-3, 1.0);
        o.surface.alpha_y = k & 2 ? o.surface.alpha_x : (float)random_log_between(&random, 1e-3, 1.0);
        glint_material *m = create(&o);
        float wo[3], wi[3], rgb[3];
        random_direction(&random, wo);
        /* Near the mirror direction, where there is something to compare: the half vector within a few alpha of the
         * normal. */
        const double slope_x = (double)o.surface.alpha_x * random_between(&random, -2.0, 2.0);
        const double slope_y = (double)o.surface.alpha_y * random_between(&random, -2.0, 2.0);
        const double norm = sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
        const double hx = slope_x / norm, hy = slope_y / norm, hz = 1.0 / norm;
        const double dot = 2.0 * (hx * (double)wo[0] + hy * (double)wo[1] + hz * (double)wo[2]);
        wi[0] = (float)(dot * hx - (double)wo[0]);
        wi[1] = (float)(dot * hy - (double)wo[1]);
        wi[2] = (float)(dot * hz - (double)wo[2]);
        glint_eval(m, NULL, NULL, wo, wi, NULL, rgb);
        glint_material_destroy(m);
        if (wi[2] < 1e-3F || wo[2] < 1e-3F)
            continue;
        const double exact = cook_torrance(k & 1, (double)o.surface.alpha_x, (double)o.surface.alpha_y,
                                           (double3){ (double)wo[0], (double)wo[1], (double)wo[2] },
                                           (double3){ (double)wi[0], (double)wi[1], (double)wi[2] });
        worst[k & 1] = fmax(worst[k & 1], fabs((double)rgb[0] / exact - 1.0));
    }
    printf("largest relative error: GGX %.1e, Beckmann %.1e (bound 1e-5)\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-5 && worst[1] < 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_agrees_with_double_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
