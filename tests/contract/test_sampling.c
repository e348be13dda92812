/* Every model draws directions with the density that it states. */
#include "contract.h"
#include "sampling.h"

static void samples_have_their_density(void **state)
{
    (void)state;
    static sampling_counts counts;
    uint64_t random = 5;
    const double tests = (double)(sizeof(MODELS) / sizeof(MODELS[0])) * CONFIGURATIONS * 2.0;
    FOR_EACH_CONFIGURATION(c, m, row)
    for (int t = 0; t < 2; t++) {
        float wo[3];
        direction(t ? 1.3 : 0.4, 0.5, wo);
        sampling_expect(&counts, m, NULL, wo, 3);
        sampling_draw(&counts, m, NULL, wo, &random);
        double cells;
        const double chi2 = sampling_chi_square(&counts, &cells), tail = chi_square_tail(chi2, cells);
        if (tail < 0.001 / tests)
            fail_msg("%s, %s, view %d: chi^2 %.1f on %.0f cells, significance %.1e", glint_model_name(row->model),
                     c.name, t, chi2, cells, tail);
    }
    contract_kept(10, "Samples have their density (chi², 10⁶ samples, 512² cells)", "sampling", NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_have_their_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
