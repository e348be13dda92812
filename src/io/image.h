/* Image files and filtered texture lookups. OpenImageIO does the work; image_oiio.cpp is the only file that includes it. */
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

/* Float pixels with named channels, interleaved, row 0 on top. */
typedef struct image {
    int width, height, channel_count;
    char (*channel_names)[32]; /* "R", "smooth.G", "glints.N" */
    float *pixels;
} image;

bool image_allocate(image *out, int width, int height, int channel_count, report *r);
void image_free(image *i);
bool image_read(const char *path, image *out, report *r);

typedef struct image_text { const char *key, *value; } image_text; /* metadata */

/* Scene-linear float32 OpenEXR with all channels. The file appears under its name only when it is whole. */
bool image_write_exr(const char *path, const image *i, const image_text *metadata, size_t metadata_count, report *r);
/* R, G, B (and A) as 8-bit sRGB after 2^exposure_ev; values above 1 clip. */
bool image_write_png(const char *path, const image *i, float exposure_ev, report *r);

/* ---- textures ---- */

typedef struct textures textures; /* all images of a scene, with mip levels, shared by all threads */

/* Opens every image that a material uses; a missing or broken one is an error that names it. s must outlive the result. */
bool textures_open(const scene *s, textures **out, report *r);
void textures_close(textures *t);

/* Filtered lookup: s, t are the texture coordinates before KHR_texture_transform (which is applied here, derivatives too),
 * ds/dx ... their change per pixel. Colours come linear. Missing channels: alpha 1, grey is spread to RGB.
 * No allocation after a thread's first call. The result does not depend on threads or on earlier lookups. */
void texture_lookup(const textures *t, const scene_texture *which, float s, float t_, float dsdx, float dtdx, float dsdy,
                    float dtdy, float rgba[4]);

#ifdef __cplusplus
}
#endif

#endif
