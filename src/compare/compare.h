/* Holds picture B against picture A: means, variance of block means, distribution, bright spots, spectra, a verdict.
 *
 * A glint picture never equals another pixel by pixel unless both show the very same facets, so what is compared is
 * what an eye averages over: how bright, how grainy at each size, how many sparks and how strong. Every ratio is B over
 * A and comes with a standard error: the jackknife over 8 x 8 parts of the picture.
 */
#ifndef COMPARE_COMPARE_H
#define COMPARE_COMPARE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "io/image.h"
#include "scene/report.h"

enum {
    COMPARE_CHANNELS = 4,  /* R, G, B, luminance */
    COMPARE_BLOCKS = 6,    /* sides 1, 2, 4 ... 32 pixels */
    COMPARE_QUANTILES = 9, /* see compare_quantile_shares */
    COMPARE_BINS = 42,     /* half a stop each, from 2^-10 of A's mean up to 2^10; first and last: all beyond */
    COMPARE_SPOTS = 5,     /* 2, 4, 8, 16, 32 times the background */
    COMPARE_RINGS = 32,    /* of the spectrum */
    COMPARE_CHECKS = 10
};

typedef struct compare_ratio {
    double a, b;
    double ratio;          /* b / a; 1 where both are zero */
    double standard_error; /* of the ratio; NAN where it cannot be told */
} compare_ratio;

typedef struct compare_block {
    int side; /* pixels */
    uint32_t count;
    compare_ratio variance; /* of block means around the background */
    double correlation;     /* of the same, A with B */
} compare_block;

typedef struct compare_spot {
    double threshold;                        /* times the background */
    double a_per_megapixel, b_per_megapixel; /* connected spots */
    double a_area_share, b_area_share;       /* of the compared pixels */
} compare_spot;

typedef enum compare_outcome { COMPARE_PASS, COMPARE_UNCLEAR, COMPARE_FAIL } compare_outcome;

/* PASS: within the tolerance. UNCLEAR: outside it by less than two standard errors. */
typedef struct compare_check {
    char name[64];
    double value, expected, tolerance, standard_error;
    compare_outcome outcome;
} compare_check;

typedef struct compare_options {
    double mean_tolerance;       /* of the ratio of means, relative */
    double variance_tolerance;   /* of the ratio of block variances, relative */
    double least_correlation;    /* of a pair that shows the same facets */
    double exact_mean_tolerance; /* its ratio of means */
    bool exact;                  /* the pair is said to show the same facets */
} compare_options;

/* What Blender references are held to. */
#define COMPARE_OPTIONS_INIT                                                                                           \
    {                                                                                                                  \
        0.02, 0.2, 0.995, 0.005, false                                                                                 \
    }

typedef struct compare_result {
    int width, height;
    uint64_t pixels;             /* compared; those where both pictures are empty are left out */
    uint64_t a_broken, b_broken; /* pixels with NaN or infinity, left out too */
    bool has_smooth;             /* the background is a smooth picture; else means over squares of 4 blocks by 4 */
    bool exact;                  /* both show the same facets, by their own look or by the options */
    compare_ratio mean[COMPARE_CHANNELS];
    double rms_difference; /* of luminance, over A's mean luminance */
    double correlation;    /* of luminance */
    double most_difference;
    int most_x, most_y;
    compare_block block[COMPARE_BLOCKS];
    int block_count;
    double a_quantile[COMPARE_QUANTILES], b_quantile[COMPARE_QUANTILES];
    double distance; /* Kolmogorov and Smirnov's, of the distributions of luminance */
    uint64_t a_bin[COMPARE_BINS], b_bin[COMPARE_BINS];
    compare_spot spot[COMPARE_SPOTS];
    double frequency[COMPARE_RINGS]; /* cycles per pixel */
    double a_power[COMPARE_RINGS], b_power[COMPARE_RINGS];
    int ring_count; /* 0: the picture is too small or has too many holes */
    compare_check check[COMPARE_CHECKS];
    int check_count;
    compare_outcome outcome; /* the worst */
} compare_result;

extern const double compare_quantile_shares[COMPARE_QUANTILES];
extern const double compare_spot_thresholds[COMPARE_SPOTS];

/* Both pictures need R, G, B (or Y), the same size and a pixel that is not empty. smooth.R, .G, .B of either are its
 * background. Names are for messages. */
bool compare_pictures(const image *a, const char *a_name, const image *b, const char *b_name,
                      const compare_options *options, compare_result *result, report *r);

/* One self-contained HTML page: the pictures with a wipe, and the result as tables and plots. json is the document of
 * glint compare --json. Written beside its name and renamed. */
bool compare_write_page(const char *path, const image *a, const image *b, const char *json, report *r);

#endif
