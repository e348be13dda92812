/* PNG files for tests, written without a library, so that a reader is tested against an independent writer. */
#ifndef SUPPORT_PNG_FILE_H
#define SUPPORT_PNG_FILE_H

#include <stddef.h>
#include <stdint.h>

typedef struct bytes {
    uint8_t *data; /* free it */
    size_t size;
} bytes;

/* PNG colour types. */
enum { PNG_GREY = 0, PNG_RGB = 2, PNG_GREY_ALPHA = 4, PNG_RGBA = 6 };

/* A PNG of interleaved samples of 8 or 16 bits (the high byte first), row 0 on top, without compression. */
bytes png_make(uint32_t width, uint32_t height, int bit_depth, int color_type, const uint8_t *samples);
/* A PNG that ends after a header with this size. */
bytes png_header(uint32_t width, uint32_t height);

/* 8-bit RGBA. Free the result. */
uint8_t *png_file(const uint8_t *rgba, int width, int height, size_t *byte_count);

#endif
