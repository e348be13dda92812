/* The metadata of one kind of file each; image_read_metadata chooses by the first bytes. */
#ifndef IO_IMAGE_METADATA_H
#define IO_IMAGE_METADATA_H

#include "io/image.h"

#ifdef __cplusplus
extern "C" {
#endif

bool image_exr_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r);
bool image_png_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r);

#ifdef __cplusplus
}
#endif

#endif
