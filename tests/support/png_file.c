/* The least PNG: one chunk of pixels in one block that is not compressed. */
#include "png_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *checked(void *memory)
{
    if (memory == NULL) {
        fputs("png_file: no memory\n", stderr);
        abort();
    }
    return memory;
}

typedef struct bytes {
    uint8_t *data;
    size_t count;
} bytes;

static void put(bytes *b, const void *data, size_t count)
{
    if (count == 0)
        return;
    b->data = checked(realloc(b->data, b->count + count));
    memcpy(b->data + b->count, data, count);
    b->count += count;
}

static void put_u32(bytes *b, uint32_t v)
{
    const uint8_t big[4] = { (uint8_t)(v >> 24), (uint8_t)(v >> 16), (uint8_t)(v >> 8), (uint8_t)v };
    put(b, big, sizeof big);
}

static uint32_t crc32_of(const uint8_t *data, size_t count)
{
    uint32_t crc = 0xffffffffU;
    for (size_t i = 0; i < count; ++i) {
        crc ^= data[i];
        for (int k = 0; k < 8; ++k)
            crc = (crc >> 1) ^ ((crc & 1U) ? 0xedb88320U : 0U);
    }
    return ~crc;
}

static void put_chunk(bytes *png, const char *type, const bytes *content)
{
    put_u32(png, (uint32_t)content->count);
    const size_t start = png->count;
    put(png, type, 4);
    put(png, content->data, content->count);
    put_u32(png, crc32_of(png->data + start, png->count - start));
}

/* One stored block (RFC 1951, 3.2.4) of at most 65535 bytes in a zlib frame (RFC 1950). */
static bytes stored(const bytes *raw)
{
    bytes z = { 0 };
    const uint16_t n = (uint16_t)raw->count;
    const uint8_t head[7] = { 0x78, 0x01, 0x01, (uint8_t)n, (uint8_t)(n >> 8), (uint8_t)~n, (uint8_t)(~n >> 8) };
    put(&z, head, sizeof head);
    put(&z, raw->data, raw->count);
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < raw->count; ++i) {
        a = (a + raw->data[i]) % 65521U;
        b = (b + a) % 65521U;
    }
    put_u32(&z, (b << 16) | a);
    return z;
}

uint8_t *png_file(const uint8_t *rgba, int width, int height, size_t *byte_count)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    static const uint8_t depth8_rgba[5] = { 8, 6, 0, 0, 0 };
    bytes png = { 0 }, header = { 0 }, raw = { 0 };
    const bytes none = { 0 };
    put(&png, signature, sizeof signature);
    put_u32(&header, (uint32_t)width);
    put_u32(&header, (uint32_t)height);
    put(&header, depth8_rgba, sizeof depth8_rgba);
    put_chunk(&png, "IHDR", &header);
    for (int y = 0; y < height; ++y) {
        put(&raw, "", 1); /* filter 0 */
        put(&raw, rgba + (size_t)y * (size_t)width * 4, (size_t)width * 4);
    }
    bytes z = stored(&raw);
    put_chunk(&png, "IDAT", &z);
    put_chunk(&png, "IEND", &none);
    free(header.data);
    free(raw.data);
    free(z.data);
    *byte_count = png.count;
    return png.data;
}
