/* Tiles become a picture: each is copied to its place, and a map remembers which tile a pixel came from. */
#include "io/image_merge.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "io/image_bytes.h"

typedef struct merging {
    const char *const *paths;
    image *out;
    uint32_t *owner; /* of each pixel: 1 + the number of its tile, 0: none yet */
} merging;

static bool read_tile(const char *path, image *tile, report *r)
{
    *tile = (image){ 0 };
    const char *format = image_file_format(path, r);
    if (!format)
        return false;
    if (strcmp(format, "openexr") != 0)
        return report_error(
            r, "%s: found a picture of the format %s, which does not say where it lies, expected an OpenEXR file", path,
            format);
    if (!image_read(path, tile, r))
        return false;
    if (tile->full_width == 0) {
        tile->full_width = tile->width;
        tile->full_height = tile->height;
    }
    if (tile->x >= 0 && tile->y >= 0 && tile->width <= tile->full_width - tile->x &&
        tile->height <= tile->full_height - tile->y)
        return true;
    return report_error(r, "%s: found %dx%d pixels from %d,%d on, expected a part of its %dx%d pixels", path,
                        tile->width, tile->height, tile->x, tile->y, tile->full_width, tile->full_height);
}

static bool begin(merging *m, const image *tile, report *r)
{
    if (!image_allocate(m->out, tile->full_width, tile->full_height, tile->channel_count, r))
        return false;
    for (int c = 0; c < tile->channel_count; ++c)
        if (!image_name_channel(m->out, c, tile->channel_names[c], m->paths[0], r))
            return false;
    m->owner = calloc((size_t)m->out->width * (size_t)m->out->height, sizeof *m->owner);
    return m->owner ? true : report_error(r, "%s: the picture of this tile does not fit into memory", m->paths[0]);
}

static bool check_size(const merging *m, int number, const image *tile, report *r)
{
    if (tile->full_width == m->out->width && tile->full_height == m->out->height)
        return true;
    return report_error(r, "%s: is part of a picture of %dx%d pixels, expected the %dx%d of %s", m->paths[number],
                        tile->full_width, tile->full_height, m->out->width, m->out->height, m->paths[0]);
}

/* Where each channel of the picture is in the tile. */
static bool match_channels(const merging *m, int number, const image *tile, int *places, report *r)
{
    for (int c = 0; c < tile->channel_count; ++c)
        if (image_channel(m->out, tile->channel_names[c]) < 0)
            return report_error(r, "%s: has a channel \"%s\", expected the channels of %s", m->paths[number],
                                tile->channel_names[c], m->paths[0]);
    for (int c = 0; c < m->out->channel_count; ++c) {
        places[c] = image_channel(tile, m->out->channel_names[c]);
        if (places[c] < 0)
            return report_error(r, "%s: has no channel \"%s\", expected the channels of %s", m->paths[number],
                                m->out->channel_names[c], m->paths[0]);
    }
    return true;
}

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The bits decide: NaN agrees with itself. */
static bool check_overlap(const merging *m, int number, size_t at, const float *pixel, report *r)
{
    const image *out = m->out;
    const float *there = &out->pixels[at * (size_t)out->channel_count];
    for (int c = 0; c < out->channel_count; ++c)
        if (bits_of(there[c]) != bits_of(pixel[c]))
            return report_error(r, "%s: %s of pixel %zu,%zu is %.9g, expected the %.9g of %s", m->paths[number],
                                out->channel_names[c], at % (size_t)out->width, at / (size_t)out->width,
                                (double)pixel[c], (double)there[c], m->paths[m->owner[at] - 1]);
    return true;
}

static bool copy_tile(merging *m, int number, const image *tile, const int *places, float *pixel, report *r)
{
    const size_t channels = (size_t)m->out->channel_count;
    for (int y = 0; y < tile->height; ++y) {
        for (int x = 0; x < tile->width; ++x) {
            const size_t from = (size_t)y * (size_t)tile->width + (size_t)x;
            const size_t at = (size_t)(tile->y + y) * (size_t)m->out->width + (size_t)(tile->x + x);
            for (size_t c = 0; c < channels; ++c)
                pixel[c] = tile->pixels[from * channels + (size_t)places[c]];
            if (m->owner[at] == 0)
                memcpy(&m->out->pixels[at * channels], pixel, channels * sizeof *pixel);
            else if (!check_overlap(m, number, at, pixel, r))
                return false;
            m->owner[at] = (uint32_t)number + 1;
        }
    }
    return true;
}

static bool place_tile(merging *m, int number, const image *tile, report *r)
{
    int *places = calloc((size_t)m->out->channel_count, sizeof *places);
    float *pixel = calloc((size_t)m->out->channel_count, sizeof *pixel);
    bool done = places && pixel;
    if (!done)
        report_error(r, "%s: does not fit into memory", m->paths[number]);
    done = done && match_channels(m, number, tile, places, r) && copy_tile(m, number, tile, places, pixel, r);
    free(places);
    free(pixel);
    return done;
}

/* Names the part that is missing, as --tile wants it: from the first pixel as wide, then as high, as the gap goes. */
static bool check_whole(const merging *m, report *r)
{
    const size_t width = (size_t)m->out->width, count = width * (size_t)m->out->height;
    size_t first = 0;
    while (first < count && m->owner[first] != 0)
        ++first;
    if (first == count)
        return true;
    size_t missing = 0, wide = 0, high = 0;
    for (size_t at = first; at < count; ++at)
        missing += m->owner[at] == 0;
    while (first % width + wide < width && m->owner[first + wide] == 0)
        ++wide;
    for (bool empty = true; empty && first + high * width < count;) {
        for (size_t x = 0; empty && x < wide; ++x)
            empty = m->owner[first + high * width + x] == 0;
        high += empty;
    }
    return report_error(
        r, "%s: %zu of the %dx%d pixels of its picture are in no tile, such as %zu,%zu,%zu,%zu (x, y, width, height)",
        m->paths[0], missing, m->out->width, m->out->height, first % width, first / width, wide, high);
}

static bool merge(merging *m, int count, report *r)
{
    for (int i = 0; i < count; ++i) {
        image tile;
        const bool done = read_tile(m->paths[i], &tile, r) && (m->owner || begin(m, &tile, r)) &&
                          check_size(m, i, &tile, r) && place_tile(m, i, &tile, r);
        image_free(&tile);
        if (!done)
            return false;
    }
    return m->owner ? check_whole(m, r) : report_error(r, "there are no tiles to merge");
}

bool image_merge(const char *const *paths, int count, image *out, report *r)
{
    *out = (image){ 0 };
    merging m = { .paths = paths, .out = out };
    const bool done = merge(&m, count, r);
    free(m.owner);
    if (!done)
        image_free(out);
    return done;
}
