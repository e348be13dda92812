/* Pictures whose statistics are known. */
#ifndef TESTS_COMPARE_PICTURES_H
#define TESTS_COMPARE_PICTURES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "compare/compare.h"
#include "statistics.h"

/* Channels by names with blanks between: "R G B A". */
static inline image picture(int width, int height, const char *channels)
{
    int count = 1;
    for (const char *c = channels; *c; ++c)
        count += *c == ' ';
    image i;
    report r = { 0 };
    if (!image_allocate(&i, width, height, count, &r))
        fail_msg("%s", r.error);
    for (int c = 0; c < count; ++c) {
        const size_t length = strcspn(channels, " ");
        memcpy(i.channel_names[c], channels, length);
        channels += length + (channels[length] == ' ');
    }
    return i;
}

static inline float *pixel(const image *i, int x, int y)
{
    return i->pixels + ((size_t)y * (size_t)i->width + (size_t)x) * (size_t)i->channel_count;
}

static inline void set_grey(const image *i, int x, int y, double value)
{
    for (int c = 0; c < 3; ++c)
        pixel(i, x, y)[c] = (float)value;
}

/* The sum of twelve uniforms: mean 0, variance 1, and a kurtosis of 2.9. */
static inline double random_normal(uint64_t *random)
{
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
        sum += random_uniform(random);
    return sum;
}

/* Grey noise of this mean and deviation. */
static inline image noise(int side, double mean, double deviation, uint64_t seed)
{
    image i = picture(side, side, "R G B");
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            set_grey(&i, x, y, mean + deviation * random_normal(&seed));
    return i;
}

static inline compare_result compare(const image *a, const image *b)
{
    const compare_options options = COMPARE_OPTIONS_INIT;
    compare_result result;
    report r = { 0 };
    if (!compare_pictures(a, "a.exr", b, "b.exr", &options, &result, &r))
        fail_msg("%s", r.error);
    return result;
}

#endif
