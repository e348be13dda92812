/* Sparks: connected spots of pixels that are so many times brighter than their background. */
#include <stdlib.h>

#include "compare/pair.h"

const double compare_spot_thresholds[COMPARE_SPOTS] = { 2.0, 4.0, 8.0, 16.0, 32.0 };

/* Without a smooth picture the background is the mean of a square of this side. Taste: wider than a spark, narrower
 * than a highlight. */
enum { SQUARE = 32 };

/* The picture's own mean over squares of 32 pixels. */
static void average_squares(const pair *p, int which, float *out)
{
    for (int top = 0; top < p->height; top += SQUARE)
        for (int left = 0; left < p->width; left += SQUARE) {
            const int bottom = top + SQUARE < p->height ? top + SQUARE : p->height;
            const int right = left + SQUARE < p->width ? left + SQUARE : p->width;
            double sum = 0.0, count = 0.0;
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    if (p->compared[pair_index(p, x, y)]) {
                        sum += (double)p->luminance[which][pair_index(p, x, y)];
                        count += 1.0;
                    }
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    out[pair_index(p, x, y)] = count > 0.0 ? (float)(sum / count) : 0.0F;
        }
}

static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static bool is_bright(const pair *p, int which, const float *background, double threshold, size_t i)
{
    return p->compared[i] && background[i] > 0.0F && (double)p->luminance[which][i] > threshold * (double)background[i];
}

/* Bright pixels, and the spots that they form with their eight neighbours: every pixel is a spot, and every pair that
 * was apart makes one fewer. */
static void count_spots(const pair *p, int which, const float *background, double threshold, uint32_t *parent,
                        double *spots, double *pixels)
{
    static const int before[4][2] = { { -1, 0 }, { -1, -1 }, { 0, -1 }, { 1, -1 } };
    *spots = *pixels = 0.0;
    for (int y = 0; y < p->height; ++y)
        for (int x = 0; x < p->width; ++x) {
            const size_t i = pair_index(p, x, y);
            parent[i] = (uint32_t)i;
            if (!is_bright(p, which, background, threshold, i))
                continue;
            *spots += 1.0;
            *pixels += 1.0;
            for (int n = 0; n < 4; ++n) {
                const int nx = x + before[n][0], ny = y + before[n][1];
                if (nx < 0 || ny < 0 || nx >= p->width ||
                    !is_bright(p, which, background, threshold, pair_index(p, nx, ny)))
                    continue;
                const uint32_t here = root_of(parent, (uint32_t)i);
                const uint32_t there = root_of(parent, (uint32_t)pair_index(p, nx, ny));
                if (here != there) {
                    parent[here] = there;
                    *spots -= 1.0;
                }
            }
        }
}

bool spots_measure(const pair *p, compare_result *result, report *r)
{
    const size_t count = (size_t)p->width * (size_t)p->height;
    uint32_t *const parent = malloc(count * sizeof *parent);
    float *const squares = malloc(count * sizeof *squares);
    const bool has_memory = parent && squares;
    for (int which = PAIR_A; which <= PAIR_B && has_memory; ++which) {
        if (!p->background[which])
            average_squares(p, which, squares);
        for (int i = 0; i < COMPARE_SPOTS; ++i) {
            compare_spot *const s = &result->spot[i];
            double spots, pixels;
            s->threshold = compare_spot_thresholds[i];
            count_spots(p, which, p->background[which] ? p->background[which] : squares, s->threshold, parent, &spots,
                        &pixels);
            *(which == PAIR_A ? &s->a_per_megapixel : &s->b_per_megapixel) = spots * 1e6 / (double)p->pixels;
            *(which == PAIR_A ? &s->a_area_share : &s->b_area_share) = pixels / (double)p->pixels;
        }
    }
    free(parent);
    free(squares);
    return has_memory || report_error(r, "no memory for the bright spots of %zu pixels", count);
}
