/* Every model draws directions with the density that it states. */
#include <stdbool.h>

#include "contract.h"
#include "exact_inputs.h"
#include "sampling.h"

/* What a sampler does with the same random numbers: directions, their densities, and densities elsewhere. */
static uint64_t sampler_bits(const glint_material *m, const float wo[3])
{
    uint64_t random = 6, hash = HASH_START;
    for (int i = 0; i < 10000; i++) {
        float u[3], wi[3];
        for (int k = 0; k < 3; k++)
            u[k] = (float)random_uniform(&random);
        random_direction(&random, wi);
        glint_sample s = { 0 };
        glint_sample_direction(m, NULL, NULL, wo, u, &s);
        const float pdf[2] = { s.pdf, glint_pdf(m, NULL, NULL, wo, wi) };
        hash = hash_floats(hash_floats(hash, s.wi, 3), pdf, 2);
    }
    return hash;
}

/* Without a footprint, models of facets draw as the smooth one does, and so do materials that differ in colours alone:
 * what gives the same bits has been tested. */
static bool is_known(uint64_t bits)
{
    static uint64_t known[sizeof(MODELS) / sizeof(MODELS[0]) * CONFIGURATIONS * 2];
    static size_t count;
    for (size_t i = 0; i < count; i++)
        if (known[i] == bits)
            return true;
    known[count++] = bits;
    return false;
}

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
        if (is_known(sampler_bits(m, wo)))
            continue;
        sampling_expect(&counts, m, NULL, wo, 3);
        sampling_draw(&counts, m, NULL, wo, &random);
        double cells;
        const double chi2 = sampling_chi_square(&counts, &cells), tail = chi_square_tail(chi2, cells);
        if (!(cells > 1000.0 && tail >= 0.001 / tests))
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
