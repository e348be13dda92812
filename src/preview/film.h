/* The picture under way: means over the samples of each pixel. */
#ifndef PREVIEW_FILM_H
#define PREVIEW_FILM_H

#include "io/image.h"
#include "preview/integrator.h"

/* An image with the channels of preview_render. */
bool film_make(image *out, int width, int height, bool aov, report *r);

/* Sums over the samples of one pixel, in double precision and in the order of the samples. */
typedef struct film_pixel {
    double rgba[4], smooth[3], facet_count, lit_probability, normal[3], albedo[3], depth;
    uint32_t samples, hits;
} film_pixel;

void film_add(film_pixel *pixel, const pixel_sample *sample);
/* x, y: within the image. Different pixels may be written by different threads. */
void film_write(image *film, int x, int y, const film_pixel *pixel);

#endif
