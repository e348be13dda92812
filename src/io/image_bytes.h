/* Encoded images: which format they are in, and the bytes of one that a scene uses, wherever they lie. */
#ifndef IO_IMAGE_BYTES_H
#define IO_IMAGE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* OpenImageIO's name for the format of a picture, by its first bytes and not by its name: OpenEXR, Radiance HDR, TIFF,
 * PNG, JPEG or WebP. NULL after an error, also for what is not a regular file. */
const char *image_file_format(const char *path, report *r);

#define IMAGE_BYTES_MAX ((size_t)1 << 30) /* beyond the largest texture there may be, uncompressed */

typedef struct image_bytes {
    const uint8_t *bytes;
    size_t byte_count;
    const char *format; /* "png", "jpeg" or "webp" */
    uint8_t *owned;     /* NULL where the bytes belong to the scene */
} image_bytes;

/* Reads the file where the scene does not hold the bytes. What cannot be read, is empty or in another format is an
 * error that names the image. */
bool image_bytes_load(const scene_image *image, image_bytes *out, report *r);
void image_bytes_free(image_bytes *b);

#ifdef __cplusplus
}
#endif

#endif
