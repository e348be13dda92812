/* A texture in memory: 16-bit texels at every resolution from the file's own down to one texel. */
#ifndef IO_MIPMAP_H
#define IO_MIPMAP_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/report.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What 16 bits hold. Data keep even spacing, so that 8-bit and 16-bit files are exact; linear colours need fine steps
 * near black, where sRGB has them, so they are half floats (rounding 2^-11 of the value at most, above 6e-5). */
typedef enum mipmap_coding { MIPMAP_UNORM16, MIPMAP_HALF } mipmap_coding;

#define MIPMAP_SIDE_MAX 16384                 /* what GPUs that glTF is made for can hold */
#define MIPMAP_PIXELS_MAX (UINT64_C(1) << 26) /* 8192 x 8192: 683 MiB with four channels and all levels */
#define MIPMAP_LEVELS_MAX 15                  /* 16384 = 2^14 */

typedef struct mipmap_level {
    int width, height;
    uint16_t *texels; /* interleaved, row 0 on top */
} mipmap_level;

typedef struct mipmap {
    int channel_count; /* 1 (grey), 3 or 4 */
    mipmap_coding coding;
    int level_count;
    mipmap_level levels[MIPMAP_LEVELS_MAX]; /* every one half as wide and high as the one before, rounded down */
} mipmap;

/* Room for all levels; sizes beyond the limits are errors that name the image. The coding is MIPMAP_UNORM16. */
bool mipmap_allocate(mipmap *out, int width, int height, int channel_count, const char *name, report *r);
void mipmap_free(mipmap *m);
/* Allocates and fills level 0 with a picture as its file (PNG, JPEG or WebP) or the scene stores it; in image_engine.c.
 * On failure *out may hold memory, too. */
bool mipmap_decode(const scene_image *picture, mipmap *out, report *r);

/* The same for a picture that the scene holds as texels. */
bool mipmap_copy(const scene_image *picture, mipmap *out, report *r);

/* Level 0 has grey and alpha in the first two of four channels: makes them RGBA. */
void mipmap_spread_grey(mipmap *m);

/* Turns level 0 from sRGB in MIPMAP_UNORM16 into linear MIPMAP_HALF; alpha is linear in both. False without memory. */
bool mipmap_decode_srgb(mipmap *m);

/* Computes all other levels from level 0: every texel is the exact mean of the area that it covers. */
void mipmap_build(mipmap *m);

#ifdef __cplusplus
}
#endif

#endif
