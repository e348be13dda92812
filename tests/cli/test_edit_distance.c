/* Edit distance, against counts made by hand and the properties of a distance. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene/edit_distance.h"

static void distance_counts_single_changes(void **state)
{
    (void)state;
    static const struct {
        const char *a, *b;
        size_t distance;
    } known[] = {
        { "", "", 0 },          { "", "abc", 3 },      { "size", "size", 0 }, { "size", "sise", 1 },
        { "size", "sizes", 1 }, { "size", "ize", 1 },  { "size", "szie", 1 }, { "kitten", "sitting", 3 },
        { "ab", "ba", 1 },      { "abcd", "badc", 2 }, { "snow", "sand", 3 }, { "render", "rendr", 1 },
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        assert_int_equal(edit_distance(known[i].a, known[i].b), known[i].distance);
        assert_int_equal(edit_distance(known[i].b, known[i].a), known[i].distance);
    }
}

static void names_too_long_to_type_are_equal_or_far(void **state)
{
    (void)state;
    char longest[65], longer[66];
    memset(longest, 'a', 64);
    longest[64] = '\0';
    memset(longer, 'a', 65);
    longer[65] = '\0';
    assert_int_equal(edit_distance(longest, longest + 1), 1);
    assert_int_equal(edit_distance(longer, longer), 0);
    assert_int_equal(edit_distance(longer, longest), 65);
}

static void near_is_a_third_of_the_letters_and_at_least_two(void **state)
{
    (void)state;
    assert_int_equal(edit_distance_near(""), 2);
    assert_int_equal(edit_distance_near("12345678"), 2);
    assert_int_equal(edit_distance_near("123456789"), 3);
    char longer[301];
    memset(longer, 'a', 300);
    longer[300] = '\0';
    assert_true(edit_distance_near(longer) < edit_distance(longer, "size"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_counts_single_changes),
        cmocka_unit_test(names_too_long_to_type_are_equal_or_far),
        cmocka_unit_test(near_is_a_third_of_the_letters_and_at_least_two),
    };
    return cmocka_run_group_tests_name("edit_distance", tests, NULL, NULL);
}
