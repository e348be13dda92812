/* Rows of the table of transformed cosines, fitted again: the table is what its program makes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "light/fit/ltc_fit.h"
#include "light/ltc.h"

static void check_row(int distribution, int i)
{
    ltc_fit row[LTC_FIT_SIDE];
    ltc_fit_row(distribution, ltc_fit_alpha(i), row);
    for (int j = 0; j < LTC_FIT_SIDE; j++) {
        const double made[LTC_NUMBERS] = { row[j].p[0],   row[j].p[1],    row[j].p[2],
                                           row[j].albedo, row[j].schlick, row[j].facets };
        for (int k = 0; k < LTC_NUMBERS; k++) {
            const double found = (double)ltc_table[distribution][i][j][k];
            /* Six digits are printed; another libm may turn the simplex another way at last, by its own stopping width.
             */
            if (fabs(made[k] - found) > 2e-3 * fabs(made[k]) + 1e-4)
                fail_msg("distribution %d, row %d, view %d, number %d: %g in the table, %g fitted", distribution, i, j,
                         k, found, made[k]);
        }
    }
}

static void rows_of_the_table_are_made_again(void **state)
{
    (void)state;
    check_row(LTC_FIT_GGX, 12);
    check_row(LTC_FIT_BECKMANN, 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(rows_of_the_table_are_made_again) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
