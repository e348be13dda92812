/* Numbers in the report have as many digits as their error leaves, and no exponent of a machine. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "study/number.h"

#define SPACE "\u202f"

static void assert_measured(double value, double bar, const char *expected)
{
    char text[96];
    number_measured(text, sizeof text, value, bar);
    assert_string_equal(text, expected);
}

static void the_bar_says_how_many_digits(void **state)
{
    (void)state;
    assert_measured(0.0708179, 0.0107, "0.071 ± 0.011");
    assert_measured(3.08171, 0.674, "3.1 ± 0.7");
    assert_measured(1.0, 0.00654, "1.000 ± 0.007");
    assert_measured(123.4, 20.0, "123 ± 20");
    assert_measured(0.012429, 0.00159, "0.0124 ± 0.0016");
}

static void without_a_bar_there_are_three_digits(void **state)
{
    (void)state;
    assert_measured(0.0276329, 0.0, "0.0276");
    assert_measured(1.0, 0.0, "1.00");
    assert_measured(0.0, 0.0, "0");
}

static void small_numbers_are_powers_of_ten(void **state)
{
    (void)state;
    assert_measured(6.19e-5, 1.21e-5, "(6.2 ± 1.2) · 10<sup>−5</sup>");
    assert_measured(4.5e-7, 0.0, "4.50 · 10<sup>−7</sup>");
    /* The bar is larger than the value: its power. */
    assert_measured(1e-6, 3e-4, "(0 ± 3) · 10<sup>−4</sup>");
}

static void assert_rounded(double value, const char *expected)
{
    char text[64];
    number_rounded(text, sizeof text, value);
    assert_string_equal(text, expected);
}

static void large_numbers_stand_in_groups(void **state)
{
    (void)state;
    assert_rounded(10799.4, "10" SPACE "800");
    assert_rounded(1234567.0, "1" SPACE "230" SPACE "000");
    assert_rounded(9876.3, "9880");
    assert_rounded(630.4, "630");
    assert_rounded(12.08, "12.1");
    assert_rounded(0.31249, "0.312");
    assert_rounded(0.0, "0");
    /* Bytes are counted. */
    assert_rounded(1024.0, "1024");
    assert_rounded(65536.0, "65" SPACE "536");
}

static void assert_lasts(double seconds, const char *expected)
{
    char text[64];
    number_duration(text, sizeof text, seconds);
    assert_string_equal(text, expected);
}

static void times_are_those_of_a_clock(void **state)
{
    (void)state;
    assert_lasts(0.13, "0.1 s");
    assert_lasts(9.97, "10 s");
    assert_lasts(59.4, "59 s");
    assert_lasts(160.0, "2 min 40 s");
    assert_lasts(3900.0, "1 h 5 min");
}

static void a_short_text_is_not_passed(void **state)
{
    (void)state;
    char text[16];
    memset(text, '#', sizeof text);
    number_measured(text, 8, 6.19e-5, 1.21e-5);
    assert_int_equal(text[8], '#');
    number_rounded(text, 8, 1234567890.0);
    assert_true(strlen(text) < 8);
    assert_int_equal(text[8], '#');
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bar_says_how_many_digits),    cmocka_unit_test(without_a_bar_there_are_three_digits),
        cmocka_unit_test(small_numbers_are_powers_of_ten), cmocka_unit_test(large_numbers_stand_in_groups),
        cmocka_unit_test(times_are_those_of_a_clock),      cmocka_unit_test(a_short_text_is_not_passed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
