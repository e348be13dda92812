/* Means by channel, and how far the pictures are apart pixel by pixel. */
#include <math.h>
#include <stdlib.h>

#include "compare/jackknife.h"
#include "compare/pair.h"

/* Channel 3 is the luminance. */
static double value_of(const pair *p, int which, size_t pixel, int channel)
{
    return (double)(channel < 3 ? pair_color(p, which, pixel, channel) : p->luminance[which][pixel]);
}

static void add_channel(const pair *p, int channel, jackknife *sums)
{
    for (int y = 0; y < p->height; ++y)
        for (int x = 0; x < p->width; ++x) {
            const size_t i = pair_index(p, x, y);
            if (p->compared[i])
                jackknife_add(sums, x, y, p->width, p->height, value_of(p, PAIR_A, i, channel),
                              value_of(p, PAIR_B, i, channel));
        }
}

static void find_most_different(const pair *p, compare_result *result)
{
    for (int y = 0; y < p->height; ++y)
        for (int x = 0; x < p->width; ++x) {
            const size_t i = pair_index(p, x, y);
            const double difference = fabs((double)p->luminance[PAIR_A][i] - (double)p->luminance[PAIR_B][i]);
            if (difference > result->most_difference) {
                result->most_difference = difference;
                result->most_x = x;
                result->most_y = y;
            }
        }
}

bool means_measure(const pair *p, compare_result *result, report *r)
{
    jackknife *sums = malloc(sizeof *sums);
    if (!sums)
        return report_error(r, "no memory for the means of a picture");
    for (int channel = 0; channel < COMPARE_CHANNELS; ++channel) {
        *sums = (jackknife){ 0 };
        add_channel(p, channel, sums);
        result->mean[channel] = jackknife_ratio_of_means(sums);
    }
    const jackknife_sums total = jackknife_total(sums); /* the last channel is the luminance */
    free(sums);
    const double mean_square = (total.aa - 2.0 * total.ab + total.bb) / total.count, mean = result->mean[3].a;
    result->rms_difference = mean > 0.0 ? sqrt(fmax(mean_square, 0.0)) / mean : (double)NAN;
    result->correlation = jackknife_correlation(&total);
    find_most_different(p, result);
    return true;
}
