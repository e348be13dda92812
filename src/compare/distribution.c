/* Histograms and quantiles of the luminance of single pixels. */
#include <math.h>
#include <stdlib.h>

#include "compare/pair.h"

const double compare_quantile_shares[COMPARE_QUANTILES] = { 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999, 1.0 };

static int by_value(const void *left, const void *right)
{
    const float a = *(const float *)left, b = *(const float *)right;
    return (a > b) - (a < b);
}

/* Luminances of the compared pixels in order; NULL without memory. */
static float *sorted(const pair *p, int which)
{
    float *out = malloc(p->pixels * sizeof *out);
    if (!out)
        return NULL;
    size_t n = 0;
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; ++i)
        if (p->compared[i])
            out[n++] = p->luminance[which][i];
    qsort(out, n, sizeof *out, by_value);
    return out;
}

/* The least value that this share of all does not exceed. */
static double quantile(const float *values, size_t count, double share)
{
    const size_t rank = (size_t)ceil(share * (double)count);
    return (double)values[rank > 0 ? rank - 1 : 0];
}

/* The largest distance between the shares that do not exceed a value. */
static double distance(const float *a, const float *b, size_t count)
{
    size_t i = 0, k = 0, most = 0;
    while (i < count && k < count) {
        const float at = fminf(a[i], b[k]);
        while (i < count && a[i] <= at)
            ++i;
        while (k < count && b[k] <= at)
            ++k;
        const size_t apart = i > k ? i - k : k - i;
        most = apart > most ? apart : most;
    }
    return (double)most / (double)count;
}

static void fill_bins(const float *values, size_t count, double mean, uint64_t bins[COMPARE_BINS])
{
    const int middle = COMPARE_BINS / 2;
    for (size_t i = 0; i < count; ++i) {
        const double stops = values[i] > 0.0F && mean > 0.0 ? log2((double)values[i] / mean) : -1e9;
        const double bin = floor(2.0 * stops) + middle;
        ++bins[bin < 0.0 ? 0 : bin >= COMPARE_BINS ? COMPARE_BINS - 1 : (int)bin];
    }
}

bool distribution_measure(const pair *p, compare_result *result, report *r)
{
    float *const a = sorted(p, PAIR_A), *const b = sorted(p, PAIR_B);
    const bool has_memory = a && b;
    if (has_memory) {
        for (int i = 0; i < COMPARE_QUANTILES; ++i) {
            result->a_quantile[i] = quantile(a, p->pixels, compare_quantile_shares[i]);
            result->b_quantile[i] = quantile(b, p->pixels, compare_quantile_shares[i]);
        }
        result->distance = distance(a, b, p->pixels);
        fill_bins(a, p->pixels, result->mean[3].a, result->a_bin);
        fill_bins(b, p->pixels, result->mean[3].a, result->b_bin);
    }
    free(a);
    free(b);
    return has_memory ||
           report_error(r, "no memory for the distribution of %llu pixels", (unsigned long long)p->pixels);
}
