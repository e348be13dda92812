/* No light of real size is lost: sums over many lights, and over the parts of one. */
#include "area_material.h"

#define PI AREA_PI

/* Sums over the lights of one cell of roughness and view. */
typedef struct light_balance {
    double fast, truth, squares; /* squares: of fast - truth */
    int count;
} light_balance;

/* The fast integral over brute force, for light as a whole, and its standard error as a ratio of sums. */
static double balance_of(const light_balance *b, double *error)
{
    const double ratio = b->fast / b->truth, off = b->fast - b->truth;
    *error = sqrt(fmax(b->squares - off * off / b->count, 0.0)) / b->truth;
    return ratio - 1.0;
}

enum { ROUGHNESSES = 3, VIEWS = 3 };

static double smooth_of(const area_case *c, glint_area_light_method method)
{
    glint_material *m = material_of(c, GLINT_MODEL_COUNTING, method);
    const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
    glint_value value;
    glint_eval_area(m, NULL, &f, c->wo, &c->light, &value);
    glint_material_destroy(m);
    return (double)value.smooth[0];
}

/* Adds a light to the cell of its roughness and view until that has `each`. 0: it had. */
static int weigh_light(light_balance all[2][ROUGHNESSES][VIEWS], const area_case *c, double fast, double truth,
                       int each)
{
    const int r = (int)((c->roughness - 0.1) / 0.9 * ROUGHNESSES), v = (int)(c->view / (85.0 * PI / 180.0) * VIEWS);
    light_balance *const b = &all[c->lobe.is_beckmann][r < ROUGHNESSES ? r : 2][v < VIEWS ? v : 2];
    if (b->count >= each)
        return 0;
    b->fast += fast;
    b->truth += truth;
    b->squares += (fast - truth) * (fast - truth);
    b->count++;
    return 1;
}

/* Within `most` beyond four standard errors. */
static int count_lost_light(light_balance all[2][ROUGHNESSES][VIEWS], const char *what, double most)
{
    int failed = 0;
    for (int k = 0; k < 2; k++)
        for (int r = 0; r < ROUGHNESSES; r++) {
            printf("%s, %s, roughness %.1f to %.1f:", what, k ? "Beckmann" : "GGX", 0.1 + 0.3 * r, 0.4 + 0.3 * r);
            for (int v = 0; v < VIEWS; v++) {
                double error;
                const double bias = balance_of(&all[k][r][v], &error);
                printf("  %+.4f +- %.4f", bias, error);
                failed += fabs(bias) > most + 4.0 * error;
            }
            printf("   expected 0 +- %g\n", most);
        }
    return failed;
}

/* Errors of single lights have either sign; a picture is off by what they have in common. At most half a percent, half
 * of what the exact integral of a single light may be off, beyond what chance explains. Brute force takes too long for
 * enough lights to tell: it weighs the exact integral, on fewer, and that the fast one. */
static void fast_keeps_the_light_of_all_lights(void **state)
{
    (void)state;
    enum { FEW = 12, MANY = 1500, CELLS = 2 * ROUGHNESSES * VIEWS };
    static light_balance few[2][ROUGHNESSES][VIEWS], many[2][ROUGHNESSES][VIEWS];
    uint64_t random = 38;
    for (int left = CELLS * FEW; left > 0;) {
        const area_case c = area_case_of(&random, 0);
        const area_truth truth = area_truth_of(&c.lobe, c.wo, &c.light, 300);
        if (area_is_lit(&truth))
            left -= weigh_light(few, &c, smooth_of(&c, GLINT_AREA_LIGHT_EXACT), truth.specular, FEW);
    }
    for (int left = CELLS * MANY; left > 0;) {
        const area_case c = area_case_of(&random, 0);
        const double truth = smooth_of(&c, GLINT_AREA_LIGHT_EXACT);
        if (truth > 1e-6)
            left -= weigh_light(many, &c, smooth_of(&c, GLINT_AREA_LIGHT_FAST), truth, MANY);
    }
    int failed = count_lost_light(few, "exact over brute force", 0.005);
    failed += count_lost_light(many, "fast over exact", 0.005);
    assert_int_equal(failed, 0);
}

/* Appendix C of Kneiphof and Klein 2024 (Fig. 9): a light in K parts gives what the whole gives. */
static void parts_of_a_light_add_up(void **state)
{
    (void)state;
    enum { K = 4 };
    uint64_t random = 36;
    double worst[2] = { 0.0, 0.0 }, worst_p[2] = { 0.0, 0.0 };
    for (int i = 0; i < 60; i++) {
        area_case c = area_case_of(&random, 0);
        c.light.kind = GLINT_AREA_RECTANGLE;
        for (int method = 0; method < 2; method++) {
            glint_material *m = material_of(&c, GLINT_MODEL_COUNTING, (glint_area_light_method)method);
            const glint_footprint f = { .dudx = 1e-3F, .dvdy = 1e-3F };
            glint_value whole, part;
            glint_eval_area(m, NULL, &f, c.wo, &c.light, &whole);
            double sum = 0.0, p = 0.0;
            for (int a = 0; a < K; a++)
                for (int b = 0; b < K; b++) {
                    glint_area_light l = c.light;
                    for (int k = 0; k < 3; k++) {
                        l.center[k] += c.light.half_x[k] * (float)((2.0 * a + 1.0) / K - 1.0) +
                                       c.light.half_y[k] * (float)((2.0 * b + 1.0) / K - 1.0);
                        l.half_x[k] /= K;
                        l.half_y[k] /= K;
                    }
                    glint_eval_area(m, NULL, &f, c.wo, &l, &part);
                    sum += (double)part.smooth[0];
                    p += (double)part.lit_probability;
                }
            if (whole.smooth[0] > 1e-6F) {
                worst[method] = fmax(worst[method], fabs(sum / (double)whole.smooth[0] - 1.0));
                worst_p[method] = fmax(worst_p[method], fabs(p / (double)whole.lit_probability - 1.0));
            }
            glint_material_destroy(m);
        }
    }
    printf("parts of a light over the whole: exact within %.4f (p %.4f), fast within %.4f (p %.4f)\n", worst[1],
           worst_p[1], worst[0], worst_p[0]);
    assert_true(worst[1] < 0.01 && worst_p[1] < 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fast_keeps_the_light_of_all_lights),
        cmocka_unit_test(parts_of_a_light_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
