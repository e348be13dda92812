/* PNG files for tests, written without a library, so that a reader is tested against an independent writer. */
#ifndef SUPPORT_PNG_FILE_H
#define SUPPORT_PNG_FILE_H

#include <stddef.h>
#include <stdint.h>

/* 8-bit RGBA, row 0 on top, at most 65535 bytes of pixels and row starts. Free the result. */
uint8_t *png_file(const uint8_t *rgba, int width, int height, size_t *byte_count);

#endif
