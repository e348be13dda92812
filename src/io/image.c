/* The memory of a picture and the names of its channels. */
#include "io/image.h"

#include <stdlib.h>
#include <string.h>

bool image_allocate(image *out, int width, int height, int channel_count, report *r)
{
    *out = (image){ 0 };
    if (width < 1 || height < 1 || channel_count < 1)
        return report_error(r, "a picture of %d x %d pixels with %d channels: expected at least one of each", width,
                            height, channel_count);
    size_t value_count;
    size_t byte_count;
    if (__builtin_mul_overflow((size_t)width, (size_t)height, &value_count) ||
        __builtin_mul_overflow(value_count, (size_t)channel_count, &value_count) ||
        __builtin_mul_overflow(value_count, sizeof *out->pixels, &byte_count))
        return report_error(r, "a picture of %d x %d pixels with %d channels has more bytes than can be counted", width,
                            height, channel_count);
    float *pixels = calloc(value_count, sizeof *pixels);
    char(*names)[32] = calloc((size_t)channel_count, sizeof *names);
    if (!pixels || !names) {
        free(pixels);
        free(names);
        return report_error(r, "a picture of %d x %d pixels with %d channels does not fit into memory: %.1f GiB", width,
                            height, channel_count, (double)byte_count / 0x1p30);
    }
    *out = (image){
        .width = width, .height = height, .channel_count = channel_count, .channel_names = names, .pixels = pixels
    };
    return true;
}

void image_free(image *i)
{
    free(i->channel_names);
    free(i->pixels);
    *i = (image){ 0 };
}

int image_channel(const image *i, const char *name)
{
    for (int c = 0; c < i->channel_count; c++)
        if (strcmp(i->channel_names[c], name) == 0)
            return c;
    return -1;
}

bool image_name_channel(image *i, int channel, const char *name, const char *path, report *r)
{
    const size_t room = sizeof *i->channel_names;
    const size_t length = strlen(name);
    if (length >= room)
        return report_error(r, "%s: the channel name \"%s\" has %zu bytes, expected at most %zu", path, name, length,
                            room - 1);
    memcpy(i->channel_names[channel], name, length + 1);
    return true;
}

bool image_check_names(const image *i, const char *path, report *r)
{
    for (int c = 0; c < i->channel_count; c++) {
        if (i->channel_names[c][0] == '\0')
            return report_error(r, "%s: channel %d has no name", path, c);
        if (image_channel(i, i->channel_names[c]) != c)
            return report_error(r, "%s: two channels are called \"%s\"", path, i->channel_names[c]);
    }
    return true;
}
