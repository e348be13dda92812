/* Puts the tiles of a picture together. */
#ifndef IO_IMAGE_MERGE_H
#define IO_IMAGE_MERGE_H

#include "io/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The picture that OpenEXR files are parts of, every pixel and every channel with the bits of its tile. Where tiles
 * overlap they must agree; a gap, tiles of another size or with other channels, and files that do not say where they
 * lie, are errors that name the file. On failure *out is zeroed. */
bool image_merge(const char *const *paths, int count, image *out, report *r);

#ifdef __cplusplus
}
#endif

#endif
