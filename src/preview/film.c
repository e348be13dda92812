/* Channels of the film, and the mean that goes into them. */
#include "preview/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const CHANNELS[] = {
    "R",        "G",        "B",        "A",        "smooth.R", "smooth.G", "smooth.B", "glints.N",
    "glints.p", "normal.X", "normal.Y", "normal.Z", "albedo.R", "albedo.G", "albedo.B", "depth.Z",
};
#define PICTURE_CHANNELS 4
#define ALL_CHANNELS 16

bool film_of_options(const preview_options *o, image *out, report *r)
{
    const bool whole = o->tile_width == 0;
    if (!image_allocate(out, whole ? o->width : o->tile_width, whole ? o->height : o->tile_height,
                        o->aov ? ALL_CHANNELS : PICTURE_CHANNELS, r))
        return false;
    for (int c = 0; c < out->channel_count; ++c)
        snprintf(out->channel_names[c], sizeof out->channel_names[c], "%s", CHANNELS[c]);
    return true;
}

static void add(double *sums, const float *values, int count)
{
    for (int i = 0; i < count; ++i)
        sums[i] += (double)values[i];
}

bool film_is_described(const image *film)
{
    return film->channel_count > PICTURE_CHANNELS;
}

void film_add(film_pixel *pixel, const pixel_sample *sample, bool described)
{
    ++pixel->samples;
    add(pixel->rgba, sample->light.discrete, 3);
    add(&pixel->rgba[3], &sample->alpha, 1);
    if (!described)
        return;
    add(pixel->smooth, sample->light.smooth, 3);
    add(&pixel->facet_count, &sample->facet_count, 1);
    add(&pixel->lit_probability, &sample->lit_probability, 1);
    add(pixel->normal, sample->normal, 3);
    add(pixel->albedo, sample->albedo, 3);
    add(&pixel->depth, &sample->depth, 1);
    if (sample->depth > 0.0F)
        ++pixel->hits;
}

static float *put(float *to, const double *sums, int count, uint32_t samples)
{
    for (int i = 0; i < count; ++i)
        *to++ = samples > 0 ? (float)(sums[i] / samples) : 0.0F;
    return to;
}

void film_write(image *film, int x, int y, const film_pixel *pixel)
{
    const uint32_t n = pixel->samples;
    float *to = &film->pixels[((size_t)y * (size_t)film->width + (size_t)x) * (size_t)film->channel_count];
    to = put(to, pixel->rgba, 4, n);
    if (!film_is_described(film))
        return;
    to = put(to, pixel->smooth, 3, n);
    to = put(to, &pixel->facet_count, 1, n);
    to = put(to, &pixel->lit_probability, 1, n);
    to = put(to, pixel->normal, 3, n);
    to = put(to, pixel->albedo, 3, n);
    put(to, &pixel->depth, 1, pixel->hits);
}

bool film_sums_make(film_sums *out, const image *film, report *r)
{
    const size_t pixels = (size_t)film->width * (size_t)film->height;
    *out = (film_sums){ .width = film->width, .channel_count = film->channel_count };
    out->sums = calloc(pixels * (size_t)film->channel_count, sizeof *out->sums);
    out->counts = calloc(2 * pixels, sizeof *out->counts);
    if (out->sums != NULL && out->counts != NULL)
        return true;
    film_sums_free(out);
    return report_error(r, "no memory for the sums of %d x %d pixels", film->width, film->height);
}

void film_sums_free(film_sums *s)
{
    free(s->sums);
    free(s->counts);
    *s = (film_sums){ 0 };
}

static size_t place_of(const film_sums *s, int x, int y)
{
    return (size_t)y * (size_t)s->width + (size_t)x;
}

/* The sums come first in a film_pixel, in the order of the channels. */
void film_sums_load(const film_sums *s, int x, int y, film_pixel *pixel)
{
    const size_t at = place_of(s, x, y);
    memcpy(pixel, &s->sums[at * (size_t)s->channel_count], (size_t)s->channel_count * sizeof *s->sums);
    pixel->samples = s->counts[2 * at];
    pixel->hits = s->counts[2 * at + 1];
}

void film_sums_store(const film_sums *s, int x, int y, const film_pixel *pixel)
{
    const size_t at = place_of(s, x, y);
    memcpy(&s->sums[at * (size_t)s->channel_count], pixel, (size_t)s->channel_count * sizeof *s->sums);
    s->counts[2 * at] = pixel->samples;
    s->counts[2 * at + 1] = pixel->hits;
}
