/* The example model beside the sum of its seeds, and under footprints of any size, for programs that count
 * instructions.
 *
 *     example_ways seeds tiled|scattered         each once under footprints from a tenth of a texel to half a map
 *     example_ways wide tiled|scattered SIDE N   N evaluations under footprints of SIDE x SIDE examples
 */
#include <stdio.h>
#include <string.h>

#include "seed_race.h"

static void under_footprints(const bench *b)
{
    static const double sigmas[] = { 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0 };
    const seed_surface all = seed_race_export(b);
    for (size_t k = 0; k < sizeof(sigmas) / sizeof(sigmas[0]); k++)
        for (int is_lit = 0; is_lit < 2; is_lit++)
            seed_race_count(b, &all, sigmas[k], is_lit, 2);
    free(all.seeds);
}

static void under_wide_footprints(bench *b, float side, long count)
{
    b->material.options.example.side_m = 1.0F;
    for (long i = 0; i < count; i++) {
        const glint_footprint f = { 0.37 * (double)i, 0.11 * (double)i, side, 0.0F, 0.0F, side, 0U };
        const model_query q = { .material = &b->material,
                                .surface = &b->material.options.surface,
                                .footprint = &f,
                                .solid_angle_sr = 1e-4F,
                                .wo = { 0.0F, 0.0F, 1.0F },
                                .wi = vec3_normalize((vec3){ 0.3F, 0.1F, 1.0F }) };
        glint_value v;
        example_model.eval(&q, &v);
        assert_true(v.smooth[0] > 0.0F);
    }
}

int main(int argc, char **argv)
{
    const int is_seeds = argc == 3 && strcmp(argv[1], "seeds") == 0,
              is_wide = argc == 5 && strcmp(argv[1], "wide") == 0;
    if (!is_seeds && !is_wide) {
        fputs("usage: example_ways seeds PLACEMENT | wide PLACEMENT SIDE N\n", stderr);
        return 2;
    }
    const int is_scattered = strcmp(argv[2], "scattered") == 0;
    const glint_example o = seed_race_example(is_scattered);
    bench b;
    bench_make(&b, is_scattered ? GLINT_EXAMPLE_SCRATCHES : GLINT_EXAMPLE_ISOTROPIC_NOISE, &o);
    if (is_seeds)
        under_footprints(&b);
    else
        under_wide_footprints(&b, strtof(argv[3], NULL), strtol(argv[4], NULL, 10));
    bench_free(&b);
    return 0;
}
