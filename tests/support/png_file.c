/* The PNG text (ISO/IEC 15948) with stored deflate blocks (RFC 1951) in a zlib frame (RFC 1950) needs no library. */
#include "png_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(bytes *b, const void *data, size_t size)
{
    b->data = realloc(b->data, b->size + size + 1);
    if (!b->data) {
        fputs("png_file: no memory\n", stderr);
        abort();
    }
    if (size)
        memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void append_u32(bytes *b, uint32_t value)
{
    const uint8_t big_endian[4] = { (uint8_t)(value >> 24), (uint8_t)(value >> 16), (uint8_t)(value >> 8),
                                    (uint8_t)value };
    append(b, big_endian, 4);
}

static uint32_t crc32_of(const uint8_t *data, size_t size)
{
    uint32_t crc = 0xFFFFFFFFU;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int k = 0; k < 8; k++)
            crc = (crc >> 1) ^ (crc & 1U ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

static void append_chunk(bytes *b, const char *type, const bytes *content)
{
    append_u32(b, (uint32_t)content->size);
    const size_t start = b->size;
    append(b, type, 4);
    append(b, content->data, content->size);
    append_u32(b, crc32_of(b->data + start, b->size - start));
}

static bytes zlib_stored(const bytes *raw)
{
    bytes z = { 0 };
    append(&z, "\x78\x01", 2);
    uint32_t a = 1;
    uint32_t s = 0;
    size_t done = 0;
    do {
        const size_t left = raw->size - done;
        const size_t n = left < 65535 ? left : 65535;
        const uint8_t block[5] = { n == left, (uint8_t)n, (uint8_t)(n >> 8), (uint8_t)~n, (uint8_t)(~n >> 8) };
        append(&z, block, 5);
        append(&z, raw->data + done, n);
        for (size_t i = 0; i < n; i++) {
            a = (a + raw->data[done + i]) % 65521U;
            s = (s + a) % 65521U;
        }
        done += n;
    } while (done < raw->size);
    append_u32(&z, s << 16 | a);
    return z;
}

static bytes png_start(uint32_t width, uint32_t height, int bit_depth, int color_type)
{
    bytes png = { 0 };
    bytes header = { 0 };
    append(&png, "\x89PNG\r\n\x1a\n", 8);
    append_u32(&header, width);
    append_u32(&header, height);
    const uint8_t rest[5] = { (uint8_t)bit_depth, (uint8_t)color_type, 0, 0, 0 };
    append(&header, rest, 5);
    append_chunk(&png, "IHDR", &header);
    free(header.data);
    return png;
}

bytes png_header(uint32_t width, uint32_t height)
{
    return png_start(width, height, 8, PNG_RGB);
}

bytes png_make(uint32_t width, uint32_t height, int bit_depth, int color_type, const uint8_t *samples)
{
    static const size_t channel_counts[7] = { 1, 0, 3, 0, 2, 0, 4 };
    const size_t row_size = width * channel_counts[color_type] * (size_t)bit_depth / 8;
    bytes raw = { 0 };
    for (uint32_t y = 0; y < height; y++) {
        append(&raw, "", 1); /* the row's filter: none */
        append(&raw, samples + y * row_size, row_size);
    }
    bytes png = png_start(width, height, bit_depth, color_type);
    bytes z = zlib_stored(&raw);
    append_chunk(&png, "IDAT", &z);
    append_chunk(&png, "IEND", &(bytes){ 0 });
    free(raw.data);
    free(z.data);
    return png;
}

uint8_t *png_file(const uint8_t *rgba, int width, int height, size_t *byte_count)
{
    const bytes png = png_make((uint32_t)width, (uint32_t)height, 8, PNG_RGBA, rgba);
    *byte_count = png.size;
    return png.data;
}
