/* Between a picture of light and the bytes that a screen or a PNG shows. */
#include "io/image_srgb.h"

#include <math.h>

#include "io/srgb.h"

static size_t pixel_count_of(const image *i)
{
    return (size_t)i->width * (size_t)i->height;
}

void image_from_srgb(image *i, int alpha_channel)
{
    const size_t pixel_count = pixel_count_of(i);
    for (size_t p = 0; p < pixel_count; p++) {
        float *pixel = i->pixels + p * (size_t)i->channel_count;
        const double alpha = alpha_channel >= 0 ? (double)pixel[alpha_channel] : 1.0;
        for (int c = 0; c < i->channel_count; c++)
            if (c != alpha_channel)
                pixel[c] = (float)(srgb_decode((double)pixel[c]) * alpha);
    }
}

/* The nearest byte to a fraction, NaN counting as 0. */
static uint8_t byte_of(double fraction)
{
    return (uint8_t)lrint(fmin(fmax(fraction, 0.0), 1.0) * 255.0);
}

static uint8_t encoded_byte(double linear)
{
    return byte_of(srgb_encode(fmin(fmax(linear, 0.0), 1.0)));
}

bool image_to_srgb(const image *i, float exposure_ev, uint8_t *bytes)
{
    const int r = image_channel(i, "R"), g = image_channel(i, "G"), b = image_channel(i, "B"),
              a = image_channel(i, "A");
    if (r < 0 || g < 0 || b < 0)
        return false;
    const double gain = exp2((double)exposure_ev);
    const size_t pixel_count = pixel_count_of(i);
    for (size_t p = 0; p < pixel_count; p++) {
        const float *pixel = i->pixels + p * (size_t)i->channel_count;
        const double alpha = a < 0 ? 1.0 : (double)pixel[a];
        /* Light without coverage (a glow on nothing) has no straight colour; it is kept as it is. */
        const double straight = alpha > 0.0 ? gain / alpha : gain;
        *bytes++ = encoded_byte((double)pixel[r] * straight);
        *bytes++ = encoded_byte((double)pixel[g] * straight);
        *bytes++ = encoded_byte((double)pixel[b] * straight);
        if (a >= 0)
            *bytes++ = byte_of(alpha);
    }
    return true;
}
