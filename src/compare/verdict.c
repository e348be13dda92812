/* The verdict: every check of a comparison against its tolerance, and the worst of them. */
#include <math.h>
#include <stdio.h>

#include "compare/pair.h"

/* Fewer blocks say too little about a variance. Taste. */
enum { LEAST_BLOCKS = 64, MOST_SIDE_CHECKED = 16 };

/* Two pictures whose fine grain correlates better than this show the same facets: different ones correlate by less than
 * .1 over some thousand pixels. */
#define SAME_FACETS 0.9

static compare_outcome judge(double off, double tolerance, double standard_error)
{
    if (off <= tolerance)
        return COMPARE_PASS;
    /* A standard error that cannot be told excuses nothing. */
    return isfinite(standard_error) && off - 2.0 * standard_error <= tolerance ? COMPARE_UNCLEAR : COMPARE_FAIL;
}

static void add_check(compare_result *result, const char *name, double value, double expected, double tolerance,
                      double standard_error, double off)
{
    compare_check *const c = &result->check[result->check_count++];
    *c = (compare_check){ "", value, expected, tolerance, standard_error, judge(off, tolerance, standard_error) };
    snprintf(c->name, sizeof c->name, "%s", name);
    if (c->outcome > result->outcome)
        result->outcome = c->outcome;
}

static void check_ratio(compare_result *result, const char *name, const compare_ratio *ratio, double tolerance)
{
    /* NaN is off by any measure. */
    const double off = fabs(ratio->ratio - 1.0);
    add_check(result, name, ratio->ratio, 1.0, tolerance, ratio->standard_error, off <= HUGE_VAL ? off : HUGE_VAL);
}

static void check_variances(const compare_options *options, compare_result *result)
{
    for (int i = 0; i < result->block_count; ++i) {
        const compare_block *const b = &result->block[i];
        char name[64];
        if (b->count < LEAST_BLOCKS || b->side > MOST_SIDE_CHECKED)
            continue;
        snprintf(name, sizeof name, "variance of %d x %d blocks", b->side, b->side);
        check_ratio(result, name, &b->variance, options->variance_tolerance);
    }
}

void verdict_find(const compare_options *options, compare_result *result)
{
    const uint64_t broken = result->a_broken + result->b_broken;
    result->outcome = COMPARE_PASS;
    add_check(result, "pixels that are not finite", (double)broken, 0.0, 0.0, 0.0, (double)broken);
    const bool looks_the_same = result->block_count > 0 && result->block[0].correlation > SAME_FACETS;
    result->exact = options->exact || looks_the_same;
    if (result->exact) {
        check_ratio(result, "mean luminance", &result->mean[3], options->exact_mean_tolerance);
        add_check(result, "correlation of pixels", result->correlation, 1.0, 1.0 - options->least_correlation, 0.0,
                  1.0 - result->correlation);
        return;
    }
    check_ratio(result, "mean luminance", &result->mean[3], options->mean_tolerance);
    check_variances(options, result);
}
