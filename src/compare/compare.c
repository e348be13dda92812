/* Holds picture B against picture A, measure by measure. */
#include "compare/pair.h"

bool compare_pictures(const image *a, const char *a_name, const image *b, const char *b_name,
                      const compare_options *options, compare_result *result, report *r)
{
    pair p;
    if (!pair_make(&p, a, a_name, b, b_name, r))
        return false;
    *result = (compare_result){ .width = p.width,
                                .height = p.height,
                                .pixels = p.pixels,
                                .a_broken = p.broken[PAIR_A],
                                .b_broken = p.broken[PAIR_B],
                                .has_smooth = p.background[PAIR_A] != NULL };
    const bool done = means_measure(&p, result, r) && blocks_measure(&p, result, r) &&
                      distribution_measure(&p, result, r) && spots_measure(&p, result, r) &&
                      spectrum_measure(&p, result, r);
    pair_free(&p);
    if (done)
        verdict_find(options, result);
    return done;
}
