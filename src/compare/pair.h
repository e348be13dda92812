/* Two pictures side by side: which pixels are compared, their luminance, their background. */
#ifndef COMPARE_PAIR_H
#define COMPARE_PAIR_H

#include "compare/compare.h"

enum { PAIR_A, PAIR_B };

/* Indices of R, G and B; three times the same in a grey picture. */
typedef struct pair_colors {
    int channel[3];
} pair_colors;

typedef struct pair {
    int width, height;
    const image *picture[2];
    pair_colors colors[2];
    bool *compared;       /* of each pixel */
    float *luminance[2];  /* 0 where a pixel is not compared */
    float *background[2]; /* luminance of the smooth picture; NULL without any */
    uint64_t pixels, broken[2];
} pair;

/* "R", "G", "B", or those of a layer of Blender's ("View Layer.Combined.R"), or "Y". */
bool pair_find_colors(const image *i, const char *name, pair_colors *out, report *r);
bool pair_make(pair *p, const image *a, const char *a_name, const image *b, const char *b_name, report *r);
void pair_free(pair *p);

static inline size_t pair_index(const pair *p, int x, int y)
{
    return (size_t)y * (size_t)p->width + (size_t)x;
}

static inline float pair_color(const pair *p, int which, size_t pixel, int color)
{
    const image *i = p->picture[which];
    return i->pixels[pixel * (size_t)i->channel_count + (size_t)p->colors[which].channel[color]];
}

/* The parts of a result, each in the file of its name. False: no memory, *r says so. */
bool means_measure(const pair *p, compare_result *result, report *r);
bool blocks_measure(const pair *p, compare_result *result, report *r);
bool distribution_measure(const pair *p, compare_result *result, report *r);
bool spots_measure(const pair *p, compare_result *result, report *r);
bool spectrum_measure(const pair *p, compare_result *result, report *r);
void verdict_find(const compare_options *options, compare_result *result);

#endif
