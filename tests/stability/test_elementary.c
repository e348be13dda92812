/* The functions that everything else is made of, against long double, over all that they may be given. A bound counts
 * the roundings that add up at worst; what a polynomial leaves out is said beside it. */
#define _GNU_SOURCE
#include "traps.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/real.h"
#include "ndf/distributions.h"
#include "wide.h"

enum { MANY = 2000000 };

/* Every float between two of the same sign, or one in so many of them. */
typedef struct floats {
    uint32_t from, to, step;
} floats;

static floats floats_between(float low, float high)
{
    uint32_t from, to;
    memcpy(&from, &low, sizeof(from));
    memcpy(&to, &high, sizeof(to));
    return (floats){ from, to, (to - from) / MANY + 1 };
}

static void exponential_keeps_its_digits(void **state)
{
    (void)state;
    worst_error alone = { 0 };
    const floats f = floats_between(1e-30F, 86.9F);
    for (uint32_t u = f.from; u < f.to; u += f.step) {
        const float t = -float_of(u);
        /* The reduced argument is off by half an ulp of .35, a quarter of a rounding; the polynomial's terms below one
         * add one and a half times .41 of it, the last sum one, over at least .7; the fit 2e-8. */
        worst_add(&alone, relative_error((double)exp_negative(t), expl((wide)t)), 3.0L * FLOAT_ROUNDING, (double)t, 0,
                  0);
    }
    assert_true(worst_holds(&alone, "exp_negative", (double)FLOAT_ROUNDING));
    assert_true(exp_negative(-87.1F) == 0.0F && exp_negative(-3e38F) == 0.0F && exp_negative(0.0F) == 1.0F);
}

static void power_of_two_and_what_it_misses_keep_their_digits(void **state)
{
    (void)state;
    worst_error whole = { 0 }, missing = { 0 };
    const floats f = floats_between(1e-30F, 90.0F);
    for (uint32_t u = f.from; u < f.to; u += f.step) {
        float miss, e;
        const float t = -float_of(u);
        exp2_both(t, 31, &miss, &e);
        /* The polynomial's terms below one add two and a half times .41 of a rounding, the last sum one, over at least
         * .7; the fit 6e-9. */
        const wide bound = 3.0L * FLOAT_ROUNDING;
        worst_add(&whole, relative_error((double)e * 0x1p-31, exp2l((wide)t)), bound, (double)t, 0, 0);
        /* 1 - 2^t loses another rounding where 2^t is taken from 1, at .29 at least. */
        worst_add(&missing, relative_error((double)miss * 0x1p-31, -expm1l((wide)t * logl(2.0L))),
                  bound + FLOAT_ROUNDING, (double)t, 0, 0);
    }
    int ok = worst_holds(&whole, "exp2_both, 2^t", (double)FLOAT_ROUNDING);
    ok &= worst_holds(&missing, "exp2_both, 1 - 2^t", (double)FLOAT_ROUNDING);
    assert_true(ok);
}

static void logarithms_keep_their_digits(void **state)
{
    (void)state;
    worst_error log_of = { 0 }, log_of_miss = { 0 };
    floats f = floats_between(1.18e-38F, 3.4e38F);
    /* Around one, where the logarithm vanishes, all of them. */
    for (uint32_t u = 0x3f700000U; u < 0x3f900000U; u++)
        worst_add(&log_of, relative_error((double)log_f(float_of(u)), logl((wide)float_of(u))), 4.0L * FLOAT_ROUNDING,
                  (double)float_of(u), 0, 0);
    for (uint32_t u = f.from; u < f.to; u += f.step)
        worst_add(&log_of, relative_error((double)log_f(float_of(u)), logl((wide)float_of(u))), 4.0L * FLOAT_ROUNDING,
                  (double)float_of(u), 0, 0);
    f = floats_between(1e-37F, 0.5F);
    /* Two roundings of the quotient, one of the sum, half of one of the rest. */
    for (uint32_t u = f.from; u <= f.to; u += f.step)
        worst_add(&log_of_miss,
                  relative_error((double)log2_of_miss(float_of(u)), log1pl(-(wide)float_of(u)) / logl(2.0L)),
                  4.0L * FLOAT_ROUNDING, (double)float_of(u), 0, 0);
    int ok = worst_holds(&log_of, "log_f", (double)FLOAT_ROUNDING);
    ok &= worst_holds(&log_of_miss, "log2_of_miss", (double)FLOAT_ROUNDING);
    assert_true(ok);
    assert_true(log2_of_miss(0.0F) == 0.0F && log_f(1.0F) == 0.0F);
}

static void angles_keep_their_digits(void **state)
{
    (void)state;
    worst_error sine = { 0 }, cosine = { 0 }, turn = { 0 };
    for (uint32_t i = 0; i < 1U << 24; i += 7) {
        const float x = (float)i * 0x1p-24F;
        float s, c;
        sincos_pi(x, &s, &c);
        /* Taylor's series in y^2, whose first missing term is .00193 y^12. Horner's rule up to y^2 = 1/4: 4.9 y^2
         * carries four roundings of one, with those of y and of the coefficient; the sum with 1 is the fifth. */
        const wide y2 = ((wide)x - 0.5L) * ((wide)x - 0.5L), missing = 0.00193L * y2 * y2 * y2 * y2 * y2 * y2;
        worst_add(&sine, (wide)s - sinl(WIDE_PI * (wide)x), missing + 5.0L * FLOAT_ROUNDING, (double)x, 0, 0);
        /* Relative, since it is y times a sum near pi: also where the cosine vanishes. */
        worst_add(&cosine, relative_error((double)c, cosl(WIDE_PI * (wide)x)), 6.0L * FLOAT_ROUNDING, (double)x, 0, 0);
    }
    uint64_t random = 1;
    for (int i = 0; i < MANY; i++) {
        const float size = (float)random_log_between(&random, 1e-30, 1e15);
        const float x = (float)random_between(&random, -1.0, 1.0) * size;
        const float y = (float)(random_between(&random, -1.0, 1.0) * random_log_between(&random, 1e-6, 1.0)) * size;
        wide exact = atan2l((wide)y, (wide)x) / (2.0L * WIDE_PI);
        exact = exact < 0.0L ? exact + 1.0L : exact;
        const wide error = fabsl((wide)turn_of(y, x) - exact);
        /* Of a turn: the last difference rounds at one, the two before at a half and a quarter; four roundings of an
         * eighth before that. */
        worst_add(&turn, fminl(error, 1.0L - error), 2.5L * FLOAT_ROUNDING, (double)x, (double)y, 0);
    }
    int ok = worst_holds(&sine, "sincos_pi, sine (absolute)", (double)FLOAT_ROUNDING);
    ok &= worst_holds(&cosine, "sincos_pi, cosine", (double)FLOAT_ROUNDING);
    ok &= worst_holds(&turn, "turn_of (absolute)", (double)FLOAT_ROUNDING);
    assert_true(ok);
    assert_true(turn_of(0.0F, 0.0F) == 0.0F && turn_of(-1e-30F, 1.0F) < 1.0F);
}

/* x with P(X < x) = u, by Newton's method on the distribution function. */
static wide exact_quantile(wide u)
{
    wide z = 0.0L;
    for (int i = 0; i < 60; i++) {
        const wide tail = 0.5L * erfcl(-z / sqrtl(2.0L));
        const wide density = expl(-0.5L * z * z) / sqrtl(2.0L * WIDE_PI);
        const wide step = (tail - u) / density;
        z -= fmaxl(-0.5L, fminl(0.5L, step));
        if (fabsl(step) < 1e-15L)
            break;
    }
    return z;
}

static void quantile_is_as_near_as_it_says(void **state)
{
    (void)state;
    worst_error within_2 = { 0 }, within_5 = { 0 }, whole_within_2 = { 0 }, whole_within_5 = { 0 };
    for (int i = -20000; i <= 20000; i++) {
        /* Dense at both ends. */
        const float x = (float)tanh(i / 20000.0 * 8.0);
        if (fabsf(x) >= 1.0F)
            continue;
        const wide exact = exact_quantile(0.5L * (1.0L + (wide)x));
        const wide error = (wide)normal_quantile(x) - exact;
        const wide whole_error = (wide)normal_quantile_i((vint)((double)x * 0x1p31)) - exact;
        if (fabsl(exact) < 2.0L) {
            worst_add(&within_2, error, 0.0009L, (double)x, 0, 0);
            worst_add(&whole_within_2, whole_error, 0.0003L, (double)x, 0, 0);
        } else if (fabsl(exact) < 5.0L) {
            worst_add(&within_5, error, 0.0031L, (double)x, 0, 0);
            worst_add(&whole_within_5, whole_error, 0.023L, (double)x, 0, 0);
        }
    }
    int ok = worst_holds(&within_2, "normal_quantile, 2 sigma (1 = 1)", 1.0);
    ok &= worst_holds(&within_5, "normal_quantile, 5 sigma (1 = 1)", 1.0);
    ok &= worst_holds(&whole_within_2, "normal_quantile_i, 2 sigma (1 = 1)", 1.0);
    ok &= worst_holds(&whole_within_5, "normal_quantile_i, 5 sigma (1 = 1)", 1.0);
    assert_true(ok);
}

static void doubles_keep_their_digits(void **state)
{
    (void)state;
    worst_error arc = { 0 }, arc2 = { 0 }, e = { 0 }, l = { 0 }, tanh_over = { 0 }, arc_over = { 0 };
    const wide unit = DOUBLE_ROUNDING;
    uint64_t random = 2;
    for (int i = 0; i < MANY; i++) {
        const double x = random_log_between(&random, 1e-300, 1e300), y = random_log_between(&random, 1e-12, 1e12);
        /* The reduced argument two roundings, the sum one, the fit .4. */
        worst_add(&arc, relative_error(real_atan(x), atanl((wide)x)), 5.0L * unit, x, 0, 0);
        const double turn = random_between(&random, -3.14159, 3.14159), c = y * cos(turn), s = y * sin(turn);
        /* Where it is taken from pi or pi / 2, these are off by .6 of a rounding of theirs. */
        worst_add(&arc2, (wide)real_atan2(s, c) - atan2l((wide)s, (wide)c), 5.0L * WIDE_PI * unit, s, c, 0);
        worst_add(&l, relative_error(real_log(x), logl((wide)x)), 4.0L * unit, x, 0, 0);
        const double t = -random_log_between(&random, 1e-20, 699.0);
        /* As exp_negative; n times the low half of log 2 is off by 2^-53 of .0014 n, with n up to 1010. */
        worst_add(&e, relative_error(real_exp_negative(t), expl((wide)t)), 5.0L * unit, t, 0, 0);
        const double z = i & 1 ? random_between(&random, 0.0, 1.0) : 1.0 - random_log_between(&random, 1e-15, 1.0);
        /* The quotient in the logarithm has three roundings, which weigh as much as the logarithm is small. */
        const wide quotient = (1.0L + (wide)z) / (1.0L - (wide)z);
        if (z > 0.0)
            worst_add(&tanh_over, relative_error(real_atanh_over(z), atanhl((wide)z) / (wide)z),
                      (8.0L + 3.0L / logl(quotient)) * unit, z, 0, 0);
        worst_add(&arc_over,
                  relative_error(real_atan_over(x < 1e150 ? x : y),
                                 atanl((wide)(x < 1e150 ? x : y)) / (wide)(x < 1e150 ? x : y)),
                  6.0L * unit, x, 0, 0);
    }
    /* Just below and above one, where the logarithm vanishes. */
    for (int i = -100000; i <= 100000; i++) {
        const double x = 1.0 + i * 0x1p-52 * (i < 0 ? 0.5 : 1.0);
        worst_add(&l, relative_error(real_log(x), logl((wide)x)), 4.0L * unit, x, 0, 0);
    }
    int ok = worst_holds(&arc, "real_atan", (double)unit);
    ok &= worst_holds(&arc2, "real_atan2 (absolute)", (double)unit);
    ok &= worst_holds(&l, "real_log", (double)unit);
    ok &= worst_holds(&e, "real_exp_negative", (double)unit);
    ok &= worst_holds(&tanh_over, "real_atanh_over", (double)unit);
    ok &= worst_holds(&arc_over, "real_atan_over", (double)unit);
    assert_true(ok);
}

/* sqrt(pi) / 2 a erfcx(w / a), which holds erfcx where erfc alone is 0. */
static void scaled_error_function_keeps_its_digits(void **state)
{
    (void)state;
    worst_error tail = { 0 };
    uint64_t random = 3;
    for (int i = 0; i < MANY / 4; i++) {
        const float alpha = (float)random_log_between(&random, 1e-4, 1.0),
                    w = (float)random_log_between(&random, 1, 1e4);
        const wide x = (wide)w / (wide)alpha;
        const wide exact = 0.5L * sqrtl(WIDE_PI) * (wide)alpha * wide_erfcx(x);
        /* The fit 3e-7 by its comment, which is five roundings, Horner's rule and the rest four. */
        worst_add(&tail, relative_error((double)beckmann_tail_area(alpha, w), exact), 9.0L * FLOAT_ROUNDING,
                  (double)alpha, (double)w, 0);
    }
    assert_true(worst_holds(&tail, "beckmann_tail_area", (double)FLOAT_ROUNDING));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(exponential_keeps_its_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(power_of_two_and_what_it_misses_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(logarithms_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test_setup_teardown(angles_keep_their_digits, with_traps, without_traps),
        cmocka_unit_test(quantile_is_as_near_as_it_says),
        cmocka_unit_test(doubles_keep_their_digits),
        cmocka_unit_test(scaled_error_function_keeps_its_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
