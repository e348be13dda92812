/* The previewer's own numbers at the edge of what floats can say: all that it hands to the library and to its rays is a
 * finite number, and no floating-point exception is raised. */
#define _GNU_SOURCE
#include "traps.h"

#include "preview_sweep.h"

/* By bits: a comparison would raise what it looks for. */
static void assert_finite(void *user, const char *what, const double *numbers, size_t count)
{
    *(long *)user += 1;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        if ((bits >> 52 & 0x7ffU) == 0x7ffU)
            fail_msg("%s: number %zu has the bits %016llx", what, i, (unsigned long long)bits);
    }
}

static void whatever_a_scene_says_is_a_number(void **state)
{
    (void)state;
    long seen = 0;
    preview_sweep(200000, 6, assert_finite, &seen);
    printf("%ld results\n", seen);
    assert_true(seen > 1000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(whatever_a_scene_says_is_a_number, with_traps, without_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
