/* Radial power spectra: how the graininess of the pictures is spread over frequencies.
 *
 * Welch's method: the picture is cut into squares that overlap by half, each less its mean and under a Hann window, and
 * their powers are averaged over squares and over rings of equal frequency. White noise of variance v has power v
 * everywhere.
 */
#include "compare/spectrum.h"

#include <math.h>
#include <stdlib.h>

#include "compare/pair.h"

enum { MOST_SIDE = 128, LEAST_SIDE = 16 };

typedef struct welch {
    int side;
    fourier *transform;
    float *square, *power;
    double *window;
    double window_power; /* mean of its square over the square */
    double sum[2][COMPARE_RINGS], count[COMPARE_RINGS];
} welch;

static bool welch_make(welch *w, int side)
{
    *w = (welch){ .side = side, .transform = fourier_make(side) };
    w->square = malloc((size_t)side * (size_t)side * sizeof *w->square);
    w->power = malloc((size_t)side * (size_t)side * sizeof *w->power);
    w->window = malloc((size_t)side * sizeof *w->window);
    if (!w->transform || !w->square || !w->power || !w->window)
        return false;
    double sum = 0.0;
    for (int i = 0; i < side; ++i) {
        w->window[i] = 0.5 - 0.5 * cos(2.0 * 3.14159265358979324 * (i + 0.5) / side);
        sum += w->window[i] * w->window[i] / side;
    }
    w->window_power = sum * sum;
    return true;
}

static void welch_free(welch *w)
{
    fourier_free(w->transform);
    free(w->square);
    free(w->power);
    free(w->window);
}

static double value_at(const pair *p, int which, int x, int y)
{
    const size_t i = pair_index(p, x, y);
    return (double)p->luminance[which][i] - (p->background[which] ? (double)p->background[which][i] : 0.0);
}

static bool is_whole(const pair *p, int side, int left, int top)
{
    for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x)
            if (!p->compared[pair_index(p, x, y)])
                return false;
    return true;
}

/* The ring of a frequency, or -1 beyond half a cycle per pixel and at the mean itself. */
static int ring_of(int row, int column, int side)
{
    const int fy = row <= side / 2 ? row : row - side;
    const double frequency = sqrt((double)(fy * fy + column * column)) / side;
    const int ring = (int)(frequency * 2.0 * COMPARE_RINGS);
    return frequency > 0.0 && ring < COMPARE_RINGS ? ring : -1;
}

static void add_square(welch *w, const pair *p, int which, int left, int top)
{
    const int side = w->side;
    double mean = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            mean += value_at(p, which, left + x, top + y) / ((double)side * side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            w->square[y * side + x] =
                (float)((value_at(p, which, left + x, top + y) - mean) * w->window[y] * w->window[x]);
    fourier_power(w->transform, w->square, w->power);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column <= side / 2; ++column) {
            const int ring = ring_of(row, column, side);
            if (ring < 0)
                continue;
            w->sum[which][ring] += (double)w->power[row * side + column] / w->window_power;
            if (which == PAIR_A)
                w->count[ring] += 1.0;
        }
}

static void average(const welch *w, compare_result *result)
{
    for (int ring = 0; ring < COMPARE_RINGS; ++ring) {
        if (!(w->count[ring] > 0.0))
            continue;
        const int i = result->ring_count++;
        result->frequency[i] = (ring + 0.5) / (2.0 * COMPARE_RINGS);
        result->a_power[i] = w->sum[PAIR_A][ring] / w->count[ring];
        result->b_power[i] = w->sum[PAIR_B][ring] / w->count[ring];
    }
}

bool spectrum_measure(const pair *p, compare_result *result, report *r)
{
    const int least = p->width < p->height ? p->width : p->height;
    int side = MOST_SIDE;
    while (side > least)
        side /= 2;
    if (side < LEAST_SIDE)
        return true;
    welch w;
    const bool has_memory = welch_make(&w, side);
    for (int top = 0; has_memory && top + side <= p->height; top += side / 2)
        for (int left = 0; left + side <= p->width; left += side / 2)
            if (is_whole(p, side, left, top))
                for (int which = PAIR_A; which <= PAIR_B; ++which)
                    add_square(&w, p, which, left, top);
    if (has_memory)
        average(&w, result);
    welch_free(&w);
    return has_memory || report_error(r, "no memory for the spectrum of a picture");
}
