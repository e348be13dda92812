/* Pictures and texture lookups. OpenImageIO reads and looks up, and is loaded when first needed (image_engine.h);
 * libpng and OpenEXR write. */
#ifndef IO_IMAGE_H
#define IO_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pictures that the tools make ---- */

/* Float pixels with named channels, interleaved, row 0 on top. Light is linear, and R, G, B are multiplied by A
 * (coverage), as OpenEXR has it. */
typedef struct image {
    int width, height, channel_count;
    char (*channel_names)[32]; /* "R", "smooth.G", "glints.N" */
    float *pixels;
    /* Where it lies in a larger picture, pixels from the upper left of that; full_width 0: it is all there is. */
    int x, y, full_width, full_height;
} image;

/* Pixels of 0 and empty names. Sizes below 1, and those that memory cannot hold, are errors; *out is then zeroed. */
bool image_allocate(image *out, int width, int height, int channel_count, report *r);
void image_free(image *i);
/* The index of a channel, or -1. */
int image_channel(const image *i, const char *name);
/* A name that is longer than 31 bytes is an error that names path. */
bool image_name_channel(image *i, int channel, const char *name, const char *path, report *r);
/* Every channel has a name of its own; if not, an error that names path. */
bool image_check_names(const image *i, const char *path, report *r);

/* OpenEXR, Radiance HDR, TIFF, PNG, JPEG or WebP; the first picture of a file. Float files come as they are; what
 * stores 8 or 16-bit integers is taken for sRGB with straight alpha and decoded. Channels may come in another order
 * than they were written in: look them up. A part of a larger picture says where it lies. */
bool image_read(const char *path, image *out, report *r);

typedef struct image_text {
    const char *key, *value;
} image_text; /* metadata */

/* OpenEXR, float32, ZIP, every channel under its name. A part of a larger picture is the data window in the display
 * window of the whole. The file appears under its name only when it is whole. */
bool image_write_exr(const char *path, const image *i, const image_text *metadata, size_t metadata_count, report *r);
/* R, G, B (and A) as 8-bit sRGB after 2^exposure_ev, with straight alpha; values above 1 clip, NaN is black. Atomic,
 * too. */
bool image_write_png(const char *path, const image *i, float exposure_ev, report *r);
bool image_write_png_with_metadata(const char *path, const image *i, float exposure_ev, const image_text *metadata,
                                   size_t metadata_count, report *r);

/* Visits the texts in the metadata of an OpenEXR file or a PNG, in no order. Pixels are not read, but a file that ends
 * too early is broken, which is an error, as a file of another kind is. */
bool image_read_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r);

/* Data, as a texture of normals is: RGB, row 0 on top, no colour space; the file has 8 or 16 bits. Atomic, too. */
bool image_write_data_png(const char *path, int width, int height, int bits, const uint16_t *rgb, report *r);

/* ---- textures ---- */

typedef struct textures textures; /* all images of a scene, with mip levels, shared by all threads */

/* Opens and decodes every image that a material uses, once as colour and once as data where it is used as both. A
 * missing or broken one is an error that names it. PNG, JPEG and WebP, at most 16384 pixels on a side and 2^26 in all.
 */
bool textures_open(const scene *s, textures **out, report *r);
/* NULL is allowed. */
void textures_close(textures *t);

/* Filtered lookup: s, t are the texture coordinates before KHR_texture_transform (which is applied here, derivatives
 * too), ds/dx ... their change per pixel; (0, 0) is the upper left corner. Colours come linear. Missing channels: alpha
 * 1, grey is spread to RGB; no texture is 1 everywhere. Finite whatever the coordinates are. No allocation after a
 * thread's first call. The result does not depend on threads or on earlier lookups. */
void texture_lookup(const textures *t, const scene_texture *which, float s, float t_, float dsdx, float dtdx,
                    float dsdy, float dtdy, float rgba[4]);

#ifdef __cplusplus
}
#endif

#endif
