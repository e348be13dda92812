/* The picture under way: means over the samples of each pixel. */
#ifndef PREVIEW_FILM_H
#define PREVIEW_FILM_H

#include "io/image.h"
#include "preview/integrator.h"

/* An image with the channels of preview_render, as large as the part of the picture that the options ask for. */
bool film_of_options(const preview_options *o, image *out, report *r);

/* Sums over the samples of one pixel, in double precision and in the order of the samples. */
typedef struct film_pixel {
    double rgba[4], smooth[3], facet_count, lit_probability, normal[3], albedo[3], depth;
    uint32_t samples, hits;
} film_pixel; /* the sums are in the order of the channels */

/* described: all of the sample, not only light and alpha. */
void film_add(film_pixel *pixel, const pixel_sample *sample, bool described);
bool film_is_described(const image *film);
/* x, y: within the image. Different pixels may be written by different threads. */
void film_write(image *film, int x, int y, const film_pixel *pixel);

/* ---- a picture that grows: the sums of all its pixels ---- */

typedef struct film_sums {
    int width, channel_count;
    double *sums;     /* channel_count a pixel */
    uint32_t *counts; /* 2 a pixel: samples and hits */
} film_sums;

bool film_sums_make(film_sums *out, const image *film, report *r);
void film_sums_free(film_sums *s);
void film_sums_load(const film_sums *s, int x, int y, film_pixel *pixel);
void film_sums_store(const film_sums *s, int x, int y, const film_pixel *pixel);

#endif
