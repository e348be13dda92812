/* Variance of the means of k x k blocks: how grainy the pictures are at each size.
 *
 * The picture itself varies too, so what is squared is how far a block is from its background: the smooth picture where
 * there is one, else the mean of the 4 x 4 blocks around it (16/15 gives back what that takes away).
 */
#include <math.h>
#include <stdlib.h>

#include "compare/jackknife.h"
#include "compare/pair.h"

enum { FAMILY = 4 }; /* blocks along a side of their common square */

/* Mean over a block of luminance less background. False: some of it is not compared. */
static bool block_mean(const pair *p, int side, int left, int top, double mean[2])
{
    double sum[2] = { 0.0, 0.0 };
    for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x) {
            const size_t i = pair_index(p, x, y);
            if (!p->compared[i])
                return false;
            for (int which = PAIR_A; which <= PAIR_B; ++which)
                sum[which] +=
                    (double)p->luminance[which][i] - (p->background[which] ? (double)p->background[which][i] : 0.0);
        }
    for (int which = PAIR_A; which <= PAIR_B; ++which)
        mean[which] = sum[which] / ((double)side * side);
    return true;
}

/* The blocks of one square; without a smooth picture all of them must be there. */
static void add_family(const pair *p, int side, int left, int top, jackknife *sums, uint32_t *count)
{
    const bool has_smooth = p->background[PAIR_A] != NULL;
    double value[FAMILY * FAMILY][2], mean[2] = { 0.0, 0.0 };
    bool whole[FAMILY * FAMILY];
    for (int i = 0; i < FAMILY * FAMILY; ++i) {
        whole[i] = block_mean(p, side, left + i % FAMILY * side, top + i / FAMILY * side, value[i]);
        if (!whole[i] && !has_smooth)
            return;
        for (int which = PAIR_A; which <= PAIR_B && !has_smooth; ++which)
            mean[which] += value[i][which] / (FAMILY * FAMILY);
    }
    const double lost = has_smooth ? 1.0 : (double)(FAMILY * FAMILY) / (FAMILY * FAMILY - 1);
    for (int i = 0; i < FAMILY * FAMILY; ++i) {
        if (!whole[i])
            continue;
        jackknife_add(sums, left, top, p->width, p->height, sqrt(lost) * (value[i][PAIR_A] - mean[PAIR_A]),
                      sqrt(lost) * (value[i][PAIR_B] - mean[PAIR_B]));
        ++*count;
    }
}

bool blocks_measure(const pair *p, compare_result *result, report *r)
{
    jackknife *sums = malloc(sizeof *sums);
    if (!sums)
        return report_error(r, "no memory for the blocks of a picture");
    for (int i = 0; i < COMPARE_BLOCKS; ++i) {
        const int side = 1 << i, square = side * FAMILY;
        uint32_t count = 0;
        *sums = (jackknife){ 0 };
        for (int y = 0; y + square <= p->height; y += square)
            for (int x = 0; x + square <= p->width; x += square)
                add_family(p, side, x, y, sums, &count);
        if (count == 0)
            break;
        const jackknife_sums total = jackknife_total(sums);
        result->block[result->block_count++] =
            (compare_block){ side, count, jackknife_ratio_of_squares(sums), jackknife_correlation(&total) };
    }
    free(sums);
    return true;
}
