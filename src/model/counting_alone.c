/* The counting model for one point at a time, its four grids in four lanes: for a caller without a batch.
 *
 * Compiled twice on x86: AVX2 looks up the quantile's tables in one instruction each, which four lanes of SSE do lane
 * by lane, and copies nothing before it changes it.
 */
#include "model/counting_kernel.h"

#include "model/counting_count.h"

#if defined(__AVX2__)
#define NAME counting_alone_avx2
#else
#define NAME counting_alone
#endif

void NAME(const counting_points *points, size_t size, float *factor, float *facets)
{
    for (size_t i = 0; i < size; i++) {
        counting_apart a;
        counting_take_apart(points, i, &a);
        const binomial_chance chance = binomial_chance_of(a.p);
        const vfloat trials = a.drawn * a.share;
        const grid_cells_read cells = { a.cell, a.weight, NULL };
        const vfloat counts = are_many(trials, a.p) ? count_many(&a.lattice, 1, &cells, &chance, &trials)
                                                    : count(&a.lattice, 1, &cells, a.dither, &chance, &trials);
        factor[i] = counting_together(&a, counting_factor(counting_across(counts), a.drawn, a.p));
        facets[i] = a.pixel.facets[0];
    }
}
