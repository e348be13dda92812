/* Files and folders that the tests of pictures make: PNGs byte by byte, without the library under test. */
#ifndef TESTS_IMAGE_FILES_H
#define TESTS_IMAGE_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct bytes {
    uint8_t *data;
    size_t size;
} bytes;

/* PNG colour types. */
enum { PNG_GREY = 0, PNG_RGB = 2, PNG_GREY_ALPHA = 4, PNG_RGBA = 6 };

/* A PNG whose samples (interleaved, 16-bit ones with the high byte first) are stored without compression. */
bytes png_make(uint32_t width, uint32_t height, int bit_depth, int color_type, const uint8_t *samples);
/* A PNG that ends after a header with this size. */
bytes png_header(uint32_t width, uint32_t height);

bytes file_read(const char *path);
void file_write(const char *path, const void *data, size_t size);

/* A new empty folder; folder_remove takes its files with it. */
char *folder_make(void);
void folder_remove(char *folder);
int folder_count(const char *folder);
/* "folder/name" in one of a few static buffers. */
const char *folder_path(const char *folder, const char *name);

#endif
