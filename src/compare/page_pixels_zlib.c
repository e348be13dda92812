/* Pixels for a web page, on zlib. */
#include "compare/page_pixels.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* The nearest half float; of two, the even one. NaN stays NaN, what is too large becomes infinite. */
static uint16_t half_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint16_t sign = (uint16_t)(bits >> 16 & 0x8000U);
    const uint32_t size = bits & 0x7fffffffU;
    if (size > 0x7f800000U)
        return (uint16_t)(sign | 0x7e00U);
    if (size >= 0x477ff000U) /* 65520 and more round beyond the largest half */
        return (uint16_t)(sign | 0x7c00U);
    if (size < 0x38800000U) { /* below 2^-14 the steps are even, 2^-24 each: adding 1/2 rounds to them */
        float small;
        memcpy(&small, &size, sizeof small);
        small += 0.5F;
        uint32_t steps;
        memcpy(&steps, &small, sizeof steps);
        return (uint16_t)(sign | (uint16_t)(steps - 0x3f000000U));
    }
    const uint32_t odd = size >> 13 & 1U;
    return (uint16_t)(sign | (uint16_t)((size - 0x38000000U + 0xfffU + odd) >> 13));
}

static char *base64(const uint8_t *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc((count + 2) / 3 * 4 + 1), *end = text;
    for (size_t i = 0; text && i < count; i += 3) {
        const uint32_t left = (uint32_t)(count - i), three = (uint32_t)bytes[i] << 16 |
                                                             (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0U) |
                                                             (left > 2 ? (uint32_t)bytes[i + 2] : 0U);
        *end++ = digits[three >> 18];
        *end++ = digits[three >> 12 & 63U];
        *end++ = left > 1 ? digits[three >> 6 & 63U] : '=';
        *end++ = left > 2 ? digits[three & 63U] : '=';
    }
    if (text)
        *end = '\0';
    return text;
}

char *page_pixels(const image *i, const pair_colors *colors)
{
    const size_t count = (size_t)i->width * (size_t)i->height;
    uint8_t *const plain = malloc(count * 6);
    uLongf packed_size = compressBound(count * 6);
    uint8_t *const packed = malloc(packed_size);
    char *text = NULL;
    if (plain && packed) {
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < count; ++k) {
                const uint16_t half = half_of(i->pixels[k * (size_t)i->channel_count + (size_t)colors->channel[c]]);
                plain[c * count + k] = (uint8_t)half;
                plain[(3 + c) * count + k] = (uint8_t)(half >> 8);
            }
        if (compress2(packed, &packed_size, plain, count * 6, 6) == Z_OK)
            text = base64(packed, packed_size);
    }
    free(plain);
    free(packed);
    return text;
}
