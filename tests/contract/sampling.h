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

/* By fine x fine points where a cell matters: where it expects as many samples as a tenth of what is judged at once. By
 * its middle elsewhere. The horizon is left what the cells do not expect. */
static inline void sampling_expect(sampling_counts *n, const glint_material *m, const glint_footprint *f,
                                   const float wo[3], int fine)
{
    n->below_expected = SAMPLING_COUNT;
    for (int i = 0; i < SAMPLING_ROWS; i++)
        for (int k = 0; k < SAMPLING_COLUMNS; k++) {
            double *const expected = &n->expected[i * SAMPLING_COLUMNS + k];
            *expected = sampling_expect_cell(m, f, wo, i, k, 1);
            if (*expected > 1.0)
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

/* A run of cells that is judged at once. */
typedef struct sampling_run {
    double expected, seen;
} sampling_run;

static inline double sampling_run_square(const sampling_run *run)
{
    return (run->seen - run->expected) * (run->seen - run->expected) / run->expected;
}

/* chi^2 over runs of cells of a row, each as long as it takes to expect 10 samples; what is left of a row goes on to
 * the next, and what is left at the end is joined with what lies below the horizon. *cells: degrees of freedom. */
static inline double sampling_chi_square(const sampling_counts *n, double *cells)
{
    double chi2 = 0.0;
    sampling_run run = { 0 };
    *cells = 0.0;
    for (int i = 0; i < SAMPLING_ROWS * SAMPLING_COLUMNS; i++) {
        run.expected += n->expected[i];
        run.seen += n->seen[i];
        if (run.expected >= 10.0) {
            chi2 += sampling_run_square(&run);
            *cells += 1.0;
            run = (sampling_run){ 0 };
        }
    }
    run.expected += n->below_expected;
    run.seen += n->below_seen;
    if (run.expected >= 10.0)
        chi2 += sampling_run_square(&run);
    return chi2;
}

#endif
