/* One chi^2 test for every sampler: 10^6 samples in 512 x 512 cells of (cos theta, phi) against the integral of the
 * density over each. */
#ifndef TESTS_SAMPLING_H
#define TESTS_SAMPLING_H

#include <math.h>
#include <string.h>

#include "glint.h"
#include "statistics.h"

enum { SAMPLING_ROWS = 512, SAMPLING_COLUMNS = 512, SAMPLING_COUNT = 1000000 };

typedef struct sampling_counts {
    double expected[SAMPLING_ROWS * SAMPLING_COLUMNS], seen[SAMPLING_ROWS * SAMPLING_COLUMNS];
    double below_expected, below_seen; /* the horizon */
} sampling_counts;

/* How many samples a cell expects, by fine x fine points. */
static inline double sampling_expect_cell(const glint_material *m, const glint_footprint *f, const float wo[3], int row,
                                          int column, int fine)
{
    const double turn = 6.28318530717958648, rows = SAMPLING_ROWS * fine, columns = SAMPLING_COLUMNS * fine;
    double sum = 0.0;
    for (int i = 0; i < fine; i++)
        for (int k = 0; k < fine; k++) {
            const double z = (row * fine + i + 0.5) / rows, phi = turn * (column * fine + k + 0.5) / columns;
            const double r = sqrt(1.0 - z * z);
            const float wi[3] = { (float)(r * cos(phi)), (float)(r * sin(phi)), (float)z };
            sum += (double)glint_pdf(m, NULL, f, wo, wi);
        }
    return SAMPLING_COUNT * sum * turn / (rows * columns);
}

/* By fine x fine points where a cell may be judged by itself, which takes 10 samples. By its middle where it is joined
 * with all others, which expect what is left of the samples, whatever is said here of each. */
static inline void sampling_expect(sampling_counts *n, const glint_material *m, const glint_footprint *f,
                                   const float wo[3], int fine)
{
    n->below_expected = SAMPLING_COUNT;
    for (int i = 0; i < SAMPLING_ROWS; i++)
        for (int k = 0; k < SAMPLING_COLUMNS; k++) {
            double *const expected = &n->expected[i * SAMPLING_COLUMNS + k];
            *expected = sampling_expect_cell(m, f, wo, i, k, 1);
            if (*expected > 5.0)
                *expected = sampling_expect_cell(m, f, wo, i, k, fine);
            n->below_expected -= *expected;
        }
}

static inline void sampling_draw(sampling_counts *n, const glint_material *m, const glint_footprint *f,
                                 const float wo[3], uint64_t *random)
{
    memset(n->seen, 0, sizeof(n->seen));
    n->below_seen = 0.0;
    for (int i = 0; i < SAMPLING_COUNT; i++) {
        const float u[3] = { (float)random_uniform(random), (float)random_uniform(random),
                             (float)random_uniform(random) };
        glint_sample s;
        if (!glint_sample_direction(m, NULL, f, wo, u, &s)) {
            n->below_seen += 1.0;
            continue;
        }
        const double phi = atan2((double)s.wi[1], (double)s.wi[0]) / 6.28318530717958648;
        const int column = (int)fmin((phi < 0.0 ? phi + 1.0 : phi) * SAMPLING_COLUMNS, SAMPLING_COLUMNS - 1);
        n->seen[(int)fmin((double)s.wi[2] * SAMPLING_ROWS, SAMPLING_ROWS - 1) * SAMPLING_COLUMNS + column] += 1.0;
    }
}

/* chi^2; cells that expect less than 10 are joined with what lies below the horizon. *cells: degrees of freedom. */
static inline double sampling_chi_square(const sampling_counts *n, double *cells)
{
    double chi2 = 0.0, rest_seen = n->below_seen, rest_expected = n->below_expected;
    *cells = 0.0;
    for (int i = 0; i < SAMPLING_ROWS * SAMPLING_COLUMNS; i++) {
        const double expected = n->expected[i], difference = n->seen[i] - expected;
        if (expected >= 10.0) {
            chi2 += difference * difference / expected;
            *cells += 1.0;
        } else {
            rest_seen += n->seen[i];
            rest_expected += expected;
        }
    }
    if (rest_expected >= 10.0)
        chi2 += (rest_seen - rest_expected) * (rest_seen - rest_expected) / rest_expected;
    return chi2;
}

#endif
