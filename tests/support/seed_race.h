/* The example model against the full sum of its seeds under the same footprints: how far apart they are, and how much
 * faster it is, taken in turns so that a busy machine slows both. */
#ifndef TESTS_SEED_RACE_H
#define TESTS_SEED_RACE_H

#include "example_bench.h"
#include "seed_sum.h"

/* A map of 32 x 32 texels, tiled, or scattered at any angle and at sizes that differ. */
glint_example seed_race_example(int is_scattered);

/* Bytes that a material's example keeps. */
size_t example_bytes(const example *e);

/* The surface around one cell of a bench's lattice, seeds and all; free its seeds. */
seed_surface seed_race_export(const bench *b);

typedef struct seed_race {
    double own_us, sum_us;
    double pruned_us; /* the sum without the seeds that a perfect search would have left out, the search not counted */
    double rms;       /* of the difference, over the mean of the sum */
    double worst;     /* over its largest value */
    double seeds;     /* summed, on average */
} seed_race;

/* is_lit: the slope is one of a seed below the footprint; else anywhere within three times the root mean square. */
seed_race seed_race_run(const bench *b, const seed_surface *all, double sigma_texels, int is_lit, int queries);

/* Each once at so many queries, for programs that count the instructions of example_density and seed_surface_density.
 */
void seed_race_count(const bench *b, const seed_surface *all, double sigma_texels, int is_lit, int queries);

#endif
